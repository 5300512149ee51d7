#include "render/tile_pass.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <memory>
#include <mutex>
#include <numeric>
#include <utility>

#include "base/memory_budget.h"
#include "base/parallel.h"
#include "blend/composite.h"
#include "facet/shader.h"
#include "light/cull_lights.h"
#include "raster/raster_tile.h"
#include "render/lit_box.h"
#include "render/view_directions.h"
#include "resolve/resolve_planes.h"
#include "resolve/resolve_tile.h"
#include "shade/shade_fragments.h"
#include "shade/triangle_setup.h"

namespace facet {
namespace {

struct TileCounts {
  std::uint64_t shaded = 0, blended = 0, covered = 0, non_finite = 0;
};

// Where the fragments of a pixel are shaded, by which of its samples they cover: the pixel's centre when they cover
// all, else the centroid of those they do, which lies within the triangle.
class ShadingPositions {
 public:
  explicit ShadingPositions(int samples) {
    const SamplePosition* pattern = SamplePattern(samples);
    const unsigned all = (1u << samples) - 1;
    for (unsigned mask = 1; mask <= all; ++mask) {
      int x = 0, y = 0, n = 0;
      for (int s = 0; s < samples; ++s) {
        if (mask >> s & 1) x += pattern[s].x, y += pattern[s].y, ++n;
      }
      x_[mask] = mask == all ? 0.5f : static_cast<float>(x) / static_cast<float>(n * kSampleGrid);
      y_[mask] = mask == all ? 0.5f : static_cast<float>(y) / static_cast<float>(n * kSampleGrid);
    }
  }
  float X(std::uint8_t samples) const { return x_[samples]; }
  float Y(std::uint8_t samples) const { return y_[samples]; }

 private:
  float x_[256] = {}, y_[256] = {};
};

// Of what a tile may hold in any number. What nearly all tiles have is not worth the counting.
class TileCharge {
 public:
  void AdmitRecords(std::size_t count) { Admit(count, kPerRecord, records_); }
  void AdmitFragments(std::size_t count) { Admit(count, kPerFragment, fragments_); }

 private:
  void Admit(std::size_t count, std::size_t size_each, std::size_t& admitted) {
    if (count <= admitted) return;
    const std::size_t more = std::max(count, admitted + admitted / 2) - admitted;
    leases_.emplace_back(more, size_each, "fragments of a tile", "", "use smaller tiles or fewer threads");
    admitted += more;
  }

  // A pointer, a number, a setup and its place; a fragment's own numbers, those that its shading needs, its place in
  // the order of layers. The vectors grow by half of these on average.
  static constexpr std::size_t kPerRecord = 40 + SetupLayout::kMostStride * sizeof(float), kPerFragment = 120;

  std::size_t records_ = std::size_t{1} << 14, fragments_ = std::size_t{1} << 16;
  std::vector<MemoryLease> leases_;
};

// Everything a thread needs while it works on one tile; kept for the next.
class TileWorker final : public RecordTable {
 public:
  TileWorker(const TilePassInput& input, const ShadingPositions& positions, const ViewDirections& directions)
      : in_(input), positions_(positions), directions_(directions), lighting_(input.lighting) {}

