// The parameters of the model "lecture": one row each.
#pragma once

#include <type_traits>

#include "material/models/row.h"

namespace facet {

template <class Visit>
constexpr void ForEachRow(std::type_identity<LectureParameters>, const Visit& visit) {
  using P = LectureParameters;
  visit(Row("albedo", &P::albedo, "the colour of diffuse reflection, or of a metal"));
  visit(Row("metalness", &P::metalness, "from a dielectric to a metal"));
  visit(Row("roughness", &P::roughness, "of the microfacets"));
  visit(Row("normal", &P::normal, "of the surface", {.range = kAnyNumber, .feature = Feature::NormalTexture}));
  visit(Row("ao", &P::ambient_occlusion, "the share of ambient light that arrives", {.feature = Feature::Occlusion}));
  visit(Row("emission", &P::emission, "light that the surface emits",
            {.range = kNotNegative, .unit = "cd/m2", .feature = Feature::Emission}));
}

// The features that the parameters make visible, besides the textures.
inline MaterialFeatures FeaturesOf(const LectureParameters& p) { return p.emission.value != glm::vec3(0.0f) ? kEmission : MaterialFeatures{0}; }

}  // namespace facet
