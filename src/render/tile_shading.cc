#include "render/tile_shading.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "facet/shader.h"
#include "shade/attribute_setup.h"
#include "shade/shade_fragments.h"

namespace facet {

ShadingPositions::ShadingPositions(int samples) {
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

// What the fragments of a batch share; selected_ has their indices.
struct TileShading::Batch {
  const TileBuffers& tile;
  const TileRecords& records;
  const FrameMaterial& material;
  const LightingData* lighting = nullptr;  // null: compute alpha only
  std::uint64_t* non_finite = nullptr;
};

void TileShading::Shade(const TileBuffers& tile, const TileRecords& records, const LightingData& lighting,
                        ShadedFragments& fragments, std::uint64_t& non_finite) {
  const std::size_t n = fragments.list.Size();
  fragments.Resize();
  if (n == 0) return;
  const auto shade_selected = [&](std::uint32_t material) {
    ShadeBatch({tile, records, view_.materials[material], &lighting, &non_finite}, fragments);
  };
  if (records.HaveOneMaterial()) {
    SelectAll(n);
    return shade_selected(records.MaterialOf(fragments.list.record[0]));
  }
  runs_.clear();
  std::int32_t last_id = kNoRecord;
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::int32_t id = fragments.list.record[i];
    if (id != last_id) {
      last_id = id;
      const std::uint32_t material = records.MaterialOf(id);
      if (runs_.empty() || runs_.back().material != material) runs_.push_back({material, i, i});
    }
    runs_.back().end = i + 1;
  }
  std::sort(runs_.begin(), runs_.end(), [](const MaterialRun& a, const MaterialRun& b) {
    return a.material != b.material ? a.material < b.material : a.begin < b.begin;
  });
  for (auto run = runs_.begin(); run != runs_.end();) {
    const std::uint32_t material = run->material;
    selected_.clear();
    for (; run != runs_.end() && run->material == material; ++run) {
      for (std::uint32_t i = run->begin; i < run->end; ++i) selected_.push_back(i);
    }
    shade_selected(material);
  }
}

void TileShading::ComputeAlpha(const TileBuffers& tile, const TileRecords& records, const FrameMaterial& material,
                               ShadedFragments& fragments) {
  fragments.Resize();
  SelectAll(fragments.list.Size());
  ShadeBatch({tile, records, material}, fragments);
}

void TileShading::SelectAll(std::size_t count) {
  selected_.resize(count);
  std::iota(selected_.begin(), selected_.end(), 0u);
}

// Splits large batches, because setups are indexed with 32 bits.
void TileShading::ShadeBatch(const Batch& batch, ShadedFragments& fragments) {
  constexpr std::size_t kMost = std::size_t{1} << 20;
  static_assert(kMost * AttributeLayout::kMostStride <= INT32_MAX);
  if (selected_.size() <= kMost) return ShadePart(batch, fragments);
  const std::vector<std::uint32_t> whole = selected_;
  for (auto from = whole.begin(); from != whole.end();) {
    const auto to = from + std::min<std::ptrdiff_t>(kMost, whole.end() - from);
    selected_.assign(from, to);
    ShadePart(batch, fragments);
    from = to;
  }
}

void TileShading::ShadePart(const Batch& batch, ShadedFragments& fragments) {
  const std::size_t n = selected_.size(), padded = (n + kTaskPadding - 1) / kTaskPadding * kTaskPadding;
  if (n == 0) return;
  const bool alpha_only = batch.lighting == nullptr;
  SetUpBatch(batch, fragments.list, padded);
  PlaceFragments(batch.tile, fragments.list, padded);
  for (auto* v : {&red_, &green_, &blue_, &alpha_}) v->resize(padded);
  ShadeTask task;
  task.setup = setup_of_.data();
  task.x = x_.data();
  task.y = y_.data();
  task.count = n;
  task.setups = setups_.data();
  task.material = &batch.material;
  task.lighting = batch.lighting;
  task.orthographic = !view_.view.perspective;
  const glm::dvec3 toward_eye = glm::dvec3(0.0, 0.0, 1.0) * view_.view.camera_from_world;
  for (int i = 0; i < 3; ++i) task.view_direction[i] = static_cast<float>(toward_eye[i]);
  task.red = red_.data();
  task.green = green_.data();
  task.blue = blue_.data();
  task.alpha = alpha_.data();
  task.non_finite = batch.non_finite;
  const bool is_seen_through = fragments.has_seen_through && batch.material.is_seen_through;
  SeenThroughOutputs seen_through;
  if (is_seen_through) seen_through = PrepareSeenThrough(padded, task), task.seen_through = &seen_through;
  if (alpha_only) {
    ShadeAlpha(task);
  } else if (batch.material.shader != nullptr) {
    batch.material.shader->Shade(task);
  } else {
    ShadeFragments(task);
  }
  if (fragments.has_seen_through) {
    PutSeenThrough(is_seen_through, batch.material.Has(kDispersion), fragments.seen_through);
  }
  if (n == fragments.list.Size()) {  // all, and in their order
    fragments.alpha.swap(alpha_);
    if (!alpha_only) fragments.red.swap(red_), fragments.green.swap(green_), fragments.blue.swap(blue_);
    fragments.Resize();
    return;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t f = selected_[i];
    fragments.alpha[f] = alpha_[i];
    if (alpha_only) continue;
    fragments.red[f] = red_[i], fragments.green[f] = green_[i], fragments.blue[f] = blue_[i];
  }
}

SeenThroughOutputs TileShading::PrepareSeenThrough(std::size_t padded, ShadeTask& task) {
  seen_through_.Resize(padded);
  SeenThroughOutputs out;
  for (int c = 0; c < 3; ++c) {
    out.tint[c] = seen_through_.tint[c].data();
    out.shift_x[c] = seen_through_.shift_x[c].data();
    out.shift_y[c] = seen_through_.shift_y[c].data();
  }
  out.blur = seen_through_.blur.data();
  const FrameView& view = view_.view;
  const glm::dvec3 rows[3] = {view.screen_x, view.screen_y, {0.0, 0.0, -1.0}};
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 row = rows[i] * view.camera_from_world;
    for (int c = 0; c < 3; ++c) task.screen_from_eye[i][c] = static_cast<float>(row[c]);
  }
  task.pixels_per_tangent = static_cast<float>(std::fabs(view.screen_y.y));
  return out;
}

