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
  const LightingData& lighting;
  const RenderSettings& settings;
  bool cull_lights;  // leave out those that do not reach a tile; a user's shader sees them all
};

// Fills the film (sized by the caller) and the counts of `stats`.
void RunTiles(const TilePassInput& input, Film& film, RenderStats& stats);

}  // namespace facet
