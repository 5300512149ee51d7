// What facet explains is what the scene has, and frames that use everything are the same frames.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "check/manifest.h"
#include "cli/scratch.h"
#include "facet/error.h"
#include "facet/explain.h"
#include "facet/film.h"
#include "render/hand_built.h"

namespace facet {
namespace {

namespace fs = std::filesystem;

const FeatureCost* CostOf(const Explanation& explanation, const std::string& feature) {
  for (const FeatureCost& cost : explanation.costs) {
    if (cost.feature == feature) return &cost;
  }
  return nullptr;
}

std::set<std::string> Costed(const Explanation& explanation) {
  std::set<std::string> features;
  for (const FeatureCost& cost : explanation.costs) features.insert(cost.feature);
  return features;
}

TEST(Explain, APlainSceneHasLittleToExplain) {
  Scene scene;
  Add(scene, Rectangle(-1, -1, 1, 1), AddMaterial(scene, Unlit(glm::vec4(1.0f))));
  const Explanation e = Explain(scene, Settings(32, 32, 1, Perspective(1.0, {0, 0, 3})));
  EXPECT_TRUE(e.costs.empty());
  EXPECT_TRUE(e.textures.empty());
  EXPECT_EQ(e.environment, "");
  EXPECT_FALSE(e.environment_light || e.environment_background);
  ASSERT_EQ(e.materials.size(), 1u);
  EXPECT_FALSE(e.materials[0].lit);
  EXPECT_EQ(e.materials[0].triangles, 2u);
  EXPECT_EQ(e.materials[0].features, std::vector<std::string>{"double-sided"});
  EXPECT_GE(e.frames, 5);
  EXPECT_GT(e.steady_seconds, 0.0);
}

TEST(Explain, ANormalTextureWithoutAnImageNeedsNoTangents) {
  Scene scene;
  scene.textures.emplace_back();
  Material material;
  material.normal_texture = Ref(0);
  Add(scene, Rectangle(-1, -1, 1, 1), AddMaterial(scene, material));
  const Explanation e = Explain(scene, Settings(32, 32, 1, Perspective(1.0, {0, 0, 3})));
  EXPECT_NE(std::find(e.first.disabled.begin(), e.first.disabled.end(),
                      "tangents: no normal texture is read, and no surface is anisotropic"),
            e.first.disabled.end());
  EXPECT_EQ(e.first.pose_bytes, 0u);
  ASSERT_EQ(e.materials.size(), 1u);
  EXPECT_TRUE(e.materials[0].features.empty());
}

TEST(Explain, NamesAndCountsWhatTheFrameUses) {
  Scene scene;
  const auto texture = [&](int width, int height) {
    return Ref(AddTexture(scene, MakeImage(width, height, [](int x, int y) {
                            return glm::u8vec4(100 + 30 * (x % 2), 100 + 30 * (y % 2), 200, 255);
                          })));
  };
  Material material;
  material.name = "Paint";
  material.base_color_texture = texture(8, 4);
  material.metallic_roughness_texture = texture(16, 16);
  material.occlusion_texture = material.metallic_roughness_texture;
  material.normal_texture = texture(2, 2);
  const int paint = AddMaterial(scene, material);
  Add(scene, Sphere(1.0f, 8, 12), paint);  // without tangents: they are made, and cost memory
  Material hidden;
  hidden.base_color_texture = texture(32, 32);
  Transform behind;
  behind.translation = {0, 0, 50};
  Add(scene, Rectangle(-1, -1, 1, 1), AddMaterial(scene, hidden), behind);
  scene.lights.emplace_back();
  scene.lights.back().type = LightType::Spot;
  scene.nodes.emplace_back();
  scene.nodes.back().light = 0;
  RenderSettings settings = Settings(48, 48, 4, Perspective(1.0, {0, 0, 3}));
  settings.environment = ConstantEnvironment(1.0f);
  settings.background = Background::Environment;
  const Explanation e = Explain(scene, settings);

  EXPECT_EQ(Costed(e), (std::set<std::string>{"base-color-texture", "metallic-roughness-texture", "normal-texture",
                                              "occlusion", "environment-light", "punctual-lights", "background",
                                              "multisampling", "anisotropic-filtering", "specular-antialiasing"}));
  EXPECT_EQ(e.environment, "16x8");
  EXPECT_TRUE(e.environment_light && e.environment_background);
  EXPECT_EQ(e.lights.spot, 1);
  EXPECT_EQ(e.lights.point + e.lights.directional, 0);
  ASSERT_EQ(e.materials.size(), 2u);
  EXPECT_EQ(e.materials[0].name, "Paint");
  EXPECT_EQ(e.materials[0].drawables, 1u);
  EXPECT_EQ(e.materials[0].triangles, 8u * 12u * 2u);
  EXPECT_EQ(e.materials[0].features, (std::vector<std::string>{"base-color-texture", "metallic-roughness-texture",
                                                               "normal-texture", "occlusion"}));

  ASSERT_EQ(e.textures.size(), 4u);
  EXPECT_EQ(e.textures[0].roles, std::vector<std::string>{"base-color"});
  EXPECT_EQ(e.textures[1].roles, (std::vector<std::string>{"metallic-roughness", "occlusion"}));
  ASSERT_TRUE(e.textures[0].kept && e.textures[1].kept && e.textures[2].kept);
  EXPECT_EQ(e.textures[0].kept->width, 8);
  EXPECT_EQ(e.textures[0].kept->height, 4);
  EXPECT_EQ(e.textures[0].kept->levels, 4);
  EXPECT_EQ(e.textures[0].kept->bits, 16);
  EXPECT_EQ(e.textures[0].kept->channels, 3) << "an opaque material reads no alpha";
  EXPECT_EQ(e.textures[1].kept->bits, 8);
  EXPECT_FALSE(e.textures[3].kept) << "nothing visible reads it";

  // Memory is exact: what goes when a texture is read by nobody any more.
  const auto bytes = [&](std::size_t index) { return std::int64_t(e.textures[index].kept->bytes); };
  EXPECT_EQ(CostOf(e, "base-color-texture")->bytes, bytes(0));
  // One channel of one image for occlusion, two for metalness and roughness.
  EXPECT_EQ(e.textures[1].kept->channels, 3);
  const std::int64_t of_channel = (bytes(1) - 16) / 3;
  EXPECT_EQ(CostOf(e, "occlusion")->bytes, of_channel);
  EXPECT_EQ(CostOf(e, "metallic-roughness-texture")->bytes, 2 * of_channel);
  EXPECT_EQ(CostOf(e, "normal-texture")->bytes, bytes(2) + std::int64_t(e.first.pose_bytes));
  EXPECT_GT(e.first.pose_bytes, 0u);
  EXPECT_EQ(CostOf(e, "environment-light")->bytes, 0) << "the background shows it still";
  EXPECT_EQ(CostOf(e, "environment-light")->option, "--without environment-light");
  EXPECT_EQ(CostOf(e, "multisampling")->option, "--samples 1");
  for (const FeatureCost& cost : e.costs) {
    EXPECT_GE(cost.pairs, 5) << cost.feature;
    EXPECT_LE(cost.seconds_low, cost.seconds) << cost.feature;
    EXPECT_LE(cost.seconds, cost.seconds_high) << cost.feature;
  }
}

TEST(Explain, LayersHaveTheirWordsAndCosts) {
  Scene scene;
  Material material;
  material.roughness_factor = 0.4f;
  material.clearcoat_factor = 1.0f;
  material.clearcoat_roughness_factor = 0.5f;
  material.clearcoat_roughness_texture =
      Ref(AddTexture(scene, MakeImage(8, 8, [](int x, int) { return glm::u8vec4(20 * x, 20 * x, 0, 255); })));
  material.anisotropy_strength = 0.5f;
  Add(scene, Sphere(1.0f, 8, 12), AddMaterial(scene, material));
  RenderSettings settings = Settings(32, 32, 1, Perspective(1.0, {0, 0, 3}));
  settings.environment = ConstantEnvironment(1.0f);
  const Explanation e = Explain(scene, settings);
  ASSERT_EQ(e.materials.size(), 1u);
  EXPECT_EQ(e.materials[0].features, (std::vector<std::string>{"clearcoat", "anisotropy"}));
  EXPECT_EQ(Costed(e), (std::set<std::string>{"clearcoat", "anisotropy", "anisotropic-filtering", "environment-light",
                                              "specular-antialiasing"}));
  EXPECT_EQ(e.costs.size(), 5u) << "that of the surface and that of the filter have names of their own";
  EXPECT_EQ(CostOf(e, "anisotropy")->option, "--without anisotropy");
  EXPECT_EQ(CostOf(e, "anisotropic-filtering")->option, "--max-anisotropy 1");
  ASSERT_EQ(e.textures.size(), 1u);
  EXPECT_EQ(e.textures[0].roles, std::vector<std::string>{"clearcoat-roughness"});
  ASSERT_TRUE(e.textures[0].kept);
  EXPECT_EQ(e.textures[0].kept->channels, 1) << "green alone";
  // The factor takes its textures along, and tangents are made for anisotropy.
  EXPECT_EQ(CostOf(e, "clearcoat")->bytes, std::int64_t(e.textures[0].kept->bytes));
  EXPECT_EQ(CostOf(e, "anisotropy")->bytes, std::int64_t(e.first.pose_bytes));
  EXPECT_GT(e.first.pose_bytes, 0u);
  // The table of albedos has a time of its own.
  EXPECT_GT(e.first.table_seconds, 0.0);
}

// Of a texture of emission: the share that nothing reads. The same image as base colour is read everywhere.
TEST(Explain, TheShareOfEmissionThatIsBlack) {
  for (const bool as_color : {false, true}) {
    Scene scene;
    // A texel of one of 64 x 64 cells, which lights nine.
    const TextureRef image = Ref(AddTexture(scene, MakeImage(256, 256, [](int x, int y) {
                                              return glm::u8vec4(x == 128 && y == 128 ? 200 : 0, 0, 0, 255);
                                            })));
    Material material;
    material.emissive_factor = glm::vec3(1.0f);
    material.emissive_texture = image;
    if (as_color) material.base_color_texture = image;
    Add(scene, Rectangle(-1, -1, 1, 1), AddMaterial(scene, material));
    const Explanation e = Explain(scene, Settings(16, 16, 1, Perspective(1.0, {0, 0, 3})));
    ASSERT_EQ(e.textures.size(), 1u);
    ASSERT_TRUE(e.textures[0].kept);
    EXPECT_DOUBLE_EQ(e.textures[0].kept->empty, as_color ? 0.0 : 1.0 - 9.0 / 4096.0);
    const bool said = ToText(e, "scene").find("99 % black") != std::string::npos;
    EXPECT_EQ(said, !as_color);
  }
}

TEST(Explain, WhatIsDisabledOnRequestIsSaid) {
  Scene scene;
  Material material;
  material.emissive_factor = {1, 0, 0};
  Add(scene, Rectangle(-1, -1, 1, 1), AddMaterial(scene, material));
  RenderSettings settings = Settings(16, 16, 1, Perspective(1.0, {0, 0, 3}));
  EXPECT_EQ(Costed(Explain(scene, settings)), std::set<std::string>{"emission"});
  settings.without = {Feature::Emission};
  const Explanation e = Explain(scene, settings);
  EXPECT_TRUE(e.costs.empty());
  EXPECT_NE(ToText(e, "s.glb").find("on request"), std::string::npos);
}

TEST(Explain, NamesThePlanesBesidesColour) {
  Scene scene;
  Add(scene, Rectangle(-1, -1, 1, 1), AddMaterial(scene, Unlit(glm::vec4(1.0f))));
  RenderSettings settings = Settings(16, 16, 1, Perspective(1.0, {0, 0, 3}));
  const std::string what = "planes besides colour";
  const auto disabled = [&](const Explanation& e) { return ToText(e, "s").find(what) != std::string::npos; };
  EXPECT_TRUE(disabled(Explain(scene, settings)));
  settings.planes = {PlaneKind::Triangle, PlaneKind::Depth};
  const Explanation e = Explain(scene, settings);
  EXPECT_FALSE(disabled(e));
  EXPECT_EQ(e.planes, settings.planes);
  EXPECT_EQ(Costed(e), std::set<std::string>{"planes"});
  EXPECT_EQ(nlohmann::json::parse(ToJson(e, "s"))["planes"], (nlohmann::json{"triangle", "depth"}));
  for (const char* part : {"Planes besides colour", "1 KiB", "camera's axis"}) {
    EXPECT_NE(ToText(e, "s").find(part), std::string::npos) << part;
  }
}

TEST(Explain, TextAndJsonHaveTheSameNumbers) {
  Explanation e;
  e.width = 640, e.height = 480, e.samples = 4;
  e.frames = 7, e.steady_seconds = 0.010;
  e.first.environment_seconds = 0.03125, e.first.table_seconds = 0.0625;
  e.materials.push_back({"a\x1b[2Jb\xff", 0, "metallic-roughness", true, {"occlusion"}, 3, 1234567});
  e.first.disabled = {"skins: nothing drawn has one"};
  e.costs.push_back({"occlusion", "--without occlusion", 9, 0.00125, -0.0005, 0.002, 0.25, -2048});
  const std::string text = ToText(e, "x.glb");
  for (const char* part : {"640x480", "1,234,567", "10.00 ms", "1.25", "12.5 %", "-0.50 to 2.00", "250.00", "-2 KiB",
                           "albedo tables", "62.50", "--without occlusion", "nothing drawn has one"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  }
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  const nlohmann::json json = nlohmann::json::parse(ToJson(e, "x.glb"));
  EXPECT_EQ(json["costs"][0]["feature"], "occlusion");
  EXPECT_EQ(json["costs"][0]["seconds"], 0.00125);
  EXPECT_EQ(json["costs"][0]["bytes"], -2048);
  EXPECT_EQ(json["materials"][0]["triangles"], 1234567);
  EXPECT_EQ(json["disabled"][0]["what"], "skins");
  EXPECT_EQ(json["disabled"][0]["why"], "nothing drawn has one");
  EXPECT_EQ(json["steady_frame"]["seconds"], 0.010);
  EXPECT_EQ(json["first_frame"]["environment_seconds"], 0.03125);
  EXPECT_EQ(json["first_frame"]["table_seconds"], 0.0625);
}

// --- The promise: with everything switched on, the same bits --------------------------------------------------------

void ExpectSameWithEverything(const facet::Manifest& manifest) {
  ASSERT_FALSE(manifest.entries.empty());
  for (const ManifestEntry& entry : manifest.entries) {
    SCOPED_TRACE(entry.name);
    ASSERT_FALSE(entry.problem.has_value());
    RenderRequest request = entry.request;
    request.settings.width = 64;
    request.settings.height = 64;
    RenderInputs inputs = LoadInputs(manifest.path.parent_path() / entry.scene, request, {}, {manifest.path, "/"});
    RenderStats lean, full;
    Film film;
    try {
      film = Render(inputs.loaded.scene, inputs.settings, &lean);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::MissingModule) throw;
      continue;
    }
    inputs.settings.omit_unused = false;
    EXPECT_EQ(ToHex(HashFilm(Render(inputs.loaded.scene, inputs.settings, &full))), ToHex(HashFilm(film)));
    EXPECT_TRUE(full.drawables == 0 || !full.textures.empty());
  }
}

using EverythingOn = test::Scratch;

TEST_F(EverythingOn, BundledScenesKeepTheirBits) {
  ExpectSameWithEverything(ReadManifest(fs::path(FACET_SOURCE_DIR) / "tests/golden/goldens.json"));
}

TEST_F(EverythingOn, SampleModelsKeepTheirBits) {
  const char* const named = std::getenv("FACET_CORPUS");
  const fs::path corpus = named != nullptr ? fs::path(named) : fs::path(FACET_SOURCE_DIR) / "../shared/corpus";
  if (!fs::exists(corpus / "models")) {
    GTEST_SKIP() << "there is no corpus of sample models at " << corpus << "; FACET_CORPUS names another folder";
  }
  std::ifstream stream(fs::path(FACET_SOURCE_DIR) / "tests/golden/corpus.json.in");
  std::ostringstream read;
  read << stream.rdbuf();
  std::string text = read.str();
  const std::string place = "@CORPUS@", folder = fs::absolute(corpus).lexically_normal().string();
  for (std::size_t at = 0; (at = text.find(place, at)) != std::string::npos;) text.replace(at, place.size(), folder);
  ExpectSameWithEverything(ReadManifest(Write("corpus.json", text)));
}

}  // namespace
}  // namespace facet
