// The parameters of the model "enterprise": one row each.
#pragma once

#include <type_traits>

#include "material/models/row.h"

namespace facet {

template <class Visit>
constexpr void ForEachRow(std::type_identity<EnterpriseParameters>, const Visit& visit) {
  using P = EnterpriseParameters;
  visit(Row("albedo", &P::albedo, "the colour of diffuse reflection, or of a metal"));
  visit(Row("metallic", &P::metallic, "from a dielectric to a metal"));
  visit(Row("roughness", &P::roughness, "perceptual roughness"));
  visit(Row("normal", &P::normal, "of the surface", {.range = kAnyNumber, .feature = Feature::NormalTexture}));
  visit(Row("cutoutOpacity", &P::cutout_opacity, "coverage", {.is_coverage = true}));
}

// The features that the parameters make visible, besides the textures.
inline MaterialFeatures FeaturesOf(const EnterpriseParameters&) { return 0; }

}  // namespace facet
