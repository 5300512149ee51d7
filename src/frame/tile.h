// The buffers of one tile: the nearest triangle at each sample, and the fragments to be shaded.
#pragma once

#include <cstdint>
#include <vector>

#include "base/pages.h"
#include "frame/constants.h"
#include "frame/geometry.h"

namespace facet {

inline constexpr std::int32_t kNoRecord = -1;

// Fragments, which are (pixel, triangle) pairs, as a structure of arrays. Resize() leaves added entries uninitialised.
struct FragmentList {
  PageVector<std::uint16_t> pixel;    // y * tile_size + x within the tile
  PageVector<std::int32_t> record;    // id of the triangle within the tile; ids follow submission order
  PageVector<std::uint8_t> samples;   // bit s is set where sample s is covered

  std::size_t Size() const { return pixel.size(); }
  void Clear() { Resize(0); }
  void Resize(std::size_t count) { pixel.resize(count), record.resize(count), samples.resize(count); }
  void Push(std::uint16_t p, std::int32_t r, std::uint8_t s) { pixel.push_back(p), record.push_back(r), samples.push_back(s); }
};

// What fragments of surfaces with transmission do to what is seen through them: see SeenThroughOutputs (shade_task.h).
// All zero for fragments of other surfaces.
struct SeenThroughFragments {
  static constexpr std::size_t kArrays = 10;
  PageVector<float> tint[3], shift_x[3], shift_y[3], blur;

  void Resize(std::size_t count) {
    for (auto* channels : {tint, shift_x, shift_y}) {
      for (int c = 0; c < 3; ++c) channels[c].resize(count);
    }
    blur.resize(count);
  }
};

// Fragments with their colours: linear radiance, not multiplied by alpha. Resize() as for FragmentList.
struct ShadedFragments {
  FragmentList list;
  PageVector<float> red, green, blue, alpha;
  bool has_seen_through = false;
  SeenThroughFragments seen_through;  // sized if has_seen_through

  void Resize() {
    for (auto* v : {&red, &green, &blue, &alpha}) v->resize(list.Size());
    if (has_seen_through) seen_through.Resize(list.Size());
  }
};

// Depth and triangle id of every sample. The arrays are ordered by blocks of 8 x 8 pixels; a block holds one plane of
// 64 entries for each sample, so that SIMD lanes read adjacent entries. Sample s of pixel (x, y) is at Index(x, y, s).
struct TileBuffers {
  int x0 = 0, y0 = 0;          // position of the tile's top left pixel in the image
  int width = 0, height = 0;   // pixels of the tile that lie inside the image
  int tile_size = 0, samples = 0;
  std::vector<float> depth;
  std::vector<std::int32_t> record;
  // Hierarchical Z: for each block a lower bound of its samples' depths. Depth grows towards the viewer, so a triangle
  // whose depth is nowhere larger than the bound is hidden in the whole block.
  std::vector<float> min_depth;

  // The number of samples, known at compile time in code that is instantiated for kSamples = 1, so that frames without
  // multisampling do not pay for it. 0: `samples`.
  template <int kSamples>
  int Samples() const { return kSamples != 0 ? kSamples : samples; }

  int BlocksPerRow() const { return static_cast<int>(static_cast<unsigned>(tile_size) / kBlockSize); }
  std::size_t BlockIndex(int block_x, int block_y) const { return std::size_t(block_y * BlocksPerRow() + block_x); }
  std::size_t BlockOffset(int block_x, int block_y) const {
    return BlockIndex(block_x, block_y) * std::size_t(samples * kBlockPixels);
  }
  std::size_t Index(int x, int y, int sample) const {
    // Unsigned, so that quotient and remainder become a shift and a mask.
    const unsigned column = static_cast<unsigned>(x), row = static_cast<unsigned>(y);
    const unsigned in_block = row % kBlockSize * kBlockSize + column % kBlockSize;
    return BlockOffset(static_cast<int>(column / kBlockSize), static_cast<int>(row / kBlockSize)) +
           std::size_t(sample * kBlockPixels) + in_block;
  }
};

// The depth of a triangle within one block: c + dx * x + dy * y, clamped to [low, high], with x and y in pixels from
// the block's corner. All stages compute it by these functions, so that their depths agree to the bit.
struct BlockDepth {
  float c, dx, dy, low, high;
};

inline BlockDepth MakeBlockDepth(const ScreenTriangle& r, int block_x_px, int block_y_px) {
  constexpr double kPixel = 1.0 / kSubpixelScale;
  const double x = block_x_px - r.x_fx8[0] * kPixel, y = block_y_px - r.y_fx8[0] * kPixel;
  return {static_cast<float>(r.depth_0 + r.depth_dx * x + r.depth_dy * y), static_cast<float>(r.depth_dx),
          static_cast<float>(r.depth_dy), r.depth_min, r.depth_max};
}

// `x`, `y`: position of a sample, in pixels from the block's corner.
inline float DepthAt(const BlockDepth& d, float x, float y) {
  const float z = (d.c + d.dx * x) + d.dy * y;
  const float raised = z > d.low ? z : d.low;
  return raised < d.high ? raised : d.high;
}

}  // namespace facet
