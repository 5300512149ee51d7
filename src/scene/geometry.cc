#include "scene/geometry.h"

#include <array>
#include <cmath>

#include "scene/topology.h"

namespace facet {
namespace {

template <class T>
void Gather(const std::vector<std::uint32_t>& source, std::vector<T>& values) {
  if (values.empty()) return;
  std::vector<T> gathered(source.size());
  for (std::size_t i = 0; i < source.size(); ++i) gathered[i] = values[source[i]];
  values = std::move(gathered);
}

}  // namespace

std::vector<std::uint32_t> TriangleCorners(const Primitive& primitive) {
  const std::uint32_t count = PrimitiveCount(primitive);
  std::vector<std::uint32_t> corners(std::size_t(count) * 3);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::array<std::uint32_t, 3> triangle = PrimitiveVertices(primitive, i);
    for (std::size_t k = 0; k < 3; ++k) corners[std::size_t(i) * 3 + k] = triangle[k];
  }
  return corners;
}

void MakeTriangleList(Primitive& primitive) {
  primitive.indices = TriangleCorners(primitive);
  primitive.topology = Topology::Triangles;
}

void GatherVertices(const std::vector<std::uint32_t>& source, Primitive& primitive) {
  Gather(source, primitive.positions);
  Gather(source, primitive.normals);
  Gather(source, primitive.tangents);
  for (auto& set : primitive.tex_coords) Gather(source, set);
  Gather(source, primitive.colors);
  for (auto& set : primitive.joints) Gather(source, set);
  for (auto& set : primitive.weights) Gather(source, set);
  for (MorphTarget& target : primitive.targets) {
    Gather(source, target.positions);
    Gather(source, target.normals);
    Gather(source, target.tangents);
    for (auto& set : target.tex_coords) Gather(source, set);
    Gather(source, target.colors);
  }
}

void MakeFlat(Primitive& primitive) {
  primitive.tangents.clear();
  primitive.normals.clear();
  GatherVertices(TriangleCorners(primitive), primitive);
  primitive.topology = Topology::Triangles;
  primitive.indices.clear();
  primitive.normals.resize(primitive.positions.size());
  for (std::size_t i = 0; i + 2 < primitive.positions.size(); i += 3) {
    const glm::dvec3 a(primitive.positions[i]), b(primitive.positions[i + 1]), c(primitive.positions[i + 2]);
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double length = std::sqrt(glm::dot(normal, normal));
    const bool has_area = length > 0.0 && std::isfinite(length);
    for (std::size_t k = 0; k < 3; ++k) {
      primitive.normals[i + k] = has_area ? glm::vec3(normal / length) : glm::vec3(0.0f, 0.0f, 1.0f);
    }
  }
}

}  // namespace facet
