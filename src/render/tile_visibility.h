// Visibility of one tile, in the camera's view or a light's: which triangle is seen at each sample.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/memory_budget.h"
#include "raster/raster_tile.h"
#include "render/tile_records.h"
#include "render/tile_shading.h"
#include "render/tiled_view.h"
#include "shade/attribute_setup.h"

namespace facet {

// Keeps its working memory from tile to tile. Not thread-safe: one per worker.
class TileVisibility {
 public:
  // `shading` evaluates the alpha of alpha-tested materials.
  TileVisibility(const TiledView& view, TileShading& shading)
      : view_(view), shading_(shading), records_(view.geometry) {}

  // Begins tile (column, row) of the grid; `list` is the index of its lists in the geometry's. False: no triangle
  // touches the tile, and its buffers are not cleared.
  bool Begin(int column, int row, std::size_t list);

  // Draws the tile's opaque and alpha-tested triangles.
  void Draw();

  // Lists the fragments of blended triangles that are not behind the drawn ones.
  // `seen_through`: they are shaded with SeenThroughFragments.
  void CollectBlended(bool seen_through, FragmentList& out);
  bool HasBlended() const { return !view_.geometry.lists.blended[list_].empty(); }

  const TileBuffers& Buffers() const { return tile_; }
  const TileRecords& Records() const { return records_; }

 private:
  void DrawMasked(std::span<const TileRun> runs);

  // Charges the triangles and fragments of a tile, which may be any number, to the memory budget. The few that nearly
  // every tile has are not counted. A record takes its pointer, id, setup, and the index of the setup; a fragment its
  // own 7 bytes, the arrays of its shading, and its index in the order of layers; vectors have half of that in reserve.
  void Charge(std::size_t count, std::size_t bytes_each, std::size_t& charged);
  static constexpr std::size_t kRecordBytes = 40 + AttributeLayout::kMostStride * sizeof(float), kFragmentBytes = 120;
  // Of a frame with transmission, in addition: its arrays, and those of its batch.
  static constexpr std::size_t kSeenThroughBytes = 3 * SeenThroughFragments::kArrays * sizeof(float);

  const TiledView& view_;
  TileShading& shading_;
  std::size_t list_ = 0;
  TileBuffers tile_, behind_masked_;
  TileRecords records_;
  ShadedFragments masked_;
  std::size_t charged_records_ = std::size_t{1} << 14, charged_fragments_ = std::size_t{1} << 16;
  std::vector<MemoryLease> leases_;
};

}  // namespace facet
