#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "facet/error.h"
#include "facet/models.h"
#include "scene_helpers.h"

namespace facet {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

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
        Break{"index_count", "mesh 0, primitive 0: 4 indices are no multiple of 3",
              [](Scene& s) {
                First(s).indices = {0, 1, 2, 0};
              }},
        Break{"line_indices", "1 indices are no multiple of 2",
              [](Scene& s) { First(s).topology = Topology::Lines, First(s).indices = {0}; }},
        Break{"topology", "topology 7 is unknown", [](Scene& s) { First(s).topology = Topology(7); }},
        Break{"wrap", "texture 0: wrap_v 3 is unknown", [](Scene& s) { s.textures[0].sampler.wrap_v = Wrap(3); }},
        Break{"filter", "texture 0: the minification filter 2 is unknown",
              [](Scene& s) { s.textures[0].sampler.minification = Filter(2); }},
        Break{"mip", "texture 0: the mip filter 9 is unknown",
              [](Scene& s) { s.textures[0].sampler.mip = MipFilter(9); }},
        Break{"alpha_mode", "alpha mode 3 is unknown", [](Scene& s) { s.materials[0].alpha_mode = AlphaMode(3); }},
        Break{"light_type", "light 0: type 3 is unknown", [](Scene& s) { s.lights[0].type = LightType(3); }},
        Break{"path", "channel 0: path 4 is unknown",
              [](Scene& s) {
                s.animations[0].channels[0].path = AnimationPath(4);
                s.animations[0].channels[0].values.resize(6);
              }},
        Break{"interpolation", "interpolation 3 is unknown",
              [](Scene& s) { s.animations[0].channels[0].interpolation = Interpolation(3); }},
        Break{"normals", "normals has 2", [](Scene& s) { First(s).normals.resize(2); }},
        Break{"uv", "UV set",
              [](Scene& s) {
                First(s).tex_coords.resize(1, {{0, 0}});
              }},
        Break{"weights", "weight sets", [](Scene& s) { First(s).weights.clear(); }},
        Break{"target", "target 0", [](Scene& s) { First(s).targets[0].positions.pop_back(); }},
        Break{"material", "material 1 is not", [](Scene& s) { First(s).material = 1; }},
        Break{"variant", "variant", [](Scene& s) { First(s).variant_materials = {0}; }},
        Break{"texture", "material 0: normal texture 7", [](Scene& s) { s.materials[0].normal_texture.texture = 7; }},
        Break{"layer_texture", "material 0: iridescence thickness texture 7",
              [](Scene& s) { s.materials[0].iridescence_thickness_texture.texture = 7; }},
        Break{"layer_texture_uv_set", "material 0: anisotropy texture uses UV set -1",
              [](Scene& s) { s.materials[0].anisotropy_texture.tex_coord = -1; }},
        Break{"model", "material 0: shading model 6 is unknown",
              [](Scene& s) { s.materials[0].model = ShadingModel(6); }},
        Break{"noParameters", "material 0: its parameters are not those of its shading model",
              [](Scene& s) { s.materials[0].model = ShadingModel::Lecture; }},
        Break{"parameter", "material 0: roughness 2 is not in [0, 1]",
              [](Scene& s) {
                LectureParameters block;
                block.roughness.value = 2.0f;
                s.materials[0].model = ShadingModel::Lecture;
                s.materials[0].parameters = std::make_shared<const ModelParameters>(block);
              }},
        Break{"image", "texture 0: image 0", [](Scene& s) { s.textures[0].image = 0; }},
        Break{"source", "image 0: it has no source", [](Scene& s) { s.images.resize(1); }},
        Break{"joint", "skin 0: joint -1", [](Scene& s) { s.skins[0].joints[1] = -1; }},
        Break{"inverse_bind", "inverse bind", [](Scene& s) { s.skins[0].inverse_bind.resize(1); }},
        Break{"mesh", "node 0: mesh 4", [](Scene& s) { s.nodes[0].mesh = 4; }},
        Break{"minus_two", "light -2", [](Scene& s) { s.nodes[0].light = -2; }},
        Break{"two_parents", "already a child", [](Scene& s) { s.nodes[1].children = {2}; }},
        Break{"own_child", "its own ancestor", [](Scene& s) { s.nodes.emplace_back().children = {3}; }},
        Break{"cycle", "its own ancestor",
              [](Scene& s) {
                s.nodes.resize(5);
                s.nodes[3].children = {4};
                s.nodes[4].children = {3};
              }},
        Break{"times", "channel 0",
              [](Scene& s) {
                s.animations[0].channels[0].times = {1.0f, 0.5f};
              }},
        Break{"values", "values has 7", [](Scene& s) { s.animations[0].channels[0].values.pop_back(); }},
        Break{"cubic", "values has 8",
              [](Scene& s) { s.animations[0].channels[0].interpolation = Interpolation::CubicSpline; }},
        Break{"yfov", "yfov", [](Scene& s) { s.cameras[0].yfov = 3.2; }},
        Break{"xmag", "xmag", [](Scene& s) { s.cameras[1].xmag = 0.0; }},
        Break{"scene", "scene 0: node 9", [](Scene& s) { s.scenes[0].nodes = {9}; }},
        Break{"default_scene", "default scene 1", [](Scene& s) { s.default_scene = 1; }}),
    [](const auto& parameter) { return parameter.param.name; });

