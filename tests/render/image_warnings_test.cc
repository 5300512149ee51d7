// Images that show nothing, or nothing but black, say why.
#include <gtest/gtest.h>

#include <algorithm>

#include "render/hand_built.h"

namespace facet {
namespace {

std::vector<std::string> WarningsOf(const Scene& scene, const RenderSettings& settings) {
  RenderStats stats;
  Render(scene, settings, &stats);
  RenderStats in_bands;
  RenderBands(
      scene, settings, 8, [](const Film&, int) {}, &in_bands);
  EXPECT_EQ(in_bands.warnings, stats.warnings);
  return stats.warnings;
}

Material OneSided() {
  Material material = Unlit({1, 1, 1, 1});
  material.double_sided = false;
  return material;
}

RenderSettings From(const CameraChoice& camera) { return Settings(32, 32, 4, camera); }

struct Empty {
  const char* name;
  Scene scene;
  RenderSettings settings;
  const char* reason;  // a part of the warning
};

std::vector<Empty> EmptyImages() {
  std::vector<Empty> cases;
  const auto add = [&](const char* name, const RenderSettings& settings, const char* reason, const auto& make) {
    Scene scene;
    make(scene);
    cases.push_back({name, std::move(scene), settings, reason});
  };
  const RenderSettings usual = From(Orthographic(1.0));
  const auto rectangle = [](Scene& scene) {
    Add(scene, Rectangle(-0.5f, -0.5f, 0.5f, 0.5f), AddMaterial(scene, OneSided()));
  };
  Transform turned;
  turned.rotation = glm::dquat(0, 0, 1, 0);

  add("no nodes", usual, "no node has a mesh; is it the right file?", [](Scene&) {});
  add("nothing in this scene", usual, "no node of this scene has a mesh; choose another scene", [&](Scene& scene) {
    rectangle(scene);
    scene.nodes.emplace_back();
    scene.scenes = {{"empty", {1}}, {"full", {0}}};
  });
  add("hidden", usual, "every node that has a mesh is hidden", [&](Scene& scene) {
    rectangle(scene);
    scene.nodes[0].visible = false;
  });
  add("no vertices", usual, "its meshes have no vertices", [&](Scene& scene) {
    rectangle(scene);
    scene.meshes[0].primitives.clear();
  });
  add("no triangle", usual, "vertices enough for a triangle", [&](Scene& scene) {
    rectangle(scene);
    scene.meshes[0].primitives[0] = Primitive();
    scene.meshes[0].primitives[0].positions = {{0, 0, 0}, {1, 0, 0}};
  });
  add("faces away", usual, "turns its back to the camera", [&](Scene& scene) {
    rectangle(scene);
    scene.nodes[0].transform = turned;
  });
  add("faces away from the framing camera", From(AutoCamera()), "turns its back", [&](Scene& scene) {
    rectangle(scene);
    scene.nodes[0].transform = turned;
  });
  add("one faces away, one is aside", usual, "turns its back to the camera", [&](Scene& scene) {
    rectangle(scene);
    scene.nodes[0].transform = turned;
    Add(scene, Rectangle(8, 8, 9, 9), 0);
  });
  add("behind the camera", From(Perspective(1.0, {0, 0, -5})), "everything is behind the camera", rectangle);
  add("nearer than the near plane", From(Orthographic(1.0, {0, 0, 0.005})), "nearer than the camera's near plane",
      rectangle);
  add("beyond the far plane", From(Orthographic(1.0, {0, 0, 2000})), "beyond the camera's far plane", rectangle);
  add("beside the view", From(Orthographic(1.0, {7, 0, 10})), "everything is beside the view", rectangle);
  add("above a perspective view", From(Perspective(0.5, {0, -30, 10})), "everything is beside the view", rectangle);
  add("far too small", From(Perspective(1.0, {0.013, 0.011, 1e7})), "smaller than the gaps between samples", rectangle);
  add("transparent", usual, "wholly transparent", [&](Scene& scene) {
    rectangle(scene);
    scene.materials[0].alpha_mode = AlphaMode::Blend;
    scene.materials[0].base_color_factor.a = 0.0f;
  });
  add("cut out", usual, "wholly transparent", [&](Scene& scene) {
    rectangle(scene);
    scene.materials[0].alpha_mode = AlphaMode::Mask;
    scene.materials[0].base_color_factor.a = 0.25f;
  });
  return cases;
}

TEST(ImageWarnings, EmptyImagesSayWhy) {
  for (const Empty& empty : EmptyImages()) {
    const std::vector<std::string> warnings = WarningsOf(empty.scene, empty.settings);
    ASSERT_EQ(warnings.size(), 1u) << empty.name;
    EXPECT_EQ(warnings[0].rfind("nothing is visible: ", 0), 0u) << warnings[0];
    EXPECT_NE(warnings[0].find(empty.reason), std::string::npos) << empty.name << ": " << warnings[0];
  }
}

TEST(ImageWarnings, TheBackgroundIsNoPartOfTheScene) {
  Scene scene;
  RenderSettings settings = From(Orthographic(1.0));
  settings.environment = ConstantEnvironment(1.0f);
  settings.background = Background::Environment;
  EXPECT_EQ(WarningsOf(scene, settings).size(), 1u);
}

TEST(ImageWarnings, WhatShowsAnythingIsSilent) {
  Scene scene;
  Add(scene, Rectangle(-0.01f, -0.01f, 0.1f, 0.1f), AddMaterial(scene, OneSided()));
  Transform turned;
  turned.rotation = glm::dquat(0, 0, 1, 0);
  Add(scene, Rectangle(-1, -1, 1, 1), 0, turned);  // one of them faces away
  EXPECT_EQ(WarningsOf(scene, From(Orthographic(1.0))), std::vector<std::string>());
  // A renderer's next frame is none the worse for the question why the last one was empty.
  Renderer renderer(scene);
  Film film;
  RenderStats stats;
  renderer.Render(From(Orthographic(1.0, {50, 0, 10})), film, &stats);
  EXPECT_EQ(stats.warnings.size(), 1u);
  renderer.Render(From(Orthographic(1.0)), film, &stats);
  EXPECT_TRUE(stats.warnings.empty());
  EXPECT_TRUE(SameBytes(film, Render(scene, From(Orthographic(1.0)))));
}

TEST(ImageWarnings, UnlitImagesSayWhy) {
  Scene scene;
  const int material = AddMaterial(scene, Material());
  Add(scene, Rectangle(-0.5f, -0.5f, 0.5f, 0.5f), material);
  const int lamp = int(scene.nodes.size());
  scene.nodes.emplace_back();
  scene.lights.push_back({"", LightType::Point, glm::vec3(1), 5.0f});
  RenderSettings settings = From(Orthographic(1.0));
  const auto warning = [&] {
    const std::vector<std::string> warnings = WarningsOf(scene, settings);
    return warnings.empty() ? std::string() : warnings[0];
  };
  const auto is_dark = [&](const char* why) {
    EXPECT_EQ(warning().rfind("nothing lights the picture: " + std::string(why), 0), 0u) << warning();
  };
  is_dark("there is no environment");
  scene.nodes[std::size_t(lamp)].light = 0;
  EXPECT_EQ(warning(), "");
  scene.lights[0].intensity = 0.0f;
  is_dark("there is no environment");
  scene.lights[0].intensity = 5.0f;
  scene.lights[0].color = glm::vec3(0);
  is_dark("there is no environment");
  settings.environment = ConstantEnvironment(1.0f);
  EXPECT_EQ(warning(), "");
  settings.environment.intensity = 0.0;
  is_dark("the environment's intensity is 0");
  // Asked for feature by feature, or nothing that needs light.
  settings.without = {Feature::EnvironmentLight};
  EXPECT_EQ(warning(), "");
  settings.without = {};
  scene.materials[0].emissive_factor = glm::vec3(1);
  EXPECT_EQ(warning(), "") << "it can be seen";
  scene.materials[0] = Unlit({1, 1, 1, 1});
  EXPECT_EQ(warning(), "");
  scene.materials[0] = Material();
  scene.nodes[0].transform.translation.x = 100.0;
  EXPECT_EQ(warning().rfind("nothing is visible: ", 0), 0u) << "nothing that the light could fall on";
}

}  // namespace
}  // namespace facet
