// The usual triangle, many at once: one that needs no clipping and spans few pixels.
#pragma once

#include <cstdint>
#include <vector>

#include "frame/geometry.h"

namespace facet {

// The outermost samples of a pixel, in fx8 from its corner: they bound which triangles can cover one at all.
struct SampleReach {
  int low_x, high_x, low_y, high_y;
};

SampleReach ReachOf(int samples);

// The largest extent of a small triangle: twice its area fits 32 bits.
inline constexpr std::int32_t kSmallTriangle_fx8 = (1 << 15) - 1;

// A run of a drawable's triangles.
struct TriangleRun {
  const FrameDrawable* drawable = nullptr;
  const ScreenVertex* vertices = nullptr;  // the drawable's
  const std::uint32_t* corners = nullptr;  // three indices into `vertices` a triangle
  std::uint32_t drawable_index = 0;
  std::uint32_t first_primitive = 0, count = 0;
  SampleReach reach{};
};

struct SmallTriangles {
  std::uint32_t taken = 0;  // triangles of the run, from its start
  std::uint32_t culled = 0, rejected = 0;  // of those taken
};

// Sets up triangles of the run from its start on, group by group, up to the first group that holds one which is neither
// small nor outside the view. Appends to `records` those that can be seen, in their order. The others are outside the
// view (rejected), or have no area, show a hidden face or lie between samples (culled).
SmallTriangles SetUpSmallTriangles(const TriangleRun& run, std::vector<TriangleRecord>& records);

// How many triangles at most are a group.
inline constexpr std::uint32_t kTriangleGroup = 16;

}  // namespace facet
