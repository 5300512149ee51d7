#include "raster/raster_tile.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/raster_tile.cc"
#include "hwy/foreach_target.h"
// Must come after foreach_target.h.
#include "facet/shader/dispatch.h"
#include "facet/shader/lane-inl.h"
#include "frame/edge_function-inl.h"

#ifndef FACET_RASTER_BLOCKS_H_
#define FACET_RASTER_BLOCKS_H_
namespace facet {

// The part of a triangle's bounding box that lies in the tile, in blocks and rows of pixels.
struct BlockRange {
  int x0, y0, x1, y1;       // blocks within the tile, inclusive
  int first_row, last_row;  // pixels within the tile
  bool small;               // no larger than a block, so that it covers no block completely

  FACET_INLINE BlockRange(const ScreenTriangle& r, const TileBuffers& tile) {
    const int min_x = LeastOf(r.x_fx8), max_x = GreatestOf(r.x_fx8);
    const int min_y = LeastOf(r.y_fx8), max_y = GreatestOf(r.y_fx8);
    const int last_column_px = std::min((max_x >> kSubpixelBits) - tile.x0, tile.width - 1);
    const int first_column_px = std::max((min_x >> kSubpixelBits) - tile.x0, 0);
    first_row = std::max((min_y >> kSubpixelBits) - tile.y0, 0);
    last_row = std::min((max_y >> kSubpixelBits) - tile.y0, tile.height - 1);
    small = ((max_x - min_x) | (max_y - min_y)) < kBlockSize << kSubpixelBits;
    x0 = first_column_px / kBlockSize, y0 = first_row / kBlockSize;
    x1 = last_column_px < 0 ? -1 : last_column_px / kBlockSize;
    y1 = last_row < 0 ? -1 : last_row / kBlockSize;
  }
};

// VisitCoverage (below) for a small triangle whose covered samples are known (ScreenTriangle::covered): calls
// visit(offset, sample, depth) for each sample that passes the depth test, and end_pixel(x, y) after those of a pixel.
template <bool kOrEqual, int kSamples, class Visit, class EndPixel>
FACET_INLINE void VisitKnownCoverage(const ScreenTriangle& r, const TileBuffers& tile, const SampleReach& reach,
                                     const Visit& visit, const EndPixel& end_pixel) {
  const int samples_a_pixel = tile.Samples<kSamples>();
  const SamplePosition* pattern = SamplePattern(samples_a_pixel);
  const int stride_bits = CoverageSquareOf(samples_a_pixel).stride_bits;
  const std::uint32_t all = (1u << samples_a_pixel) - 1;
  const int sample_bits = __builtin_popcount(static_cast<unsigned>(samples_a_pixel - 1));
  const int first_x = FirstPixel(LeastOf(r.x_fx8), reach.high_x) - tile.x0;
  const int first_y = FirstPixel(LeastOf(r.y_fx8), reach.high_y) - tile.y0;
  for (std::uint32_t left = r.covered; left != 0;) {
    const int first_bit = __builtin_ctz(left) & -samples_a_pixel, pixel = first_bit >> sample_bits;
    std::uint32_t samples = left >> first_bit & all;
    left ^= samples << first_bit;
    const int x = first_x + (pixel & ((1 << stride_bits) - 1)), y = first_y + (pixel >> stride_bits);
    if (static_cast<unsigned>(x) >= static_cast<unsigned>(tile.width) ||
        static_cast<unsigned>(y) >= static_cast<unsigned>(tile.height)) {
      continue;
    }
    const std::size_t index = tile.Index(x, y, 0);
    if (kSamples == 1 && (kOrEqual ? r.depth_max < tile.depth[index] : r.depth_max <= tile.depth[index])) continue;
    const int in_block_x = x & (kBlockSize - 1), in_block_y = y & (kBlockSize - 1);
    const BlockDepth d = MakeBlockDepth(r, tile.x0 + x - in_block_x, tile.y0 + y - in_block_y);
    for (; samples != 0; samples &= samples - 1) {
      const int s = kSamples == 1 ? 0 : __builtin_ctz(samples);
      constexpr float kUnit = 1.0f / kSampleGrid;
      const float depth = DepthAt(d, static_cast<float>(in_block_x * kSampleGrid + pattern[s].x) * kUnit,
                                  static_cast<float>(in_block_y * kSampleGrid + pattern[s].y) * kUnit);
      const std::size_t offset = index + std::size_t(s * kBlockPixels);
      if (kOrEqual ? depth >= tile.depth[offset] : depth > tile.depth[offset]) visit(offset, s, depth);
    }
    end_pixel(x, y);
  }
}

inline void PrefetchRecord(const ScreenTriangle& r) {
  const char* bytes = reinterpret_cast<const char*>(&r);
  __builtin_prefetch(bytes);
  __builtin_prefetch(bytes + sizeof r - 1);
}

// Positions of a block's pixels in sixteenths, in the order of TileBuffers.
struct BlockPixels {
  alignas(64) std::int32_t x[kBlockPixels];
  alignas(64) std::int32_t y[kBlockPixels];
  constexpr BlockPixels() : x{}, y{} {
    for (int i = 0; i < kBlockPixels; ++i) {
      x[i] = i % kBlockSize * kSampleGrid;
      y[i] = i / kBlockSize * kSampleGrid;
    }
  }
};
inline constexpr BlockPixels kBlockPixelPositions;

}  // namespace facet
#endif  // FACET_RASTER_BLOCKS_H_

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// A triangle's three edge functions on the grid of sample positions of one block: a * x + b * y + c >= 0 inside, x and
// y in sixteenths of a pixel from the block's corner. Exact.
struct BlockEdges {
  std::int32_t a[3], b[3], c[3];
};

