// The screen triangles that touch one tile. A tile knows each by its place in this list, its number.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "raster/raster_tile.h"
#include "render/geometry_pass.h"

namespace facet {

// Keeps its memory from tile to tile.
class TileRecords {
 public:
  explicit TileRecords(const FrameGeometry& geometry) : geometry_(geometry) {}

  void Clear();
  // Adds the runs' triangles, and gives them with their numbers. Valid until the next call.
  TileTriangles Append(std::span<const TileRun> runs);

  // By number.
  std::span<const TriangleRecord* const> All() const { return records_; }
  const TriangleRecord& Record(std::int32_t number) const { return *records_[std::size_t(number)]; }
  const FrameDrawable& DrawableOf(std::int32_t number) const { return geometry_.drawables[Record(number).drawable]; }
  std::uint32_t MaterialOf(std::int32_t number) const {
    return static_cast<std::uint32_t>(DrawableOf(number).material);
  }

  // Whether all of them have the same material.
  bool HaveOneMaterial() const { return one_material_; }

 private:
  const FrameGeometry& geometry_;
  std::vector<const TriangleRecord*> records_;
  std::vector<std::int32_t> numbers_;  // 0, 1, 2, ...
  int last_material_ = -1;
  bool one_material_ = true;
};

inline std::size_t CountOf(std::span<const TileRun> runs) {
  std::size_t count = 0;
  for (const TileRun& run : runs) count += run.end - run.begin;
  return count;
}

}  // namespace facet
