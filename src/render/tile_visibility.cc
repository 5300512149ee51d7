#include "render/tile_visibility.h"

#include <algorithm>

namespace facet {

void TileVisibility::Charge(std::size_t count, std::size_t bytes_each, std::size_t& charged) {
  if (count <= charged) return;
  const std::size_t more = std::max(count, charged + charged / 2) - charged;
  leases_.emplace_back(more, bytes_each, "fragments of a tile", "", "use smaller tiles or fewer threads");
  charged += more;
}

bool TileVisibility::Begin(int column, int row, std::size_t list) {
  const TileGrid& grid = view_.grid;
  list_ = list;
  tile_.x0 = column * grid.tile_size;
  tile_.y0 = row * grid.tile_size;
  tile_.width = std::min(grid.tile_size, grid.width - tile_.x0);
  tile_.height = std::min(grid.tile_size, grid.height - tile_.y0);
  tile_.tile_size = grid.tile_size;
  tile_.samples = view_.samples;
  records_.Clear();
  const TileLists& lists = view_.geometry.lists;
  const std::size_t count = CountOf(lists.opaque[list]) + CountOf(lists.masked[list]) + CountOf(lists.blended[list]);
  Charge(count, kRecordBytes, charged_records_);
  return count != 0;
}

void TileVisibility::Draw() {
  const TileLists& lists = view_.geometry.lists;
  ClearTile(tile_);
  RasterOpaque(records_.Append(lists.opaque[list_]), tile_);
  if (!lists.masked[list_].empty()) DrawMasked(lists.masked[list_]);
}

// Works in batches: lists the fragments that are nearer than the opaque triangles, computes their alpha, and stores
// those that pass in order, each with its own depth test. (If fragments were listed against the depth of that moment,
// the samples that a fragment covers, and with them the position at which its alpha is read, would depend on where
// batches end, and so on the size of tiles.)
void TileVisibility::DrawMasked(std::span<const TileRun> runs) {
  constexpr std::size_t kBatch = 64;  // triangles
  behind_masked_ = tile_;
  for (const TileRun& run : runs) {
    const TriangleChunk& chunk = view_.geometry.chunks[run.chunk];
    FrameMaterial material = view_.materials[std::size_t(view_.geometry.drawables[chunk.drawable].material)];
    material.features &= ~(kLit | kTangentSpaceBits);  // alpha needs neither position nor normal
    for (std::uint32_t first = run.begin; first < run.end; first += kBatch) {
      const TileRun part{run.chunk, first, std::min<std::uint32_t>(run.end, first + kBatch)};
      FragmentList& list = masked_.list;
      list.Clear();
      RasterCollect(records_.Append({&part, 1}), behind_masked_, list);
      shading_.ComputeAlpha(tile_, records_, material, masked_);
      for (std::size_t i = 0; i < list.Size(); ++i) {
        if (!(masked_.alpha[i] >= material.factors.alpha_cutoff)) continue;
        WriteFragment(records_.Record(list.record[i]), list.record[i], list.pixel[i], list.samples[i], tile_);
      }
    }
  }
}

// Works in batches, so that fragments, of which there may be any number, are charged before memory runs out.
void TileVisibility::CollectBlended(bool seen_through, FragmentList& out) {
  const std::size_t bytes = kFragmentBytes + (seen_through ? kSeenThroughBytes : 0);
  constexpr std::size_t kBatch = 256;  // triangles
  const TileTriangles all = records_.Append(view_.geometry.lists.blended[list_]);
  for (std::size_t first = 0; first < all.count; first += kBatch) {
    Charge(out.Size(), bytes, charged_fragments_);
    RasterCollect({all.records + first, all.ids + first, std::min(kBatch, all.count - first)}, tile_, out,
                  CollectDepth::NearerOrEqual);
  }
  Charge(out.Size(), bytes, charged_fragments_);
}

}  // namespace facet
