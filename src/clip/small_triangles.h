// The fast path for the most common triangles, those that need no clipping and span few pixels: many are set up at
// once.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "frame/constants.h"
#include "frame/geometry.h"

namespace facet {

// The coverage of a triangle whose corners are in clockwise order.
struct SampleCoverage {
  bool some;              // false: none. Beyond CoverageSquareOf(), only the bounding box is tested
  std::uint32_t covered;  // ScreenTriangle::covered
};
SampleCoverage CoverageOf(const std::int32_t (&x_fx8)[3], const std::int32_t (&y_fx8)[3], int samples);

// The largest extent of a small triangle: twice its area fits 32 bits.
inline constexpr std::int32_t kSmallTriangle_fx8 = (1 << 15) - 1;
// Its depth does not overflow a float at the corner of any block that it touches: two of its depths differ by at most 2
// kMostDistance, and a gradient, which comes from two such differences, is largest for an area of 1 fx8^2.
static_assert(kMostDistance * (1.0 + 2.0 * (4.0 * kSmallTriangle_fx8 * kSubpixelScale) *
                                         (kSmallTriangle_fx8 / double{kSubpixelScale} + kBlockSize)) <
              double{std::numeric_limits<float>::max()});

// A run of a drawable's triangles.
struct TriangleRun {
  const FrameDrawable* drawable = nullptr;
  const ScreenVertex* vertices = nullptr;  // of the drawable
  const std::uint32_t* corners = nullptr;  // three indices into `vertices` for each triangle
  std::uint32_t drawable_index = 0;
  std::uint32_t first_primitive = 0, count = 0;
  int samples = 1;
};

struct SmallTriangles {
  std::uint32_t taken = 0;  // how many triangles were processed, from the start of the run
  std::uint32_t culled = 0, rejected = 0;  // how many of these were
};

// Processes triangles of the run from its start on, group by group, up to the first group with a triangle that is
// neither small nor outside the view. Appends the visible ones to `records`, in order. Others are rejected (outside the
// view) or culled (without area, back faces, or between samples, as many are if a mesh is finer than the image). The
// coverage of triangles that span few samples is computed here, so that the raster stage need not do it for each tile.
SmallTriangles SetUpSmallTriangles(const TriangleRun& run, std::vector<ScreenTriangle>& records);

// The maximum number of triangles in a group.
inline constexpr std::uint32_t kTriangleGroup = 16;

}  // namespace facet
