// From tile lists to the film: the raster, shade, blend and resolve stages, tile by tile.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "facet/planes.h"
#include "facet/render.h"
#include "film/develop_pixels.h"
#include "frame/tile_grid.h"
#include "light/lighting.h"
#include "render/geometry_pass.h"

namespace facet {

struct TilePassInput {
  const FrameView& view;
  const FramePlan& plan;
  const FrameGeometry& geometry;
  const TileGrid& grid;
  const LightingData& lighting;    // of the scene
  const LightingData& background;  // what is seen behind it
  const RenderSettings& settings;
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
