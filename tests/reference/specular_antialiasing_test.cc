// Small mirrors are nearer to the reference with specular antialiasing than without.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "facet/render.h"
#include "reference/reference.h"
#include "render/hand_built.h"

namespace facet {
namespace {

// The root mean square of the difference from the reference over pixels that are wholly covered.
double ErrorOf(const Film& film, const ReferenceFilm& exact) {
  double squares = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < film.pixels.size(); ++i) {
    if (film.pixels[i].a < 1.0f || exact.pixels[i].w < 1.0) continue;
    for (int c = 0; c < 3; ++c) squares += std::pow(double(film.pixels[i][c]) - exact.pixels[i][c], 2);
    ++count;
  }
  EXPECT_GT(count, 0);
  return std::sqrt(squares / (3.0 * count));
}

// A sky of squares, 24 around, dark and bright.
Image Checkers() {
  return MakeImage(256, 128, [](int x, int y) {
    const std::uint8_t v = (x * 24 / 256 + y * 12 / 128) % 2 == 0 ? 255 : 0;
    return glm::u8vec4(v, v, v, 255);
  });
}

// Mirrors eight pixels wide, as metal and as a clear coat over black.
TEST(SpecularAntialiasing, SmallMirrorsAreNearerToTheReference) {
  constexpr int kPixels = 8;
  for (const bool coat : {false, true}) {
    Scene scene;
    Material material;
    material.base_color_factor = coat ? glm::vec4(0.0f, 0.0f, 0.0f, 1.0f) : glm::vec4(1.0f);
    material.metallic_factor = coat ? 0.0f : 1.0f;
    material.roughness_factor = coat ? 1.0f : 0.0f;
    material.clearcoat_factor = coat ? 1.0f : 0.0f;
    const int index = AddMaterial(scene, material);
    for (int i = 0; i < 3; ++i) {  // at different places in their pixels
      Transform place;
      place.translation = {2.27 * (i - 1), 0.13 * i, 0.0};
      Add(scene, Sphere(1.0f, 24, 48), index, place);
    }
    RenderSettings settings = Settings(4 * kPixels, 2 * kPixels, 8, Orthographic(2.0, {0, 0, 10}, 2.0));
    settings.environment.kind = EnvironmentSettings::Kind::Image;
    settings.environment.image = std::make_shared<const Image>(Checkers());
    ReferenceSettings effort;
    effort.samples = 32;
    effort.environment_samples = 2;
    effort.batches = 2;
    const ReferenceFilm exact = RenderReference(scene, settings, effort);
    const double with = ErrorOf(Render(scene, settings), exact);
    settings.specular_antialiasing = false;
    const double without = ErrorOf(Render(scene, settings), exact);
    RecordProperty(coat ? "coat" : "metal", std::to_string(with / without));
    EXPECT_LT(with, 0.6 * without) << (coat ? "coat: " : "metal: ") << with << ", " << without;
  }
}

}  // namespace
}  // namespace facet
