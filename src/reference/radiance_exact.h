// The material under all the light of a scene, by integration.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "light/punctual.h"
#include "reference/albedo_exact.h"
#include "reference/environment_exact.h"
#include "reference/material_exact.h"
#include "reference/sample_sequence.h"
#include "reference/surface_exact.h"

namespace facet {

struct ExactLight {
  const std::vector<PunctualLight>& punctual;
  const ExactEnvironment* environment;  // may be null
  const AlbedoSurface& albedos;
  std::uint32_t environment_samples;  // see ReferenceSettings
};

// Which random numbers an estimate uses: pairs [pair, pair + kPairsOfRadiance) of the sequence, points
// [index, index + environment_samples).
inline constexpr std::uint32_t kPairsOfRadiance = 5;
struct SampleRun {
  const SampleSequence& sequence;
  std::uint32_t pair, index;
};

// Radiance towards the eye. Emission and punctual lights are exact. The environment's share is an unbiased estimate by
// multiple importance sampling (Veach and Guibas, 1995, Optimally Combining Sampling Techniques for Monte Carlo
// Rendering: balance heuristic) of the environment's luminance, of the visible normals of the specular lobe and of the
// clear coat (Heitz, 2018, Sampling the GGX Distribution of Visible Normals; by Dupuy and Benyoub, 2023, Sampling
// Visible GGX Normals with Spherical Caps) and of the cosine, on both sides where the surface transmits diffusely.
//
// Of the model's limits, kMinPerceptualRoughness holds for the environment as well: what is smoother reflects it in a
// lobe 0.2 degrees wide, where the rasterizer shows a mirror. `base_color`: the material's at this point.
glm::dvec3 RadianceTowardEye(const ExactMaterial& material, const glm::dvec3& base_color, const SurfacePoint& point,
                             const ExactLight& light, const SampleRun& run);

// The same for a material whose model is not glTF's.
glm::dvec3 RadianceOfOwnModel(const ExactMaterial& material, const glm::dvec3& base_color, const SurfacePoint& point,
                              const ExactLight& light, const SampleRun& run);

}  // namespace facet
