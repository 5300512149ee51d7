// Constants that several stages must agree on: fixed point, blocks, depth, interpolation planes, sample positions.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

namespace facet {

// --- Fixed point ----------------------------------------------------------------------------------------------------
// Screen positions are snapped to 1/256 pixel ("fx8"), x to the right and y down, origin at the image's top left
// corner. Pixel (i, j) has its centre at (i + 1/2, j + 1/2).
inline constexpr int kSubpixelBits = 8;
inline constexpr int kSubpixelScale = 1 << kSubpixelBits;

// Images have at most 2^14 pixels a side. Triangles are clipped to a guard band that reaches 2^14 pixels from the
// image's centre, so snapped positions stay within 3/2 * 2^14 pixels of the origin, and two differ by at most 2^15
// pixels.
inline constexpr int kMaxImageSize = 1 << 14;
inline constexpr int kGuardBand = 1 << 14;  // pixels, from the centre
inline constexpr std::int64_t kMaxDelta_fx8 = std::int64_t{2 * kGuardBand} << kSubpixelBits;  // along an edge

// --- Blocks ---------------------------------------------------------------------------------------------------------
// Coverage is computed in blocks of 8 x 8 pixels, with 64-bit edge functions at the block's corner and 32-bit ones
// inside it. The coverage of triangles of few pixels is computed already when they are set up
// (ScreenTriangle::covered).
inline constexpr int kBlockSize = 8;
inline constexpr int kBlockPixels = kBlockSize * kBlockSize;

// Samples lie on a grid of 1/16 pixel. Inside a block an edge function is a * x + b * y + c with x and y in sixteenths
// of a pixel, |a|, |b| <= kMaxDelta_fx8 and 0 <= x, y < 128. Where an edge crosses the block, the function's absolute
// value is below 2 * kMaxDelta_fx8 * 128, which must fit 32 bits:
inline constexpr int kSampleGrid = 16;
static_assert(kMaxDelta_fx8 * (kBlockSize * kSampleGrid - 1) * 2 <= std::int64_t{INT32_MAX},
              "32-bit edge functions overflow inside a block");
// At the block's corner it is a sum of products of two differences of snapped positions, which must fit 64 bits:
static_assert((kMaxDelta_fx8 * 2) * (kMaxDelta_fx8 * 2) < INT64_MAX / 4, "64-bit edge functions overflow");

// --- Depth ----------------------------------------------------------------------------------------------------------
// Distances from the eye are kept at or above kLeastDistance in perspective views, and at or below kMostDistance in
// orthographic ones. A depth (1 / distance or -distance) is then no larger than kMostDistance, and does not overflow a
// float when it is extrapolated over a triangle and a block. Depth gradients are clamped to kSteepestDepth, except for
// the triangles of small_triangles.h, which are too small to need it.
inline constexpr double kLeastDistance = 1e-28, kMostDistance = 1.0 / kLeastDistance;
inline constexpr double kSteepestDepth = 1e33;  // per pixel
static_assert(kMostDistance + 2.0 * kSteepestDepth * (2 * kGuardBand + kBlockSize) <
              double{std::numeric_limits<float>::max()});

// --- Planes ---------------------------------------------------------------------------------------------------------
// Interpolation planes are stored in float relative to an anchor: the pixel's position with its low six bits cleared. A
// tile always lies within one anchor's square, and the anchor does not depend on the tile size, so the image's bits do
// not depend on it either.
inline constexpr int kAnchorSize = 64;

// --- Samples --------------------------------------------------------------------------------------------------------
inline constexpr int kMaxSamples = 8;

struct SamplePosition {
  std::int8_t x, y;  // sixteenths of a pixel from the pixel's top left corner
};

// The standard patterns of Direct3D 11 and Vulkan (Vulkan 1.3 specification, "Multisampling", standardSampleLocations).
inline constexpr std::array<SamplePosition, 1> kSamples1 = {{{8, 8}}};
inline constexpr std::array<SamplePosition, 2> kSamples2 = {{{12, 12}, {4, 4}}};
inline constexpr std::array<SamplePosition, 4> kSamples4 = {{{6, 2}, {14, 6}, {2, 10}, {10, 14}}};
inline constexpr std::array<SamplePosition, 8> kSamples8 = {
    {{9, 5}, {7, 11}, {13, 9}, {5, 3}, {3, 13}, {1, 7}, {11, 15}, {15, 1}}};

// `samples`: 1, 2, 4 or 8.
constexpr const SamplePosition* SamplePattern(int samples) {
  return samples == 1 ? kSamples1.data() : samples == 2 ? kSamples2.data() : samples == 4 ? kSamples4.data() : kSamples8.data();
}

// The least and largest sample coordinates of a pixel, in fx8 from its top left corner.
struct SampleReach {
  int low_x, high_x, low_y, high_y;
};

constexpr SampleReach ReachOf(int samples) {
  constexpr int kUnit = kSubpixelScale / kSampleGrid;
  const SamplePosition* pattern = SamplePattern(samples);
  SampleReach reach{kSubpixelScale, 0, kSubpixelScale, 0};
  for (int s = 0; s < samples; ++s) {
    const int x = pattern[s].x * kUnit, y = pattern[s].y * kUnit;
    reach.low_x = x < reach.low_x ? x : reach.low_x, reach.high_x = x > reach.high_x ? x : reach.high_x;
    reach.low_y = y < reach.low_y ? y : reach.low_y, reach.high_y = y > reach.high_y ? y : reach.high_y;
  }
  return reach;
}

// Triangles whose samples lie within `side` x `side` pixels store their coverage as one 32-bit mask.
struct CoverageSquare {
  int side;
  int stride_bits;  // log2 of the distance from one row of pixels to the next in the mask, in pixels
};

constexpr CoverageSquare CoverageSquareOf(int samples) {
  return samples <= 2 ? CoverageSquare{3, 2} : CoverageSquare{2, 1};
}

// The first column (or row) of pixels that has a sample at or after a position; `high`: SampleReach::high_x (or
// high_y).
constexpr std::int32_t FirstPixel(std::int32_t from_fx8, int high) {
  return (from_fx8 + kSubpixelScale - 1 - high) >> kSubpixelBits;
}

}  // namespace facet