// The edges over a whole triangle.
struct TriangleEdges {
  std::int64_t a[3], b[3], c[3];  // of its edge functions, from the image's origin

  FACET_INLINE explicit TriangleEdges(const ScreenTriangle& r) {
    for (int i = 0; i < 3; ++i) {
      const int j = i == 2 ? 0 : i + 1;
      const auto edge = MakeEdgeFunction<std::int64_t>(r.x_fx8[i], r.y_fx8[i], r.x_fx8[j], r.y_fx8[j]);
      a[i] = edge.a, b[i] = edge.b, c[i] = edge.c;
    }
  }

  // Whether a block is outside of one edge, cut by some, or inside of all. An edge function that is nowhere
  // negative in the block becomes 0, which passes everywhere.
  enum class Overlap { None, Part, Whole };
  FACET_INLINE Overlap InBlock(int x_px, int y_px, BlockEdges& out) const {
    constexpr std::int64_t kReach = kBlockSize * kSampleGrid - 1;
    Overlap overlap = Overlap::Whole;
    for (int i = 0; i < 3; ++i) {
      const std::int64_t corner = Corner(i, x_px, y_px);
      const std::int64_t low =
          corner + std::min<std::int64_t>(a[i], 0) * kReach + std::min<std::int64_t>(b[i], 0) * kReach;
      const std::int64_t high =
          corner + std::max<std::int64_t>(a[i], 0) * kReach + std::max<std::int64_t>(b[i], 0) * kReach;
      if (high < 0) return Overlap::None;
      const bool inside = low >= 0;
      if (!inside) overlap = Overlap::Part;
      out.a[i] = inside ? 0 : static_cast<std::int32_t>(a[i]);
      out.b[i] = inside ? 0 : static_cast<std::int32_t>(b[i]);
      out.c[i] = inside ? 0 : static_cast<std::int32_t>(corner);
    }
    return overlap;
  }

  // The same without the test, for triangles that are no larger than a block and whose bounding box touches this one:
  // their edge functions fit 32 bits anywhere in it.
  FACET_INLINE Overlap AcrossBlock(int x_px, int y_px, BlockEdges& out) const {
    for (int i = 0; i < 3; ++i) {
      out.a[i] = static_cast<std::int32_t>(a[i]);
      out.b[i] = static_cast<std::int32_t>(b[i]);
      out.c[i] = static_cast<std::int32_t>(Corner(i, x_px, y_px));
    }
    return Overlap::Part;
  }

  // Edge function i at a block's corner, divided by 16 and rounded down. Nothing is lost: samples lie on sixteenths of
  // a pixel, which are multiples of 16 in fx8.
  FACET_INLINE std::int64_t Corner(int i, int x_px, int y_px) const {
    return (a[i] * (std::int64_t{x_px} << kSubpixelBits) + b[i] * (std::int64_t{y_px} << kSubpixelBits) +
            c[i]) >>
           4;
  }
};
static_assert(kSubpixelScale / kSampleGrid == 16, "the shift in Corner");

