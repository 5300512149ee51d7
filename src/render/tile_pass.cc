#include "render/tile_pass.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <mutex>
#include <utility>

#include "base/parallel.h"
#include "blend/composite.h"
#include "blend/composite_through.h"
#include "render/tile_lights.h"
#include "render/tile_shading.h"
#include "render/tile_visibility.h"
#include "resolve/resolve_planes.h"
#include "resolve/resolve_tile.h"

namespace facet {
namespace {

struct TileCounts {
  std::uint64_t shaded = 0, blended = 0, covered = 0, non_finite = 0;
};

// Draws tiles, one after the other, and keeps its working memory. Not thread-safe: one per thread.
class TileWorker {
 public:
  TileWorker(const TilePassInput& input, const ShadingPositions& positions)
      : in_(input),
        shading_(input.view, positions),
        visibility_(input.view, shading_),
        lights_(input.view.view, input.lighting, input.cull_lights) {
    blended_.has_seen_through = input.backdrop != nullptr;
  }

  // `t`: the index of the tile in the output, whose top row of tiles is `first_row` of the grid.
  void Run(std::size_t t, int first_row, const TileOutput& output, TileCounts& counts) {
    const TileGrid& grid = in_.view.grid;
    const int column = static_cast<int>(t) % grid.columns, row = static_cast<int>(t) / grid.columns;
    opaque_.list.Clear();
    blended_.list.Clear();
    const bool touched = visibility_.Begin(column, first_row + row, t);
    const bool is_known = in_.backdrop != nullptr && output.planes.empty() && !visibility_.HasBlended();
    TileCounts again;  // not counted: of fragments that were shaded for the backdrop
    is_known ? in_.backdrop->GetTile(visibility_.Buffers(), pixels_)
             : DrawOpaque(touched, in_.backdrop != nullptr ? again : counts);
    in_.background.CompositeUnder(visibility_.Buffers(), pixels_);
    if (in_.ShowsThrough()) {
      through_pixels_.clear();
      for (const glm::vec4& pixel : pixels_) through_pixels_.emplace_back(1.0f - std::min(pixel.a, 1.0f));
    }
    if (visibility_.HasBlended()) Blend(counts);
    const std::size_t first =
        std::size_t(row * grid.tile_size) * std::size_t(grid.width) + std::size_t(column * grid.tile_size);
    Put(output, first);
    if (!output.planes.empty()) {
      const VisibleTile seen{visibility_.Buffers(), !touched, visibility_.Records().All().data(), in_.view.view,
                             in_.view.geometry.drawables.data()};
      planes_.Run(seen, first, std::size_t(grid.width), output.planes);
    }
    CountCovered(counts);
  }

  // The same, for the backdrop.
  void Run(std::size_t t, int first_row, Backdrop& backdrop, TileCounts& counts) {
    const int columns = in_.view.grid.columns, column = static_cast<int>(t) % columns;
    opaque_.list.Clear();
    const bool touched = visibility_.Begin(column, first_row + static_cast<int>(t) / columns, t);
    if (touched) DrawOpaque(touched, counts);
    backdrop.SetTile(visibility_.Buffers(), !touched, pixels_);
  }

 private:
  void DrawOpaque(bool touched, TileCounts& counts) {
    if (touched) {
      visibility_.Draw();
      VisibleFragments(visibility_.Buffers(), opaque_.list);
      Shade(opaque_, counts);
      counts.shaded += opaque_.list.Size();
      ResolveOpaque(visibility_.Buffers(), opaque_, pixels_);
    } else {
      const auto size = static_cast<std::size_t>(in_.view.grid.tile_size);
      pixels_.assign(size * size, glm::vec4(0.0f));
    }
  }

  void Shade(ShadedFragments& fragments, TileCounts& counts) {
    const TileBuffers& tile = visibility_.Buffers();
    const TileRecords& records = visibility_.Records();
    const LightingData& lighting = lights_.Reaching(tile, records, fragments.list);
    shading_.Shade(tile, records, lighting, fragments, counts.non_finite);
  }

  void Blend(TileCounts& counts) {
    visibility_.CollectBlended(in_.backdrop != nullptr, blended_.list);
    Shade(blended_, counts);
    counts.blended += blended_.list.Size();
    background_.assign(pixels_.size(), glm::vec4(0.0f));
    in_.background.CompositeUnder(visibility_.Buffers(), background_);
    if (in_.backdrop == nullptr) {
      compositor_.Run(visibility_.Buffers(), opaque_, blended_, visibility_.Records().All(), background_, pixels_);
      return;
    }
    const ThroughView view{in_.view.view.perspective, static_cast<float>(std::fabs(in_.view.view.screen_y.y)),
                           in_.background.IsEnvironment()};
    through_pixels_.resize(pixels_.size());
    through_.Run(view, visibility_.Buffers(), opaque_, blended_, visibility_.Records().All(), *in_.backdrop,
                 background_, pixels_, through_pixels_, environment_seen_);
    in_.background.AddSeen(environment_seen_, pixels_);
  }

