#include "render/geometry_pass.h"

#include <algorithm>

#include "base/parallel.h"
#include "bin/bin_triangles.h"
#include "clip/assemble.h"
#include "facet/error.h"
#include "render/frame_view.h"
#include "vertex/outside_view.h"
#include "vertex/transform_vertices.h"

namespace facet {
namespace {

constexpr std::uint32_t kChunkPrimitives = 4096;
constexpr std::size_t kVertexGrain = 8192;

struct VertexRange {
  std::uint32_t drawable;
  std::size_t begin, end;
};

}  // namespace

void RunGeometry(const FrameView& view, const PosedScene& posed, const FramePlan& plan, const TileGrid& grid,
                 int samples, FrameGeometry& frame, RenderStats& stats) {
  std::vector<VertexRange> ranges;
  std::uint64_t vertex_count = 0;
  std::size_t chunk_count = 0;
  MemoryBudget& budget = MemoryBudget::Current();
  budget.Charge(posed.drawables.size(), sizeof(FrameDrawable) + sizeof(VertexRange) + sizeof(const Primitive*),
                "drawables");
  frame.drawables.clear();
  frame.drawables.reserve(posed.drawables.size());
  for (std::size_t d = 0; d < posed.drawables.size(); ++d) {
    FrameDrawable drawable = MakeFrameDrawable(view, posed.drawables[d]);
    drawable.material = plan.material_of_drawable[d];
    drawable.double_sided = plan.materials[std::size_t(drawable.material)].frame.Has(kDoubleSided);
    drawable.vertex_base = static_cast<std::uint32_t>(vertex_count);
    const std::size_t n = drawable.geometry->positions.size();
    stats.vertices += n;
    stats.triangles_in += drawable.primitive_count;
    if (OutsideView(view, drawable, posed.drawables[d].bounds_mesh)) {
      stats.triangles_clipped += drawable.primitive_count;
      frame.drawables.push_back(drawable);
      continue;
    }
    for (std::size_t b = 0; b < n; b += kVertexGrain) {
      ranges.push_back({static_cast<std::uint32_t>(d), b, std::min(n, b + kVertexGrain)});
    }
    for (std::uint32_t b = 0; b < drawable.primitive_count; b += kChunkPrimitives) {
      if (chunk_count == frame.chunks.size()) frame.chunks.emplace_back();
      TriangleChunk& chunk = frame.chunks[chunk_count++];
      chunk.drawable = static_cast<std::uint32_t>(d);
      chunk.first_primitive = b;
      chunk.primitive_count = std::min(kChunkPrimitives, drawable.primitive_count - b);
    }
    vertex_count += n;
    if (vertex_count > INT32_MAX / 3) {  // lanes index the components of positions with 32 bits
      throw Error(ErrorCode::OutOfMemory, "the scene has more than 715,827,882 vertices at once", {},
                  "render it in parts");
    }
    frame.drawables.push_back(drawable);
  }
  stats.drawables = frame.drawables.size();
  budget.Charge(chunk_count, sizeof(TriangleChunk) + sizeof(VertexRange) + 192, "drawables");
  budget.Charge(vertex_count, sizeof(ScreenVertex), "vertices on the screen");

  frame.chunks.resize(chunk_count);
  frame.vertices.resize(vertex_count);
  ParallelFor(ranges.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      TransformVertices(view, frame.drawables[ranges[i].drawable], ranges[i].begin, ranges[i].end, frame.vertices);
    }
  });
  ParallelFor(frame.chunks.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      TriangleChunk& chunk = frame.chunks[i];
      AssembleChunk(view, frame.drawables[chunk.drawable], frame.vertices, samples, chunk);
      BinChunk(grid, chunk);
    }
  });

  frame.drawable_visible.assign(frame.drawables.size(), false);
  frame.material_visible.assign(plan.materials.size(), false);
  std::uint64_t record_count = 0;
  for (const TriangleChunk& chunk : frame.chunks) {
    record_count += chunk.records.size();
    stats.triangles_culled += chunk.culled;
    stats.triangles_clipped += chunk.clipped;
    if (chunk.tiles.empty()) continue;
    frame.drawable_visible[chunk.drawable] = true;
    frame.material_visible[std::size_t(frame.drawables[chunk.drawable].material)] = true;
  }
  stats.triangles_binned = record_count;
  if (record_count > INT32_MAX) {
    throw Error(ErrorCode::OutOfMemory, "the scene has more than 2^31 triangles on the screen", {},
                "render it in parts");
  }
}

MemoryLease ListTiles(const FramePlan& plan, int first, int end, FrameGeometry& frame) {
  std::uint64_t runs = 0;
  for (const TriangleChunk& chunk : frame.chunks) runs += chunk.tiles.size();
  // While a list grows, its content exists twice.
  MemoryLease lease(3 * sizeof(TileRun) * runs + 3 * sizeof(std::vector<TileRun>) * std::uint64_t(end - first), 1,
                    kTileListsCharge);
  for (auto* lists : {&frame.lists.opaque, &frame.lists.masked, &frame.lists.blended}) {
    for (std::vector<TileRun>& list : *lists) list.clear();
    lists->resize(std::size_t(end - first));
  }
  for (std::size_t i = 0; i < frame.chunks.size(); ++i) {
    const TriangleChunk& chunk = frame.chunks[i];
    const FrameMaterial& material = plan.materials[std::size_t(frame.drawables[chunk.drawable].material)].frame;
    const AlphaMode mode = material.is_seen_through ? AlphaMode::Blend : material.alpha_mode;
    auto& lists = mode == AlphaMode::Opaque ? frame.lists.opaque
                  : mode == AlphaMode::Mask ? frame.lists.masked
                                            : frame.lists.blended;
    const auto at = [&](int tile) {
      return std::lower_bound(chunk.tiles.begin(), chunk.tiles.end(), std::uint32_t(tile)) - chunk.tiles.begin();
    };
    const auto stop = std::size_t(at(end));
    for (auto t = std::size_t(at(first)); t < stop; ++t) {
      lists[chunk.tiles[t] - std::uint32_t(first)].push_back(
          {static_cast<std::uint32_t>(i), chunk.begin[t], chunk.begin[t + 1]});
    }
  }
  return lease;
}

}  // namespace facet
