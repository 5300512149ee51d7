// Rendering: from a scene to a film, or to an image.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "facet/film.h"
#include "facet/image.h"
#include "facet/scene.h"
#include "facet/settings.h"

namespace facet {

// --- Statistics -----------------------------------------------------------------------------------------------------

// A texture that the frame reads, as it is stored.
struct TextureStats {
  int image = -1;             // index into Scene::images
  bool color = false;         // read as colour (sRGB decoded); false: as data
  int width = 0, height = 0;  // texels of its largest level
  int levels = 0;
  int channels = 0;       // only those that are read are stored
  int bits = 0;           // per channel
  std::size_t bytes = 0;  // of all levels
  double empty = 0.0;     // emission textures: the share of the texture that is empty, which means black with black
                          // all around it. It is not read unless minified much, and takes no memory if it is large
};

// Times are wall-clock seconds; counts are exact and independent of thread count.
struct RenderStats {
  double pose_seconds = 0, environment_seconds = 0, texture_seconds = 0, geometry_seconds = 0, raster_seconds = 0,
         total_seconds = 0;  // texture: with the generation of tangents; raster: all work on tiles, from coverage to
                             // resolve
  double table_seconds = 0;  // of lobes' albedos, which the first frame of the process makes that needs them
  std::uint64_t drawables = 0;
  std::uint64_t vertices = 0;
  std::uint64_t triangles_in = 0;       // primitives of the scene: triangles, lines and points
  std::uint64_t triangles_culled = 0;   // back faces, and triangles or pieces that cover no sample
  std::uint64_t triangles_clipped = 0;  // cut by a clip plane, or wholly outside the view
  std::uint64_t triangles_binned = 0;   // screen triangles: pieces count singly, points and lines twice
  std::uint64_t tiles = 0;
  std::uint64_t fragments_shaded = 0;  // of opaque and alpha-tested surfaces
  std::uint64_t fragments_blended = 0;
  std::uint64_t covered_pixels = 0;  // with alpha > 0
  std::uint64_t images_decoded = 0;
  std::uint64_t texture_bytes = 0;      // of all mip levels
  std::uint64_t environment_bytes = 0;  // of the prepared environment
  std::uint64_t pose_bytes = 0;         // copies of geometry: deformed, or with generated normals and tangents
  int environment_size = 0;             // texels along its sharpest map
  std::vector<TextureStats> textures;
  std::uint64_t non_finite_fragments = 0;  // shaded NaN or infinite and replaced by black, see docs/conventions.md
  FreeCamera camera;                       // the camera that was used, with its lens fitted to the image
  double camera_target_distance = 1.0;     // AutoCamera and OrbitCamera: the distance of the target; others: 1
  std::string target;                      // instruction set: SCALAR, SSE4, AVX2 or AVX3
  int threads = 0;
  std::vector<std::string> disabled;  // what was disabled because it was not needed, one line each: "WHAT: WHY"
  std::vector<std::string> warnings;  // images that could not be decoded, why nothing is visible or lit
};

// Renders. Safe to call from several threads at once. Throws Error: InvalidUsage for settings out of range,
// InvalidInput for scenes that break their rules, OutOfMemory.
Film Render(const Scene& scene, const RenderSettings& settings, RenderStats* stats = nullptr);

// Receives some rows of an image, of which the first is row `first_row`. `band` is valid during the call only.
using BandReceiver = std::function<void(const Film& band, int first_row)>;

// Render() without the whole film in memory: calls `receive` with one band of rows after the other, from top to bottom.
// Together they are the film of Render() with its planes, bit for bit. A band has the full width and at most `max_rows`
// rows, rounded down to a multiple of the tile size, but at least one row of tiles. Throws what Render() and `receive`
// throw.
void RenderBands(const Scene& scene, const RenderSettings& settings, int max_rows, const BandReceiver& receive,
                 RenderStats* stats = nullptr);

// Renders one scene repeatedly. What a frame has in common with the one before (pose, textures, environment, memory) is
// reused; every frame equals the one that Render() makes, bit for bit. The scene must outlive the renderer and must not
// change.
class Renderer {
 public:
  explicit Renderer(const Scene& scene);
  explicit Renderer(const Scene&& scene) = delete;  // a temporary would not outlive it
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Renders into `film`, whose memory is reused. Throws what Render() does, and then leaves no usable film. Not
  // thread-safe.
  void Render(const RenderSettings& settings, Film& film, RenderStats* stats = nullptr);

  // Renders into an image: the same bytes as EncodeFilm() of the film of Render(). Each tile is tone-mapped and encoded
  // while it is in the first-level cache, so that no film is stored, which would take 16 bytes a pixel. The memory of
  // `image` is reused. Throws what Render() and EncodeFilm() do, and Error(InvalidUsage) for settings.planes,
  // which an image does not have; then it leaves no usable image.
  void RenderImage(const RenderSettings& settings, const DisplaySettings& display, Image& image,
                   RenderStats* stats = nullptr, ChannelType type = ChannelType::U8);

  // As RenderBands().
  void RenderBands(const RenderSettings& settings, int max_rows, const BandReceiver& receive,
                   RenderStats* stats = nullptr);

 private:
  struct FrameOutput;
  void Draw(const RenderSettings& settings, const FrameOutput& output, RenderStats* stats);

  class Frames;
  std::unique_ptr<Frames> frames_;
};

}  // namespace facet
