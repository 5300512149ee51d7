#include "plan/unused_features.h"

#include <algorithm>
#include <limits>

#include "material/models/models.h"

namespace facet {
namespace {

// A white texture of one texel, as FramePlan::textures has it; made where it is missing.
int WhiteTexture(TextureRole role, FramePlan& plan) {
  const PlannedTexture white{kWhiteImage, role, false, kRgba, false};
  const auto place = std::find(plan.textures.begin(), plan.textures.end(), white);
  const int index = static_cast<int>(place - plan.textures.begin());
  if (place == plan.textures.end()) plan.textures.push_back(white);
  return index;
}

void UseWhiteTextures(PlannedMaterial& material, FramePlan& plan) {
  FrameMaterial& f = material.frame;
  const ModelInfo& model = InfoOf(f.model);
  for (const FactorFeature& factor : kFactorFeatures) {
    if (factor.is_neutral_at_zero && (model.reads & factor.bit) != 0 && f.Has(kLit)) f.features |= factor.bit;
  }
  for (const SlotInfo& slot : kSlots) {
    const std::size_t i = IndexOf(slot.slot);
    if ((model.reads & BitOf(slot.slot)) == 0) continue;
    if (!slot.white_is_neutral || material.textures[i] >= 0 || (slot.slot != Slot::BaseColor && !f.Has(kLit))) continue;
    if (f.uv_slots == 0) f.uv_slots = 1;  // TEXCOORD_0, zeros where there is none: one texel is the same everywhere
    f.features |= BitOf(slot.slot);
    f.textures[i] = BoundTexture();
    material.textures[i] = WhiteTexture(slot.role, plan);
  }
}

}  // namespace

void UseEverything(const RenderSettings& settings, FramePlan& plan) {
  for (PlannedTexture& texture : plan.textures) texture.emission = false;  // empty cells are read, too
  for (PlannedMaterial& material : plan.materials) UseWhiteTextures(material, plan);
  if (!plan.alpha_test) {
    for (PlannedMaterial& material : plan.materials) {
      FrameMaterial& f = material.frame;
      if (f.alpha_mode != AlphaMode::Opaque) continue;
      f.alpha_mode = AlphaMode::Mask;
      f.factors.alpha_cutoff = -std::numeric_limits<float>::infinity();
      f.features |= kAlphaTest;
      plan.alpha_test = true;
    }
  }
  plan.environment_light |=
      settings.environment.kind != EnvironmentSettings::Kind::None && !settings.without.Has(Feature::EnvironmentLight);
  plan.zero_light = !plan.punctual_lights;
  plan.every_texture = true;
}

}  // namespace facet
