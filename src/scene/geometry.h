// Changes of how a primitive's vertices are laid out.
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

// Rewrites every vertex array so that new vertex i is a copy of old vertex source[i]. Indices are left alone.
void GatherVertices(const std::vector<std::uint32_t>& source, Primitive& primitive);

// Gives every corner of every triangle a vertex of its own, and the triangle's geometric normal; tangents are dropped.
// A triangle without area gets +Z. Needs a primitive of triangles in any form; makes it a list without indices.
void MakeFlat(Primitive& primitive);

}  // namespace facet