// Calls visit(offset, sample, passed, depth) for each group of lanes of each sample of each block that the triangle
// touches: `offset` is the group's index in the tile's buffers, `passed` the lanes that are covered and pass the depth
// test (nearer, or with kOrEqual not farther). end_group(block_x, block_y, first pixel) comes after all samples of a
// group, end_block(block_x, block_y, wholly covered) after all groups of a block; block_x and block_y in blocks.
template <bool kOrEqual, int kSamples, class Visit, class EndGroup, class EndBlock>
FACET_INLINE void VisitCoverage(const ScreenTriangle& r, const TileBuffers& tile, const Visit& visit,
                                const EndGroup& end_group, const EndBlock& end_block) {
  const int samples = tile.Samples<kSamples>();
  const SamplePosition* pattern = SamplePattern(samples);
  const TriangleEdges edges(r);
  const BlockRange range(r, tile);
  const int lanes = static_cast<int>(LaneCount());
  const int group = lanes < kBlockPixels ? lanes : kBlockPixels;
  for (int by = range.y0; by <= range.y1; ++by) {
    for (int bx = range.x0; bx <= range.x1; ++bx) {
      const int x_px = tile.x0 + bx * kBlockSize, y_px = tile.y0 + by * kBlockSize;
      const std::size_t block_index = tile.BlockIndex(bx, by);
      const float min_depth = tile.min_depth[block_index];
      if (kOrEqual ? r.depth_max < min_depth : r.depth_max <= min_depth) continue;
      BlockEdges e;
      const TriangleEdges::Overlap overlap =
          range.small ? edges.AcrossBlock(x_px, y_px, e) : edges.InBlock(x_px, y_px, e);
      if (overlap == TriangleEdges::Overlap::None) continue;
      const BlockDepth d = MakeBlockDepth(r, x_px, y_px);
      const std::size_t block = block_index * std::size_t(samples * kBlockPixels);
      const int first = std::max(range.first_row - by * kBlockSize, 0) * kBlockSize;
      const int last = std::min(range.last_row - by * kBlockSize, kBlockSize - 1) * kBlockSize + kBlockSize - 1;
      for (int i = first / group * group; i <= last; i += group) {
        const Int px = LoadInt(kBlockPixelPositions.x + i), py = LoadInt(kBlockPixelPositions.y + i);
        const Int e0 = Int(e.a[0]) * px + Int(e.b[0]) * py + Int(e.c[0]);
        const Int e1 = Int(e.a[1]) * px + Int(e.b[1]) * py + Int(e.c[1]);
        const Int e2 = Int(e.a[2]) * px + Int(e.b[2]) * py + Int(e.c[2]);
        for (int s = 0; s < samples; ++s) {
          const int sx = pattern[s].x, sy = pattern[s].y;
          const Mask covered = IsCovered(e0 + Int(e.a[0] * sx + e.b[0] * sy), e1 + Int(e.a[1] * sx + e.b[1] * sy),
                                         e2 + Int(e.a[2] * sx + e.b[2] * sy));
          if (!Any(covered)) continue;
          const Float x = ToFloat(px + Int(sx)) * Float(1.0f / kSampleGrid);
          const Float y = ToFloat(py + Int(sy)) * Float(1.0f / kSampleGrid);
          const Float z = (Float(d.c) + Float(d.dx) * x) + Float(d.dy) * y;
          const Float depth = Min(Max(z, Float(d.low)), Float(d.high));
          const std::size_t offset = block + std::size_t(s * kBlockPixels + i);
          const Float there = LoadFloat(tile.depth.data() + offset);
          const Mask passed = covered & (kOrEqual ? depth >= there : depth > there);
          if (Any(passed)) visit(offset, s, passed, depth);
        }
        end_group(bx, by, i);
      }
      end_block(bx, by, overlap == TriangleEdges::Overlap::Whole);
    }
  }
}

