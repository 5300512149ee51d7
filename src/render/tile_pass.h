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

// Fills the film (sized by the caller) and the counts of `stats`.
void RunTiles(const TilePassInput& input, Film& film, RenderStats& stats);

}  // namespace facet
