// Binning: finds the tiles that each triangle touches.
#pragma once

#include "frame/geometry.h"
#include "frame/tile_grid.h"

namespace facet {

// Fills chunk.tiles, chunk.begin and chunk.entries from chunk.records, and reorders the records so that those of a tile
// are close together in memory. The entries of a tile are in submission order. Memory is charged to the current memory
// budget. Throws Error(OutOfMemory).
inline constexpr const char* kTileListsCharge = "lists of triangles for tiles";  // purpose of the charge
void BinChunk(const TileGrid& grid, TriangleChunk& chunk);

}  // namespace facet
