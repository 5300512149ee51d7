#include "reference/reference.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <optional>

#include "base/parallel.h"
#include "facet/error.h"
#include "frame/constants.h"
#include "light/punctual.h"
#include "plan/frame_plan.h"
#include "reference/geometry_exact.h"
#include "reference/material_exact.h"
#include "reference/radiance_exact.h"
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
  CheckRange("a width", settings.width, 1, kMaxPictureSize);
  CheckRange("a height", settings.height, 1, kMaxPictureSize);
  CheckRange("a number of threads", settings.threads, 0, 65536);
  CheckRange("an environment rotation", settings.environment.rotation, -1e9, 1e9);
  CheckRange("an environment intensity", settings.environment.intensity, 0, 1e30);
  CheckRange("a number of samples", reference.samples, 1, 65536);
  CheckRange("a number of environment samples", reference.environment_samples, 1, 1024);
  CheckRange("a number of batches", reference.batches, 2, 65536);
  CheckRange("a target error", reference.target_error, 0, kInfinity);
  CheckRange("a time budget", reference.time_budget, 0, kInfinity);
  CheckRange("a time to give up after", reference.give_up_after, 0, kInfinity);
  if (settings.environment.kind == EnvironmentSettings::Kind::Image && settings.environment.image == nullptr &&
      settings.environment.source == nullptr) {
    throw Error(ErrorCode::InvalidUsage, "no environment picture", "reference settings",
                "set environment.image, environment.source or another environment.kind");
  }
  if (settings.shader != nullptr) {
    throw Error(ErrorCode::InvalidUsage, "a fragment shader of one's own", "reference settings",
                "the reference has glTF's material model alone");
  }
}

// Whose tangents is a choice of approximation.
PoseSettings PoseForReference(const RenderSettings& settings) {
  PoseSettings pose = PoseOf(settings);
  pose.generate_tangents = false;
  return pose;
}

// A scene made ready, and the picture of one pixel in one batch.
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
  }

  // Working memory of one thread.
  struct Scratch {
    std::vector<std::uint32_t> candidates;
    std::vector<ExactGeometry::Hit> hits, layers;
  };

  // The mean over the pixel's samples.
  glm::dvec4 Pixel(int x, int y, int batch, Scratch& scratch) const {
    geometry_.CandidatesOf(x, y, scratch.candidates);
    const std::uint64_t number = std::uint64_t(y) << 32 | std::uint64_t(x);
    const SampleSequence sequence(MixBits(MixBits(MixBits(reference_.seed) ^ std::uint64_t(batch)) ^ number));
    glm::dvec4 sum(0.0);
    for (int i = 0; i < reference_.samples; ++i) {
      const glm::dvec2 place = glm::dvec2(x, y) + sequence.Point(0, std::uint32_t(i));
      sum += At(place, {sequence, 1, std::uint32_t(i) * light_->environment_samples}, scratch);
    }
    return sum / double(reference_.samples);
  }

  std::uint64_t NonFinite() const { return non_finite_; }

 private:
  using Hit = ExactGeometry::Hit;

  std::vector<bool> DoubleSided() const {
    std::vector<bool> result;
    for (const int material : plan_.material_of_drawable) {
      result.push_back(materials_[std::size_t(material)].IsDoubleSided());
    }
    return result;
  }

  const ExactMaterial& MaterialAt(const Hit& hit) const {
    return materials_[std::size_t(plan_.material_of_drawable[geometry_.DrawableOf(hit)])];
  }

  // Linear light, premultiplied, at one place of the picture: the nearest opaque or tested surface, over it what
  // blends.
  glm::dvec4 At(const glm::dvec2& place, SampleRun run, Scratch& scratch) const {
    geometry_.HitsAt(place, scratch.candidates, scratch.hits);
    const Hit* nearest = nullptr;
    const auto consider = [&](const Hit& hit) {
      if (nearest == nullptr || hit.depth > nearest->depth) nearest = &hit;
    };
    bool others = false;
    for (const Hit& hit : scratch.hits) {
      if (MaterialAt(hit).Mode() == AlphaMode::Opaque) {
        consider(hit);
      } else {
        others = true;
      }
    }
    scratch.layers.clear();
    if (others) {
      for (const Hit& hit : scratch.hits) {
        const ExactMaterial& material = MaterialAt(hit);
        if (material.Mode() != AlphaMode::Mask || (nearest != nullptr && hit.depth <= nearest->depth)) continue;
        if (material.BaseColor(geometry_.SurfaceAt(hit)).w >= material.AlphaCutoff()) consider(hit);
      }
      for (const Hit& hit : scratch.hits) {
        const bool seen = nearest == nullptr || hit.depth >= nearest->depth;
        if (seen && MaterialAt(hit).Mode() == AlphaMode::Blend) scratch.layers.push_back(hit);
      }
      std::stable_sort(scratch.layers.begin(), scratch.layers.end(),
                       [](const Hit& a, const Hit& b) { return a.depth < b.depth; });
    }

    glm::dvec4 color(0.0);
    if (nearest != nullptr) {
      color = glm::dvec4(glm::dvec3(Shade(*nearest, run)), 1.0);
    } else if (plan_.environment_background) {
      color = glm::dvec4(environment_->Toward(view_.DirectionThrough(place)).radiance, 1.0);
    }
    for (const Hit& layer : scratch.layers) {
      run.pair += kPairsOfRadiance;
      const glm::dvec4 shaded = Shade(layer, run);
      color = glm::dvec4(glm::dvec3(shaded), 1.0) * shaded.w + color * (1.0 - shaded.w);
    }
    return color;
  }

  // Radiance, and alpha in [0, 1]. What is not finite becomes black and transparent, and is counted.
  glm::dvec4 Shade(const Hit& hit, const SampleRun& run) const {
    const SurfacePoint point = geometry_.SurfaceAt(hit);
    const ExactMaterial& material = MaterialAt(hit);
    const glm::dvec4 base = material.BaseColor(point);
    glm::dvec3 color(base);
    if (material.IsLit()) color = RadianceTowardEye(material.Inputs(point, color), point, *light_, run);
    if (!std::isfinite(color.x + color.y + color.z + base.w)) {
      ++non_finite_;
      return glm::dvec4(0.0);
    }
    return glm::dvec4(color, std::clamp(base.w, 0.0, 1.0));
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
  mutable std::atomic<std::uint64_t> non_finite_{0};
};

