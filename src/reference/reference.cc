#include "reference/reference.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

#include "base/memory_budget.h"
#include "base/parallel.h"
#include "facet/error.h"
#include "frame/constants.h"
#include "light/punctual.h"
#include "plan/frame_plan.h"
#include "reference/geometry_exact.h"
#include "reference/material_exact.h"
#include "reference/trace_exact.h"
#include "scene/camera.h"

namespace facet {
namespace {

void CheckRange(const char* what, double value, double low, double high) {
  if (value >= low && value <= high) return;
  const auto text = [](double x) {
    std::string digits = std::to_string(x);
    digits.erase(digits.find_last_not_of('0') + 1);
    if (digits.back() == '.') digits.pop_back();
    return digits;
  };
  throw Error(ErrorCode::InvalidUsage, std::string(what) + " of " + text(value), "reference settings",
              text(low) + " to " + text(high) + " are accepted");
}

void CheckSettings(const RenderSettings& settings, const ReferenceSettings& reference) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  CheckRange("a width", settings.width, 1, kMaxImageSize);
  CheckRange("a height", settings.height, 1, kMaxImageSize);
  CheckThreads(settings.threads);
  CheckRange("an environment rotation", settings.environment.rotation, -1e9, 1e9);
  CheckRange("an environment intensity", settings.environment.intensity, 0, 1e30);
  CheckRange("a number of samples", reference.samples, 1, 65536);
  CheckRange("a number of environment samples", reference.environment_samples, 1, 1024);
  CheckRange("a number of batches", reference.batches, 2, 65536);
  CheckRange("a target error", reference.target_error, 0, kInfinity);
  CheckRange("a time budget", reference.time_budget, 0, kInfinity);
  if (settings.environment.kind == EnvironmentSettings::Kind::Image && settings.environment.image == nullptr &&
      settings.environment.source == nullptr) {
    throw Error(ErrorCode::InvalidUsage, "no environment picture", "reference settings",
                "set environment.image, environment.source or another environment.kind");
  }
  if (settings.HasShaders()) {
    throw Error(ErrorCode::InvalidUsage, "a fragment shader of one's own", "reference settings",
                "the reference has glTF's material model alone");
  }
}

// The source of tangents is an approximation setting; the reference always uses those of the file if it has them.
PoseSettings PoseForReference(const RenderSettings& settings) {
  PoseSettings pose = PoseOf(settings);
  pose.generate_tangents = false;
  return pose;
}

// A prepared scene, and the computation of one pixel in one batch.
class ReferenceScene {
 public:
  ReferenceScene(const Scene& scene, const RenderSettings& settings, const ReferenceSettings& reference,
                 std::vector<std::string>& notes)
      : reference_(reference),
        posed_(Pose(scene, PoseForReference(settings))),
        plan_(MakeFramePlan(scene, posed_, settings)),
        materials_(MakeExactMaterials(scene, plan_, notes)),
        view_(ResolveCamera(settings.camera, scene, posed_, settings.width, settings.height), settings.width,
              settings.height),
        geometry_(view_, posed_, DoubleSided()),
        punctual_(plan_.punctual_lights ? MakePunctualLights(posed_.lights, view_.eye_world)
                                        : std::vector<PunctualLight>()) {
    if (plan_.environment_light || plan_.environment_background) environment_.emplace(settings.environment);
    light_.emplace(ExactLight{punctual_, plan_.environment_light ? &*environment_ : nullptr, AlbedoSurface::Shared(),
                              std::uint32_t(reference.environment_samples)});
    tracer_.emplace(geometry_, posed_, plan_, materials_, *light_,
                    plan_.environment_background ? &*environment_ : nullptr);
  }

  // Working memory of one thread.
  struct Scratch {
    std::vector<std::uint32_t> candidates;
    std::vector<ExactGeometry::Hit> hits, layers;
  };

  // Light as in a film, and what shows through (Film::through).
  struct Value {
    glm::dvec4 color{0.0};
    glm::dvec3 through{0.0};
  };
  // Whether a background that is not known yet shows through some surfaces.
  bool ShowsThrough() const { return tracer_->Traces() && !plan_.environment_background; }

