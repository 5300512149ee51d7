// Numbers that more than one stage must agree on: fixed point, blocks, sample positions.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

namespace facet {

// --- Fixed point -----------------------------------------------------------------------------------------------------
// Screen positions are snapped to 1/256 pixel ("fx8"), x to the right and y down, origin at the picture's top left
// corner. Pixel (i, j) has its centre at (i + 1/2, j + 1/2).
inline constexpr int kSubpixelBits = 8;
inline constexpr int kSubpixelScale = 1 << kSubpixelBits;

// Pictures reach 2^14 pixels. Triangles are clipped to a guard band of 2^14 pixels around the picture's centre, so that
// snapped positions stay within 3/2 * 2^14 pixels of the origin, and two of them differ by at most 2^15 pixels.
inline constexpr int kMaxPictureSize = 1 << 14;
inline constexpr int kGuardBand = 1 << 14;  // pixels, from the centre
inline constexpr std::int64_t kMaxDelta_fx8 = std::int64_t{2 * kGuardBand} << kSubpixelBits;  // of an edge

// --- Blocks -------------------------------------------------------------------------------------------------------------
// Coverage is decided in blocks of 8 x 8 pixels, with 64-bit edge functions at the block's corner and 32-bit ones inside;
// for triangles of few pixels, where they are set up (TriangleRecord::covered).
inline constexpr int kBlockSize = 8;
inline constexpr int kBlockPixels = kBlockSize * kBlockSize;

// Samples lie on a grid of 1/16 pixel. Inside a block an edge function is a * x + b * y + c with x and y in sixteenths,
// |a|, |b| <= kMaxDelta_fx8 and 0 <= x, y < 128. Where it is not of one sign over the whole block, its absolute value is
// below 2 * kMaxDelta_fx8 * 128, which must fit 32 bits:
inline constexpr int kSampleGrid = 16;
static_assert(kMaxDelta_fx8 * (kBlockSize * kSampleGrid - 1) * 2 <= std::int64_t{INT32_MAX},
              "32-bit edge functions overflow inside a block");
// At the block's corner it is a product of two differences of snapped positions, with room to spare in 64 bits:
static_assert((kMaxDelta_fx8 * 2) * (kMaxDelta_fx8 * 2) < INT64_MAX / 4, "64-bit edge functions overflow");

// --- Depth ----------------------------------------------------------------------------------------------------------
// The least distance of a perspective view, and the most of an orthographic one: a depth, 1 / distance or -distance, is
// no larger than kMostDistance, so that it and its rates over the screen, extrapolated over a triangle and a block, are
// floats. Rates are kept below kSteepestDepth where a triangle may be larger than small_triangles.h has it.
inline constexpr double kLeastDistance = 1e-28, kMostDistance = 1.0 / kLeastDistance;
inline constexpr double kSteepestDepth = 1e33;  // per pixel
static_assert(kMostDistance + 2.0 * kSteepestDepth * (2 * kGuardBand + kBlockSize) <
              double{std::numeric_limits<float>::max()});

// --- Planes -------------------------------------------------------------------------------------------------------------
// Interpolation planes are rounded to float relative to an anchor: the pixel's position with its low six bits cleared.
// It does not depend on the tile's size, so neither do the bits of the picture; tiles lie within one anchor's square.
inline constexpr int kAnchorSize = 64;
inline constexpr int kMaxTileSize = kAnchorSize;

// --- Samples ------------------------------------------------------------------------------------------------------------
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

// The outermost samples of a pixel, in fx8 from its corner.
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

// A triangle that spans the samples of no more than `side` x `side` pixels is known by what it covers, in one number.
struct CoverageSquare {
  int side;
  int stride_bits;  // of pixels from one row to the next in that number
};

constexpr CoverageSquare CoverageSquareOf(int samples) {
  return samples <= 2 ? CoverageSquare{3, 2} : CoverageSquare{2, 1};
}

// The first column (row) of pixels with a sample at or after a position; `high`: the reach's.
constexpr std::int32_t FirstPixel(std::int32_t from_fx8, int high) {
  return (from_fx8 + kSubpixelScale - 1 - high) >> kSubpixelBits;
}

}  // namespace facet