  // `t`: counted from the row of tiles that is the output's top.
  void Run(std::size_t t, int first_row, const TileOutput& output, TileCounts& counts) {
    counts_ = &counts;
    const int size = in_.grid.tile_size, output_y0 = static_cast<int>(t) / in_.grid.columns * size;
    tile_.x0 = static_cast<int>(t) % in_.grid.columns * size;
    tile_.y0 = first_row * size + output_y0;
    tile_.width = std::min(size, in_.grid.width - tile_.x0);
    tile_.height = std::min(size, in_.grid.height - tile_.y0);
    tile_.tile_size = size;
    tile_.samples = in_.settings.samples;
    records_.clear();
    material_ = -1;
    one_material_ = true;
    setup_of_record_.clear();
    opaque_.list.Clear();
    blended_.list.Clear();

    const TileLists& lists = in_.geometry.lists;
    charge_.AdmitRecords(CountOf(lists.opaque[t]) + CountOf(lists.masked[t]) + CountOf(lists.blended[t]));
    const bool nothing = lists.opaque[t].empty() && lists.masked[t].empty() && lists.blended[t].empty();
    const bool background = in_.plan.environment_background;
    if (nothing) {
      pixels_.assign(std::size_t(size) * std::size_t(size), glm::vec4(0.0f));
    } else {
      ClearTile(tile_);
      RasterOpaque(Gather(lists.opaque[t]), tile_);
      if (!lists.masked[t].empty()) DrawMasked(lists.masked[t]);
      VisibleFragments(tile_, opaque_.list);
      Shade(opaque_);
      counts.shaded += opaque_.list.Size();
      ResolveOpaque(tile_, opaque_, pixels_);
    }
    if (background) LayUnder(pixels_);
    if (!lists.blended[t].empty()) {
      CollectBlended(Gather(lists.blended[t]));
      Shade(blended_);
      counts.blended += blended_.list.Size();
      background_.assign(pixels_.size(), glm::vec4(0.0f));
      if (background) LayUnder(background_);
      compositor_.Run(tile_, opaque_, blended_, *this, background_, pixels_);
    }
    const std::size_t first = std::size_t(output_y0) * std::size_t(in_.grid.width) + std::size_t(tile_.x0);
    if (!output.planes.empty()) {
      plane_resolver_.Run({tile_, nothing, records_.data(), in_.view, in_.geometry.drawables.data()}, first,
                          std::size_t(in_.grid.width), output.planes);
    }
    if (output.film != nullptr) {
      for (int y = 0; y < tile_.height; ++y) {
        const glm::vec4* row = pixels_.data() + y * size;
        std::copy(row, row + tile_.width, output.film + first + std::ptrdiff_t(y) * in_.grid.width);
      }
    } else {
      Develop(first, output.develop);
    }
    int covered = 0;
    for (int y = 0; y < tile_.height; ++y) {
      const glm::vec4* row = pixels_.data() + y * size;
      for (int x = 0; x < tile_.width; ++x) covered += row[x].a > 0.0f;
    }
    counts.covered += static_cast<std::uint64_t>(covered);
  }

  const TriangleRecord& Record(std::int32_t number) const override { return *records_[std::size_t(number)]; }

 private:
  // `first`: the number of the tile's first pixel in the picture that the task is of.
  void Develop(std::size_t first, DevelopTask task) const {
    task.pixels = &pixels_[0].x;
    task.count = static_cast<std::size_t>(tile_.width), task.rows = static_cast<std::size_t>(tile_.height);
    task.pixel_stride = static_cast<std::size_t>(tile_.tile_size);
    task.out_stride = static_cast<std::size_t>(in_.grid.width);
    task.out += first * task.PixelBytes();
    DevelopPixels(task);
  }

  // Appends to records_; their places there are the numbers by which the tile knows them.
  TileTriangles Gather(const std::vector<TileRun>& runs) {
    const std::size_t before = records_.size();
    std::size_t count = before;
    for (const TileRun& run : runs) count += run.end - run.begin;
    records_.resize(count);
    setup_of_record_.resize(count, {0, 0});
    const TriangleRecord** out = records_.data() + before;
    for (const TileRun& run : runs) {
      const TriangleChunk& chunk = in_.geometry.chunks[run.chunk];
      const int material = in_.geometry.drawables[chunk.drawable].material;
      one_material_ = one_material_ && (material_ < 0 || material_ == material);
      material_ = material;
      const TriangleRecord* records = chunk.records.data();
      for (std::uint32_t e = run.begin; e < run.end; ++e) *out++ = records + chunk.entries[e];
    }
    for (std::size_t i = numbers_.size(); i < count; ++i) numbers_.push_back(static_cast<std::int32_t>(i));
    return {records_.data() + before, numbers_.data() + before, count - before};
  }

  static std::size_t CountOf(const std::vector<TileRun>& runs) {
    std::size_t count = 0;
    for (const TileRun& run : runs) count += run.end - run.begin;
    return count;
  }

  // In batches, so that the layers of a tile, of which there may be any number, are charged as they come.
  void CollectBlended(const TileTriangles& triangles) {
    constexpr std::size_t kBatch = 256;  // triangles
    for (std::size_t first = 0; first < triangles.count; first += kBatch) {
      charge_.AdmitFragments(blended_.list.Size());
      RasterCollect({triangles.records + first, triangles.numbers + first, std::min(kBatch, triangles.count - first)},
                    tile_, blended_.list, CollectDepth::NearerOrEqual);
    }
    charge_.AdmitFragments(blended_.list.Size());
  }

