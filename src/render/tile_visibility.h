// Which triangle is seen at each sample of a tile, of the camera's view or of a light's.
#pragma once

#include <cstddef>
#include <vector>

#include "base/memory_budget.h"
#include "raster/raster_tile.h"
#include "render/tile_records.h"
#include "render/tile_shading.h"
#include "render/tiled_view.h"
#include "shade/triangle_setup.h"

namespace facet {

// Charges what may be any number in a tile to the memory budget. The few that nearly every tile has are not counted.
class TileCharge {
 public:
  void AdmitRecords(std::size_t count) { Admit(count, kPerRecord, records_); }
  void AdmitFragments(std::size_t count) { Admit(count, kPerFragment, fragments_); }

 private:
  void Admit(std::size_t count, std::size_t size_each, std::size_t& admitted);

  // A record's pointer, number and setup, and the index of that; a fragment's own 7 bytes, what its shading needs, and
  // its index in the order of layers. The vectors grow by half of these on average.
  static constexpr std::size_t kPerRecord = 40 + SetupLayout::kMostStride * sizeof(float), kPerFragment = 120;

  std::size_t records_ = std::size_t{1} << 14, fragments_ = std::size_t{1} << 16;  // that were admitted
  std::vector<MemoryLease> leases_;
};

// Keeps its working memory from tile to tile. Not thread-safe: one per worker.
class TileVisibility {
 public:
  // `shading` evaluates the alpha of alpha-tested materials.
  TileVisibility(const TiledView& view, TileShading& shading)
      : view_(view), shading_(shading), records_(view.geometry) {}

  // Goes to tile (column, row) of the grid, whose lists are number `list` of the geometry's. False: no triangle touches
  // it, and its buffers are not cleared.
  bool Begin(int column, int row, std::size_t list);

  // Draws the tile's opaque and alpha-tested triangles.
  void Draw();

  // The fragments of blended triangles that are not behind what was drawn.
  void CollectBlended(FragmentList& out);
  bool HasBlended() const { return !view_.geometry.lists.blended[list_].empty(); }

  const TileBuffers& Buffers() const { return tile_; }
  const TileRecords& Records() const { return records_; }

 private:
  void DrawMasked(std::span<const TileRun> runs);

  const TiledView& view_;
  TileShading& shading_;
  std::size_t list_ = 0;
  TileBuffers tile_, behind_masked_;
  TileRecords records_;
  ShadedFragments masked_;
  TileCharge charge_;
};

}  // namespace facet
