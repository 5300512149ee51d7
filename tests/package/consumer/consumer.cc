// A scene made by hand, rendered with facet::core alone.
#include <cmath>
#include <cstdio>

#include "facet/film.h"
#include "facet/render.h"
#include "facet/scene.h"

int main() {
  facet::Scene scene;
  facet::Material red;
  red.base_color_factor = {1.0f, 0.0f, 0.0f, 1.0f};
  red.model = facet::ShadingModel::Unlit;
  scene.materials.push_back(red);

  facet::Primitive square;  // 2 by 2, facing +Z
  square.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  square.indices = {0, 1, 2, 0, 2, 3};
  square.material = 0;
  facet::Mesh mesh;
  mesh.primitives.push_back(square);
  scene.meshes.push_back(mesh);
  facet::Node node;
  node.mesh = 0;
  scene.nodes.push_back(node);

  facet::FreeCamera camera;  // orthographic, 4 by 4, so that the square covers the inner quarter of the picture
  camera.lens.orthographic = true;
  camera.lens.xmag = camera.lens.ymag = 2.0;
  camera.world_from_camera[3] = glm::dvec4(0.0, 0.0, 5.0, 1.0);

  facet::RenderSettings settings;
  settings.width = settings.height = 64;
  settings.camera = camera;
  settings.environment.kind = facet::EnvironmentSettings::Kind::None;
  facet::RenderStats stats;
  const facet::Film film = facet::Render(scene, settings, &stats);

  int wrong = 0;
  for (int y = 0; y < film.height; ++y) {
    for (int x = 0; x < film.width; ++x) {
      const glm::vec4 pixel = film.pixels[std::size_t(y) * std::size_t(film.width) + std::size_t(x)];
      const bool inside = x >= 16 && x < 48 && y >= 16 && y < 48;
      const glm::vec4 expected = inside ? glm::vec4(1, 0, 0, 1) : glm::vec4(0);
      for (int c = 0; c < 4; ++c) wrong += std::fabs(pixel[c] - expected[c]) > 1e-6f;
    }
  }
  const facet::Image image = facet::EncodeFilm(film, {});
  std::printf("covered %llu pixels, %d wrong channels, encoded %dx%dx%d\n",
              static_cast<unsigned long long>(stats.covered_pixels), wrong, image.width, image.height, image.channels);
  return wrong == 0 && stats.covered_pixels == 32 * 32 && image.channels == 4 ? 0 : 1;
}