// Fragments that are not seen through have zeros.
void TileShading::PutSeenThrough(bool is_seen_through, bool disperses, SeenThroughFragments& out) const {
  const auto put = [&](const PageVector<float>& from, PageVector<float>& to) {
    for (std::size_t i = 0; i < selected_.size(); ++i) to[selected_[i]] = is_seen_through ? from[i] : 0.0f;
  };
  for (int c = 0; c < 3; ++c) {
    const int channel = disperses ? c : 0;
    put(seen_through_.tint[c], out.tint[c]);
    put(seen_through_.shift_x[channel], out.shift_x[c]);
    put(seen_through_.shift_y[channel], out.shift_y[c]);
  }
  put(seen_through_.blur, out.blur);
}

// Sets up the attributes of each triangle of the batch once. Padding uses the setup of the last fragment.
void TileShading::SetUpBatch(const Batch& batch, const FragmentList& list, std::size_t padded) {
  const std::size_t n = selected_.size();
  ++batch_number_;
  set_up_.clear();
  setup_of_.resize(padded);
  setup_of_record_.resize(std::max(setup_of_record_.size(), batch.records.All().size()), {0, 0});
  const std::uint64_t batch_number = batch_number_;
  const ScreenTriangle* const* records = batch.records.All().data();
  const std::uint32_t* selected = selected_.data();
  const std::int32_t* ids = list.record.data();
  SetupOfRecord* setup_of_record = setup_of_record_.data();
  std::int32_t* setup_of = setup_of_.data();
  std::int32_t last_id = kNoRecord, last_setup = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::int32_t id = ids[selected[i]];
    if (id != last_id) {
      last_id = id;
      SetupOfRecord& known = setup_of_record[id];
      if (known.batch != batch_number) {
        known = {batch_number, static_cast<std::int32_t>(set_up_.size())};
        set_up_.push_back(records[id]);
      }
      last_setup = known.setup;
    }
    setup_of[i] = last_setup;
  }
  for (std::size_t i = n; i < padded; ++i) setup_of[i] = last_setup;
  const std::size_t stride = std::size_t(AttributeLayout::Stride(batch.material.uv_slots));
  setups_.resize(std::max(setups_.size(), set_up_.size() * stride));
  AttributeSetupTask task;
  task.view = &view_.view;
  task.drawables = view_.geometry.drawables.data();
  task.attributes = view_.attributes.data();
  task.material = &batch.material;
  task.anchor_x = batch.tile.x0 & ~(kAnchorSize - 1);
  task.anchor_y = batch.tile.y0 & ~(kAnchorSize - 1);
  task.records = set_up_.data();
  task.count = set_up_.size();
  task.setups = setups_.data();
  SetUpTriangleAttributes(task);
}

// Computes the positions at which fragments are shaded, in pixels from the anchor. Padding repeats the last one.
void TileShading::PlaceFragments(const TileBuffers& tile, const FragmentList& list, std::size_t padded) {
  const std::size_t n = selected_.size();
  x_.resize(padded), y_.resize(padded);
  const int tile_shift = std::countr_zero(static_cast<unsigned>(tile.tile_size));
  const int tile_x = tile.x0 & (kAnchorSize - 1), tile_y = tile.y0 & (kAnchorSize - 1);
  const std::uint32_t* selected = selected_.data();
  const std::uint16_t* pixels = list.pixel.data();
  const std::uint8_t* samples = list.samples.data();
  float *x = x_.data(), *y = y_.data();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t f = selected[i];
    x[i] = static_cast<float>(tile_x + (pixels[f] & (tile.tile_size - 1))) + positions_.X(samples[f]);
    y[i] = static_cast<float>(tile_y + (pixels[f] >> tile_shift)) + positions_.Y(samples[f]);
  }
  for (std::size_t i = n; i < padded; ++i) x[i] = x[n - 1], y[i] = y[n - 1];
}

}  // namespace facet
