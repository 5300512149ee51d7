#include "facet/render.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <new>
#include <optional>
#include <utility>

#include "base/bytes_text.h"
#include "base/memory_budget.h"
#include "base/pages.h"
#include "base/parallel.h"
#include "facet/error.h"
#include "facet/shader.h"
#include "facet/shader/dispatch.h"
#include "film/develop_pixels.h"
#include "frame/constants.h"
#include "light/environment_source.h"
#include "light/studio.h"
#include "plan/frame_plan.h"
#include "render/film_planes.h"
#include "render/frame_view.h"
#include "render/geometry_pass.h"
#include "render/picture_warnings.h"
#include "render/texture_pass.h"
#include "render/tile_pass.h"
#include "scene/camera.h"
#include "scene/held_bytes.h"
#include "scene/topology.h"
#include "shade/shade_fragments.h"

namespace facet {
namespace {

class Stopwatch {
 public:
  // Seconds since the last call, or since the start.
  double Lap() {
    const auto now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

void Refuse(const std::string& what, const std::string& accepted) {
  throw Error(ErrorCode::InvalidUsage, what, "render settings", accepted);
}

void CheckSettings(const RenderSettings& s) {
  const auto size_ok = [](int n) { return n >= 1 && n <= kMaxPictureSize; };
  if (!size_ok(s.width) || !size_ok(s.height)) {
    const double bytes = double(s.width) * s.height * sizeof(glm::vec4);
    const double most = double(kMaxPictureSize) * kMaxPictureSize * sizeof(glm::vec4);
    Refuse("a picture of " + std::to_string(s.width) + " x " + std::to_string(s.height) + " pixels" +
               (bytes > most && s.width > 0 ? " needs " + BytesText(bytes) : ""),
           "each side is 1 to " + std::to_string(kMaxPictureSize) + ", " + BytesText(most) + " in all");
  }
  if (s.samples != 1 && s.samples != 2 && s.samples != 4 && s.samples != 8) {
    Refuse(std::to_string(s.samples) + " samples per pixel", "1, 2, 4 or 8 are accepted");
  }
  if (s.max_anisotropy < 1 || s.max_anisotropy > 16) {
    Refuse("a maximal anisotropy of " + std::to_string(s.max_anisotropy), "1 to 16 are accepted");
  }
  const int size = s.environment_size;
  if (size < 64 || size > 1024 || (size & (size - 1)) != 0) {
    Refuse("an environment of " + std::to_string(size) + " texels", "64, 128, 256, 512 or 1024 are accepted");
  }
  if (s.environment_samples < 6 || s.environment_samples > 768) {
    Refuse(std::to_string(s.environment_samples) + " samples of the environment", "6 to 768 are accepted");
  }
  if (s.tile_size != 8 && s.tile_size != 16 && s.tile_size != 32 && s.tile_size != 64) {
    Refuse("tiles of " + std::to_string(s.tile_size) + " pixels", "8, 16, 32 or 64 are accepted");
  }
  CheckPlanes(s.planes);
  if (std::isnan(s.time)) Refuse("a time that is not a number", "seconds are accepted");
  if (!std::isfinite(s.environment.rotation)) Refuse("an environment rotation that is not finite", "give radians");
  if (!(s.environment.intensity >= 0.0 && s.environment.intensity <= 1e30)) {
    Refuse("an environment intensity of " + std::to_string(s.environment.intensity), "0 to 1e30 are accepted");
  }
  if (s.environment.kind == EnvironmentSettings::Kind::Image && s.environment.image == nullptr &&
      s.environment.source == nullptr) {
    Refuse("no environment picture", "set environment.image, environment.source or another environment.kind");
  }
}

// The environment's picture, its copies in linear light, and its maps.
void Count(const Image& picture, const EnvironmentOptions& options, MemoryBudget& budget) {
  const auto size = std::size_t(SharpestLevelSize(picture.width, options.max_size));
  const std::size_t floats = picture.PixelCount() * (options.keep_picture ? 2 : 1) + 3 * size * size;
  budget.Charge(
      picture.bytes.size() + floats * 4 * sizeof(float), 1,
      "an environment of " + std::to_string(picture.width) + " x " + std::to_string(picture.height) + " pixels", {},
      "scale it down");
}

std::size_t BytesOf(const EnvironmentMap& map) { return (map.texels.size() + map.picture.size()) * sizeof(float); }

constexpr const char* kPosed = "posed geometry";
constexpr const char* kPrepared = "a prepared environment";

void CountPrepared(std::uint64_t bytes, MemoryBudget& budget) {
  budget.Charge(bytes, 1, kPrepared, {}, "scale its picture down");
}

std::shared_ptr<const EnvironmentMap> FromSource(const EnvironmentSource& source, const EnvironmentOptions& options,
                                                 MemoryBudget& budget, std::vector<std::string>& warnings) {
  std::uint64_t admitted = 0;
  if (auto kept = source.Find(options, [&](std::uint64_t bytes) { CountPrepared(admitted = bytes, budget); }))
    return kept;
  budget.Release(admitted, kPrepared);  // what is found but is of no use takes no memory
  const auto picture = source.Picture();
  Count(*picture, options, budget);
  auto map = PrefilterEnvironment(*picture, options);
  const std::string warning = source.Keep(options, *map);
  if (!warning.empty()) warnings.push_back(warning);
  return map;
}

void Warn(const std::string& warning, RenderStats& stats) {
  if (!warning.empty()) stats.warnings.push_back(warning);
}

void PrepareFilm(int width, int rows, Film& film) {
  film.width = width;
  film.pixels.reserve(std::size_t(width) * std::size_t(rows));
  PreferHugePages(film.pixels.data(), film.pixels.capacity() * sizeof(glm::vec4));
}

}  // namespace

// Where a frame goes: to a film, whole or a band of rows after the other in the same memory, or to a picture.
struct Renderer::FrameOutput {
  Film* film = nullptr;
  int max_rows = kMaxPictureSize;         // of a band
  const BandReceiver* receive = nullptr;  // called for each band; may be null
  Image* picture = nullptr;               // where there is no film
  DevelopTask develop;

