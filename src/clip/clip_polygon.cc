#include "clip/clip_polygon.h"

#include <algorithm>

#include "frame/constants.h"

namespace facet {
namespace {

// inside: dot(normal, position) + offset >= 0
struct Plane {
  OutcodeBit bit;
  glm::dvec3 normal;
  double offset;
};

// The planes in the order in which they are applied: near first, so that later ones see positive distances only.
int MakePlanes(const FrameView& view, std::int32_t outcodes, Plane* planes) {
  const double cx = view.width * 0.5, cy = view.height * 0.5, g = kGuardBand;
  const auto guard = [&](OutcodeBit bit, double sx, double sy, double bound) {
    // sign * coordinate <= bound * w, with w = distance or 1
    return view.perspective ? Plane{bit, {-sx, -sy, bound}, 0.0} : Plane{bit, {-sx, -sy, 0.0}, bound};
  };
  const Plane all[] = {
      {kOutNear, {0.0, 0.0, 1.0}, -view.near_distance},
      {kOutFar, {0.0, 0.0, -1.0}, view.far_distance},
      guard(kOutGuardLeft, -1.0, 0.0, g - cx),
      guard(kOutGuardRight, 1.0, 0.0, g + cx),
      guard(kOutGuardTop, 0.0, -1.0, g - cy),
      guard(kOutGuardBottom, 0.0, 1.0, g + cy),
  };
  int count = 0;
  for (const Plane& plane : all) {
    // A plane that no vertex lies beyond stays uncrossed: what other planes make lies on edges between the vertices.
    if ((outcodes & plane.bit) != 0) planes[count++] = plane;
  }
  return count;
}

double Side(const Plane& plane, const ClipVertex& v) {
  const double side = glm::dot(plane.normal, v.position) + plane.offset;
  return (v.outcode & plane.bit) == 0 && side < 0.0 ? 0.0 : side;
}

ClipVertex Cut(const FrameView& view, const ClipVertex& inner, double d_inner, const ClipVertex& outer,
               double d_outer) {
  const double t = d_inner / (d_inner - d_outer);
  ClipVertex cut{inner.position + (outer.position - inner.position) * t, -1};
  // Beside a corner 1e16 times as far away, the near plane's distance is lost in rounding.
  if (view.perspective && cut.position.z < 0.5 * view.near_distance) cut.position.z = view.near_distance;
  return cut;
}

}  // namespace

int ClipPolygon(const FrameView& view, std::int32_t outcodes, ClipVertex* vertices, int count) {
  Plane planes[6];
  const int plane_count = MakePlanes(view, outcodes, planes);
  ClipVertex next[kMaxClipVertices + 1];
  for (int p = 0; p < plane_count && count >= 3; ++p) {
    int kept = 0;
    for (int i = 0; i < count; ++i) {
      const ClipVertex& a = vertices[i];
      const ClipVertex& b = vertices[i + 1 == count ? 0 : i + 1];
      const double da = Side(planes[p], a), db = Side(planes[p], b);
      if (da >= 0.0 && kept < kMaxClipVertices) next[kept++] = a;
      if ((da >= 0.0) != (db >= 0.0) && kept < kMaxClipVertices) {
        next[kept++] = da >= 0.0 ? Cut(view, a, da, b, db) : Cut(view, b, db, a, da);
      }
    }
    count = kept;
    std::copy(next, next + kept, vertices);
  }
  return count >= 3 ? count : 0;
}

int ClipLine(const FrameView& view, std::int32_t outcodes, ClipVertex* vertices) {
  Plane planes[6];
  const int plane_count = MakePlanes(view, outcodes, planes);
  for (int p = 0; p < plane_count; ++p) {
    const double da = Side(planes[p], vertices[0]), db = Side(planes[p], vertices[1]);
    if (da < 0.0 && db < 0.0) return 0;
    if (da < 0.0) vertices[0] = Cut(view, vertices[1], db, vertices[0], da);
    if (db < 0.0) vertices[1] = Cut(view, vertices[0], da, vertices[1], db);
  }
  return 2;
}

}  // namespace facet
