// The plane `depth`: how far away what is seen is, along the camera's axis.
#pragma once

#include <limits>

#include "resolve/planes/plane_tile.h"

namespace facet {

// Of the depths by which visibility was decided, so that whoever compares them finds what is seen: 1 / depth, rounded
// as IEEE 754 has it, with a perspective camera, and -depth (0 without a sign) with an orthographic one.
inline void WriteDepth(const PlaneTile& t) {
  constexpr float kNothing = std::numeric_limits<float>::infinity();
  const float* depth = t.tile.depth.data();
  if (t.view.perspective) {
    WritePixels(t, kNothing, [depth](std::size_t sample) { return 1.0f / depth[sample]; });
  } else {
    WritePixels(t, kNothing, [depth](std::size_t sample) { return 0.0f - depth[sample]; });
  }
}

}  // namespace facet
