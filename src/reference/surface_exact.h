// A point of a surface, as materials and light see it.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "facet/scene.h"

namespace facet {

// World axes, origin at the eye. Vectors are turned to the viewer's side.
struct SurfacePoint {
  glm::dvec3 position{0.0};
  glm::dvec3 view{0.0, 0.0, 1.0};         // unit, towards the eye
  glm::dvec3 flat_normal{0.0, 0.0, 1.0};  // unit, of the triangle
  glm::dvec3 normal{0.0, 0.0, 1.0};       // unit, interpolated
  // Interpolated and not normalised, as MikkTSpace demands; tangent.w is the handedness.
  glm::dvec3 interpolated_normal{0.0, 0.0, 1.0};
  glm::dvec4 tangent{1.0, 0.0, 0.0, 1.0};
  glm::dvec4 color{1.0};  // of the vertices: linear, straight alpha; 1 where there is none
  double metres_per_unit = 1.0;  // of the mesh; 0 where it is seen from behind, where no volume begins

  // Where on the primitive it lies.
  const Primitive* geometry = nullptr;
  std::array<std::uint32_t, 3> vertex{};
  glm::dvec3 weight{1.0, 0.0, 0.0};  // barycentric

  // Texture coordinates of a set; 0 where the primitive lacks it.
  glm::dvec2 Uv(int set) const {
    const std::size_t s = std::size_t(set);
    if (s >= geometry->tex_coords.size() || geometry->tex_coords[s].empty()) return glm::dvec2(0.0);
    const auto& uv = geometry->tex_coords[s];
    return glm::dvec2(uv[vertex[0]]) * weight.x + glm::dvec2(uv[vertex[1]]) * weight.y +
           glm::dvec2(uv[vertex[2]]) * weight.z;
  }
};

// v / |v|, or `otherwise` where v has no direction.
inline glm::dvec3 UnitOr(const glm::dvec3& v, const glm::dvec3& otherwise) {
  const double largest = glm::max(glm::max(glm::abs(v.x), glm::abs(v.y)), glm::abs(v.z));
  const glm::dvec3 scaled = v / largest;
  const double length = glm::length(scaled);
  return length >= 1.0 && length < 2.0 ? scaled / length : otherwise;  // false for NaN
}

}  // namespace facet
