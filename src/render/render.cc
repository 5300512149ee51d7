#include "facet/render.h"

#include <chrono>
#include <cmath>
#include <new>

#include "base/parallel.h"
#include "facet/error.h"
#include "facet/shader/dispatch.h"
#include "frame/constants.h"
#include "light/studio.h"
#include "plan/frame_plan.h"
#include "render/frame_view.h"
#include "render/geometry_pass.h"
#include "render/texture_pass.h"
#include "render/tile_pass.h"
#include "scene/camera.h"

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
    Refuse("a picture of " + std::to_string(s.width) + " x " + std::to_string(s.height) + " pixels",
           "each side is 1 to " + std::to_string(kMaxPictureSize));
  }
  if (s.samples != 1 && s.samples != 2 && s.samples != 4 && s.samples != 8) {
    Refuse(std::to_string(s.samples) + " samples per pixel", "1, 2, 4 or 8 are accepted");
  }
  if (s.threads < 0) Refuse(std::to_string(s.threads) + " threads", "0 (one per core) or more are accepted");
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
  if (std::isnan(s.time)) Refuse("a time that is not a number", "seconds are accepted");
  if (!std::isfinite(s.environment.rotation)) Refuse("an environment rotation that is not finite", "give radians");
  if (!(s.environment.intensity >= 0.0 && s.environment.intensity <= 1e30)) {
    Refuse("an environment intensity of " + std::to_string(s.environment.intensity), "0 to 1e30 are accepted");
  }
  if (s.environment.kind == EnvironmentSettings::Kind::Image && s.environment.image == nullptr) {
    Refuse("no environment picture", "set environment.image or another environment.kind");
  }
}

std::shared_ptr<const EnvironmentMap> PrepareEnvironment(const FramePlan& plan, const RenderSettings& settings,
                                                         RenderStats& stats) {
  if (!plan.environment_light && !plan.environment_background) return nullptr;
  const EnvironmentOptions options{plan.environment_background, settings.environment_size, settings.environment_samples,
                                   settings.irradiance};
  if (settings.environment.kind == EnvironmentSettings::Kind::Studio) return StudioEnvironment(options);
  auto map = PrefilterEnvironment(*settings.environment.image, options);
  if (map->repaired_values > 0) {
    stats.warnings.push_back("environment: " + std::to_string(map->repaired_values) +
                             " values were not finite, negative or too large, and were replaced");
  }
  return map;
}

Film RenderPinned(const Scene& scene, const RenderSettings& settings, RenderStats& stats) {
  Stopwatch total, stage;
  PoseSettings pose;
  pose.scene = settings.scene;
  pose.animation = settings.animation;
  pose.time = settings.time;
  pose.variant = settings.variant;
  pose.generate_tangents = settings.tangents == TangentSource::Generated;
  const PosedScene posed = Pose(scene, pose);
  FramePlan plan = MakeFramePlan(scene, posed, settings);
  stats.left_out = plan.left_out;
  const FrameView view = MakeFrameView(ResolveCamera(settings.camera, scene, posed, settings.width, settings.height),
                                       settings.width, settings.height);
  stats.pose_seconds = stage.Lap();

  const TileGrid grid = MakeTileGrid(settings.width, settings.height, settings.tile_size);
  const FrameGeometry geometry = RunGeometry(view, posed, plan, grid, settings.samples, stats);
  stats.geometry_seconds = stage.Lap();

  const FrameTextures textures = DecodeTextures(scene, geometry.material_visible, settings.texels, plan, stats);
  stats.texture_seconds = stage.Lap();

  const auto environment = PrepareEnvironment(plan, settings, stats);
  const std::vector<PunctualLight> lights =
      plan.punctual_lights ? MakePunctualLights(posed.lights, view.eye_world) : std::vector<PunctualLight>();
  const LightingData lighting =
      MakeLightingData(lights, environment.get(), settings.environment.rotation, settings.environment.intensity);
  stats.environment_seconds = stage.Lap();

  Film film;
  film.width = settings.width;
  film.height = settings.height;
  film.pixels.resize(std::size_t(film.width) * std::size_t(film.height));
  RunTiles({view, plan, geometry, grid, lighting, settings}, film, stats);
  stats.raster_seconds = stage.Lap();
  stats.total_seconds = total.Lap();
  if (settings.progress) settings.progress(1.0);
  return film;
}

}  // namespace

Film Render(const Scene& scene, const RenderSettings& settings, RenderStats* stats) {
  CheckSettings(settings);
  RenderStats unused;
  RenderStats& s = stats != nullptr ? *stats : unused;
  s = RenderStats();
  s.target = TargetName(ActiveTarget());
  Film film;
  try {
    RunWithThreads(settings.threads, [&] {
      s.threads = CurrentThreadCount();
      film = RenderPinned(scene, settings, s);
    });
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::OutOfMemory, "the machine has too little memory for this picture of this scene", {},
                "render it smaller, or with fewer threads");
  }
  return film;
}

}  // namespace facet
