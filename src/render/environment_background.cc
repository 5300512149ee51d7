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
    double corner = out.whole[c];
    if (view.perspective) {
      out.per_column[c] = static_cast<float>(axis.x / view.screen_x.x);
      out.per_row[c] = static_cast<float>(axis.y / view.screen_y.y);
      corner -= axis.x * (view.width * 0.5 / view.screen_x.x) + axis.y * (view.height * 0.5 / view.screen_y.y);
    }
    out.corner[c] = static_cast<float>(corner);
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

void EnvironmentBackground::AddSeen(EnvironmentSeen& seen, std::vector<glm::vec4>& pixels) const {
  const std::size_t count = seen.Size(), padded = (count + kTaskPadding - 1) / kTaskPadding * kTaskPadding;
  if (count == 0) return;
  for (auto* v : {&seen.x, &seen.y, &seen.roughness}) v->resize(padded, v->back());
  std::vector<float> light(3 * padded);
  EnvironmentTask task;
  for (int c = 0; c < 3; ++c) {
    task.column[c] = directions_.per_column[c];
    task.row[c] = directions_.per_row[c];
    task.whole[c] = directions_.corner[c];
  }
  task.x = seen.x.data(), task.y = seen.y.data(), task.roughness = seen.roughness.data();
  task.count = count;
  task.lighting = lighting_;
  task.red = light.data(), task.green = task.red + padded, task.blue = task.green + padded;
  LookUpEnvironment(task);
  for (std::size_t i = 0; i < count; ++i) {
    pixels[seen.pixel[i]] += glm::vec4(glm::vec3(task.red[i], task.green[i], task.blue[i]) * seen.weight[i], 0.0f);
  }
}

}  // namespace facet
