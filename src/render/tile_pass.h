// From tile lists to pixels: visibility, shading, blending and resolve, tile by tile.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <span>

#include "facet/planes.h"
#include "facet/render.h"
#include "film/develop_pixels.h"
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
};

// Where the pixels of tiles go: to a film, or developed at once, while they are in the nearest cache, to a picture.
// Both are as wide as the grid.
struct TileOutput {
  glm::vec4* film = nullptr;  // null: `develop` has all but the pixels and their number
  DevelopTask develop;
  std::span<Plane> planes;  // besides colour
};

// Draws the rows of tiles [first_row, end_row) of the grid, which the geometry has lists for. The output, which is
// large enough for them, begins with the first. Adds to the counts of `stats`.
void RunTiles(const TilePassInput& input, int first_row, int end_row, const TileOutput& output, RenderStats& stats);

}  // namespace facet