  // Alpha-tested triangles, in batches: their fragments are collected against the depth of the opaque ones, their alpha
  // alone is shaded, and those that pass are written in order, each against the depth of that moment. (Collected
  // against that depth, which samples a fragment covers, hence where its alpha is read, would depend on where batches
  // end, and so on the tile's size.)
  void DrawMasked(const std::vector<TileRun>& runs) {
    constexpr std::size_t kBatch = 64;  // triangles
    behind_masked_ = tile_;
    for (const TileRun& run : runs) {
      const TriangleChunk& chunk = in_.geometry.chunks[run.chunk];
      const int material = in_.geometry.drawables[chunk.drawable].material;
      FrameMaterial m = in_.plan.materials[std::size_t(material)].frame;
      m.features &= ~(kLit | kTangentSpaceBits);  // alpha needs neither place nor direction
      for (std::uint32_t first = run.begin; first < run.end; first += kBatch) {
        masked_.list.Clear();
        RasterCollect(Gather({{run.chunk, first, std::min<std::uint32_t>(run.end, first + kBatch)}}), behind_masked_,
                      masked_.list);
        const std::size_t n = masked_.list.Size();
        masked_.Resize();
        BatchAll(n);
        ShadeBatch(m, masked_, /*alpha_only=*/true);
        for (std::size_t i = 0; i < n; ++i) {
          if (!(masked_.alpha[i] >= m.factors.alpha_cutoff)) continue;
          const std::int32_t number = masked_.list.record[i];
          WriteFragment(Record(number), number, masked_.list.pixel[i], masked_.list.samples[i], tile_);
        }
      }
    }
  }

  std::uint32_t MaterialOf(std::int32_t number) const {
    return static_cast<std::uint32_t>(in_.geometry.drawables[Record(number).drawable].material);
  }

  // All of a list's fragments, in their order, for ShadeBatch().
  void BatchAll(std::size_t n) {
    batch_.resize(n);
    std::iota(batch_.begin(), batch_.end(), 0u);
  }

  // Shades all fragments of a list, material by material.
  void Shade(ShadedFragments& fragments) {
    const std::size_t n = fragments.list.Size();
    fragments.Resize();
    ChooseLights(fragments.list);
    if (n == 0) return;
    if (one_material_) {
      BatchAll(n);
      ShadeBatch(in_.plan.materials[MaterialOf(fragments.list.record[0])].frame, fragments, /*alpha_only=*/false);
      return;
    }
    by_material_.clear();
    std::int32_t last_number = kNoRecord;
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::int32_t number = fragments.list.record[i];
      if (number != last_number) {
        last_number = number;
        const std::uint32_t material = MaterialOf(number);
        if (by_material_.empty() || by_material_.back().material != material) by_material_.push_back({material, i, i});
      }
      by_material_.back().end = i + 1;
    }
    std::sort(by_material_.begin(), by_material_.end(), [](const MaterialRun& a, const MaterialRun& b) {
      return a.material != b.material ? a.material < b.material : a.begin < b.begin;
    });
    for (auto run = by_material_.begin(); run != by_material_.end();) {
      const std::uint32_t material = run->material;
      batch_.clear();
      for (; run != by_material_.end() && run->material == material; ++run) {
        for (std::uint32_t i = run->begin; i < run->end; ++i) batch_.push_back(i);
      }
      ShadeBatch(in_.plan.materials[material].frame, fragments, /*alpha_only=*/false);
    }
  }

  // Those lights that reach the tile's fragments: all where there are few, or nothing to bound the fragments with, and
  // for shaders of users, who may count them.
  void ChooseLights(const FragmentList& list) {
    constexpr int kFew = 4;
    lighting_ = in_.lighting;
    const bool all = in_.settings.HasShaders() || in_.lighting.light_count <= kFew || !in_.view.perspective;
    if (all || list.Size() == 0) return;
    LitBox box(in_.view, tile_);
    std::int32_t last_number = kNoRecord;
    for (std::size_t i = 0; i < list.Size(); ++i) {
      if (list.record[i] == last_number) continue;
      last_number = list.record[i];
      if (!box.Add(Record(last_number), in_.geometry.drawables[Record(last_number).drawable])) return;
    }
    glm::dvec3 low, high;
    box.Corners(low, high);
    LightsReaching(in_.lighting, low, high, reaching_);
    lighting_.lights = reaching_.data();
    lighting_.light_count = static_cast<int>(reaching_.size());
  }

