// Clipping of one convex polygon or one line in homogeneous screen space.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "frame/geometry.h"

namespace facet {

// A vertex on its way through the clipper.
struct ClipVertex {
  glm::dvec3 position;  // homogeneous screen space: x, y, distance
  int source;           // 0 to 2: the primitive's own vertex, untouched; -1: made by the clipper
  // Of a vertex that the vertex stage has judged: planes that it does not name have the vertex inside, whatever the
  // position says in double. The triangle next to this one may not be clipped and then has the vertex where it was.
  std::int32_t outcode = kOutClip;
};

// A triangle gains at most one vertex at each of six planes.
inline constexpr int kMaxClipVertices = 9;

// Clips `count` vertices in place against those planes that `outcodes` (the union over the vertices) names: near, far,
// guard band. Returns the number of vertices left; 0 when nothing is. Sutherland & Hodgman 1974, "Reentrant Polygon
// Clipping". The cut of an edge is computed from its inner end to its outer one, whichever way the polygon runs through
// it, so that two triangles that share the edge are cut at the same point.
int ClipPolygon(const FrameView& view, std::int32_t outcodes, ClipVertex* vertices, int count);

// The same for a segment: returns 0 or 2.
int ClipLine(const FrameView& view, std::int32_t outcodes, ClipVertex* vertices);

}  // namespace facet
