// The model "filament": the rasterizer's split sums against integrals over the environment, and what it shows through
// refractive and blended surfaces against traced rays.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "facet/models.h"
#include "facet/render.h"
#include "reference/reference.h"
#include "render/hand_built.h"

namespace facet {
namespace {

using P = FilamentParameters;

struct Case {
  const char* name;
  std::function<void(P&)> set;
  double mean;    // bound of the relative difference of the mean light
  double single;  // of the root mean square over pixels, over the mean
};

Material FilamentMaterial(const P& parameters) {
  Material material;
  material.model = ShadingModel::Filament;
  material.parameters = std::make_shared<const ModelParameters>(parameters);
  return material;
}

class FilamentAgreement : public testing::TestWithParam<Case> {};

// A ball in a sky that is bright above and dark below, with a lamp: soft enough that one lookup can stand for a lobe.
TEST_P(FilamentAgreement, OfABall) {
  Scene scene;
  P parameters;
  GetParam().set(parameters);
  Add(scene, Sphere(0.9f, 48, 96), AddMaterial(scene, FilamentMaterial(parameters)));
  RenderSettings settings = Settings(32, 32, 4, Orthographic(1.0, {0, 0, 6}));
  settings.environment.kind = EnvironmentSettings::Kind::Image;
  settings.environment.image = std::make_shared<const Image>(MakeImage(128, 64, [](int x, int y) {
    const double v = 0.5 + 0.4 * std::cos(M_PI * (y + 0.5) / 64) + 0.1 * std::sin(2 * M_PI * (x + 0.5) / 128);
    const auto byte = static_cast<std::uint8_t>(std::lround(255.0 * v));
    return glm::u8vec4(byte, byte, byte, 255);
  }));
  settings.specular_antialiasing = false;
  const Film film = Render(scene, settings);
  ReferenceSettings effort;
  effort.samples = 8;
  effort.environment_samples = 16;
  effort.batches = 2;
  const ReferenceFilm exact = RenderReference(scene, settings, effort);
  double mean = 0.0, exact_mean = 0.0, squares = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < film.pixels.size(); ++i) {
    if (film.pixels[i].a < 1.0f || exact.pixels[i].w < 1.0) continue;
    ++count;
    for (int c = 0; c < 3; ++c) {
      const double a = double(film.pixels[i][c]), b = exact.pixels[i][c];
      mean += a, exact_mean += b, squares += (a - b) * (a - b);
    }
  }
  ASSERT_GT(count, 300);
  const double off = mean / exact_mean - 1.0, spread = std::sqrt(squares * 3.0 * count) / exact_mean;
  std::printf("%s: mean %+.4f, pixels %.4f\n", GetParam().name, off, spread);
  EXPECT_LT(std::fabs(off), GetParam().mean);
  EXPECT_LT(spread, GetParam().single);
}

INSTANTIATE_TEST_SUITE_P(
    All, FilamentAgreement,
    testing::Values(
        Case{"dielectric", [](P& p) { p.roughness.value = 0.4f; }, 0.02, 0.05},
        Case{"metal", [](P& p) { p.metallic.value = 1.0f, p.roughness.value = 0.5f; }, 0.03, 0.08},
        Case{"coat", [](P& p) { p.clear_coat.value = 1.0f, p.clear_coat_roughness.value = 0.3f; }, 0.02, 0.05},
        Case{"sheen", [](P& p) { p.sheen_color.value = glm::vec3(1.0f), p.sheen_roughness.value = 0.5f; }, 0.08, 0.17},
        Case{"occluded", [](P& p) { p.roughness.value = 0.5f, p.ambient_occlusion.value = 0.4f; }, 0.02, 0.05},
        Case{"cloth", [](P& p) { p.shading_model = P::Shading::Cloth, p.roughness.value = 0.6f; }, 0.08, 0.17},
        Case{"subsurface", [](P& p) { p.shading_model = P::Shading::Subsurface, p.roughness.value = 0.5f; }, 0.05, 0.1},
        Case{"gloss",
             [](P& p) {
               p.shading_model = P::Shading::SpecularGlossiness;
               p.specular_color.value = glm::vec3(0.3f), p.glossiness.value = 0.6f;
             },
             0.02, 0.05},
        Case{"unlit",
             [](P& p) {
               p.shading_model = P::Shading::Unlit, p.base_color.value = {0.5f, 0.25f, 1.0f, 1.0f};
             },
             1e-6, 1e-6}),
    [](const auto& test) { return std::string(test.param.name); });

// A plate before a wall: refraction without rays that bend out of the picture, and each way to blend.
TEST(FilamentAgreement, OfWhatIsBehindAPlate) {
  const auto check = [](const char* name, const P& parameters, double bound) {
    Scene scene;
    Add(scene, Rectangle(-9, -9, 9, 9, -3), AddMaterial(scene, Unlit({0.2f, 0.4f, 0.8f, 1.0f})));
    Material plate = FilamentMaterial(parameters);
    plate.alpha_mode = parameters.refraction_mode == P::RefractionMode::None ? AlphaMode::Blend : AlphaMode::Opaque;
    Add(scene, Rectangle(-0.9f, -0.9f, 0.9f, 0.9f), AddMaterial(scene, plate));
    RenderSettings settings = Settings(16, 16, 1, Orthographic(0.8, {0, 0, 6}));
    settings.environment.kind = EnvironmentSettings::Kind::Image;
    settings.environment.image =
        std::make_shared<const Image>(MakeImage(32, 16, [](int, int) { return glm::u8vec4(255, 255, 255, 255); }));
    ReferenceSettings effort;
    effort.samples = 16;
    effort.environment_samples = 16;
    effort.batches = 2;
    const Film film = Render(scene, settings);
    const ReferenceFilm exact = RenderReference(scene, settings, effort);
    double worst = 0.0;
    glm::dvec3 a(0.0), b(0.0);
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
      a += glm::dvec3(film.pixels[i]) / double(film.pixels.size());
      b += glm::dvec3(exact.pixels[i]) / double(film.pixels.size());
    }
    for (int c = 0; c < 3; ++c) worst = std::max(worst, std::fabs(a[c] - b[c]));
    std::printf("%s: %.3f %.3f %.3f, reference %.3f %.3f %.3f\n", name, a.x, a.y, a.z, b.x, b.y, b.z);
    EXPECT_LT(worst, bound) << name;
  };
  P p;
  p.roughness.value = 0.5f;
  p.base_color.value = {0.9f, 0.7f, 0.5f, 1.0f};
  p.blending = P::Blending::Add;
  check("add", p, 0.02);
  p.blending = P::Blending::Multiply;
  check("multiply", p, 0.02);
  p.blending = P::Blending::Screen;
  check("screen", p, 0.02);
  p.base_color.value.a = 0.4f;
  p.blending = P::Blending::Fade;
  check("fade", p, 0.02);
  p.blending = P::Blending::Transparent;
  check("transparent", p, 0.02);
  p.base_color.value.a = 1.0f;
  p.blending = P::Blending::Opaque;
  p.refraction_mode = P::RefractionMode::ScreenSpace;
  p.refraction_type = P::RefractionType::Thin;
  p.absorption.value = glm::vec3(0.5f, 1.0f, 2.0f);
  p.micro_thickness.value = 0.3f;
  p.roughness.value = 0.0f;
  check("thin", p, 0.02);
}

}  // namespace
}  // namespace facet