  // Shades the fragments that batch_ names; some at a time, as the numbers of their setups are counted in 32 bits.
  void ShadeBatch(const FrameMaterial& material, ShadedFragments& fragments, bool alpha_only) {
    constexpr std::size_t kMost = std::size_t{1} << 20;
    static_assert(kMost * SetupLayout::kMostStride <= INT32_MAX);
    if (batch_.size() <= kMost) return ShadeSome(material, fragments, alpha_only);
    const std::vector<std::uint32_t> whole = batch_;
    for (auto from = whole.begin(); from != whole.end();) {
      const auto to = from + std::min<std::ptrdiff_t>(kMost, whole.end() - from);
      batch_.assign(from, to);
      ShadeSome(material, fragments, alpha_only);
      from = to;
    }
  }

  void ShadeSome(const FrameMaterial& material, ShadedFragments& fragments, bool alpha_only) {
    const std::size_t n = batch_.size();
    const std::size_t padded = (n + kTaskPadding - 1) / kTaskPadding * kTaskPadding;
    if (n == 0) return;
    setup_of_.resize(padded);
    for (auto* v : {&x_, &y_, &red_, &green_, &blue_, &alpha_}) v->resize(padded);
    const int tile_shift = std::countr_zero(static_cast<unsigned>(tile_.tile_size));
    const int anchor_x = tile_.x0 & ~(kAnchorSize - 1), anchor_y = tile_.y0 & ~(kAnchorSize - 1);
    const int tile_x = tile_.x0 - anchor_x, tile_y = tile_.y0 - anchor_y;
    const FragmentList& list = fragments.list;
    std::int32_t last_number = kNoRecord, last_setup = 0;
    ++batch_number_;
    set_up_.clear();
    const std::uint32_t* batch = batch_.data();
    const std::int32_t* numbers = list.record.data();
    std::int32_t* setup_of = setup_of_.data();
    for (std::size_t i = 0; i < n; ++i) {
      const std::int32_t number = numbers[batch[i]];
      if (number != last_number) {
        last_number = number;
        last_setup = SetupFor(number);
      }
      setup_of[i] = last_setup;
    }
    setups_.resize(std::max(setups_.size(), set_up_.size() * std::size_t(SetupLayout::Stride(material.uv_slots))));
    SetUpTriangles({&in_.view, in_.geometry.drawables.data(), &material, anchor_x, anchor_y, set_up_.data(),
                    set_up_.size(), setups_.data()});
    const std::uint16_t* pixels = list.pixel.data();
    const std::uint8_t* samples = list.samples.data();
    float *x = x_.data(), *y = y_.data();
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t f = batch[i];
      x[i] = static_cast<float>(tile_x + (pixels[f] & (tile_.tile_size - 1))) + positions_.X(samples[f]);
      y[i] = static_cast<float>(tile_y + (pixels[f] >> tile_shift)) + positions_.Y(samples[f]);
    }
    for (std::size_t i = n; i < padded; ++i) setup_of[i] = last_setup, x[i] = x[n - 1], y[i] = y[n - 1];
    ShadeTask task;
    task.setup = setup_of_.data();
    task.x = x_.data();
    task.y = y_.data();
    task.count = n;
    task.setups = setups_.data();
    task.material = &material;
    task.lighting = &lighting_;
    task.orthographic = !in_.view.perspective;
    const glm::dvec3 toward_eye = glm::dvec3(0.0, 0.0, 1.0) * in_.view.camera_from_world;
    for (int i = 0; i < 3; ++i) task.view_direction[i] = static_cast<float>(toward_eye[i]);
    task.red = red_.data();
    task.green = green_.data();
    task.blue = blue_.data();
    task.alpha = alpha_.data();
    task.non_finite = &counts_->non_finite;
    if (alpha_only) {
      ShadeAlpha(task);
    } else if (material.shader != nullptr) {
      material.shader->Shade(task);
    } else {
      ShadeFragments(task);
    }
    if (n == list.Size()) {  // all, and in their order
      fragments.alpha.swap(alpha_);
      if (!alpha_only) fragments.red.swap(red_), fragments.green.swap(green_), fragments.blue.swap(blue_);
      fragments.Resize();
      return;
    }
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t f = batch_[i];
      fragments.alpha[f] = alpha_[i];
      if (alpha_only) continue;
      fragments.red[f] = red_[i], fragments.green[f] = green_[i], fragments.blue[f] = blue_[i];
    }
  }

  // The number of a triangle's setup: there is one per triangle and batch.
  std::int32_t SetupFor(std::int32_t number) {
    SetupOfRecord& known = setup_of_record_[std::size_t(number)];
    if (known.batch != batch_number_) {
      known = {batch_number_, static_cast<std::int32_t>(set_up_.size())};
      set_up_.push_back(records_[std::size_t(number)]);
    }
    return known.setup;
  }

  // The environment, where pixels are not wholly covered.
  void LayUnder(std::vector<glm::vec4>& pixels) {
    BackgroundTask task;
    for (int c = 0; c < 3; ++c) {
      task.column[c] = directions_.column[c].data() + tile_.x0;
      task.whole[c] = directions_.whole[c];
    }
    task.width = tile_.width;
    task.lighting = &in_.background;
    for (int y = 0; y < tile_.height; ++y) {
      for (int c = 0; c < 3; ++c) task.row[c] = directions_.row[c][std::size_t(tile_.y0 + y)];
      task.pixels = &pixels[std::size_t(y) * std::size_t(tile_.tile_size)].x;
      ShadeBackground(task);
    }
  }

  // Fragments [begin, end) of a list, which have one material: neighbours mostly do.
  struct MaterialRun {
    std::uint32_t material, begin, end;
  };

  struct SetupOfRecord {
    std::uint64_t batch;  // in which it was made
    std::int32_t setup;
  };

  const TilePassInput& in_;
  const ShadingPositions& positions_;
  const ViewDirections& directions_;
  TileCounts* counts_ = nullptr;
  TileCharge charge_;
  TileBuffers tile_, behind_masked_;
  ShadedFragments opaque_, masked_, blended_;
  Compositor compositor_;
  PlaneResolver plane_resolver_;
  std::vector<const TriangleRecord*> records_;
  std::vector<std::int32_t> numbers_;
  int material_ = -1;         // of the record that came last
  bool one_material_ = true;  // all records have it
  std::vector<MaterialRun> by_material_;
  std::vector<std::uint32_t> batch_;
  std::vector<SetupOfRecord> setup_of_record_;
  std::uint64_t batch_number_ = 0;
  std::vector<const TriangleRecord*> set_up_;  // the records that have a setup in this batch, in its order
  std::vector<float> setups_;
  std::vector<std::int32_t> setup_of_;
  std::vector<float> x_, y_, red_, green_, blue_, alpha_;
  std::vector<glm::vec4> background_, pixels_;
  std::vector<PunctualLight> reaching_;
  LightingData lighting_;  // of the tile's fragments
};

