#include "material/features.h"

#include "material/models/models.h"
#include "material/slots.h"

namespace facet {

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
  const auto shows = [&](const SlotInfo& slot) {
    return (model.texture_slots & BitOf(slot.slot)) != 0 && (lit || !slot.needs_light) && slot.is_visible(m);
  };
  for (const FactorFeature& factor : kFactorFeatures) set(shows(InfoOf(factor.slot)), factor.bit);
  for (const SlotInfo& slot : kSlots) set(bool(m.*slot.ref) && shows(slot), BitOf(slot.slot));
  const bool is_metal = m.metallic_factor == 1.0f && (features & BitOf(Slot::MetallicRoughness)) == 0;
  set(lit && !is_metal, kDiffuseLobe);
  return features;
}

}  // namespace facet