// A number of a scene, by name; `refused` are values that it must not have.
struct Parameter {
  const char* name;
  const char* expected;  // part of the message
  std::function<void(Scene&, float)> set;
  std::vector<float> refused, taken;
};

class Parameters : public testing::TestWithParam<Parameter> {};

TEST_P(Parameters, AreFiniteAndInTheirRange) {
  const Parameter& p = GetParam();
  std::vector<float> refused = p.refused;
  refused.push_back(kNan);
  refused.push_back(-kInfinity);
  for (const float value : refused) {
    Scene scene = Valid();
    p.set(scene, value);
    try {
      ValidateScene(scene);
      ADD_FAILURE() << value << " was taken";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
      const std::string what = error.what();
      EXPECT_NE(what.find(p.expected), std::string::npos) << what;
      EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    }
    EXPECT_THROW(Pose(scene, {}), Error) << value;
  }
  for (const float value : p.taken) {
    Scene scene = Valid();
    p.set(scene, value);
    EXPECT_NO_THROW(ValidateScene(scene)) << value;
  }
}

constexpr float kLargest = std::numeric_limits<float>::max();
const std::vector<float> kNotInUnit = {-1e-6f, -1.0f, 1.001f, kInfinity}, kUnit = {0.0f, -0.0f, 0.5f, 1.0f};
const std::vector<float> kNegative = {-1e-38f, -1.0f, kInfinity}, kPositive = {0.0f, -0.0f, 1e-45f, 1.0f, kLargest};
const std::vector<float> kBelowOne = {-1.0f, 0.5f, 0.999f, kInfinity}, kIors = {0.0f, -0.0f, 1.0f, 2.4f, kLargest};
const std::vector<float> kBelowOneOrZero = {0.0f, 0.5f, -1.0f, kInfinity}, kOneAndMore = {1.0f, 2.4f, kLargest};
const std::vector<float> kNotPositive = {0.0f, -0.0f, -1.0f, 1e-45f}, kDistances = {1e-30f, 1.0f, kLargest, kInfinity};
const std::vector<float> kInfinite = {kInfinity}, kAny = {-kLargest, -1.0f, 0.0f, kLargest};

