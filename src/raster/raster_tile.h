// The raster stage: coverage and the depth test, which decide the triangle that is seen at each sample of a tile.
#pragma once

#include <cstdint>

#include "frame/tile.h"

namespace facet {

// Triangles of one tile, in submission order.
struct TileTriangles {
  const ScreenTriangle* const* records = nullptr;
  const std::int32_t* ids = nullptr;  // of the records within the tile
  std::size_t count = 0;
};

// Clears the depth and the records of all samples: nothing is visible.
void ClearTile(TileBuffers& tile);

// Draws opaque triangles: where a triangle covers a sample and is nearer than the tile's depth there, its depth and id
// are stored. At equal depth the earlier triangle stays.
void RasterOpaque(const TileTriangles& triangles, TileBuffers& tile);

// The depth test of RasterCollect: fragments must be nearer than the tile's depth, or may also be equally near (so that
// a transparent layer that lies in an opaque surface is visible).
enum class CollectDepth : std::uint8_t { Nearer, NearerOrEqual };

// Lists the fragments that pass the depth test against the tile, without changing the tile. They are in the order of
// the triangles; those of one triangle are in no particular order.
void RasterCollect(const TileTriangles& triangles, const TileBuffers& tile, FragmentList& out,
                   CollectDepth test = CollectDepth::Nearer);

// Stores depth and id of one listed fragment at those of its samples where it is still the nearest: for alpha-tested
// fragments that passed the test.
void WriteFragment(const ScreenTriangle& record, std::int32_t id, std::uint16_t pixel, std::uint8_t samples,
                   TileBuffers& tile);

// Lists the visible (pixel, triangle) pairs, each with the samples at which it is visible. The order is by squares of
// 4 x 4 pixels, row by row, and row by row within each, so that fragments that are shaded together read neighbouring
// texels.
void VisibleFragments(const TileBuffers& tile, FragmentList& out);

}  // namespace facet
