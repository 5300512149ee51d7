// How light passes a surface at one point, for the rays of the reference.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "light/punctual.h"
#include "reference/albedo_exact.h"
#include "reference/material_exact.h"
#include "reference/radiance_exact.h"
#include "reference/surface_exact.h"

namespace facet {

// World axes. Vectors are unit, and the normals are on the side that the view comes from.
struct ExactInterface {
  glm::dvec3 view{0.0};         // towards where the light goes
  glm::dvec3 normal{0.0};       // shading
  glm::dvec3 flat_normal{0.0};  // of the triangle
  double alpha = 0.0;           // GGX's width of the microfacets; 0: smooth
  glm::dvec3 ior{1.0};          // of the medium, for red, green and blue
};

// The surface as a ray meets it that leaves its medium.
ExactInterface ExitAt(const ExactMaterial& material, const SurfacePoint& point);

// The surface where it is entered.
struct ExactEntry {
  ExactInterface at;
  double thin_wall_alpha = 0.0;  // GGX's width of a thin wall: narrower where the indices differ less
  // Of what is seen through it: base colour times transmission, without what is reflected here and by the layers above.
  glm::dvec3 tint{0.0};
  glm::dvec3 absorption{0.0};  // of the medium, per metre
  double thickness = 0.0;      // of the medium as stated, in metres
  // The light of punctual lights behind the surface that passes it, by the closure's lobe: not traced.
  glm::dvec3 punctual{0.0};
};
ExactEntry EntryAt(const ExactMaterial& material, const glm::dvec3& base_color, const SurfacePoint& point,
                   const ExactLight& light);

// A way on through a thin wall: a sample of the reflection with Fresnel 1 and multiple scattering between microfacets,
// mirrored to the back. The mean of `weight` is 1.
struct ThinWallSample {
  glm::dvec3 direction{0.0};
  double weight = 1.0;
};
ThinWallSample PassThinWall(const ExactEntry& entry, const AlbedoSurface& albedos, const glm::dvec2& random,
                            double choice);

// The normal of a microfacet, in proportion to its area as the view sees it; that of the surface if it is smooth.
glm::dvec3 SampleFacet(const ExactInterface& at, const glm::dvec2& random);

// Snell's law. `incident`: unit, against the normal's side; `ratio`: the index on that side over the one beyond. None
// where all is reflected.
std::optional<glm::dvec3> Refracted(const glm::dvec3& incident, const glm::dvec3& normal, double ratio);
glm::dvec3 Reflected(const glm::dvec3& incident, const glm::dvec3& normal);

// The direction, mirrored by the triangle's plane if it is on the other side: a shading normal must not send light
// where the triangle stands in its way.
glm::dvec3 Beyond(const ExactInterface& at, const glm::dvec3& direction);  // away from the view
glm::dvec3 Before(const ExactInterface& at, const glm::dvec3& direction);  // on its side

}  // namespace facet