  std::uint64_t PixelBytes() const { return film != nullptr ? sizeof(glm::vec4) : develop.PixelBytes(); }
};

// What frames share. Each part is made anew when the settings that it was made for are others.
class Renderer::Frames {
 public:
  explicit Frames(const Scene& scene) : scene_(scene) {}

  void Render(const RenderSettings& settings, const FrameOutput& output, RenderStats& stats) {
    Stopwatch total, stage;
    const TileGrid grid = MakeTileGrid(settings.width, settings.height, settings.tile_size);
    const int band_tiles =
        output.max_rows >= settings.height ? grid.rows : std::max(output.max_rows / grid.tile_size, 1);
    const int band_rows = std::min(band_tiles * grid.tile_size, settings.height);
    MemoryBudget budget(settings.memory_limit);
    const MemoryBudget::Scope scope(budget);
    budget.Charge(std::uint64_t(settings.width) * std::uint64_t(band_rows), output.PixelBytes(),
                  (output.film != nullptr ? "a film of " : "a picture of ") + std::to_string(settings.width) + " x " +
                      std::to_string(band_rows) + " pixels",
                  {}, "make the picture smaller");
    ChargePlanes(settings.planes, settings.width, band_rows, budget);
    budget.Charge(HeldBytes(scene_), 1, "the scene", {}, "leave some out");
    const PosedScene& posed = Posed(PoseOf(settings));
    budget.Charge(HeldBytes(posed) + HeldCompleted(), 1, kPosed);
    FramePlan plan = MakeFramePlan(scene_, posed, settings);
    stats.left_out = plan.left_out;
    const ResolvedCamera camera =
        ResolveCamera(settings.camera, scene_, posed, settings.width, settings.height, &known_ball_);
    stats.camera = {camera.world_from_camera, camera.lens};
    stats.camera_target_distance = camera.target_distance;
    const FrameView view = MakeFrameView(camera, settings.width, settings.height);
    stats.pose_seconds = stage.Lap();

    RunGeometry(view, posed, plan, grid, settings.samples, geometry_, stats);
    stats.geometry_seconds = stage.Lap();

    DecodeTextures(scene_, geometry_.material_visible, settings.texels, plan, textures_, budget,
                   CompletionOfVisible(plan.every_texture), stats);
    DrawCompleted();
    stats.pose_bytes = HeldCompleted();
    for (const Primitive& copy : posed.owned) stats.pose_bytes += HeldBytes(copy);
    stats.texture_seconds = stage.Lap();

    const EnvironmentMap* environment = Environment(plan, settings, budget, stats);
    std::vector<PunctualLight> lights;
    if (plan.punctual_lights) lights = MakePunctualLights(posed.lights, view.eye_world);
    Warn(WhyNothingIsLit(plan, geometry_.material_visible, !lights.empty(), settings), stats);
    if (plan.dark_light) lights.emplace_back().type = LightType::Directional;
    const LightingData lighting =
        MakeLightingData(lights, environment, settings.environment.rotation, settings.environment.intensity);
    stats.environment_seconds = stage.Lap();

    TileOutput tiles_to{nullptr, output.develop, {}};
    if (output.film != nullptr) {
      PrepareFilm(settings.width, band_rows, *output.film);
    } else {
      SizeForTask(output.develop, settings.width, settings.height, *output.picture);
      tiles_to.develop.out = output.picture->bytes.data();
    }
    LightingData lit = lighting;
    if (!plan.environment_light) lit.environment = nullptr;  // seen behind the scene at most
    const TilePassInput input{view, plan, geometry_, grid, lit, lighting, settings};
    for (int row = 0; row < grid.rows; row += band_tiles) {
      const int end = std::min(row + band_tiles, grid.rows), first = row * grid.tile_size;
      const MemoryLease lists = ListTiles(plan, row * grid.columns, end * grid.columns, geometry_);
      stats.geometry_seconds += stage.Lap();
      if (output.film != nullptr) {
        Film& film = *output.film;
        film.height = std::min(end * grid.tile_size, settings.height) - first;
        film.pixels.resize(std::size_t(film.width) * std::size_t(film.height));
        tiles_to.film = film.pixels.data();
        SizePlanes(plan.planes, film);
        tiles_to.planes = film.planes;
      }
      RunTiles(input, row, end, tiles_to, stats);
      stats.raster_seconds += stage.Lap();
      if (output.receive != nullptr) (*output.receive)(*output.film, first), stage.Lap();
    }
    Warn(WhyNothingIsVisible(scene_, posed, view, plan, grid, settings, stats, geometry_), stats);
    stats.total_seconds = total.Lap();
    if (settings.progress) settings.progress(1.0);
  }