template <int kSamples>
FACET_INLINE void Draw(const TileTriangles& triangles, TileBuffers& tile) {
  constexpr std::size_t kAhead = 8;  // records to prefetch ahead: only those of one chunk are in order in memory
  const SampleReach reach = ReachOf(tile.Samples<kSamples>());
  for (std::size_t t = 0; t < triangles.count; ++t) {
    if (t + kAhead < triangles.count) PrefetchRecord(*triangles.records[t + kAhead]);
    if (triangles.records[t]->covered != 0) {
      VisitKnownCoverage<false, kSamples>(
          *triangles.records[t], tile, reach,
          [&](std::size_t offset, int, float depth) {
            tile.depth[offset] = depth;
            tile.record[offset] = triangles.ids[t];
          },
          [](int, int) {});
      continue;
    }
    const Int id(triangles.ids[t]);
    VisitCoverage<false, kSamples>(
        *triangles.records[t], tile,
        [&](std::size_t offset, int, Mask nearer, Float depth) HWY_ATTR {
          float* depths = tile.depth.data() + offset;
          std::int32_t* records = tile.record.data() + offset;
          Store(Select(nearer, depth, LoadFloat(depths)), depths);
          Store(Select(nearer, id, LoadInt(records)), records);
        },
        [](int, int, int) HWY_ATTR {},
        [&](int block_x, int block_y, bool whole) HWY_ATTR {
          if (!whole) return;
          const std::size_t size = std::size_t(tile.Samples<kSamples>() * kBlockPixels);
          const std::size_t block = tile.BlockIndex(block_x, block_y);
          const float* depths = tile.depth.data() + block * size;
          Float lowest = LoadFloat(depths);
          for (std::size_t i = LaneCount(); i < size; i += LaneCount()) lowest = Min(lowest, LoadFloat(depths + i));
          alignas(64) float lanes[kMaxLanes];
          Store(lowest, lanes);
          tile.min_depth[block] = *std::min_element(lanes, lanes + LaneCount());
        });
  }
}

void RasterOpaqueKernel(const TileTriangles& triangles, TileBuffers& tile) {
  tile.samples == 1 ? Draw<1>(triangles, tile) : Draw<0>(triangles, tile);
}

template <bool kOrEqual, int kSamples>
FACET_INLINE void Collect(const TileTriangles& triangles, const TileBuffers& tile, FragmentList& out) {
  const SampleReach reach = ReachOf(tile.Samples<kSamples>());
  for (std::size_t t = 0; t < triangles.count; ++t) {
    if (triangles.records[t]->covered != 0) {
      std::uint32_t samples = 0;
      VisitKnownCoverage<kOrEqual, kSamples>(
          *triangles.records[t], tile, reach, [&](std::size_t, int s, float) { samples |= 1u << s; },
          [&](int x, int y) {
            if (samples == 0) return;
            out.Push(static_cast<std::uint16_t>(y * tile.tile_size + x), triangles.ids[t],
                     static_cast<std::uint8_t>(samples));
            samples = 0;
          });
      continue;
    }
    std::uint32_t lanes_of[kMaxSamples] = {};
    std::uint32_t any = 0;
    VisitCoverage<kOrEqual, kSamples>(
        *triangles.records[t], tile,
        [&](std::size_t, int s, Mask nearer, Float) HWY_ATTR { any |= lanes_of[s] = BitsOf(nearer); },
        [&](int block_x, int block_y, int first) HWY_ATTR {
          for (; any != 0; any &= any - 1) {
            const int lane = __builtin_ctz(any);
            const int x = block_x * kBlockSize + (first + lane) % kBlockSize;
            const int y = block_y * kBlockSize + (first + lane) / kBlockSize;
            std::uint32_t samples = 0;
            for (int s = 0; s < tile.Samples<kSamples>(); ++s) samples |= (lanes_of[s] >> lane & 1u) << s;
            if (x < tile.width && y < tile.height) {
              out.Push(static_cast<std::uint16_t>(y * tile.tile_size + x), triangles.ids[t],
                       static_cast<std::uint8_t>(samples));
            }
          }
          for (std::uint32_t& bits : lanes_of) bits = 0;
        },
        [](int, int, bool) HWY_ATTR {});
  }
}

