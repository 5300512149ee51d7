// Which tiles each triangle touches.
#pragma once

#include "frame/geometry.h"
#include "frame/tile_grid.h"

namespace facet {

// Fills chunk.tiles, chunk.begin and chunk.entries from chunk.records, and puts these in the order in which tiles come
// to them, so that a tile reads neighbours. Entries of a tile keep the order that the records had. What the chunk takes
// is charged to the current memory budget. Throws Error(OutOfMemory).
inline constexpr const char* kTileListsCharge = "lists of triangles for tiles";  // what it is charged for
void BinChunk(const TileGrid& grid, TriangleChunk& chunk);

}  // namespace facet
