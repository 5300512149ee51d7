#include "render/tile_records.h"

namespace facet {

void TileRecords::Clear() {
  records_.clear();
  last_material_ = -1;
  one_material_ = true;
}

TileTriangles TileRecords::Append(std::span<const TileRun> runs) {
  const std::size_t before = records_.size(), count = before + CountOf(runs);
  records_.resize(count);
  const ScreenTriangle** out = records_.data() + before;
  for (const TileRun& run : runs) {
    const TriangleChunk& chunk = geometry_.chunks[run.chunk];
    const int material = geometry_.drawables[chunk.drawable].material;
    one_material_ = one_material_ && (last_material_ < 0 || last_material_ == material);
    last_material_ = material;
    const ScreenTriangle* records = chunk.records.data();
    for (std::uint32_t e = run.begin; e < run.end; ++e) *out++ = records + chunk.entries[e];
  }
  for (std::size_t i = ids_.size(); i < count; ++i) ids_.push_back(static_cast<std::int32_t>(i));
  return {records_.data() + before, ids_.data() + before, count - before};
}

}  // namespace facet
