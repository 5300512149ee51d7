// Which tiles each triangle touches.
#pragma once

#include "frame/geometry.h"
#include "frame/tile_grid.h"

namespace facet {

// Fills chunk.tiles, chunk.begin and chunk.entries from chunk.records. Entries of a tile keep the records' order.
void BinChunk(const TileGrid& grid, TriangleChunk& chunk);

}  // namespace facet
