// From tile lists to pixels: visibility, shading, resolve and blending, tile by tile.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <span>

#include "blend/backdrop.h"
#include "facet/planes.h"
#include "facet/render.h"
#include "film/encode_pixels.h"
#include "light/lighting.h"
#include "render/environment_background.h"
#include "render/tiled_view.h"

namespace facet {

struct TilePassInput {
  const TiledView& view;
  const LightingData& lighting;
  bool cull_lights = true;  // false: shaders get every light at every fragment
  const EnvironmentBackground& background;
  const std::function<void(double)>& progress;  // may be empty
  // What is behind surfaces that are seen through, from CollectBackdrop(); null: there are none.
  const Backdrop* backdrop = nullptr;
  // Whether a background that is not known yet shows through some of them.
  bool ShowsThrough() const { return backdrop != nullptr && !background.IsEnvironment(); }
};

// Where the pixels of tiles go: to a film, or to an image, for which each tile is tone-mapped and encoded while it is
// in the first-level cache. Both have the width of the grid.
struct TileOutput {
  glm::vec4* film = nullptr;  // null: pixels go to encode.out
  glm::vec3* through = nullptr;  // Film::through, if the film has it
  EncodeTask encode;
  std::span<Plane> planes;  // besides colour
};

// Draws the opaque surfaces of the rows of tiles [first_row, end_row), which the geometry has lists for, and puts them
// into the backdrop.
void CollectBackdrop(const TilePassInput& input, int first_row, int end_row, Backdrop& backdrop, RenderStats& stats);

// Draws the rows of tiles [first_row, end_row) of the grid, which the geometry has lists for. The output, which is
// large enough for them, begins with the first. Adds to the counts of `stats`.
void RunTiles(const TilePassInput& input, int first_row, int end_row, const TileOutput& output, RenderStats& stats);

}  // namespace facet
