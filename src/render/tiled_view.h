// One view of the scene, the camera's or a light's, with everything that its tiles are drawn from.
#pragma once

#include <span>

#include "frame/tile_grid.h"
#include "plan/frame_material.h"
#include "render/geometry_pass.h"

namespace facet {

// Refers to its parts, which outlive it.
struct TiledView {
  const FrameView& view;
  const FrameGeometry& geometry;                 // with the lists of the tiles
  std::span<const Primitive* const> attributes;  // by drawable: its geometry, with the tangents that its material needs
  std::span<const FrameMaterial> materials;      // by FrameDrawable::material, with their textures
  const TileGrid& grid;
  int samples = 1;
};

}  // namespace facet