  // The mean over the pixel's samples.
  Value Pixel(int x, int y, int batch, Scratch& scratch) const {
    geometry_.CandidatesOf(x, y, scratch.candidates);
    const std::uint64_t number = std::uint64_t(y) << 32 | std::uint64_t(x);
    const SampleSequence sequence(MixBits(MixBits(MixBits(reference_.seed) ^ std::uint64_t(batch)) ^ number));
    Value sum;
    for (int i = 0; i < reference_.samples; ++i) {
      const glm::dvec2 place = glm::dvec2(x, y) + sequence.Point(0, std::uint32_t(i));
      const Value value = At(place, {sequence, 1, std::uint32_t(i) * light_->environment_samples}, scratch);
      sum.color += value.color, sum.through += value.through;
    }
    return {sum.color / double(reference_.samples), sum.through / double(reference_.samples)};
  }

  const ExactTracer& Tracer() const { return *tracer_; }

 private:
  using Hit = ExactGeometry::Hit;

  std::vector<bool> DoubleSided() const {
    std::vector<bool> result;
    for (const int material : plan_.material_of_drawable) {
      result.push_back(materials_[std::size_t(material)].Frame().Has(kDoubleSided));
    }
    return result;
  }

  const ExactMaterial& MaterialAt(const Hit& hit) const {
    return materials_[std::size_t(plan_.material_of_drawable[geometry_.DrawableOf(hit)])];
  }

  // Linear light, premultiplied, at one position in the image: blended surfaces composited over the nearest opaque or
  // alpha-tested surface.
  Value At(const glm::dvec2& place, SampleRun run, Scratch& scratch) const {
    geometry_.HitsAt(place, scratch.candidates, scratch.hits);
    const Hit* nearest = nullptr;
    const auto consider = [&](const Hit& hit) {
      if (nearest == nullptr || hit.depth > nearest->depth) nearest = &hit;
    };
    bool others = false;
    for (const Hit& hit : scratch.hits) {
      if (MaterialAt(hit).Frame().alpha_mode == AlphaMode::Opaque) {
        consider(hit);
      } else {
        others = true;
      }
    }
    scratch.layers.clear();
    if (others) {
      for (const Hit& hit : scratch.hits) {
        const ExactMaterial& material = MaterialAt(hit);
        const FrameMaterial& frame = material.Frame();
        if (frame.alpha_mode != AlphaMode::Mask || (nearest != nullptr && hit.depth <= nearest->depth)) continue;
        if (material.BaseColor(geometry_.SurfaceAt(hit)).w >= double(frame.factors.alpha_cutoff)) consider(hit);
      }
      for (const Hit& hit : scratch.hits) {
        const bool seen = nearest == nullptr || hit.depth >= nearest->depth;
        if (seen && MaterialAt(hit).Frame().alpha_mode == AlphaMode::Blend) scratch.layers.push_back(hit);
      }
      std::stable_sort(scratch.layers.begin(), scratch.layers.end(),
                       [](const Hit& a, const Hit& b) { return a.depth < b.depth; });
    }

    Value value;
    if (nearest != nullptr) {
      const ExactTracer::Shown shown = tracer_->Shade(*nearest, run);
      value = {glm::dvec4(shown.light, shown.Alpha()), shown.through};
    } else if (plan_.environment_background) {
      value.color = glm::dvec4(environment_->Toward(view_.DirectionThrough(place)).radiance, 1.0);
    } else {
      value.through = glm::dvec3(1.0);
    }
    for (const Hit& layer : scratch.layers) {
      run.pair += kPairsOfRadiance;
      const ExactTracer::Shown shown = tracer_->Shade(layer, run);
      const double rest = 1.0 - shown.coverage;
      value.color = glm::dvec4(shown.light, shown.Alpha()) * shown.coverage + value.color * rest;
      value.through = shown.through * shown.coverage + value.through * rest;
    }
    return value;
  }

  const ReferenceSettings& reference_;
  PosedScene posed_;
  FramePlan plan_;
  std::vector<ExactMaterial> materials_;
  ExactView view_;
  ExactGeometry geometry_;
  std::vector<PunctualLight> punctual_;
  std::optional<ExactEnvironment> environment_;
  std::optional<ExactLight> light_;
  std::optional<ExactTracer> tracer_;
};

// Computes the overall errors of a film from its `standard_error`. Unknown pixels are 0 and add nothing.
void SumUp(ReferenceFilm& film) {
  double light = 0.0, error = 0.0;
  for (std::size_t i = 0; i < film.pixels.size(); ++i) {
    const glm::dvec3 color(film.pixels[i]), deviation(film.standard_error[i]);
    light += glm::dot(color, color);
    error += glm::dot(deviation, deviation);
  }
  film.rms_error = std::sqrt(error / (3.0 * double(film.known_pixels)));
  film.relative_error = light > 0.0 ? std::sqrt(error / light) : 0.0;
}

RenderSettings WithoutWhatIsUnused(RenderSettings settings) {
  settings.omit_unused = true;
  return settings;
}

}  // namespace

