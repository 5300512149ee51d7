// The environment behind the scene, composited under the pixels of a tile.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "frame/tile.h"
#include "light/lighting.h"
#include "render/view_directions.h"

namespace facet {

// Serves all tiles of a frame. Thread-safe.
class EnvironmentBackground {
 public:
  // A transparent background.
  EnvironmentBackground() = default;
  EnvironmentBackground(const FrameView& view, const LightingData& lighting)
      : lighting_(&lighting), directions_(MakeViewDirections(view)) {}

  // Changes the pixels that are not completely covered. `pixels`: of the tile, tile_size a row.
  void CompositeUnder(const TileBuffers& tile, std::vector<glm::vec4>& pixels) const;

 private:
  const LightingData* lighting_ = nullptr;
  ViewDirections directions_;
};

}  // namespace facet
