// The usual triangle, many at once: one that needs no clipping and spans few pixels.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "frame/constants.h"
#include "frame/geometry.h"

namespace facet {

// What a triangle, its corners clockwise, covers.
struct SampleCoverage {
  bool some;              // false: no sample. Of one beyond CoverageSquareOf() its bounding box alone is asked
  std::uint32_t covered;  // TriangleRecord::covered
};
SampleCoverage CoverageOf(const std::int32_t (&x_fx8)[3], const std::int32_t (&y_fx8)[3], int samples);

// The largest extent of a small triangle: twice its area fits 32 bits.
inline constexpr std::int32_t kSmallTriangle_fx8 = (1 << 15) - 1;
// Its depth is a float wherever a block begins that it touches: two of its depths differ by 2 kMostDistance at most,
// and a rate, of two such differences, is largest where the area is 1 fx8^2.
static_assert(kMostDistance * (1.0 + 2.0 * (4.0 * kSmallTriangle_fx8 * kSubpixelScale) *
                                         (kSmallTriangle_fx8 / double{kSubpixelScale} + kBlockSize)) <
              double{std::numeric_limits<float>::max()});

// A run of a drawable's triangles.
struct TriangleRun {
  const FrameDrawable* drawable = nullptr;
  const ScreenVertex* vertices = nullptr;  // the drawable's
  const std::uint32_t* corners = nullptr;  // three indices into `vertices` a triangle
  std::uint32_t drawable_index = 0;
  std::uint32_t first_primitive = 0, count = 0;
  int samples = 1;
};

struct SmallTriangles {
  std::uint32_t taken = 0;  // triangles of the run, from its start
  std::uint32_t culled = 0, rejected = 0;  // of those taken
};

// Sets up triangles of the run from its start on, group by group, up to the first group that holds one which is neither
// small nor outside the view. Appends to `records` those that can be seen, in their order. The others are outside the
// view (rejected), or have no area, show a hidden face or lie between samples (culled): where a mesh is finer than the
// picture many do, and what covers few samples is set up here once and for all.
SmallTriangles SetUpSmallTriangles(const TriangleRun& run, std::vector<TriangleRecord>& records);

// How many triangles at most are a group.
inline constexpr std::uint32_t kTriangleGroup = 16;

}  // namespace facet
