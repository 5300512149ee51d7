#include "facet/render.h"

#include <algorithm>
#include <chrono>
#include <new>
#include <optional>
#include <utility>

#include "base/memory_budget.h"
#include "base/pages.h"
#include "base/parallel.h"
#include "blend/backdrop.h"
#include "facet/error.h"
#include "facet/shader/dispatch.h"
#include "film/encode_pixels.h"
#include "plan/frame_plan.h"
#include "render/check_settings.h"
#include "render/frame_environment.h"
#include "render/frame_pose.h"
#include "render/frame_view.h"
#include "render/geometry_pass.h"
#include "render/image_warnings.h"
#include "render/texture_pass.h"
#include "render/tile_pass.h"
#include "scene/camera.h"
#include "scene/held_bytes.h"

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

void Warn(const std::string& warning, RenderStats& stats) {
  if (!warning.empty()) stats.warnings.push_back(warning);
}

void PrepareFilm(int width, int rows, Film& film) {
  film.width = width;
  film.pixels.reserve(std::size_t(width) * std::size_t(rows));
  PreferHugePages(film.pixels.data(), film.pixels.capacity() * sizeof(glm::vec4));
}

// Gives the film these planes, of its width and height, reusing their memory. Their pixels are not set.
void SizePlanes(const std::vector<PlaneKind>& planes, Film& film) {
  film.planes.resize(planes.size());
  for (std::size_t i = 0; i < planes.size(); ++i) {
    film.planes[i].kind = planes[i];
    film.planes[i].bytes.resize(std::size_t(film.width) * std::size_t(film.height) * InfoOf(planes[i]).PixelBytes());
  }
}

}  // namespace

// The output of a frame: a film, whole or in bands that use the same memory, or an image.
struct Renderer::FrameOutput {
  Film* film = nullptr;
  int max_rows = kMaxImageSize;           // of a band
  const BandReceiver* receive = nullptr;  // called for each band; may be null
  Image* image = nullptr;                 // where there is no film
  EncodeTask encode;

  // Charges the rows that are in memory at once.
  void Charge(const RenderSettings& settings, int rows, MemoryBudget& budget) const {
    const std::uint64_t pixels = std::uint64_t(settings.width) * std::uint64_t(rows);
    budget.Charge(pixels, film != nullptr ? sizeof(glm::vec4) : encode.PixelBytes(),
                  (film != nullptr ? "a film of " : "a picture of ") + std::to_string(settings.width) + " x " +
                      std::to_string(rows) + " pixels",
                  {}, "make the picture smaller");
    std::uint64_t plane_bytes = 0;  // of a pixel
    for (const PlaneKind plane : settings.planes) plane_bytes += InfoOf(plane).PixelBytes();
    if (plane_bytes == 0) return;
    budget.Charge(pixels, plane_bytes, "planes besides colour", {},
                  "make the picture smaller, or ask for fewer planes");
  }
};

// Draws frames, stage by stage, and keeps what frames share. Each part of it is computed again only if its settings
// change.
class Renderer::Frames {
 public:
  explicit Frames(const Scene& scene) : scene_(scene), pose_(scene) {}

