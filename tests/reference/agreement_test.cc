// The rasterizer and the reference draw the same images, up to what the rasterizer approximates.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "facet/load.h"
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

class BundledScene : public ::testing::TestWithParam<const char*> {};

// Coverage of eight fixed samples against many random ones: hardly a pixel is off by more than a straight edge can make
// it, and on average they agree. Light: the means of the images agree to a few percent, which is what the split sum
// loses on rough surfaces and one shading a pixel loses of glints; single pixels differ by more.
TEST_P(BundledScene, CoverageAndMeanLight) {
  const LoadedScene loaded = LoadGltf(std::string(FACET_SOURCE_DIR) + "/assets/scenes/" + GetParam());
  RenderSettings settings;
  settings.width = 96;
  settings.height = 64;
  settings.samples = 8;
  settings.threads = 2;
  const Film film = Render(loaded.scene, settings);
  const ReferenceFilm exact = RenderReference(loaded.scene, settings, Effort(16, 1, 4));
  double mean[4] = {}, exact_mean[4] = {}, squares = 0.0;
  int far_off = 0;
  for (std::size_t i = 0; i < film.pixels.size(); ++i) {
    const double off = double(film.pixels[i].a) - exact.pixels[i].w;
    squares += off * off;
    far_off += std::fabs(off) > 0.3;
    constexpr double kGlint = 4.0;  // a highlight of a few pixels shall not decide the mean
    for (int c = 0; c < 4; ++c) {
      mean[c] += std::min(double(film.pixels[i][c]), kGlint) / double(film.pixels.size());
      exact_mean[c] += std::min(exact.pixels[i][c], kGlint) / double(film.pixels.size());
    }
  }
  EXPECT_LE(far_off, 6);
  EXPECT_LT(std::sqrt(squares / double(film.pixels.size())), 0.04);
  EXPECT_NEAR(mean[3], exact_mean[3], 0.003);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c] / exact_mean[c], 1.0, 0.06) << c;
}

INSTANTIATE_TEST_SUITE_P(All, BundledScene,
                         ::testing::Values("showcase.glb", "material_grid.glb", "room.glb", "animated.glb"),
                         [](const auto& test) {
                           const std::string name = test.param;
                           return name.substr(0, name.find('.'));
                         });

// A glass ball behind a bar: where its refraction would show what the bar hides, the rasterizer fills it from around,
// and the reference sees what is there. Of a plate, whose refraction the rasterizer has exactly in this view, only that
// differs.
TEST(Agreement, WhatABarHidesFromGlass) {
  const RenderSettings settings = Settings(96, 96, 4, Orthographic(1.2, {0, 0, 6}));
  for (const bool ball : {true, false}) {
    Material glass;
    glass.metallic_factor = 0.0f;
    glass.roughness_factor = 0.0f;
    glass.transmission_factor = 1.0f;
    glass.thickness_factor = ball ? 1.0f : 0.6f;
    glass.ior = 1.5f;
    Scene scenes[3];  // without the bar, with it, and the bar alone
    for (int i = 0; i < 3; ++i) {
      Scene& scene = scenes[i];
      if (i < 2) {
        Primitive wall = Rectangle(-9, -9, 9, 9, -3);
        for (const glm::vec3& at : wall.positions) {
          wall.colors.emplace_back(0.5 + at.x / 6.0, 0.5 + at.y / 6.0, 0.5, 1.0);
        }
        Add(scene, std::move(wall), AddMaterial(scene, Unlit(glm::vec4(1.0f))));
        for (int stripe = -6; stripe <= 6; ++stripe) {
          const float x = 0.4f * float(stripe);
          Add(scene, Rectangle(x, -9, x + 0.1f, 9, -2.9f), AddMaterial(scene, Unlit({0.1f, 0.2f, 0.8f, 1.0f})));
        }
        Transform turned;
        if (!ball) turned.rotation = glm::dquat(std::cos(0.35), 0.0, std::sin(0.35), 0.0);
        Add(scene, ball ? Sphere(0.9f, 64, 128) : Rectangle(-0.9f, -0.9f, 0.9f, 0.9f), AddMaterial(scene, glass),
            turned);
      }
      if (i > 0) Add(scene, Rectangle(-0.07f, -2, 0.08f, 2, 1.5f), AddMaterial(scene, Unlit({1, 0, 0, 1})));
    }
    const Film without = Render(scenes[0], settings), with = Render(scenes[1], settings),
               bar = Render(scenes[2], settings);
    const ReferenceFilm exact = RenderReference(scenes[1], settings, Effort(16, 1, 4));
    const ReferenceFilm exact_without = RenderReference(scenes[0], settings, Effort(16, 1, 4));
    double error = 0.0, error_without = 0.0;
    int changed = 0;
    for (std::size_t i = 0; i < with.pixels.size(); ++i) {
      if (bar.pixels[i].a > 0.0f || with.pixels[i] == without.pixels[i]) continue;
      ++changed;
      for (int c = 0; c < 3; ++c) {
        error += std::pow(double(with.pixels[i][c]) - exact.pixels[i][c], 2);
        error_without += std::pow(double(without.pixels[i][c]) - exact_without.pixels[i][c], 2);
      }
    }
    const auto root = [&](double sum) { return std::sqrt(sum / (3.0 * changed)); };
    // With shorter shifts, which tear, it was 0.185 and 0.249. A slab is no ball, with or without the bar.
    EXPECT_LT(root(error), ball ? 0.181 : 0.245);
    EXPECT_LT(root(error_without), ball ? 0.22 : 0.003);
    EXPECT_GT(changed, 100);
  }
}

