#include "bin/bin_triangles.h"

#include <algorithm>

#include "frame/constants.h"

namespace facet {
namespace {

struct TileRange {
  int x0, y0, x1, y1;  // inclusive; empty when x1 < x0 or y1 < y0
};

TileRange TilesOf(const TileGrid& grid, const TriangleRecord& r) {
  const auto [min_x, max_x] = std::minmax({r.x_fx8[0], r.x_fx8[1], r.x_fx8[2]});
  const auto [min_y, max_y] = std::minmax({r.y_fx8[0], r.y_fx8[1], r.y_fx8[2]});
  const int size_fx8 = grid.tile_size * kSubpixelScale;
  const auto tile = [&](std::int32_t p) { return p < 0 ? -1 : p / size_fx8; };
  return {std::max(tile(min_x), 0), std::max(tile(min_y), 0), std::min(tile(max_x), grid.columns - 1),
          std::min(tile(max_y), grid.rows - 1)};
}

// False when the whole tile lies outside one edge. Conservative: exact at the tile's outer corners.
bool MayTouch(const TileGrid& grid, const TriangleRecord& r, int tile_x, int tile_y) {
  const std::int64_t size = std::int64_t{grid.tile_size} * kSubpixelScale;
  const std::int64_t left = tile_x * size, top = tile_y * size;
  for (int i = 0; i < 3; ++i) {
    const int j = i == 2 ? 0 : i + 1;
    const std::int64_t a = r.y_fx8[i] - r.y_fx8[j], b = r.x_fx8[j] - r.x_fx8[i];
    const std::int64_t x = a > 0 ? left + size : left, y = b > 0 ? top + size : top;  // the corner furthest inside
    if (a * (x - r.x_fx8[i]) + b * (y - r.y_fx8[i]) < 0) return false;
  }
  return true;
}

}  // namespace

void BinChunk(const TileGrid& grid, TriangleChunk& chunk) {
  struct Pair {
    std::uint32_t tile, record;
  };
  std::vector<Pair> pairs;
  pairs.reserve(chunk.records.size() + chunk.records.size() / 4);
  for (std::uint32_t i = 0; i < chunk.records.size(); ++i) {
    const TriangleRecord& r = chunk.records[i];
    const TileRange range = TilesOf(grid, r);
    const bool test = range.x1 - range.x0 + range.y1 - range.y0 >= 2;
    for (int y = range.y0; y <= range.y1; ++y) {
      for (int x = range.x0; x <= range.x1; ++x) {
        if (!test || MayTouch(grid, r, x, y)) pairs.push_back({static_cast<std::uint32_t>(y * grid.columns + x), i});
      }
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.tile < b.tile; });
  chunk.entries.resize(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (i == 0 || pairs[i].tile != pairs[i - 1].tile) {
      chunk.tiles.push_back(pairs[i].tile);
      chunk.begin.push_back(static_cast<std::uint32_t>(i));
    }
    chunk.entries[i] = pairs[i].record;
  }
  chunk.begin.push_back(static_cast<std::uint32_t>(pairs.size()));
}

}  // namespace facet