class ReferenceRun::Work {
 public:
  Work(const Scene& scene, const RenderSettings& settings, const ReferenceSettings& reference)
      : settings_(WithoutWhatIsUnused(settings)),
        reference_(reference),
        start_(reference.clock()),
        film_bytes_(std::uint64_t(settings.width) * std::uint64_t(settings.height), 3 * sizeof(glm::dvec4),
                    "the reference"),
        prepared_(scene, settings_, reference_, notes_),
        through_bytes_(prepared_.ShowsThrough() ? std::uint64_t(settings.width) * std::uint64_t(settings.height) : 0,
                       sizeof(glm::dvec3), "the reference"),
        order_(SpreadBlocks(settings.width, settings.height, reference.seed)) {
    film_.width = settings_.width;
    film_.height = settings_.height;
    const std::size_t count = std::size_t(film_.width) * std::size_t(film_.height);
    film_.pixels.assign(count, glm::dvec4(0.0));
    film_.standard_error.assign(count, glm::dvec4(0.0));
    if (prepared_.ShowsThrough()) film_.through.assign(count, glm::dvec3(0.0));
    squares_.assign(count, glm::dvec4(0.0));
    preparation_seconds_ = Elapsed();
  }

  int Threads() const { return settings_.threads; }

  const ReferenceFilm& Continue(double seconds) {
    if (!film_.whole) MakeBlocks(seconds);
    while (film_.whole && film_.batches < reference_.batches) {
      if (film_.batches >= kFewestForTarget && film_.relative_error <= reference_.target_error) break;
      const double before = Elapsed();
      if (before + batch_seconds_ > seconds) break;
      MakeBatch();
      SumUp(film_);
      batch_seconds_ = Elapsed() - before;
      Tell();
    }
    film_.notes = notes_;
    const ExactTracer& tracer = prepared_.Tracer();
    if (tracer.NonFinite() > 0) {
      film_.notes.push_back(std::to_string(tracer.NonFinite()) + " samples were not finite, and became black");
    }
    if (tracer.GivenUp() > 0) {
      film_.notes.push_back(std::to_string(tracer.GivenUp()) + " rays were still inside of glass after " +
                            std::to_string(ExactTracer::kMostCrossings) + " surfaces, and became black");
    }
    film_.seconds = Elapsed();
    return film_;
  }

  double SecondsFor(double relative_error) const {
    if (film_.relative_error <= relative_error) return film_.seconds;
    // Further batches always cover the whole image. The error of the mean falls with the root of their number.
    const double share = double(film_.known_pixels) / double(film_.pixels.size());
    const double ratio = film_.relative_error / relative_error;
    return preparation_seconds_ + blocks_seconds_ / share * film_.batches * ratio * ratio / 2.0;
  }

 private:
  // At least this many blocks that are not black are rendered in any case, as long as no more than that are black.
  static constexpr std::size_t kFewestLitBlocks = 16, kFewestBlocks = 128;
  static constexpr int kFewestForTarget = 4;            // batches
  static constexpr double kSecondsBetweenWords = 0.25;  // between calls of progress

  double Elapsed() const { return reference_.clock() - start_; }

  // Progress of one batch, in rendered blocks.
  void Tell() const {
    if (!settings_.progress) return;
    const double done = film_.whole ? film_.batches : 2.0 * double(film_.blocks.size()) / double(order_.size());
    settings_.progress(done / reference_.batches);
  }

  // Adds one batch to the mean and variance of pixel (x, y), which `batch` batches have been added to before: Welford,
  // 1962, Note on a Method for Calculating Corrected Sums of Squares and Products.
  void AddBatch(int x, int y, int batch, ReferenceScene::Scratch& scratch) {
    const std::size_t i = std::size_t(y) * std::size_t(film_.width) + std::size_t(x);
    const ReferenceScene::Value pixel = prepared_.Pixel(x, y, batch, scratch);
    const glm::dvec4& value = pixel.color;
    const double n = batch + 1.0;
    const glm::dvec4 off = value - film_.pixels[i];
    film_.pixels[i] += off / n;
    if (!film_.through.empty()) film_.through[i] += (pixel.through - film_.through[i]) / n;
    squares_[i] += off * (value - film_.pixels[i]);
    film_.standard_error[i] = glm::sqrt(squares_[i] / (n * std::max(n - 1.0, 1.0)));
  }