// Workers are lent to tasks, so that there are as many as threads, not as tiles.
class WorkerPool {
 public:
  explicit WorkerPool(const TilePassInput& input)
      : input_(input),
        positions_(input.settings.samples),
        directions_(input.plan.environment_background ? MakeViewDirections(input.view) : ViewDirections()) {}

  std::unique_ptr<TileWorker> Take() {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) return std::make_unique<TileWorker>(input_, positions_, directions_);
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
  const ViewDirections directions_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<TileWorker>> idle_;
};

}  // namespace

void RunTiles(const TilePassInput& input, int first_row, int end_row, const TileOutput& output, RenderStats& stats) {
  WorkerPool pool(input);
  const int first_tile = first_row * input.grid.columns;
  const std::size_t tile_count = std::size_t((end_row - first_row) * input.grid.columns);
  std::vector<TileCounts> counts(tile_count);
  std::atomic<std::size_t> done{0};
  double reported = 0.0;  // guarded by progress_mutex
  std::mutex progress_mutex;
  ParallelFor(tile_count, 1, [&](std::size_t begin, std::size_t end) {
    std::unique_ptr<TileWorker> worker = pool.Take();
    for (std::size_t i = begin; i < end; ++i) worker->Run(i, first_row, output, counts[i]);
    pool.Return(std::move(worker));
    const std::size_t now = done += end - begin;
    if (input.settings.progress && now % 16 == 0) {
      const std::unique_lock lock(progress_mutex, std::try_to_lock);
      const double share = (first_tile + static_cast<double>(now)) / input.grid.Count();
      if (lock.owns_lock() && share > reported) input.settings.progress(reported = share);
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
