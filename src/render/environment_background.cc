#include "render/environment_background.h"

#include "shade/shade_fragments.h"

namespace facet {

ViewDirections MakeViewDirections(const FrameView& view) {
  ViewDirections out;
  for (int c = 0; c < 3; ++c) {
    const glm::dvec3& axis = view.camera_from_world[c];  // world axis c in camera space
    out.column[c].resize(std::size_t(view.width) + kTaskPadding);
    out.row[c].resize(std::size_t(view.height));
    for (int x = 0; x < view.width && view.perspective; ++x) {
      out.column[c][std::size_t(x)] = axis.x * ((x + 0.5 - view.width * 0.5) / view.screen_x.x);
    }
    for (int y = 0; y < view.height && view.perspective; ++y) {
      out.row[c][std::size_t(y)] = axis.y * ((y + 0.5 - view.height * 0.5) / view.screen_y.y);
    }
    out.whole[c] = axis.z * -1.0;
  }
  return out;
}

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
