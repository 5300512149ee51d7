// The division of the image into tiles, and the triangles of each.
#pragma once

#include <cstdint>
#include <vector>

namespace facet {

struct TileGrid {
  int width = 0, height = 0;  // pixels
  int tile_size = 0;          // pixels, a power of two from 8 to 64
  int columns = 0, rows = 0;

  int Count() const { return columns * rows; }
};

TileGrid MakeTileGrid(int width, int height, int tile_size);

// The entries of one chunk that belong to one tile.
struct TileRun {
  std::uint32_t chunk;
  std::uint32_t begin, end;  // a range of TriangleChunk::entries
};

// For each tile the runs of all chunks, in chunk order, by alpha mode: opaque, alpha-tested (masked) and blended.
// Surfaces that are seen through for their transmission are among the blended ones, whatever their alpha mode.
struct TileLists {
  std::vector<std::vector<TileRun>> opaque, masked, blended;
};

}  // namespace facet