// One directional light and no environment: nothing is approximated but the albedo, which DfgTable gives to 0.007, and
// the place of shading, once a pixel. Away from edges and sharp highlights that leaves half a percent.
TEST(Agreement, DirectionalLight) {
  for (float metallic : {0.0f, 1.0f}) {
    for (float roughness : {0.4f, 0.7f, 1.0f}) {
      Scene scene;
      Material material;
      material.base_color_factor = {0.8f, 0.5f, 0.2f, 1.0f};
      material.metallic_factor = metallic;
      material.roughness_factor = roughness;
      Add(scene, Sphere(1.0f, 64, 128), AddMaterial(scene, material));
      Light light;
      light.type = LightType::Directional;
      light.intensity = 3.0f;
      scene.lights.push_back(light);
      Node node;
      node.light = 0;
      node.transform.rotation = glm::normalize(glm::dquat(0.95, -0.2, 0.2, 0.0));
      scene.nodes.push_back(node);
      const RenderSettings settings = Settings(80, 80, 8, Perspective(0.5, {0, 0, 4.5}));
      const Film film = Render(scene, settings);
      const ReferenceFilm exact = RenderReference(scene, settings, Effort(8, 1, 2));
      int compared = 0;
      for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        const double x = double(i % 80) - 39.5, y = double(i / 80) - 39.5;
        if (std::hypot(x, y) > 28.0) continue;
        ++compared;
        for (int c = 0; c < 3; ++c) {
          const double expected = exact.pixels[i][c];
          EXPECT_NEAR(film.pixels[i][c], expected, 0.01 * expected + 0.001) << metallic << " " << roughness << " " << i;
        }
      }
      EXPECT_GT(compared, 2000);
    }
  }
}

