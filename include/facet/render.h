// A scene into a film.
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

// --- What it took ----------------------------------------------------------------------------------------------------

// A texture that the frame reads.
struct TextureStats {
  int image = -1;            // index into Scene::images
  bool color = false;        // kept as colour; otherwise as numbers
  int width = 0, height = 0; // texels of its largest level
  int levels = 0;
  int channels = 0;          // no more than are read
  int bits = 0;              // of a channel
  std::size_t bytes = 0;     // of all levels
  double dark = 0.0;         // share of it, where it is for emission alone, that is black, also around: not read where
                             // it is not minified much, and of a large texture it takes no memory
};

// Times are wall-clock seconds; counts are exact and independent of thread count.
struct RenderStats {
  double pose_seconds = 0, environment_seconds = 0, texture_seconds = 0, geometry_seconds = 0, raster_seconds = 0,
         total_seconds = 0;  // texture: tangents as well; raster: tiles, from coverage to resolve
  std::uint64_t drawables = 0;
  std::uint64_t vertices = 0;
  std::uint64_t triangles_in = 0;        // as the scene states them, points and lines included
  std::uint64_t triangles_culled = 0;    // back faces, and those that cannot cover a sample; pieces of clipped ones too
  std::uint64_t triangles_clipped = 0;   // cut by a plane, or wholly outside
  std::uint64_t triangles_binned = 0;    // screen triangles: pieces count apart, a point or line is two
  std::uint64_t tiles = 0;
  std::uint64_t fragments_shaded = 0;    // opaque and masked
  std::uint64_t fragments_blended = 0;
  std::uint64_t covered_pixels = 0;      // with alpha > 0
  std::uint64_t images_decoded = 0;
  std::uint64_t texture_bytes = 0;       // all mip levels kept
  std::uint64_t environment_bytes = 0;   // of the prepared environment
  std::uint64_t pose_bytes = 0;          // of geometry that was deformed, or completed with normals and tangents
  int environment_size = 0;              // texels along its sharpest map
  std::vector<TextureStats> textures;
  std::uint64_t non_finite_fragments = 0;  // replaced by black, see docs/conventions.md
  FreeCamera camera;                       // in use, whatever chose it; its lens is fitted to the picture
  double camera_target_distance = 1.0;     // of the point that an AutoCamera or OrbitCamera looks at; 1 of others
  std::string target;                    // instruction set: SCALAR, SSE4, AVX2 or AVX3
  int threads = 0;
  std::vector<std::string> left_out;     // what the frame did without, one line each: "WHAT: WHY"
  std::vector<std::string> warnings;     // images that could not be decoded, why nothing is visible or lit
};

// Renders. Safe to call from several threads at once. Throws Error: InvalidUsage for settings out of range,
// InvalidInput for scenes that break their rules, OutOfMemory.
Film Render(const Scene& scene, const RenderSettings& settings, RenderStats* stats = nullptr);

// Takes some rows of a picture, `first_row` being their first's number in it. They are gone when it returns.
using BandReceiver = std::function<void(const Film& band, int first_row)>;

// Render() without the whole film in memory: `receive` is called for bands that together, from top to bottom, are its
// film, bit for bit, each with its rows of the planes. A band has the settings' width and at most `max_rows` rows,
// rounded down to whole tiles, but one row of tiles at least. Throws what Render() and `receive` throw.
void RenderBands(const Scene& scene, const RenderSettings& settings, int max_rows, const BandReceiver& receive,
                 RenderStats* stats = nullptr);

// Renders one scene again and again: what a frame shares with the one before (its pose, textures, environment and
// memory) is kept. Every frame is the one that Render() makes. The scene must outlive the renderer, and must not
// change.
class Renderer {
 public:
  explicit Renderer(const Scene& scene);
  explicit Renderer(const Scene&& scene) = delete;  // it would be gone
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Replaces `film`, using its memory. Throws what Render() does; the film is lost then. Not from two threads at once.
  void Render(const RenderSettings& settings, Film& film, RenderStats* stats = nullptr);

  // Replaces `picture` by Develop() of the film that Render() would make, using its memory: each tile is developed
  // while it is in the nearest cache, and there is no film, which takes 16 bytes a pixel. Throws what both do, and
  // Error(InvalidUsage) where settings.planes asks for what a picture does not have; the picture is lost then.
  void RenderPicture(const RenderSettings& settings, const DisplaySettings& display, Image& picture,
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
