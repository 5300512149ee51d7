// Conversions of a primitive's topology and vertex arrays.
#pragma once

#include <cstdint>
#include <vector>

#include "facet/scene.h"

namespace facet {

// The corners of the triangles, three each, of a primitive of triangles, a strip or a fan; in the order and winding of
// the glTF 2.0 specification, section 3.7.2.1. Corners left over are dropped.
std::vector<std::uint32_t> TriangleCorners(const Primitive& primitive);

// Makes `primitive`, which must be of triangles in any form, a list of triangles with indices.
void MakeTriangleList(Primitive& primitive);

// Rewrites all vertex arrays so that new vertex i is a copy of old vertex source[i]. Does not change the indices.
void GatherVertices(const std::vector<std::uint32_t>& source, Primitive& primitive);

// Makes flat normals: every corner of every triangle gets its own vertex with the triangle's geometric normal (+Z for a
// triangle without area). Tangents are dropped. The primitive, of triangles in any form, becomes a list without
// indices.
void MakeFlat(Primitive& primitive);

}  // namespace facet
