// One tile of one plane, as its function receives it.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "frame/geometry.h"
#include "frame/tile.h"

namespace facet {

inline constexpr std::int32_t kNoSample = -1;

// What is visible in a tile.
struct VisibleTile {
  const TileBuffers& tile;
  bool nothing = false;                            // no triangle touches the tile, and its buffers are not cleared
  const ScreenTriangle* const* records = nullptr;  // by their ids in tile.record
  const FrameView& view;
  const FrameDrawable* drawables = nullptr;  // by ScreenTriangle::drawable
};

struct PlaneTile {
  const VisibleTile& seen;
  // For each pixel, tile_size a row: the index of its nearest sample in tile.depth and tile.record; kNoSample: none is
  // covered.
  const std::int32_t* nearest;
  std::byte* out;          // of the tile's top left pixel
  std::size_t out_stride;  // bytes from one row of the plane to the next

  const ScreenTriangle& RecordAt(std::size_t sample) const { return *seen.records[seen.tile.record[sample]]; }
};

// Writes to each pixel of the tile value(index of its nearest sample), or `nothing`.
template <class T, class Value>
void WritePixels(const PlaneTile& t, const T& nothing, const Value& value) {
  static_assert(std::endian::native == std::endian::little, "planes are little-endian");
  for (int y = 0; y < t.seen.tile.height; ++y) {
    const std::int32_t* nearest = t.nearest + y * t.seen.tile.tile_size;
    std::byte* out = t.out + std::size_t(y) * t.out_stride;
    for (int x = 0; x < t.seen.tile.width; ++x, out += sizeof(T)) {
      const T v = nearest[x] == kNoSample ? nothing : value(static_cast<std::size_t>(nearest[x]));
      std::memcpy(out, &v, sizeof(T));
    }
  }
}

}  // namespace facet
