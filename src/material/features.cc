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
  const auto shows = [&](const auto& row, MaterialFeatures bit) {
    return (model.reads & bit) != 0 && (lit || !row.needs_light) && row.is_visible(m);
  };
  for (const FactorFeature& factor : kFactorFeatures) set(shows(factor, factor.bit), factor.bit);
  for (const SlotInfo& slot : kSlots) set(bool(m.*slot.ref) && shows(slot, BitOf(slot.slot)), BitOf(slot.slot));
  set(lit && !IsMetal(m), kDiffuseLobe);
  return features;
}

}  // namespace facet