// White metal under one soft lamp: rough lobes gather their light from between the mirror direction and the normal. Read
// along the mirror direction, as the split sum does without that, the errors are 0.31, 0.39 and 0.55 (and 0.5 of the light
// is misplaced on the roughest).
TEST(Agreement, RoughMetalUnderALamp) {
  Image sky;
  sky.width = 128;
  sky.height = 64;
  sky.channels = 3;
  sky.type = ChannelType::F32;
  sky.encoding = Encoding::Linear;
  sky.bytes.resize(sky.PixelCount() * 3 * sizeof(float));
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 128; ++x) {
      const bool lamp = std::abs(x - 88) < 5 && std::abs(y - 20) < 5;
      for (int c = 0; c < 3; ++c) sky.As<float>()[(y * 128 + x) * 3 + c] = lamp ? 40.0f : 0.2f;
    }
  }
  const auto image = std::make_shared<const Image>(sky);
  for (const auto& [roughness, bound] : {std::pair{0.6f, 0.25}, {0.8f, 0.2}, {1.0f, 0.15}}) {
    Scene scene;
    Material material;
    material.metallic_factor = 1.0f;
    material.roughness_factor = roughness;
    Add(scene, Sphere(1.0f, 64, 128), AddMaterial(scene, material));
    RenderSettings settings = Settings(48, 48, 8, Perspective(0.5, {0, 0, 4.5}));
    settings.environment.kind = EnvironmentSettings::Kind::Image;
    settings.environment.image = image;
    const Film film = Render(scene, settings);
    const ReferenceFilm exact = RenderReference(scene, settings, Effort(8, 8, 4));
    double squares = 0.0, mean = 0.0, total = 0.0, n = 0.0;
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
      if (exact.pixels[i].w < 1.0) continue;
      const double error = double(film.pixels[i].r) - exact.pixels[i].x;
      squares += error * error;
      mean += error;
      total += exact.pixels[i].x;
      ++n;
    }
    EXPECT_LT(std::sqrt(squares / n) / (total / n), bound) << roughness;
    EXPECT_LT(std::fabs(mean / total), 0.08) << roughness;
    EXPECT_GT(n, 1000.0);
  }
}

// Textures, normal maps, vertex colours and both sides, lit by one light: magnified, so that mip levels play no part.
TEST(Agreement, TexturedAndBumped) {
  Scene scene;
  Material material;
  material.metallic_factor = 0.5f;
  material.roughness_factor = 0.8f;
  material.normal_scale = 0.7f;
  material.double_sided = true;
  Sampler sampler;
  sampler.wrap_u = Wrap::MirroredRepeat;
  sampler.wrap_v = Wrap::ClampToEdge;
  material.base_color_texture = Ref(AddTexture(
      scene, MakeImage(4, 4, [](int x, int y) { return glm::u8vec4(60 * x + 60, 60 * y + 60, 128, 255); }), sampler));
  material.base_color_texture.scale = {1.5f, 0.75f};
  material.base_color_texture.rotation = 0.4f;
  material.base_color_texture.offset = {0.2f, 0.1f};
  material.normal_texture = Ref(AddTexture(
      scene, MakeImage(4, 4, [](int x, int y) { return glm::u8vec4(90 + 20 * x, 170 - 20 * y, 230, 255); }), sampler));
  material.metallic_roughness_texture = Ref(AddTexture(
      scene, MakeImage(2, 2, [](int x, int y) { return glm::u8vec4(0, 255 - 60 * x, 100 + 100 * y, 255); })));
  Primitive p = Rectangle(-1, -1, 1, 1);
  p.colors = {{1, 1, 1, 1}, {0.5f, 1, 1, 1}, {1, 0.5f, 1, 1}, {1, 1, 0.5f, 1}};
  const int index = AddMaterial(scene, material);
  Transform left, right;
  left.translation.x = -1.1;
  left.rotation = glm::normalize(glm::dquat(0.9, 0.1, 0.3, 0.05));
  right.translation.x = 1.1;
  right.rotation = glm::normalize(glm::dquat(0.25, 0.05, 0.95, 0.1));  // seen from behind
  right.scale = {-1.0, 1.0, 1.0};
  Add(scene, p, index, left);
  Add(scene, p, index, right);
  Light light;
  light.type = LightType::Point;
  light.intensity = 40.0f;
  scene.lights.push_back(light);
  Node node;
  node.light = 0;
  node.transform.translation = {0.5, 1.0, 3.0};
  scene.nodes.push_back(node);
  const RenderSettings settings = Settings(64, 40, 8, Perspective(0.7, {0, 0, 5}));
  const Film film = Render(scene, settings);
  const ReferenceFilm exact = RenderReference(scene, settings, Effort(64, 1, 4));
  int compared = 0;
  for (std::size_t i = 0; i < film.pixels.size(); ++i) {
    if (exact.pixels[i].w < 1.0 || film.pixels[i].a < 1.0f) continue;
    ++compared;
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(film.pixels[i][c], exact.pixels[i][c], 0.02 * exact.pixels[i][c] + 0.002) << i;
    }
  }
  EXPECT_GT(compared, 600);
}

}  // namespace
}  // namespace facet