void RasterCollectKernel(const TileTriangles& triangles, const TileBuffers& tile, FragmentList& out,
                         CollectDepth test) {
  const bool one_sample = tile.samples == 1;
  if (test == CollectDepth::Nearer) {
    one_sample ? Collect<false, 1>(triangles, tile, out) : Collect<false, 0>(triangles, tile, out);
  } else {
    one_sample ? Collect<true, 1>(triangles, tile, out) : Collect<true, 0>(triangles, tile, out);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facet {

FACET_EXPORT(RasterOpaqueKernel);
FACET_EXPORT(RasterCollectKernel);

void ClearTile(TileBuffers& tile) {
  const std::size_t size = std::size_t(tile.tile_size) * std::size_t(tile.tile_size) * std::size_t(tile.samples);
  tile.depth.assign(size, -std::numeric_limits<float>::infinity());
  tile.record.assign(size, kNoRecord);
  tile.min_depth.assign(size / std::size_t(tile.samples * kBlockPixels), -std::numeric_limits<float>::infinity());
}

void RasterOpaque(const TileTriangles& triangles, TileBuffers& tile) {
  FACET_DISPATCH(RasterOpaqueKernel)(triangles, tile);
}

void RasterCollect(const TileTriangles& triangles, const TileBuffers& tile, FragmentList& out, CollectDepth test) {
  FACET_DISPATCH(RasterCollectKernel)(triangles, tile, out, test);
}

namespace {

template <int kSamples>
void Write(const ScreenTriangle& record, std::int32_t id, std::uint16_t pixel, std::uint8_t samples,
           TileBuffers& tile) {
  const int x = pixel % tile.tile_size, y = pixel / tile.tile_size;
  const int block_x = x / kBlockSize * kBlockSize, block_y = y / kBlockSize * kBlockSize;
  const BlockDepth d = MakeBlockDepth(record, tile.x0 + block_x, tile.y0 + block_y);
  const SamplePosition* pattern = SamplePattern(tile.Samples<kSamples>());
  for (int s = 0; s < tile.Samples<kSamples>(); ++s) {
    if ((samples >> s & 1) == 0) continue;
    const float depth = DepthAt(d, static_cast<float>((x - block_x) * kSampleGrid + pattern[s].x) / kSampleGrid,
                                static_cast<float>((y - block_y) * kSampleGrid + pattern[s].y) / kSampleGrid);
    const std::size_t i = tile.Index(x, y, s);
    if (depth > tile.depth[i]) tile.depth[i] = depth, tile.record[i] = id;
  }
}

// The list is resized once a tile, not for each fragment.
template <int kSamples>
void ListVisible(const TileBuffers& tile, FragmentList& out) {
  constexpr int kSquare = 4;
  const int samples = tile.Samples<kSamples>();
  const std::uint32_t all = (1u << samples) - 1;
  std::size_t count = out.Size();
  out.Resize(count + std::size_t(tile.width * tile.height * samples));
  std::uint16_t* pixels = out.pixel.data();
  std::int32_t* ids = out.record.data();
  std::uint8_t* masks = out.samples.data();
  for (int square_y = 0; square_y < tile.height; square_y += kSquare) {
    for (int square_x = 0; square_x < tile.width; square_x += kSquare) {
      const int right = std::min(square_x + kSquare, tile.width), bottom = std::min(square_y + kSquare, tile.height);
      for (int y = square_y; y < bottom; ++y) {
        const std::int32_t* records = tile.record.data() + tile.Index(square_x, y, 0);
        const int row = y * tile.tile_size;
        for (int x = square_x; x < right; ++x, ++records) {
          for (std::uint32_t open = all; open != 0;) {
            const int s = kSamples == 1 ? 0 : __builtin_ctz(open);
            const std::int32_t id = records[s * kBlockPixels];
            std::uint32_t same = 1u << s;
            for (int k = s + 1; k < samples; ++k) same |= std::uint32_t{records[k * kBlockPixels] == id} << k;
            same &= open;
            open &= ~same;
            pixels[count] = static_cast<std::uint16_t>(row + x);
            ids[count] = id;
            masks[count] = static_cast<std::uint8_t>(same);
            count += id != kNoRecord;
          }
        }
      }
    }
  }
  out.Resize(count);
}

}  // namespace

void WriteFragment(const ScreenTriangle& record, std::int32_t id, std::uint16_t pixel, std::uint8_t samples,
                   TileBuffers& tile) {
  tile.samples == 1 ? Write<1>(record, id, pixel, samples, tile) : Write<0>(record, id, pixel, samples, tile);
}

void VisibleFragments(const TileBuffers& tile, FragmentList& out) {
  tile.samples == 1 ? ListVisible<1>(tile, out) : ListVisible<0>(tile, out);
}

}  // namespace facet
#endif
