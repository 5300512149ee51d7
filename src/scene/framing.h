// Where a camera has to stand to see the whole scene.
#pragma once

#include <optional>

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

// What an orbit without a radius turns about and keeps in view: a ball around all vertices, in every pose of the
// animation that was chosen (some moments of it, from the first key to the last), so that neither the angle nor the
// time moves the eye nearer or farther.
struct OrbitBall {
  glm::dvec3 centre{0.0};
  double radius = 0.0;  // of the bounds where nothing is drawn
};

// The ball of a scene that is posed. `centre`: none: the centre of the bounds of all those poses.
OrbitBall MeasureBall(const Scene& scene, const PosedScene& posed, const std::optional<glm::dvec3>& centre);

}  // namespace facet