  void Render(const RenderSettings& settings, const FrameOutput& output, RenderStats& stats) {
    Stopwatch total, stage;
    const TileGrid grid = MakeTileGrid(settings.width, settings.height, settings.tile_size);
    const int band_tiles =
        output.max_rows >= settings.height ? grid.rows : std::max(output.max_rows / grid.tile_size, 1);
    MemoryBudget budget(settings.memory_limit);
    const MemoryBudget::Scope scope(budget);
    const int band_rows = std::min(band_tiles * grid.tile_size, settings.height);
    output.Charge(settings, band_rows, budget);
    budget.Charge(HeldBytes(scene_), 1, "the scene", {}, "leave some out");
    const PosedScene& posed = pose_.Pose(PoseOf(settings));
    const FramePlan plan = MakeFramePlan(scene_, posed, settings);
    stats.disabled = plan.disabled;
    const ResolvedCamera camera =
        ResolveCamera(settings.camera, scene_, posed, settings.width, settings.height, &known_ball_);
    stats.camera = {camera.world_from_camera, camera.lens};
    stats.camera_target_distance = camera.target_distance;
    const FrameView view = MakeFrameView(camera, settings.width, settings.height);
    stats.pose_seconds = stage.Lap();

    RunGeometry(view, posed, plan, grid, settings.samples, geometry_, stats);
    stats.geometry_seconds = stage.Lap();

    DecodeTextures(scene_, geometry_.material_visible, settings.texels, plan, textures_, budget,
                   pose_.TangentsOf(geometry_.drawable_visible, plan.every_texture), stats);
    const std::vector<FrameMaterial> materials = BindTextures(plan, textures_);
    const std::vector<const Primitive*> attributes = pose_.Attributes();
    stats.pose_bytes = pose_.HeldBytes();
    stats.texture_seconds = stage.Lap();

    const EnvironmentMap* const environment = environment_.Prepare(plan, settings, budget, stats);
    stats.environment_seconds = stage.Lap();
    std::vector<PunctualLight> lights;
    if (plan.punctual_lights) lights = MakePunctualLights(posed.lights, view.eye_world);
    Warn(WhyNothingIsLit(plan, geometry_.material_visible, !lights.empty(), settings), stats);
    if (plan.zero_light) lights.emplace_back().type = LightType::Directional;
    const LightingData all_light = MakeLightingData(lights, environment, settings.environment.rotation,
                                                    settings.environment.intensity, plan.albedo_tables);
    stats.table_seconds = stage.Lap();
    LightingData lighting = all_light;
    if (!plan.environment_light) lighting.environment = nullptr;  // it may still be the background
    const EnvironmentBackground background =
        plan.environment_background ? EnvironmentBackground(view, all_light) : EnvironmentBackground();
    stats.environment_seconds += stage.Lap();

    const TiledView tiled{view, geometry_, attributes, materials, grid, settings.samples};
    TilePassInput input{tiled, lighting, /*cull_lights=*/!settings.HasShaders(), background, settings.progress};
    // The backdrop is of the whole picture, whatever the bands: surfaces show what is anywhere in it.
    std::optional<Backdrop> backdrop;
    if (IsSeenThrough(plan)) {
      backdrop.emplace(settings.width, settings.height);
      for (int row = 0; row < grid.rows; row += band_tiles) {
        const int end = std::min(row + band_tiles, grid.rows);
        const MemoryLease lists = ListTiles(plan, row * grid.columns, end * grid.columns, geometry_);
        CollectBackdrop(input, row, end, *backdrop, stats);
      }
      backdrop->Finish();
      input.backdrop = &*backdrop;
      stats.raster_seconds += stage.Lap();
    }
    TileOutput pixels{nullptr, nullptr, output.encode, {}};
    if (output.film != nullptr) {
      PrepareFilm(settings.width, band_rows, *output.film);
      if (input.ShowsThrough()) {
        budget.Charge(std::uint64_t(settings.width) * std::uint64_t(band_rows), sizeof(glm::vec3),
                      "what shows through the picture, by channel", {}, "make the picture smaller");
      }
    } else {
      SizeForTask(output.encode, settings.width, settings.height, *output.image);
      pixels.encode.out = output.image->bytes.data();
    }
    for (int row = 0; row < grid.rows; row += band_tiles) {
      const int end = std::min(row + band_tiles, grid.rows), first = row * grid.tile_size;
      const MemoryLease lists = ListTiles(plan, row * grid.columns, end * grid.columns, geometry_);
      stats.geometry_seconds += stage.Lap();
      if (output.film != nullptr) {
        Film& film = *output.film;
        film.height = std::min(end * grid.tile_size, settings.height) - first;
        film.pixels.resize(std::size_t(film.width) * std::size_t(film.height));
        pixels.film = film.pixels.data();
        film.through.resize(input.ShowsThrough() ? film.pixels.size() : 0);
        pixels.through = film.through.empty() ? nullptr : film.through.data();
        SizePlanes(plan.planes, film);
        pixels.planes = film.planes;
      }
      RunTiles(input, row, end, pixels, stats);
      stats.raster_seconds += stage.Lap();
      if (output.receive != nullptr) (*output.receive)(*output.film, first), stage.Lap();
    }
    Warn(WhyNothingIsVisible(scene_, posed, view, plan, grid, settings, stats, geometry_), stats);
    stats.total_seconds = total.Lap();
    if (settings.progress) settings.progress(1.0);
  }

 private:
  // Whether some visible material is.
  bool IsSeenThrough(const FramePlan& plan) const {
    for (std::size_t i = 0; plan.transmission && i < plan.materials.size(); ++i) {
      if (geometry_.material_visible[i] && plan.materials[i].frame.is_seen_through) return true;
    }
    return false;
  }

  const Scene& scene_;
  FramePose pose_;
  KnownBall known_ball_;
  FrameGeometry geometry_;
  FrameTextures textures_;
  FrameEnvironment environment_;
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

void Renderer::RenderImage(const RenderSettings& settings, const DisplaySettings& display, Image& image,
                           RenderStats* stats, ChannelType type) {
  if (!settings.planes.empty()) {
    throw Error(ErrorCode::InvalidUsage, "RenderImage() gives no planes besides colour", "render settings",
                "leave 'planes' empty, or call Render()");
  }
  FrameOutput output;
  output.image = &image;
  output.encode = MakeEncodeTask(display, type);
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