// The overall errors of a film whose `standard_error` is filled.
void SumUp(ReferenceFilm& film) {
  double light = 0.0, error = 0.0;
  for (std::size_t i = 0; i < film.pixels.size(); ++i) {
    const glm::dvec3 color(film.pixels[i]), deviation(film.standard_error[i]);
    light += glm::dot(color, color);
    error += glm::dot(deviation, deviation);
  }
  film.rms_error = std::sqrt(error / (3.0 * double(film.pixels.size())));
  film.relative_error = light > 0.0 ? std::sqrt(error / light) : 0.0;
}

ReferenceFilm RenderBatches(const Scene& scene, const RenderSettings& settings, const ReferenceSettings& reference) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  ReferenceFilm film;
  film.width = settings.width;
  film.height = settings.height;
  const ReferenceScene prepared(scene, settings, reference, film.notes);
  const std::size_t count = std::size_t(film.width) * std::size_t(film.height);
  film.pixels.assign(count, glm::dvec4(0.0));
  film.standard_error.assign(count, glm::dvec4(0.0));
  std::vector<glm::dvec4> squares(count, glm::dvec4(0.0));  // of deviations from the mean, summed
  constexpr std::size_t kGrain = 32;                        // pixels
  std::atomic<bool> late{false};
  for (double before = elapsed(); film.batches < reference.batches;) {
    ParallelFor(count, kGrain, [&](std::size_t begin, std::size_t end) {
      if (late || (film.batches < 2 && elapsed() > reference.give_up_after)) {
        late = true;
        return;
      }
      ReferenceScene::Scratch scratch;
      for (std::size_t i = begin; i < end; ++i) {
        const int x = int(i % std::size_t(film.width)), y = int(i / std::size_t(film.width));
        const glm::dvec4 value = prepared.Pixel(x, y, film.batches, scratch);
        // Welford, 1962, Note on a Method for Calculating Corrected Sums of Squares and Products.
        const double n = film.batches + 1.0;
        const glm::dvec4 off = value - film.pixels[i];
        film.pixels[i] += off / n;
        squares[i] += off * (value - film.pixels[i]);
        film.standard_error[i] = glm::sqrt(squares[i] / (n * std::max(n - 1.0, 1.0)));
      }
    });
    if (late) {
      throw Error(ErrorCode::InvalidUsage,
                  "a reference of " + std::to_string(film.width) + " x " + std::to_string(film.height) +
                      " pixels is not done in the time there is",
                  {}, "give it a larger budget, or a smaller picture");
    }
    ++film.batches;
    SumUp(film);
    if (settings.progress) settings.progress(double(film.batches) / reference.batches);
    const double now = elapsed(), next = now + (now - before);
    before = now;
    if (film.batches >= 4 && film.relative_error <= reference.target_error) break;
    if (film.batches >= 2 && next > reference.time_budget) break;
  }
  if (prepared.NonFinite() > 0) {
    film.notes.push_back(std::to_string(prepared.NonFinite()) + " samples were not finite, and became black");
  }
  film.seconds = elapsed();
  return film;
}

}  // namespace

ReferenceFilm RenderReference(const Scene& scene, const RenderSettings& settings, const ReferenceSettings& reference) {
  CheckSettings(settings, reference);
  RenderSettings used = settings;
  used.omit_unused = true;
  ReferenceFilm film;
  RunWithThreads(used.threads, [&] { film = RenderBatches(scene, used, reference); });
  return film;
}

Film ToFilm(const ReferenceFilm& reference) {
  Film film;
  film.width = reference.width;
  film.height = reference.height;
  for (const glm::dvec4& pixel : reference.pixels) film.pixels.push_back(RoundToFloat(pixel));
  return film;
}

}  // namespace facet