INSTANTIATE_TEST_SUITE_P(
    Scenes, Parameters,
    testing::Values(
        Parameter{"red", "material 0: base colour factor",
                  [](Scene& s, float v) { s.materials[0].base_color_factor.x = v; }, kNotInUnit, kUnit},
        Parameter{"alpha", "material 0: base colour factor",
                  [](Scene& s, float v) { s.materials[0].base_color_factor.w = v; }, kNotInUnit, kUnit},
        Parameter{"metallic", "material 0: metallic factor",
                  [](Scene& s, float v) { s.materials[0].metallic_factor = v; }, kNotInUnit, kUnit},
        Parameter{"roughness", "material 0: roughness factor",
                  [](Scene& s, float v) { s.materials[0].roughness_factor = v; }, kNotInUnit, kUnit},
        Parameter{"normal_scale", "material 0: normal scale",
                  [](Scene& s, float v) { s.materials[0].normal_scale = v; }, kInfinite, kAny},
        Parameter{"occlusion", "material 0: occlusion strength",
                  [](Scene& s, float v) { s.materials[0].occlusion_strength = v; }, kNotInUnit, kUnit},
        Parameter{"emission", "material 0: emissive factor",
                  [](Scene& s, float v) { s.materials[0].emissive_factor.z = v; }, kNegative, kPositive},
        Parameter{"emissive_strength", "material 0: emissive strength",
                  [](Scene& s, float v) { s.materials[0].emissive_strength = v; }, kNegative, kPositive},
        Parameter{"alpha_cutoff", "material 0: alpha cutoff",
                  [](Scene& s, float v) { s.materials[0].alpha_cutoff = v; }, kNegative, kPositive},
        Parameter{"uv_offset", "material 0: base colour texture has a transform",
                  [](Scene& s, float v) { s.materials[0].base_color_texture.offset.y = v; }, kInfinite, kAny},
        Parameter{"uv_scale", "material 0: emissive texture has a transform",
                  [](Scene& s, float v) { s.materials[0].emissive_texture.scale.x = v; }, kInfinite, kAny},
        Parameter{"uv_rotation", "material 0: occlusion texture has a transform",
                  [](Scene& s, float v) { s.materials[0].occlusion_texture.rotation = v; }, kInfinite, kAny},
        Parameter{"clearcoat", "material 0: clear coat factor",
                  [](Scene& s, float v) { s.materials[0].clearcoat_factor = v; }, kNotInUnit, kUnit},
        Parameter{"clearcoat_roughness", "material 0: clear coat roughness factor",
                  [](Scene& s, float v) { s.materials[0].clearcoat_roughness_factor = v; }, kNotInUnit, kUnit},
        Parameter{"clearcoat_normal_scale", "material 0: clear coat normal scale",
                  [](Scene& s, float v) { s.materials[0].clearcoat_normal_scale = v; }, kInfinite, kAny},
        Parameter{"sheen_color", "material 0: sheen colour factor",
                  [](Scene& s, float v) { s.materials[0].sheen_color_factor.y = v; }, kNotInUnit, kUnit},
        Parameter{"sheen_roughness", "material 0: sheen roughness factor",
                  [](Scene& s, float v) { s.materials[0].sheen_roughness_factor = v; }, kNotInUnit, kUnit},
        Parameter{"specular", "material 0: specular factor",
                  [](Scene& s, float v) { s.materials[0].specular_factor = v; }, kNotInUnit, kUnit},
        Parameter{"specular_color", "material 0: specular colour factor",
                  [](Scene& s, float v) { s.materials[0].specular_color_factor.x = v; }, kNegative, kPositive},
        Parameter{"ior", "material 0: index of refraction", [](Scene& s, float v) { s.materials[0].ior = v; },
                  kBelowOne, kIors},
        Parameter{"transmission", "material 0: transmission factor",
                  [](Scene& s, float v) { s.materials[0].transmission_factor = v; }, kNotInUnit, kUnit},
        Parameter{"thickness", "material 0: thickness factor",
                  [](Scene& s, float v) { s.materials[0].thickness_factor = v; }, kNegative, kPositive},
        Parameter{"attenuation_distance", "material 0: attenuation distance",
                  [](Scene& s, float v) { s.materials[0].attenuation_distance = v; }, kNotPositive, kDistances},
        Parameter{"attenuation_color", "material 0: attenuation colour",
                  [](Scene& s, float v) { s.materials[0].attenuation_color.z = v; }, kNotInUnit, kUnit},
        Parameter{"dispersion", "material 0: dispersion", [](Scene& s, float v) { s.materials[0].dispersion = v; },
                  kNegative, kPositive},
        Parameter{"diffuse_transmission", "material 0: diffuse transmission factor",
                  [](Scene& s, float v) { s.materials[0].diffuse_transmission_factor = v; }, kNotInUnit, kUnit},
        Parameter{"diffuse_transmission_color", "material 0: diffuse transmission colour factor",
                  [](Scene& s, float v) { s.materials[0].diffuse_transmission_color_factor.x = v; }, kNotInUnit, kUnit},
        Parameter{"iridescence", "material 0: iridescence factor",
                  [](Scene& s, float v) { s.materials[0].iridescence_factor = v; }, kNotInUnit, kUnit},
        Parameter{"iridescence_ior", "material 0: iridescence index of refraction",
                  [](Scene& s, float v) { s.materials[0].iridescence_ior = v; }, kBelowOneOrZero, kOneAndMore},
        Parameter{"iridescence_minimum", "material 0: iridescence thickness minimum",
                  [](Scene& s, float v) { s.materials[0].iridescence_thickness_minimum = v; }, kNegative, kPositive},
        Parameter{"iridescence_maximum", "material 0: iridescence thickness maximum",
                  [](Scene& s, float v) { s.materials[0].iridescence_thickness_maximum = v; }, kNegative, kPositive},
        Parameter{"anisotropy", "material 0: anisotropy strength",
                  [](Scene& s, float v) { s.materials[0].anisotropy_strength = v; }, kNotInUnit, kUnit},
        Parameter{"anisotropy_rotation", "material 0: anisotropy rotation",
                  [](Scene& s, float v) { s.materials[0].anisotropy_rotation = v; }, kInfinite, kAny},
        Parameter{"older_specular", "material 0: specular-glossiness specular factor",
                  [](Scene& s, float v) { s.materials[0].specular_glossiness_specular_factor.y = v; }, kNotInUnit,
                  kUnit},
        Parameter{"glossiness", "material 0: glossiness factor",
                  [](Scene& s, float v) { s.materials[0].glossiness_factor = v; }, kNotInUnit, kUnit},
        Parameter{"sheen_uv_offset", "material 0: sheen colour texture has a transform",
                  [](Scene& s, float v) { s.materials[0].sheen_color_texture.offset.y = v; }, kInfinite, kAny},
        Parameter{"light_color", "light 0: colour", [](Scene& s, float v) { s.lights[0].color.y = v; }, kNegative,
                  kPositive},
        Parameter{"light_intensity", "light 0: intensity", [](Scene& s, float v) { s.lights[0].intensity = v; },
                  kNegative, kPositive},
        Parameter{"light_range",
                  "light 0: range",
                  [](Scene& s, float v) { s.lights[0].range = v; },
                  {0.0f, -1.0f},
                  {1e-45f, 1.0f, kInfinity}},
        Parameter{"outer_cone",
                  "light 0: outer cone angle",
                  [](Scene& s, float v) { s.lights[0].outer_cone_angle = v; },
                  {-0.1f, 3.2f, kInfinity},
                  {0.0f, 1.0f, 3.14159274f}},
        Parameter{"inner_cone",
                  "light 0: inner cone angle",
                  [](Scene& s, float v) { s.lights[0].inner_cone_angle = v; },
                  {-0.1f, 0.8f, kInfinity},
                  {0.0f, 0.7f, 0.7853981634f}},
        Parameter{"translation", "node 2: the translation",
                  [](Scene& s, float v) { s.nodes[2].transform.translation.z = v; }, kInfinite, kAny},
        Parameter{"scale", "node 2: the scale", [](Scene& s, float v) { s.nodes[2].transform.scale.x = v; }, kInfinite,
                  kAny},
        Parameter{"rotation",
                  "node 2: the rotation has no direction",
                  [](Scene& s, float v) { s.nodes[2].transform.rotation = glm::dquat(v, v, v, v); },
                  {0.0f, kInfinity},
                  {1e-30f, -1.0f, 1e30f}},
        Parameter{"matrix", "node 1: the matrix",
                  [](Scene& s, float v) { s.nodes[1].matrix = glm::dmat4(1.0), (*s.nodes[1].matrix)[3][0] = v; },
                  kInfinite, kAny},
        Parameter{"last_row",
                  "node 1: the matrix",
                  [](Scene& s, float v) { s.nodes[1].matrix = glm::dmat4(1.0), (*s.nodes[1].matrix)[0][3] = v; },
                  {0.01f, kInfinity},
                  {0.0f, 1e-9f}},
        Parameter{"instance", "node 0, instance 1: the scale",
                  [](Scene& s, float v) { s.nodes[0].instances.resize(2), s.nodes[0].instances[1].scale.y = v; },
                  kInfinite, kAny},
        Parameter{"node_weight", "node 0: a morph weight", [](Scene& s, float v) { s.nodes[0].weights = {v}; },
                  kInfinite, kAny},
        Parameter{"mesh_weight", "mesh 0: a morph weight", [](Scene& s, float v) { s.meshes[0].weights = {0.0f, v}; },
                  kInfinite, kAny},
        Parameter{"inverse_bind", "skin 0: an inverse bind matrix",
                  [](Scene& s, float v) { s.skins[0].inverse_bind.assign(2, glm::mat4(v)); }, kInfinite, kAny},
        Parameter{"animation", "animation 0, channel 0: a value",
                  [](Scene& s, float v) { s.animations[0].channels[0].values[5] = v; }, kInfinite, kAny},
        Parameter{"yfov_of_camera",
                  "camera 0: yfov",
                  [](Scene& s, float v) { s.cameras[0].yfov = v; },
                  {0.0f, 3.2f, kInfinity},
                  {1e-6f, 3.1f}},
        Parameter{"znear",
                  "camera 0",
                  [](Scene& s, float v) { s.cameras[0].znear = v; },
                  {0.0f, -1.0f, kInfinity},
                  {1e-6f, 10.0f}},
        Parameter{"zfar",
                  "camera 0: zfar",
                  [](Scene& s, float v) { s.cameras[0].zfar = v; },
                  {0.0f, 0.01f},
                  {0.02f, kInfinity}}),
    [](const auto& parameter) { return parameter.param.name; });

