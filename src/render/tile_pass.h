// From tile lists to the film: the raster, shade, blend and resolve stages, tile by tile.
#pragma once

#include "facet/film.h"
#include "facet/render.h"
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

// Draws the rows of tiles [first_row, end_row) of the grid, which the geometry has lists for, into `film`, which the
// caller has sized for them: its top row is the first one's. Adds to the counts of `stats`.
void RunTiles(const TilePassInput& input, int first_row, int end_row, Film& film, RenderStats& stats);

}  // namespace facet
