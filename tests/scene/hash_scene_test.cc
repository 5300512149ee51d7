// The digests of a scene: which change tells in which.
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <set>
#include <string>
#include <type_traits>

#include "facet/scene.h"
#include "material/parameters.h"
#include "scene/scene_helpers.h"

namespace facet {
namespace {

// By a version that knew no extension but unlit materials and the emissive strength.
const char* const kDescriptionBeforeExtensions = "127eb7eb4e4759332f168d2f5cdd5c4b5444af0c7982ccad0e9e96335d1ca760";

Image OnePixel(std::uint8_t red) {
  Image image{1, 1, 3, ChannelType::U8, Encoding::Srgb, {}};
  image.bytes = {std::byte(red), std::byte(2), std::byte(3)};
  return image;
}

Scene Everything() {
  Primitive primitive = Triangle();
  primitive.normals.assign(3, {0, 0, 1});
  primitive.tangents.assign(3, {1, 0, 0, 1});
  primitive.tex_coords = {{{0, 0}, {1, 0}, {0, 1}}};
  primitive.colors.assign(3, glm::vec4(1.0f));
  primitive.joints = {{{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}}};
  primitive.weights = {{{1, 0, 0, 0}, {1, 0, 0, 0}, {1, 0, 0, 0}}};
  primitive.indices = {0, 1, 2};
  primitive.targets.resize(1);
  primitive.targets[0].positions.assign(3, glm::vec3(0.0f));
  primitive.material = 0;
  Scene scene = SceneOf(primitive);
  scene.images.push_back({"red", MakeImageSource(OnePixel(255), "red")});
  scene.textures.resize(1);
  scene.textures[0].image = 0;
  scene.materials.resize(1);
  scene.materials[0].base_color_texture.texture = 0;
  scene.meshes[0].weights = {0.5f};
  scene.skins.resize(1);
  scene.skins[0].joints = {0};
  scene.skins[0].inverse_bind = {glm::mat4(1.0f)};
  scene.cameras.resize(1);
  scene.lights.resize(1);
  scene.animations.resize(1);
  scene.animations[0].channels.resize(1);
  scene.animations[0].channels[0].times = {0.0f};
  scene.animations[0].channels[0].values = {0.0f, 0.0f, 0.0f};
  scene.scenes.resize(1);
  scene.scenes[0].nodes = {0};
  scene.variants = {"other"};
  return scene;
}

using Change = std::function<void(Scene&)>;

std::string Changed(const Change& change) {
  Scene scene = Everything();
  const SceneDigests before = HashScene(scene);
  change(scene);
  const SceneDigests after = HashScene(scene);
  std::string what;
  if (before.description != after.description) what += " description";
  if (before.geometry != after.geometry) what += " geometry";
  if (before.textures != after.textures) what += " textures";
  return what;
}

Primitive& First(Scene& scene) { return scene.meshes[0].primitives[0]; }

TEST(HashScene, EveryNumberOfTheDescriptionCounts) {
  const std::map<std::string, Change> changes = {
      {"wrap", [](Scene& s) { s.textures[0].sampler.wrap_v = Wrap::ClampToEdge; }},
      {"mip", [](Scene& s) { s.textures[0].sampler.mip = MipFilter::None; }},
      {"texture's image", [](Scene& s) { s.textures[0].image = -1; }},
      {"texture's rotation", [](Scene& s) { s.materials[0].base_color_texture.rotation = 1e-6f; }},
      {"base colour", [](Scene& s) { s.materials[0].base_color_factor.w = 0.999f; }},
      {"emission", [](Scene& s) { s.materials[0].emissive_strength = 2.0f; }},
      {"alpha mode", [](Scene& s) { s.materials[0].alpha_mode = AlphaMode::Mask; }},
      {"unlit", [](Scene& s) { s.materials[0].model = ShadingModel::Unlit; }},
      {"topology", [](Scene& s) { First(s).topology = Topology::Points; }},
      {"material", [](Scene& s) { First(s).material = -1; }},
      {"variant's material", [](Scene& s) { First(s).variant_materials = {0}; }},
      {"default weight", [](Scene& s) { s.meshes[0].weights[0] = 0.25f; }},
      {"bind matrix", [](Scene& s) { s.skins[0].inverse_bind[0][3][0] = 1.0f; }},
      {"field of view", [](Scene& s) { s.cameras[0].yfov = 0.7; }},
      {"aspect", [](Scene& s) { s.cameras[0].aspect = 1.0; }},
      {"light", [](Scene& s) { s.lights[0].range = 3.0f; }},
      {"rotation", [](Scene& s) { s.nodes[0].transform.rotation.z = 0.1; }},
      {"matrix", [](Scene& s) { s.nodes[0].matrix = glm::dmat4(1.0); }},
      {"instance", [](Scene& s) { s.nodes[0].instances.emplace_back(); }},
      {"visibility", [](Scene& s) { s.nodes[0].visible = false; }},
      {"key", [](Scene& s) { s.animations[0].channels[0].values[2] = 1.0f; }},
      {"interpolation", [](Scene& s) { s.animations[0].channels[0].interpolation = Interpolation::Step; }},
      {"roots", [](Scene& s) { s.scenes[0].nodes.clear(); }},
      {"default scene", [](Scene& s) { s.default_scene = 0; }},
  };
  for (const auto& [name, change] : changes) EXPECT_EQ(Changed(change), " description") << name;
}

// Each parameter of a material counts, and as itself: a number that stands in two of them makes two descriptions.
TEST(HashScene, EveryParameterOfAMaterialCounts) {
  std::set<std::string> descriptions = {ToHex(HashScene(Everything()).description)};
  std::size_t changes = 1;
  const auto add = [&](const char* name, const Change& change) {
    Scene scene = Everything();
    change(scene);
    descriptions.insert(ToHex(HashScene(scene).description));
    EXPECT_EQ(descriptions.size(), ++changes) << name << " does not count, or counts as another parameter";
  };
  ForEachParameter([&]<class Value>(const Parameter<Value>& parameter) {
    if (parameter.alternative) return;
    const auto value = [member = parameter.member](Scene& s) -> Value& { return s.materials[0].*member; };
    if constexpr (std::is_same_v<Value, float>) {
      add(parameter.name, [&](Scene& s) { value(s) = 0.375f; });
      add(parameter.name, [&](Scene& s) { value(s) = 0.75f; });
    } else if constexpr (std::is_same_v<Value, glm::vec3> || std::is_same_v<Value, glm::vec4>) {
      for (int c = 0; c < Value::length(); ++c) {
        add(parameter.name, [&](Scene& s) { value(s)[c] = 0.375f; });
      }
    } else if constexpr (std::is_same_v<Value, TextureRef>) {
      const auto refer = [&](Scene& s) { value(s) = {.texture = 0, .tex_coord = 1}; };
      add(parameter.name, refer);
      add(parameter.name, [&](Scene& s) { refer(s), value(s).tex_coord = 2; });
      add(parameter.name, [&](Scene& s) { refer(s), value(s).offset.y = 0.5f; });
      add(parameter.name, [&](Scene& s) { refer(s), value(s).scale.x = 0.5f; });
      add(parameter.name, [&](Scene& s) { refer(s), value(s).rotation = 0.5f; });
    } else if constexpr (std::is_same_v<Value, bool>) {
      add(parameter.name, [&](Scene& s) { value(s) = true; });
    } else {
      add(parameter.name, [&](Scene& s) { value(s) = Value(1); });
      add(parameter.name, [&](Scene& s) { value(s) = Value(2); });
    }
  });
}

TEST(HashScene, EveryVertexAttributeCountsAsGeometry) {
  const std::map<std::string, Change> changes = {
      {"position", [](Scene& s) { First(s).positions[2].z = 1e-30f; }},
      {"sign of zero", [](Scene& s) { First(s).positions[0].x = -0.0f; }},
      {"normal", [](Scene& s) { First(s).normals[1].x = 1.0f; }},
      {"tangent", [](Scene& s) { First(s).tangents[1].w = -1.0f; }},
      {"uv", [](Scene& s) { First(s).tex_coords[0][2].y = 0.5f; }},
      {"another uv set", [](Scene& s) { First(s).tex_coords.emplace_back(); }},
      {"colour", [](Scene& s) { First(s).colors[0].w = 0.0f; }},
      {"joint", [](Scene& s) { First(s).joints[0][0][3] = 1; }},
      {"weight", [](Scene& s) { First(s).weights[0][0][3] = 1.0f; }},
      {"order",
       [](Scene& s) {
         First(s).indices = {1, 2, 0};
       }},
      {"no indices", [](Scene& s) { First(s).indices.clear(); }},
      {"morph target", [](Scene& s) { First(s).targets[0].positions[0].x = 1.0f; }},
  };
  for (const auto& [name, change] : changes) EXPECT_EQ(Changed(change), " geometry") << name;
}

TEST(HashScene, TexturesAreWhatTheyDecodeTo) {
  EXPECT_EQ(Changed([](Scene& s) { s.images[0].source = MakeImageSource(OnePixel(254), "red"); }), " textures");
  EXPECT_EQ(Changed([](Scene& s) { s.images[0].source = std::make_shared<NoSource>(); }), " textures");
  EXPECT_EQ(Changed([](Scene& s) { s.images[0].source = MakeImageSource(OnePixel(255), "another name"); }), "");
}

// Verification compares it with what older versions wrote down.
TEST(HashScene, TheDescriptionOfScenesWithoutExtensionsStays) {
  EXPECT_EQ(ToHex(HashScene(Everything()).description), kDescriptionBeforeExtensions);
}

TEST(HashScene, NamesDoNotCount) {
  EXPECT_EQ(Changed([](Scene& s) {
              s.images[0].name = s.textures[0].name = s.materials[0].name = s.meshes[0].name = s.nodes[0].name = "x";
              s.skins[0].name = s.cameras[0].name = s.lights[0].name = s.animations[0].name = s.variants[0] = "x";
            }),
            "");
}

// Where an array ends is part of what is hashed: numbers cannot wander from one to the next unseen.
TEST(HashScene, ArraysAreToldApart) {
  EXPECT_EQ(Changed([](Scene& s) {
              First(s).tangents.clear();
              First(s).colors.assign(3, {1, 0, 0, 1});  // the tangents' numbers
            }),
            " geometry");
}

}  // namespace
}  // namespace facet
