// Generation of tangents for normal maps.
#pragma once

#include "facet/scene.h"

namespace facet {

// Gives `primitive`, of triangles in any form and with normals, tangents for `normal_map`: xyz unit and along
// increasing u, w the sign s in bitangent = s * cross(normal, tangent), which points along decreasing v (up in the
// image), where u and v are the coordinates the map is read at, those of its UV set after its KHR_texture_transform.
// Triangle strips and fans become lists. A vertex whose triangles need different tangents is split: the first stays,
// copies are appended, indices follow. Without that UV set the tangents are any that are perpendicular to the normal,
// with w = 1.
//
// The result agrees with MikkTSpace, on which the bakers of normal maps have settled, to the rounding of its floats
// (below 0.01 degrees on models that are not degenerate). It deviates where MikkTSpace gives no usable tangent: these
// tangents are always unit and perpendicular to the normal, and corners whose directions are exactly opposite never
// cancel (unless more than 256 corners share a tangent). Takes O(n log n) time for n corners of any mesh. Source:
// Mikkelsen 2008, Simulation of wrinkled surfaces revisited (thesis, University of Copenhagen), chapter 3 and appendix
// A; glTF 2.0 specification, section 3.7.2.1, which turns its v around.
void MakeTangents(const TextureRef& normal_map, Primitive& primitive);

}  // namespace facet