  // Whether the block is not black.
  bool MakeBlock(const PixelBlock& block, ReferenceScene::Scratch& scratch) {
    glm::dvec4 sum(0.0);
    for (int y = block.y; y < block.y + block.height; ++y) {
      for (int x = block.x; x < block.x + block.width; ++x) {
        for (int batch = 0; batch < 2; ++batch) AddBatch(x, y, batch, scratch);
        sum += film_.pixels[std::size_t(y) * std::size_t(film_.width) + std::size_t(x)];
      }
    }
    return sum.x + sum.y + sum.z > 0.0;
  }

  bool HasEnough() const { return lit_blocks_ >= kFewestLitBlocks || next_block_ >= kFewestBlocks; }

  void MakeBlocks(double seconds) {
    const double before = Elapsed();
    while (next_block_ < order_.size() && !(HasEnough() && Elapsed() >= seconds)) {
      const double pause = std::min(Elapsed() + kSecondsBetweenWords, seconds);
      // Each thread takes the next block until time is up, so that the rendered blocks are the first of the order.
      ParallelFor(std::size_t(CurrentThreadCount()), 1, [&](std::size_t, std::size_t) {
        ReferenceScene::Scratch scratch;
        do {
          const std::size_t taken = next_block_++;
          if (taken >= order_.size()) return;
          if (MakeBlock(order_[taken], scratch)) ++lit_blocks_;
        } while (!HasEnough() || Elapsed() < pause);
      });
      next_block_ = std::min(next_block_.load(), order_.size());
      film_.blocks.assign(order_.begin(), order_.begin() + std::ptrdiff_t(next_block_.load()));
      Tell();
    }
    film_.known_pixels = 0;
    for (const PixelBlock& block : film_.blocks) film_.known_pixels += std::size_t(block.width * block.height);
    film_.whole = next_block_ == order_.size();
    film_.batches = 2;
    SumUp(film_);
    blocks_seconds_ += Elapsed() - before;
    batch_seconds_ = 0.5 * blocks_seconds_;
  }

  void MakeBatch() {
    constexpr std::size_t kGrain = 32;  // pixels
    ParallelFor(film_.pixels.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      ReferenceScene::Scratch scratch;
      const std::size_t width = std::size_t(film_.width);
      for (std::size_t i = begin; i < end; ++i) AddBatch(int(i % width), int(i / width), film_.batches, scratch);
    });
    ++film_.batches;
  }

  const RenderSettings settings_;
  const ReferenceSettings reference_;
  const double start_;
  const MemoryLease film_bytes_;  // of the film and of squares_
  std::vector<std::string> notes_;
  const ReferenceScene prepared_;
  const MemoryLease through_bytes_;  // of the film's `through`
  const std::vector<PixelBlock> order_;
  ReferenceFilm film_;
  std::vector<glm::dvec4> squares_;  // of deviations from the mean, summed
  std::atomic<std::size_t> next_block_{0}, lit_blocks_{0};
  double preparation_seconds_ = 0.0;
  double blocks_seconds_ = 0.0;  // for the blocks that there are
  double batch_seconds_ = 0.0;   // for one batch of all
};

ReferenceRun::ReferenceRun(const Scene& scene, const RenderSettings& settings, const ReferenceSettings& reference) {
  CheckSettings(settings, reference);
  RunWithThreads(settings.threads, [&] { work_ = std::make_unique<Work>(scene, settings, reference); });
}

ReferenceRun::~ReferenceRun() = default;

const ReferenceFilm& ReferenceRun::Continue(double seconds) {
  const ReferenceFilm* film = nullptr;
  RunWithThreads(work_->Threads(), [&] { film = &work_->Continue(seconds); });
  return *film;
}

double ReferenceRun::SecondsFor(double relative_error) const { return work_->SecondsFor(relative_error); }

ReferenceFilm RenderReference(const Scene& scene, const RenderSettings& settings, const ReferenceSettings& reference) {
  return ReferenceRun(scene, settings, reference).Continue(reference.time_budget);
}

Film ToFilm(const ReferenceFilm& reference) {
  Film film;
  film.width = reference.width;
  film.height = reference.height;
  for (const glm::dvec4& pixel : reference.pixels) film.pixels.push_back(RoundToFloat(pixel));
  film.through.assign(reference.through.begin(), reference.through.end());
  return film;
}

}  // namespace facet
