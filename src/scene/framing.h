// Where a camera has to stand to see the whole scene.
#pragma once

#include "scene/pose.h"

namespace facet {

// Unit vectors of a camera at rest in world space.
struct CameraAxes {
  glm::dvec3 right, up, back;
};

// Of all points of a scene, seen from far away along -axes.back: how far they reach to each side. A point at (x, y, z)
// from the target is inside the picture of an eye at distance d when |x| <= tan_x * (d - z) and |y| <= tan_y * (d - z),
// so the largest x + tan_x * z decides how far the right edge has to be, and so on.
struct ViewExtent {
  double right, left, top, bottom;  // of x + tan_x z, -x + tan_x z, y + tan_y z, -y + tan_y z
  double nearest;                   // of z
};

// Over the vertices of all drawables, or the corners of the bounds where there is none. Not finite ones are skipped.
// Runs in parallel; the result does not depend on it.
ViewExtent MeasureView(const PosedScene& posed, const glm::dvec3& target, const CameraAxes& axes, double tan_x,
                       double tan_y);

}  // namespace facet
