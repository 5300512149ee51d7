// Welding: finds vertices that are the same point of a surface, and triangles that share an edge.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "facet/scene.h"

namespace facet {

// For each vertex of `primitive` the first vertex with the same position, normal and UV (-0 equals +0). `uvs` has as
// many entries as there are positions and normals.
std::vector<std::uint32_t> WeldVertices(const Primitive& primitive, const std::vector<glm::vec2>& uvs);

constexpr std::uint32_t kNoFace = 0xFFFFFFFFu;

// For each corner of a list of triangles the triangle on the other side of the edge from that corner to the next one
// of its triangle, or kNoFace. Only triangles that run along the edge in opposite directions are neighbours; where
// there are more than two, they are paired in the order of the list. Those whose `skipped` is not 0 have no neighbours.
// `corners` hold welded vertices, below `vertex_count`.
std::vector<std::uint32_t> FindNeighbors(const std::vector<std::uint32_t>& corners,
                                         const std::vector<std::uint8_t>& skipped, std::size_t vertex_count);

}  // namespace facet
