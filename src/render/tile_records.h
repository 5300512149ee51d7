// The list of the screen triangles that touch one tile. The index of a triangle in it is its id within the tile.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "raster/raster_tile.h"
#include "render/geometry_pass.h"

namespace facet {

// Keeps its memory from tile to tile. Not thread-safe: one per worker.
class TileRecords {
 public:
  explicit TileRecords(const FrameGeometry& geometry) : geometry_(geometry) {}

  void Clear();
  // Adds the triangles of the runs, and returns them with their ids. Valid until the next call.
  TileTriangles Append(std::span<const TileRun> runs);

  // By id.
  std::span<const ScreenTriangle* const> All() const { return records_; }
  const ScreenTriangle& Record(std::int32_t id) const { return *records_[std::size_t(id)]; }
  const FrameDrawable& DrawableOf(std::int32_t id) const { return geometry_.drawables[Record(id).drawable]; }
  std::uint32_t MaterialOf(std::int32_t id) const { return static_cast<std::uint32_t>(DrawableOf(id).material); }

  // Whether all triangles have the same material.
  bool HaveOneMaterial() const { return one_material_; }

 private:
  const FrameGeometry& geometry_;
  std::vector<const ScreenTriangle*> records_;
  std::vector<std::int32_t> ids_;  // 0, 1, 2, ...
  int last_material_ = -1;
  bool one_material_ = true;
};

inline std::size_t CountOf(std::span<const TileRun> runs) {
  std::size_t count = 0;
  for (const TileRun& run : runs) count += run.end - run.begin;
  return count;
}

}  // namespace facet
