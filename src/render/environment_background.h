// The environment behind the scene, composited under the pixels of a tile.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "blend/composite_through.h"
#include "frame/tile.h"
#include "light/lighting.h"

namespace facet {

// The directions from the eye through the pixels of an image, as the sum of a column's part and a row's part.
// DirectionThrough(view, x + 0.5, y + 0.5), to the bit, is (column[.][x] + row[.][y]) + whole. Columns are followed by
// kTaskPadding zeros. Through any point (x, y) it is per_column x + per_row y + corner, but for rounding.
struct ViewDirections {
  std::vector<double> column[3], row[3];
  double whole[3] = {};
  float per_column[3] = {}, per_row[3] = {}, corner[3] = {};
};

ViewDirections MakeViewDirections(const FrameView& view);

// Serves all tiles of a frame. Thread-safe.
class EnvironmentBackground {
 public:
  // A transparent background.
  EnvironmentBackground() = default;
  EnvironmentBackground(const FrameView& view, const LightingData& lighting)
      : lighting_(&lighting), directions_(MakeViewDirections(view)) {}

  // Changes the pixels that are not completely covered. `pixels`: of the tile, tile_size a row.
  void CompositeUnder(const TileBuffers& tile, std::vector<glm::vec4>& pixels) const;

  bool IsEnvironment() const { return lighting_ != nullptr; }
  // Adds the environment where it is seen past surfaces with transmission. Fills up the arrays of `seen`.
  void AddSeen(EnvironmentSeen& seen, std::vector<glm::vec4>& pixels) const;

 private:
  const LightingData* lighting_ = nullptr;
  ViewDirections directions_;
};

}  // namespace facet