 private:
  const PosedScene& Posed(const PoseSettings& pose) {
    if (!posed_ || pose != pose_) {
      posed_.reset();
      completed_.clear();
      PosedScene posed = PoseIncomplete(scene_, pose);
      completed_.resize(posed.incomplete.size());
      pose_ = pose;
      posed_ = std::move(posed);
    }
    return *posed_;
  }

  std::uint64_t HeldCompleted() const {
    std::uint64_t bytes = 0;
    for (const Primitive& primitive : completed_) bytes += HeldBytes(primitive);
    return bytes;
  }

  const Primitive& Uncompleted(std::size_t i) const {
    return *posed_->drawables[posed_->incomplete[i].drawables[0]].geometry;
  }

  // The work of completing what is visible, or everything, and is not complete yet.
  WorkBeside CompletionOfVisible(bool everything) {
    constexpr std::size_t kBytesPerCorner = 2;  // a corner takes 0.2 us, a byte of a picture 0.03 to 0.12
    WorkBeside work;
    std::vector<std::size_t> missing;
    for (std::size_t i = 0; i < completed_.size(); ++i) {
      const auto is_visible = [&](std::size_t drawable) { return bool(geometry_.drawable_visible[drawable]); };
      const std::vector<std::size_t>& drawables = posed_->incomplete[i].drawables;
      const bool needed = everything || std::any_of(drawables.begin(), drawables.end(), is_visible);
      if (!needed || !completed_[i].positions.empty()) continue;
      missing.push_back(i);
      work.size += std::size_t{PrimitiveCount(Uncompleted(i))} * 3 * kBytesPerCorner;
    }
    work.run = [this, missing = std::move(missing)] {
      ParallelFor(missing.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t m = begin; m < end; ++m) {
          const std::size_t i = missing[m];
          MemoryLease lease(HeldBytes(Uncompleted(i)), 1, kPosed);
          completed_[i] = Completed(Uncompleted(i), posed_->incomplete[i].normal_map);
          lease = MemoryLease();
          MemoryBudget::Current().Charge(HeldBytes(completed_[i]), 1, kPosed);
        }
      });
    };
    return work;
  }

  // For shading, which comes next.
  void DrawCompleted() {
    for (std::size_t i = 0; i < completed_.size(); ++i) {
      if (completed_[i].positions.empty()) continue;
      for (const std::size_t d : posed_->incomplete[i].drawables) geometry_.drawables[d].geometry = &completed_[i];
    }
  }

