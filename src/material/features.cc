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
  set((model.texture_slots & BitOf(Slot::Emissive)) != 0 && Emits(m), kEmission);
  for (const SlotInfo& slot : kSlots) {
    const bool is_read = (model.texture_slots & BitOf(slot.slot)) != 0 && (lit || !slot.needs_light);
    set(bool(m.*slot.ref) && is_read && slot.is_visible(m), BitOf(slot.slot));
  }
  const bool is_metal = m.metallic_factor == 1.0f && (features & BitOf(Slot::MetallicRoughness)) == 0;
  set(lit && !is_metal, kDiffuseLobe);
  return features;
}

}  // namespace facet
