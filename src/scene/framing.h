// Framing: how far away a camera must be to see the whole scene.
#pragma once

#include <optional>

#include "scene/pose.h"

namespace facet {

// The unit vectors of a camera in world space.
struct CameraAxes {
  glm::dvec3 right, up, back;
};

// How far the points of a scene extend to each side, as seen along -axes.back. A point at (x, y, z) from the target is
// inside the image of an eye at distance d if |x| <= tan_x * (d - z) and |y| <= tan_y * (d - z). The largest x + tan_x
// * z therefore decides how far away the right edge must be, and so on.
struct ViewExtent {
  double right, left, top, bottom;  // maxima of x + tan_x z, -x + tan_x z, y + tan_y z, -y + tan_y z
  double nearest;                   // maximum of z
};

// Measures the vertices of all drawables, or the corners of the bounds if there are none. Positions that are not finite
// are skipped. Runs in parallel; the result does not depend on the number of threads.
ViewExtent MeasureView(const PosedScene& posed, const glm::dvec3& target, const CameraAxes& axes, double tan_x,
                       double tan_y);

// A ball around all vertices in all poses of the chosen animation (sampled from the first key to the last). An orbit
// without a radius keeps it in view, so that the distance of the eye depends neither on the angle nor on the time.
struct OrbitBall {
  glm::dvec3 centre{0.0};
  double radius = 0.0;  // of the bounds where nothing is drawn
};

// The ball of a posed scene. `centre`: none stands for the centre of the bounds over all sampled poses.
OrbitBall MeasureBall(const Scene& scene, const PosedScene& posed, const std::optional<glm::dvec3>& centre);

}  // namespace facet
