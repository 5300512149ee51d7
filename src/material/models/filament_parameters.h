// The parameters of the model "filament": one row each.
#pragma once

#include <type_traits>

#include "material/models/row.h"

namespace facet {

template <class Visit>
constexpr void ForEachRow(std::type_identity<FilamentParameters>, const Visit& visit) {
  using P = FilamentParameters;
  visit(Row("baseColor", &P::base_color, "the colour of diffuse reflection, or of a metal; alpha is coverage"));
  visit(Row("metallic", &P::metallic, "from a dielectric to a metal"));
  visit(Row("roughness", &P::roughness, "perceptual roughness"));
  visit(Row("normal", &P::normal, "of the surface", {.range = kAnyNumber, .feature = Feature::NormalTexture}));
  visit(Row("ambientOcclusion", &P::ambient_occlusion, "the share of ambient light that arrives",
            {.feature = Feature::Occlusion}));
  visit(Row("emissive", &P::emissive, "light that the surface emits; alpha is the weight of the exposure",
            {.range = kNotNegative, .unit = "cd/m2", .feature = Feature::Emission}));
}

// The features that the parameters make visible, besides the textures.
inline MaterialFeatures FeaturesOf(const FilamentParameters& p) { return glm::vec3(p.emissive.value) != glm::vec3(0.0f) ? kEmission : MaterialFeatures{0}; }

}  // namespace facet