  // `first`: the index of the tile's first pixel in the output.
  void Put(const TileOutput& output, std::size_t first) const {
    const TileBuffers& tile = visibility_.Buffers();
    if (output.film == nullptr) {
      EncodeTask task = output.encode;
      task.pixels = &pixels_[0].x;
      if (in_.ShowsThrough()) task.through = &through_pixels_[0].x;
      task.count = static_cast<std::size_t>(tile.width), task.rows = static_cast<std::size_t>(tile.height);
      task.pixel_stride = static_cast<std::size_t>(tile.tile_size);
      task.out_stride = static_cast<std::size_t>(in_.view.grid.width);
      task.out += first * task.PixelBytes();
      return EncodePixels(task);
    }
    for (int y = 0; y < tile.height; ++y) {
      const std::ptrdiff_t from = y * tile.tile_size;
      const std::size_t to = first + std::size_t(y) * std::size_t(in_.view.grid.width);
      std::copy_n(pixels_.data() + from, tile.width, output.film + to);
      if (output.through != nullptr) std::copy_n(through_pixels_.data() + from, tile.width, output.through + to);
    }
  }

  void CountCovered(TileCounts& counts) const {
    const TileBuffers& tile = visibility_.Buffers();
    int covered = 0;
    for (int y = 0; y < tile.height; ++y) {
      const glm::vec4* row = pixels_.data() + y * tile.tile_size;
      for (int x = 0; x < tile.width; ++x) covered += row[x].a > 0.0f;
    }
    counts.covered += static_cast<std::uint64_t>(covered);
  }

  const TilePassInput& in_;
  TileShading shading_;
  TileVisibility visibility_;
  TileLights lights_;
  ShadedFragments opaque_, blended_;
  Compositor compositor_;
  ThroughCompositor through_;
  EnvironmentSeen environment_seen_;
  PlaneResolver planes_;
  TilePixels background_, pixels_;
  std::vector<glm::vec3> through_pixels_;  // Film::through
};

// Lends workers to tasks, so that there is one per thread, not one per tile.
class WorkerPool {
 public:
  explicit WorkerPool(const TilePassInput& input) : input_(input), positions_(input.view.samples) {}

  std::unique_ptr<TileWorker> Take() {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) return std::make_unique<TileWorker>(input_, positions_);
    std::unique_ptr<TileWorker> worker = std::move(idle_.back());
    idle_.pop_back();
    return worker;
  }
  void Return(std::unique_ptr<TileWorker> worker) {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(worker));
  }

 private:
  const TilePassInput& input_;
  const ShadingPositions positions_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<TileWorker>> idle_;
};

}  // namespace

void CollectBackdrop(const TilePassInput& input, int first_row, int end_row, Backdrop& backdrop, RenderStats& stats) {
  WorkerPool pool(input);
  const std::size_t tile_count = std::size_t((end_row - first_row) * input.view.grid.columns);
  std::vector<TileCounts> counts(tile_count);
  ParallelFor(tile_count, 1, [&](std::size_t begin, std::size_t end) {
    std::unique_ptr<TileWorker> worker = pool.Take();
    for (std::size_t i = begin; i < end; ++i) worker->Run(i, first_row, backdrop, counts[i]);
    pool.Return(std::move(worker));
  });
  for (const TileCounts& c : counts) {
    stats.fragments_shaded += c.shaded;
    stats.non_finite_fragments += c.non_finite;
  }
}

void RunTiles(const TilePassInput& input, int first_row, int end_row, const TileOutput& output, RenderStats& stats) {
  WorkerPool pool(input);
  const TileGrid& grid = input.view.grid;
  const int first_tile = first_row * grid.columns;
  const std::size_t tile_count = std::size_t((end_row - first_row) * grid.columns);
  std::vector<TileCounts> counts(tile_count);
  std::atomic<std::size_t> done{0};
  double reported = 0.0;  // guarded by progress_mutex
  std::mutex progress_mutex;
  ParallelFor(tile_count, 1, [&](std::size_t begin, std::size_t end) {
    std::unique_ptr<TileWorker> worker = pool.Take();
    for (std::size_t i = begin; i < end; ++i) worker->Run(i, first_row, output, counts[i]);
    pool.Return(std::move(worker));
    const std::size_t now = done += end - begin;
    if (input.progress && now % 16 == 0) {
      const std::unique_lock lock(progress_mutex, std::try_to_lock);
      const double share = (first_tile + static_cast<double>(now)) / grid.Count();
      if (lock.owns_lock() && share > reported) input.progress(reported = share);
    }
  });
  for (const TileCounts& c : counts) {
    stats.fragments_shaded += c.shaded;
    stats.fragments_blended += c.blended;
    stats.covered_pixels += c.covered;
    stats.non_finite_fragments += c.non_finite;
  }
  stats.tiles += tile_count;
}

}  // namespace facet