// What vertices hold is not looked at: it is replaced or left out where it is of no use (docs/conventions.md).
TEST(ValidateScene, TakesVerticesWithAnyNumbers) {
  Scene scene = Valid();
  Primitive& p = First(scene);
  p.positions[0].x = kNan;
  p.normals.assign(3, glm::vec3(0.0f));
  p.tangents.assign(3, glm::vec4(kInfinity));
  p.tex_coords = {{{kNan, 0}, {1e30f, 0}, {0, 0}}};
  p.colors.assign(3, glm::vec4(-1.0f));
  p.weights[0][1] = glm::vec4(kNan);
  p.targets[0].positions[2].z = kInfinity;
  EXPECT_NO_THROW(ValidateScene(scene));
}

// Of strips and fans, and of vertices without indices, as many triangles are drawn as there are.
TEST(ValidateScene, TakesAnyNumberOfVerticesWithoutIndices) {
  for (const Topology topology : {Topology::Points, Topology::Lines, Topology::LineLoop, Topology::LineStrip,
                                  Topology::Triangles, Topology::TriangleStrip, Topology::TriangleFan}) {
    for (std::size_t count = 0; count < 8; ++count) {
      Scene scene;
      Primitive p;
      p.topology = topology;
      p.positions.resize(count);
      scene = SceneOf(p);
      EXPECT_NO_THROW(ValidateScene(scene));
      p.positions.resize(3);
      p.indices.assign(count, 1u);
      scene = SceneOf(p);
      const std::size_t each = topology == Topology::Triangles ? 3 : topology == Topology::Lines ? 2 : 1;
      if (count % each == 0) {
        EXPECT_NO_THROW(ValidateScene(scene)) << count;
      } else {
        EXPECT_THROW(ValidateScene(scene), Error) << count;
      }
    }
  }
}

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
