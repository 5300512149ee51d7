// The reference's light against closed forms: furnaces, single lights, a sum over all directions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "closed_form.h"
#include "reference/environment_exact.h"
#include "reference/reference.h"
#include "reference/sample_sequence.h"
#include "render/hand_built.h"

namespace facet {
namespace {

constexpr double kPi = 3.14159265358979324;

Material Coloured(const glm::vec3& base, float metallic, float roughness) {
  Material material;
  material.base_color_factor = glm::vec4(base, 1.0f);
  material.metallic_factor = metallic;
  material.roughness_factor = roughness;
  return material;
}

Transform TurnedAboutY(double angle) {
  Transform transform;
  transform.rotation = glm::dquat(std::cos(0.5 * angle), 0.0, std::sin(0.5 * angle), 0.0);
  return transform;
}

void AddLight(Scene& scene, const Light& light, const Transform& transform) {
  scene.lights.push_back(light);
  Node node;
  node.light = int(scene.lights.size()) - 1;
  node.transform = transform;
  scene.nodes.push_back(node);
}

ReferenceSettings Effort(int samples, int environment_samples, int batches) {
  ReferenceSettings settings;
  settings.samples = samples;
  settings.environment_samples = environment_samples;
  settings.batches = batches;
  return settings;
}

// White reflects all: a white sphere in constant light cannot be told from it, whatever its roughness and metalness.
TEST(ReferenceLight, WhiteFurnace) {
  RenderSettings settings = Settings(10, 10, 4, Perspective(0.3, {0, 0, 8.0}));
  settings.environment = ConstantEnvironment(0.7f);
  double worst = 0.0;
  for (float roughness : {0.0f, 0.1f, 0.3f, 0.6f, 1.0f}) {
    for (float metallic : {0.0f, 0.5f, 1.0f}) {
      Scene scene;
      Add(scene, Sphere(1.0f, 40, 80), AddMaterial(scene, Coloured(glm::vec3(1.0f), metallic, roughness)));
      const ReferenceFilm film = RenderReference(scene, settings, Effort(16, 4, 6));
      int seen = 0, beyond = 0;
      for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        const glm::dvec2 off = glm::dvec2(int(i) % 10, int(i) / 10) - 4.5;
        if (glm::length(off) > 3.3) continue;  // n_dot_v above 0.3: the facets' own horizon is out of sight
        ASSERT_EQ(film.pixels[i].w, 1.0);
        ++seen;
        for (int c = 0; c < 3; ++c) {
          const double error = std::fabs(film.pixels[i][c] - 0.7);
          beyond += error > 3.0 * film.standard_error[i][c] + 1e-5;
          ASSERT_LT(error, 8.0 * film.standard_error[i][c] + 1e-5) << roughness << " " << metallic << " pixel " << i;
          worst = std::max(worst, error);
        }
      }
      EXPECT_GE(seen, 28);
      EXPECT_LE(beyond, 3 * seen / 15) << roughness << " " << metallic;  // of 6 batches: 3 % of Student's t
      EXPECT_LT(film.relative_error, 0.02);
    }
  }
  RecordProperty("worst", std::to_string(worst));
}

// At every place of a plane the same closed form, to the last digits: nothing in it is random.
TEST(ReferenceLight, DirectionalLightIsTheBrdf) {
  const double tilt = 0.7, shine = 0.4;  // of the plane, and of the light, about +Y from +Z
  const glm::dvec3 n(std::sin(tilt), 0, std::cos(tilt)), l(std::sin(shine), 0, std::cos(shine)), v(0, 0, 1);
  for (const auto& [base, metallic, roughness] :
       {std::tuple(glm::vec3(0.8f, 0.4f, 0.1f), 0.0f, 0.7f), std::tuple(glm::vec3(0.8f, 0.4f, 0.1f), 1.0f, 0.3f),
        std::tuple(glm::vec3(1.0f, 0.5f, 0.0f), 0.3f, 1.0f), std::tuple(glm::vec3(0.5f), 0.6f, 0.1f)}) {
    Scene scene;
    Add(scene, Rectangle(-5, -5, 5, 5), AddMaterial(scene, Coloured(base, metallic, roughness)), TurnedAboutY(tilt));
    Light light;
    light.type = LightType::Directional;
    light.color = {1.0f, 0.5f, 0.25f};
    light.intensity = 3.0f;
    AddLight(scene, light, TurnedAboutY(shine));
    const ReferenceFilm film = RenderReference(scene, Settings(3, 3, 1, Orthographic(1.0)), Effort(4, 1, 4));
    const glm::dvec3 expected = ClosedForm(glm::dvec3(base), double(metallic), double(roughness)).Brdf(n, v, l) *
                                glm::dot(n, l) * glm::dvec3(3.0, 1.5, 0.75);
    for (const glm::dvec4& pixel : film.pixels) {
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(pixel[c] / expected[c], 1.0, 2e-6) << metallic << " " << roughness;
      ASSERT_EQ(pixel.w, 1.0);
    }
    EXPECT_LT(film.relative_error, 1e-14);
  }
}

TEST(ReferenceLight, PointLightFallsOffWithTheSquare) {
  const ClosedForm model(glm::dvec3(0.6), 0.0, 0.9);
  for (const double x : {0.0, 0.8, 2.5}) {
    Scene scene;
    Add(scene, Rectangle(-5, -5, 5, 5), AddMaterial(scene, Coloured(glm::vec3(0.6f), 0.0f, 0.9f)));
    Light light;
    light.type = LightType::Point;
    light.intensity = 7.0f;
    Transform place;
    place.translation = {0.0, 0.0, 1.5};
    AddLight(scene, light, place);
    // An image a thousandth of a metre wide: one place.
    const ReferenceFilm film =
        RenderReference(scene, Settings(1, 1, 1, Orthographic(0.0005, {x, 0, 10})), Effort(4, 1, 2));
    const double d2 = x * x + 1.5 * 1.5, cosine = 1.5 / std::sqrt(d2);
    const glm::dvec3 l = glm::normalize(glm::dvec3(-x, 0, 1.5)), n(0, 0, 1);
    EXPECT_NEAR(film.pixels[0].x / (model.Brdf(n, n, l).x * cosine * 7.0 / d2), 1.0, 1e-4) << x;
  }
}

// The environment's integral, once more as a plain sum over the sphere.
TEST(ReferenceLight, EnvironmentIsTheIntegralOverAllDirections) {
  const double tilt = 0.9;
  const glm::dvec3 n(std::sin(tilt), 0, std::cos(tilt)), v(0, 0, 1);
  RenderSettings settings = Settings(1, 1, 1, Orthographic(1.0));
  settings.environment = EnvironmentSettings{};  // the studio
  settings.environment.rotation = 0.6;
  settings.environment.intensity = 1.5;
  const ExactEnvironment environment(settings.environment);
  for (const auto& [metallic, roughness] : {std::pair(0.0f, 0.6f), std::pair(1.0f, 0.4f), std::pair(0.5f, 1.0f)}) {
    Scene scene;
    const glm::vec3 base(0.9f, 0.5f, 0.2f);
    Add(scene, Rectangle(-5, -5, 5, 5), AddMaterial(scene, Coloured(base, metallic, roughness)), TurnedAboutY(tilt));
    const ReferenceFilm film = RenderReference(scene, settings, Effort(64, 16, 8));
    const ClosedForm model{glm::dvec3(base), double(metallic), double(roughness)};
    glm::dvec3 sum(0.0);
    constexpr std::uint32_t kCount = 1u << 13;
    const SampleSequence sequence(MixBits(12));
    for (std::uint32_t i = 0; i < kCount; ++i) {
      const glm::dvec2 random = sequence.Point(0, i);
      const double y = 1.0 - 2.0 * random.y, around = std::sqrt(1.0 - y * y), azimuth = 2.0 * kPi * random.x;
      const glm::dvec3 l(around * std::cos(azimuth), y, around * std::sin(azimuth));
      if (glm::dot(n, l) <= 0.0) continue;
      sum += model.Brdf(n, v, l) * glm::dot(n, l) * environment.Toward(l).radiance * (4.0 * kPi / kCount);
    }
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(film.pixels[0][c] / sum[c], 1.0, 0.015) << metallic << " " << roughness;
    EXPECT_LT(film.relative_error, 0.003);
  }
}

TEST(ReferenceLight, OcclusionDimsTheEnvironmentAndEmissionIsAdded) {
  RenderSettings settings = Settings(2, 2, 1, Orthographic(0.5));
  settings.environment = ConstantEnvironment(1.0f);
  Scene scene;
  Material material = Coloured(glm::vec3(1.0f), 0.0f, 0.5f);
  material.emissive_factor = {0.25f, 0.5f, 1.0f};
  material.emissive_strength = 2.0f;
  material.occlusion_strength = 0.5f;
  material.occlusion_texture =
      Ref(AddTexture(scene, MakeImage(1, 1, [](int, int) { return glm::u8vec4(51, 255, 255, 255); })));
  Add(scene, Rectangle(-1, -1, 1, 1), AddMaterial(scene, material));
  const ReferenceFilm film = RenderReference(scene, settings, Effort(64, 8, 8));
  const double occlusion = 1.0 + 0.5 * (0.2 - 1.0);
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::dvec3 expected = glm::dvec3(0.5, 1.0, 2.0) + occlusion;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(film.pixels[i][c], expected[c], 6.0 * film.standard_error[i][c] + 1e-5);
  }
}

}  // namespace
}  // namespace facet
