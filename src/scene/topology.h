// The vertices of the n-th triangle, line or point of a primitive.
#pragma once

#include <array>
#include <cstdint>

#include "facet/scene.h"

namespace facet {

enum class PrimitiveClass : std::uint8_t { Points, Lines, Triangles };

constexpr PrimitiveClass ClassOf(Topology topology) {
  switch (topology) {
    case Topology::Points: return PrimitiveClass::Points;
    case Topology::Lines:
    case Topology::LineLoop:
    case Topology::LineStrip: return PrimitiveClass::Lines;
    default: return PrimitiveClass::Triangles;
  }
}

// The number of points, lines or triangles of a primitive, without an incomplete one at the end.
inline std::uint32_t PrimitiveCount(const Primitive& primitive) {
  const std::size_t n = primitive.indices.empty() ? primitive.positions.size() : primitive.indices.size();
  std::size_t count = 0;
  switch (primitive.topology) {
    case Topology::Points: count = n; break;
    case Topology::Lines: count = n / 2; break;
    case Topology::LineLoop: count = n >= 2 ? n : 0; break;
    case Topology::LineStrip: count = n >= 2 ? n - 1 : 0; break;
    case Topology::Triangles: count = n / 3; break;
    case Topology::TriangleStrip:
    case Topology::TriangleFan: count = n >= 3 ? n - 2 : 0; break;
  }
  return static_cast<std::uint32_t>(count);
}

// The vertices of primitive i, in winding order (glTF 2.0 specification, 3.7.2.1; every other triangle of a strip is
// reversed). Unused entries repeat the last vertex.
inline std::array<std::uint32_t, 3> PrimitiveVertices(const Primitive& primitive, std::uint32_t i) {
  const std::size_t n = primitive.indices.empty() ? primitive.positions.size() : primitive.indices.size();
  std::array<std::uint32_t, 3> k{};
  switch (primitive.topology) {
    case Topology::Points: k = {i, i, i}; break;
    case Topology::Lines: k = {2 * i, 2 * i + 1, 2 * i + 1}; break;
    case Topology::LineLoop: {
      const std::uint32_t next = i + 1 == n ? 0 : i + 1;
      k = {i, next, next};
      break;
    }
    case Topology::LineStrip: k = {i, i + 1, i + 1}; break;
    case Topology::Triangles: k = {3 * i, 3 * i + 1, 3 * i + 2}; break;
    case Topology::TriangleStrip: k = {i, i + 1 + (i & 1), i + 2 - (i & 1)}; break;
    case Topology::TriangleFan: k = {i + 1, i + 2, 0}; break;
  }
  if (!primitive.indices.empty()) {
    for (std::uint32_t& v : k) v = primitive.indices[v];
  }
  return k;
}

}  // namespace facet
