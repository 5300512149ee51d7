// The model "enterprise" in the rasterizer and in the reference: the presets on spheres.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "facet/models.h"
#include "facet/render.h"
#include "reference/reference.h"
#include "render/hand_built.h"

namespace facet {
namespace {

ReferenceSettings Effort(int samples, int environment_samples, int batches) {
  ReferenceSettings settings;
  settings.samples = samples;
  settings.environment_samples = environment_samples;
  settings.batches = batches;
  return settings;
}

Scene SphereOf(const EnterpriseParameters& p) {
  Scene scene;
  Material material;
  material.model = ShadingModel::Enterprise;
  material.parameters = std::make_shared<const ModelParameters>(p);
  Add(scene, Sphere(0.5f, 64, 128), AddMaterial(scene, material));
  return scene;
}

struct Difference {
  double root_mean_square = 0.0, mean = 0.0;  // relative to the mean of the reference
};

// Over the sphere's inside.
Difference Compare(const Scene& scene, const RenderSettings& settings, const ReferenceSettings& effort) {
  const Film film = Render(scene, settings);
  const ReferenceFilm exact = RenderReference(scene, settings, effort);
  double squares = 0.0, sum = 0.0, total = 0.0, n = 0.0;
  const double middle = settings.width / 2.0 - 0.5;
  for (std::size_t i = 0; i < film.pixels.size(); ++i) {
    const double x = double(i % std::size_t(settings.width)) - middle,
                 y = double(i / std::size_t(settings.width)) - middle;
    if (std::hypot(x, y) > 0.38 * settings.width) continue;
    for (int c = 0; c < 3; ++c) {
      const double error = double(film.pixels[i][c]) - exact.pixels[i][c];
      squares += error * error, sum += error, total += exact.pixels[i][c], ++n;
    }
  }
  return {std::sqrt(squares / n) / (total / n), sum / total};
}

struct Case {
  const char* name;
  double root_mean_square, mean;  // bounds
};

class EnterprisePresets : public ::testing::TestWithParam<Case> {};

// In the studio, where the split sum and the prefiltered maps are the errors that remain. The reference traces light
// through the ball of glass, which is a lens; the rasterizer refracts it once.
TEST_P(EnterprisePresets, AgreeWithTheReference) {
  const Scene scene = SphereOf(EnterprisePreset(GetParam().name));
  RenderSettings settings = Settings(64, 64, 8, Perspective(0.5, {0, 0, 2.2}));
  settings.environment.kind = EnvironmentSettings::Kind::Studio;
  settings.background = Background::Environment;
  const Difference difference = Compare(scene, settings, Effort(16, 4, 4));
  std::printf("  %-10s rms %.4f mean %+.4f\n", GetParam().name, difference.root_mean_square, difference.mean);
  EXPECT_LT(difference.root_mean_square, GetParam().root_mean_square);
  EXPECT_LT(std::fabs(difference.mean), GetParam().mean);
}

INSTANTIATE_TEST_SUITE_P(All, EnterprisePresets,
                         ::testing::Values(Case{"basic", 0.1, 0.03}, Case{"metal", 0.15, 0.05},
                                           Case{"plastic", 0.25, 0.05}, Case{"glass", 0.5, 0.4},
                                           Case{"textile", 0.15, 0.05}, Case{"leather", 0.1, 0.03},
                                           Case{"wood", 0.1, 0.03}, Case{"carpaint", 0.3, 0.1},
                                           Case{"emissive", 0.02, 0.01}),
                         [](const auto& test) { return std::string(test.param.name); });

// Under one light nothing is approximated but the albedos and the place of shading. (A smooth coat mirrors the light in
// less than a pixel.)
TEST(EnterpriseAgreement, DirectionalLight) {
  for (const char* name : {"basic", "textile", "leather"}) {
    Scene scene = SphereOf(EnterprisePreset(name));
    Light light;
    light.type = LightType::Directional;
    light.intensity = 3.0f;
    scene.lights.push_back(light);
    Node node;
    node.light = 0;
    node.transform.rotation = glm::normalize(glm::dquat(0.95, -0.2, 0.2, 0.0));
    scene.nodes.push_back(node);
    const RenderSettings settings = Settings(64, 64, 8, Perspective(0.5, {0, 0, 2.2}));
    const Difference difference = Compare(scene, settings, Effort(16, 1, 2));
    std::printf("  %-10s rms %.4f mean %+.4f\n", name, difference.root_mean_square, difference.mean);
    EXPECT_LT(std::fabs(difference.mean), 0.02) << name;
  }
}

// Many flakes to a pixel: the reference draws each, the rasterizer their mean.
TEST(EnterpriseAgreement, SmallFlakesAreTheirMean) {
  EnterpriseParameters p = EnterprisePreset("carpaint");
  p.clearcoat.value = 0.0f;
  p.flake_coverage.value = 1.0f;
  p.flake_size.value = 1.0f;
  const Scene scene = SphereOf(p);
  RenderSettings settings = Settings(48, 48, 8, Perspective(0.5, {0, 0, 2.2}));
  settings.environment.kind = EnvironmentSettings::Kind::Studio;
  const Difference difference = Compare(scene, settings, Effort(64, 4, 4));
  std::printf("  flakes     rms %.4f mean %+.4f\n", difference.root_mean_square, difference.mean);
  EXPECT_LT(std::fabs(difference.mean), 0.05);
}

}  // namespace
}  // namespace facet