  const EnvironmentMap* Environment(const FramePlan& plan, const RenderSettings& settings, MemoryBudget& budget,
                                    RenderStats& stats) {
    if (!plan.environment_light && !plan.environment_background) return nullptr;
    const EnvironmentOptions options{plan.environment_background, settings.environment_size,
                                     settings.environment_samples, settings.irradiance};
    const bool is_picture = settings.environment.kind == EnvironmentSettings::Kind::Image;  // otherwise the studio
    const auto image = is_picture ? settings.environment.image : nullptr;
    const auto source = is_picture && image == nullptr ? settings.environment.source : nullptr;
    const bool known = environment_ != nullptr && options == environment_options_ && image == environment_image_ &&
                       source == environment_source_;
    if (image != nullptr) Count(*image, options, budget);
    if (known && source != nullptr) CountPrepared(BytesOf(*environment_), budget);
    if (!known) {
      environment_ = image != nullptr    ? PrefilterEnvironment(*image, options)
                     : source != nullptr ? FromSource(*source, options, budget, stats.warnings)
                                         : StudioEnvironment(options);
      environment_options_ = options;
      environment_image_ = image;
      environment_source_ = source;
    }
    stats.environment_bytes = BytesOf(*environment_);
    stats.environment_size = environment_->levels[0].size;
    if (image != nullptr && !image->damage.empty()) stats.warnings.push_back("environment: " + image->damage);
    if (environment_->repaired_values > 0) {
      stats.warnings.push_back("environment: " + std::to_string(environment_->repaired_values) +
                               " values were not finite, negative or too large, and were replaced");
    }
    return environment_.get();
  }

  const Scene& scene_;
  PoseSettings pose_;
  std::optional<PosedScene> posed_;
  KnownBall known_ball_;
  std::vector<Primitive> completed_;  // in place of posed_->incomplete; empty: was not visible yet
  FrameGeometry geometry_;
  FrameTextures textures_;
  EnvironmentOptions environment_options_;
  std::shared_ptr<const Image> environment_image_;  // held, so that no other can take its place in memory
  std::shared_ptr<const EnvironmentSource> environment_source_;
  std::shared_ptr<const EnvironmentMap> environment_;
};

Renderer::Renderer(const Scene& scene) : frames_(std::make_unique<Frames>(scene)) {}
Renderer::~Renderer() = default;

void Renderer::Render(const RenderSettings& settings, Film& film, RenderStats* stats) {
  FrameOutput output;
  output.film = &film;
  Draw(settings, output, stats);
}

void Renderer::RenderBands(const RenderSettings& settings, int max_rows, const BandReceiver& receive,
                           RenderStats* stats) {
  Film band;
  FrameOutput output;
  output.film = &band;
  output.max_rows = max_rows;
  if (receive) output.receive = &receive;
  Draw(settings, output, stats);
}

void Renderer::RenderPicture(const RenderSettings& settings, const DisplaySettings& display, Image& picture,
                             RenderStats* stats, ChannelType type) {
  if (!settings.planes.empty()) Refuse("planes besides colour of a picture", "Render() gives a film, which has them");
  FrameOutput output;
  output.picture = &picture;
  output.develop = MakeDevelopTask(display, type);
  Draw(settings, output, stats);
}

void Renderer::Draw(const RenderSettings& settings, const FrameOutput& output, RenderStats* stats) {
  CheckSettings(settings);
  RenderStats unused;
  RenderStats& s = stats != nullptr ? *stats : unused;
  s = RenderStats();
  s.target = TargetName(ActiveTarget());
  try {
    RunWithThreads(settings.threads, [&] {
      s.threads = CurrentThreadCount();
      frames_->Render(settings, output, s);
    });
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::OutOfMemory, "the machine has too little memory for this picture of this scene", {},
                "render it smaller, or with fewer threads");
  }
}

Film Render(const Scene& scene, const RenderSettings& settings, RenderStats* stats) {
  Film film;
  Renderer(scene).Render(settings, film, stats);
  return film;
}

void RenderBands(const Scene& scene, const RenderSettings& settings, int max_rows, const BandReceiver& receive,
                 RenderStats* stats) {
  Renderer(scene).RenderBands(settings, max_rows, receive, stats);
}

}  // namespace facet
