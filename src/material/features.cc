#include "material/features.h"

#include "material/model_parameters.h"
#include "material/models/models.h"
#include "material/slots.h"

namespace facet {
namespace {

// Whether a parameter shows nothing, whatever its texture says.
bool IsZero(float value) { return value == 0.0f; }
bool IsZero(const glm::vec3& value) { return value == glm::vec3(0.0f); }
bool IsZero(const glm::vec4& value) { return value == glm::vec4(0.0f); }

MaterialFeatures FeaturesOfParameters(const ModelParameters& parameters, bool lit, bool opaque) {
  MaterialFeatures features = 0;
  std::visit(
      [&]<class Block>(const Block& block) {
        features = lit ? FeaturesOf(block) : 0;
        std::size_t row = 0;
        ForEachParameterOf(block, [&]<class Value>(const auto& parameter, const Value& value) {
          const std::size_t slot = SlotNumber<Block>(row++);
          if (parameter.is_coverage ? opaque : !lit && slot != IndexOf(Slot::BaseColor)) return;
          if constexpr (std::is_same_v<Value, TangentSpaceNormal>) {
            if (value.texture) features |= MaterialFeatures{1} << slot;
            if (!value.texture && value.value != glm::vec3(0.0f, 0.0f, 1.0f)) features |= kTangents;
          } else if constexpr (kHasTexture<Value>) {
            if (value.texture && !IsZero(value.value)) features |= MaterialFeatures{1} << slot;
          }
        });
      },
      parameters);
  return features;
}

}  // namespace

MaterialFeatures FeaturesOf(const Material& m, bool on_surface) {
  const ModelInfo& model = InfoOf(m.model);
  const bool lit = model.reads_light && on_surface;
  MaterialFeatures features = 0;
  const auto set = [&features](bool condition, MaterialFeatures bit) {
    if (condition) features |= bit;
  };
  set(m.alpha_mode == AlphaMode::Mask, kAlphaTest);
  set(m.alpha_mode == AlphaMode::Blend, kAlphaBlend);
  set(m.double_sided, kDoubleSided);
  set(lit, kLit);
  if (m.parameters != nullptr)
    return features | FeaturesOfParameters(*m.parameters, lit, m.alpha_mode == AlphaMode::Opaque);
  const auto shows = [&](const auto& row, MaterialFeatures bit) {
    return (model.reads & bit) != 0 && (lit || !row.needs_light) && row.is_visible(m);
  };
  for (const FactorFeature& factor : kFactorFeatures) set(shows(factor, factor.bit), factor.bit);
  for (const SlotInfo& slot : kSlots) set(bool(m.*slot.ref) && shows(slot, BitOf(slot.slot)), BitOf(slot.slot));
  set(lit && !IsMetal(m), kDiffuseLobe);
  return features;
}

}  // namespace facet
