#include "render/environment_background.h"

#include "shade/shade_fragments.h"

namespace facet {

void EnvironmentBackground::CompositeUnder(const TileBuffers& tile, std::vector<glm::vec4>& pixels) const {
  if (lighting_ == nullptr) return;
  BackgroundTask task;
  for (int c = 0; c < 3; ++c) {
    task.column[c] = directions_.column[c].data() + tile.x0;
    task.whole[c] = directions_.whole[c];
  }
  task.width = tile.width;
  task.lighting = lighting_;
  for (int y = 0; y < tile.height; ++y) {
    for (int c = 0; c < 3; ++c) task.row[c] = directions_.row[c][std::size_t(tile.y0 + y)];
    task.pixels = &pixels[std::size_t(y) * std::size_t(tile.tile_size)].x;
    ShadeBackground(task);
  }
}

}  // namespace facet
