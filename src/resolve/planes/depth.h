// The plane `depth`: distance along the camera's axis.
#pragma once

#include <limits>

#include "resolve/planes/plane_tile.h"

namespace facet {

// Computed from the depth of the depth test, so that comparing distances agrees with visibility: 1 / depth, by IEEE
// 754's division, for a perspective camera, and -depth (0 without a sign) for an orthographic one.
inline void WriteDepth(const PlaneTile& t) {
  constexpr float kNothing = std::numeric_limits<float>::infinity();
  const float* depth = t.seen.tile.depth.data();
  if (t.seen.view.perspective) {
    WritePixels(t, kNothing, [depth](std::size_t sample) { return 1.0f / depth[sample]; });
  } else {
    WritePixels(t, kNothing, [depth](std::size_t sample) { return 0.0f - depth[sample]; });
  }
}

}  // namespace facet
