// Clipping of one convex polygon or one line in homogeneous screen space.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "frame/geometry.h"

namespace facet {

// A vertex of a polygon that is being clipped.
struct ClipVertex {
  glm::dvec3 position;  // homogeneous screen space: x, y, distance
  int source;           // 0 to 2: an unchanged vertex of the primitive; -1: made by clipping
  // For vertices of the primitive, the outcode of the vertex stage. The vertex counts as inside of all planes that are
  // not in it, whatever the position in double says, so that it agrees with neighbouring triangles that are not
  // clipped.
  std::int32_t outcode = kOutClip;
};

// A triangle gains at most one vertex at each of six planes.
inline constexpr int kMaxClipVertices = 9;

// Clips `count` vertices in place against the planes (near, far, guard band) in `outcodes`, the union over the
// vertices. Returns the number of remaining vertices, which may be 0. Sutherland & Hodgman 1974, "Reentrant Polygon
// Clipping". The intersection with an edge is always computed from its inner end to its outer end, so that two
// triangles that share the edge are cut at the same point.
int ClipPolygon(const FrameView& view, std::int32_t outcodes, ClipVertex* vertices, int count);

// The same for a line segment: returns 0 or 2.
int ClipLine(const FrameView& view, std::int32_t outcodes, ClipVertex* vertices);

}  // namespace facet
