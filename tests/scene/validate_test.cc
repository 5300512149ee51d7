#include <gtest/gtest.h>

#include <functional>

#include "facet/error.h"
#include "scene_helpers.h"

namespace facet {
namespace {

Scene Valid() {
  Primitive primitive = Triangle();
  primitive.indices = {0, 1, 2};
  primitive.joints = {{glm::u16vec4(0), glm::u16vec4(0), glm::u16vec4(0)}};
  primitive.weights = {{glm::vec4(1, 0, 0, 0), glm::vec4(1, 0, 0, 0), glm::vec4(1, 0, 0, 0)}};
  primitive.targets.resize(1);
  primitive.targets[0].positions.resize(3);
  primitive.variant_materials = {-1, 0};
  Scene scene = SceneOf(primitive);
  scene.variants = {"a", "b"};
  scene.materials.resize(1);
  scene.textures.resize(1);
  scene.skins.push_back({"skin", {0, 1}, {}});
  scene.cameras.resize(2);
  scene.cameras[1].orthographic = true;
  scene.lights.resize(1);
  scene.nodes.resize(3);
  scene.nodes[0].children = {1, 2};
  scene.animations.resize(1);
  scene.animations[0].channels.push_back(
      {0, AnimationPath::Rotation, Interpolation::Linear, {0.0f, 1.0f}, std::vector<float>(8, 0.5f)});
  scene.scenes.push_back({"scene", {0}});
  return scene;
}

TEST(ValidateScene, AcceptsAValidScene) { EXPECT_NO_THROW(ValidateScene(Valid())); }

struct Break {
  const char* name;
  const char* expected;  // part of the message
  std::function<void(Scene&)> apply;
};

class Broken : public testing::TestWithParam<Break> {};

TEST_P(Broken, IsNamed) {
  Scene scene = Valid();
  GetParam().apply(scene);
  try {
    ValidateScene(scene);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
    EXPECT_NE(std::string(error.what()).find(GetParam().expected), std::string::npos) << error.what();
  }
}

Primitive& First(Scene& s) { return s.meshes[0].primitives[0]; }

INSTANTIATE_TEST_SUITE_P(
    Scenes, Broken,
    testing::Values(
        Break{"index", "mesh 0, primitive 0: index 3 is not one of 3", [](Scene& s) { First(s).indices[1] = 3; }},
        Break{"normals", "normals has 2", [](Scene& s) { First(s).normals.resize(2); }},
        Break{"uv", "UV set", [](Scene& s) { First(s).tex_coords.resize(1, {{0, 0}}); }},
        Break{"weights", "weight sets", [](Scene& s) { First(s).weights.clear(); }},
        Break{"target", "target 0", [](Scene& s) { First(s).targets[0].positions.pop_back(); }},
        Break{"material", "material 1 is not", [](Scene& s) { First(s).material = 1; }},
        Break{"variant", "variant", [](Scene& s) { First(s).variant_materials = {0}; }},
        Break{"texture", "material 0: normal texture 7",
              [](Scene& s) { s.materials[0].normal_texture.texture = 7; }},
        Break{"image", "texture 0: image 0", [](Scene& s) { s.textures[0].image = 0; }},
        Break{"source", "image 0: it has no source", [](Scene& s) { s.images.resize(1); }},
        Break{"joint", "skin 0: joint -1", [](Scene& s) { s.skins[0].joints[1] = -1; }},
        Break{"inverse_bind", "inverse bind", [](Scene& s) { s.skins[0].inverse_bind.resize(1); }},
        Break{"mesh", "node 0: mesh 4", [](Scene& s) { s.nodes[0].mesh = 4; }},
        Break{"minus_two", "light -2", [](Scene& s) { s.nodes[0].light = -2; }},
        Break{"two_parents", "already a child", [](Scene& s) { s.nodes[1].children = {2}; }},
        Break{"own_child", "its own ancestor",
              [](Scene& s) { s.nodes.emplace_back().children = {3}; }},
        Break{"cycle", "its own ancestor",
              [](Scene& s) {
                s.nodes.resize(5);
                s.nodes[3].children = {4};
                s.nodes[4].children = {3};
              }},
        Break{"times", "channel 0", [](Scene& s) { s.animations[0].channels[0].times = {1.0f, 0.5f}; }},
        Break{"values", "values has 7", [](Scene& s) { s.animations[0].channels[0].values.pop_back(); }},
        Break{"cubic", "values has 8",
              [](Scene& s) { s.animations[0].channels[0].interpolation = Interpolation::CubicSpline; }},
        Break{"yfov", "yfov", [](Scene& s) { s.cameras[0].yfov = 3.2; }},
        Break{"xmag", "xmag", [](Scene& s) { s.cameras[1].xmag = 0.0; }},
        Break{"scene", "scene 0: node 9", [](Scene& s) { s.scenes[0].nodes = {9}; }},
        Break{"default_scene", "default scene 1", [](Scene& s) { s.default_scene = 1; }}),
    [](const auto& parameter) { return parameter.param.name; });

TEST(ValidateScene, TakesHierarchiesOfAnyDepth) {
  Scene scene;
  scene.nodes.resize(50000);
  for (std::size_t i = 0; i + 1 < scene.nodes.size(); ++i) {
    scene.nodes[i].children = {int(i + 1)};
    scene.nodes[i].transform.translation.x = 1.0;
  }
  scene.meshes.emplace_back().primitives.push_back(Triangle());
  scene.nodes.back().mesh = 0;
  const PosedScene posed = Pose(scene, {});
  ASSERT_EQ(posed.drawables.size(), 1u);
  EXPECT_EQ(posed.drawables[0].world_from_mesh[3].x, 49999.0);
}

}  // namespace
}  // namespace facet
