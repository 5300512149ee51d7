// Coverage and depth: which triangle is seen at each sample of a tile.
#pragma once

#include <cstdint>

#include "frame/tile.h"

namespace facet {

// Triangles of one tile, in submission order.
struct TileTriangles {
  const TriangleRecord* const* records = nullptr;
  const std::int32_t* numbers = nullptr;  // of the records, within the tile
  std::size_t count = 0;
};

// Empties the tile: nothing visible.
void ClearTile(TileBuffers& tile);

// Draws opaque triangles: where a sample is covered and nearer than what is there, depth and record are replaced. At
// equal depth the earlier triangle stays.
void RasterOpaque(const TileTriangles& triangles, TileBuffers& tile);

// Which fragments RasterCollect takes: those nearer than what is in the tile, or also those just as near (a transparent
// layer that lies in an opaque surface is seen).
enum class CollectDepth : std::uint8_t { Nearer, NearerOrEqual };

// Collects the fragments of triangles that pass the depth test against the tile, which stays as it is. In triangle
// order; those of one triangle in any.
void RasterCollect(const TileTriangles& triangles, const TileBuffers& tile, FragmentList& out,
                   CollectDepth test = CollectDepth::Nearer);

// Writes one collected fragment into the tile, sample by sample, where it still is the nearest. For alpha-tested
// fragments that passed.
void WriteFragment(const TriangleRecord& record, std::int32_t number, std::uint16_t pixel, std::uint8_t samples,
                   TileBuffers& tile);

// The visible (pixel, triangle) pairs with the samples at which each is visible. By squares of 4 x 4 pixels, row by row
// and so within each: what is shaded together then lies close together in textures.
void VisibleFragments(const TileBuffers& tile, FragmentList& out);

}  // namespace facet
