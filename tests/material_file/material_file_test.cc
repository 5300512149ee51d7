// What material files say, and what is said of wrong ones.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "facet/error.h"
#include "facet/image.h"
#include "facet/load.h"
#include "facet/models.h"

namespace facet {
namespace {

class MaterialFileTest : public testing::Test {
 protected:
  MaterialFileTest() {
    const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() / (std::string("facet_material_file_") + test->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    for (const char* name : {"paint red", "paint blue", "glass"}) scene_.materials.emplace_back().name = name;
    scene_.materials[2].alpha_mode = AlphaMode::Mask;
    scene_.materials[2].double_sided = true;
  }
  ~MaterialFileTest() override { std::filesystem::remove_all(folder_); }

  void Write(const std::string& text) const { std::ofstream(folder_ / "look.json") << text; }
  void WritePicture(const std::string& name) const {
    Image image{2, 2, 3, ChannelType::U8, Encoding::Srgb, std::vector<std::byte>(12)};
    WriteImage(folder_ / name, image);
  }
  LoadReport Apply(const std::string& text) {
    Write(text);
    return ApplyMaterialFile(scene_, folder_ / "look.json");
  }
  // The message of the file's error, without the folder.
  std::string ErrorOf(const std::string& text) {
    try {
      Apply(text);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::InvalidInput) << text;
      std::string what = error.what();
      const std::string prefix = folder_.string() + "/";
      for (std::size_t at; (at = what.find(prefix)) != what.npos;) what.erase(at, prefix.size());
      return what;
    }
    return "no error";
  }
  // Of an entry for all materials, with these further members.
  std::string ErrorOfEntry(const std::string& members) {
    return ErrorOf(R"({"materials": [{"match": "*", )" + members + "}]}");
  }

  std::filesystem::path folder_;
  Scene scene_;
};

TEST_F(MaterialFileTest, PatternsChooseMaterialsAndLaterEntriesWin) {
  Apply(R"({"materials": [
      {"match": "paint*", "model": "lecture", "parameters": {"roughness": 0.25}},
      {"match": ["paint blue", "gl?ss"], "model": "filament", "parameters": {"metallic": 1, "baseColor": [0.5, 0.25, 1]}}
    ]})");
  ASSERT_EQ(scene_.materials[0].model, ShadingModel::Lecture);
  EXPECT_EQ(std::get<LectureParameters>(*scene_.materials[0].parameters).roughness.value, 0.25f);
  for (const int i : {1, 2}) {
    ASSERT_EQ(scene_.materials[i].model, ShadingModel::Filament);
    const auto& block = std::get<FilamentParameters>(*scene_.materials[i].parameters);
    EXPECT_EQ(block.metallic.value, 1.0f);
    EXPECT_EQ(block.base_color.value, glm::vec4(0.5f, 0.25f, 1.0f, 1.0f));
  }
  EXPECT_EQ(scene_.materials[0].name, "paint red");
  EXPECT_EQ(scene_.materials[2].alpha_mode, AlphaMode::Mask) << "the scene's own";
  EXPECT_TRUE(scene_.materials[2].double_sided);
  EXPECT_NO_THROW(ValidateScene(scene_));
}

TEST_F(MaterialFileTest, TexturesAreAddedOnceAndScaleWhatIsNotStated) {
  WritePicture("a.png");
  const LoadReport report =
      Apply(R"({"materials": [{"match": "glass", "model": "filament", "parameters": {"metallic": 0.5},
      "textures": {"baseColor": "a.png",
                   "metallic": {"image": "a.png", "channel": "b", "texCoord": 1, "scale": [2, 3], "wrap": "clamp"},
                   "roughness": {"image": "a.png", "channel": "g"},
                   "normal": {"image": "a.png", "strength": -2}}}]})");
  EXPECT_EQ(scene_.images.size(), 1u);
  EXPECT_EQ(scene_.textures.size(), 4u);
  EXPECT_EQ(report.files.size(), 2u);
  const auto& block = std::get<FilamentParameters>(*scene_.materials[2].parameters);
  EXPECT_EQ(block.base_color.value, glm::vec4(1.0f));
  EXPECT_EQ(block.metallic.value, 0.5f);
  EXPECT_EQ(block.metallic.channel, 2);
  EXPECT_EQ(block.metallic.texture.tex_coord, 1);
  EXPECT_EQ(block.metallic.texture.scale, glm::vec2(2.0f, 3.0f));
  EXPECT_EQ(scene_.textures[std::size_t(block.metallic.texture.texture)].sampler.wrap_u, Wrap::ClampToEdge);
  EXPECT_EQ(block.roughness.value, 1.0f) << "a texture alone takes nothing away";
  EXPECT_EQ(block.normal.scale, -2.0f);
  EXPECT_NO_THROW(ValidateScene(scene_));
}

TEST_F(MaterialFileTest, AlphaIsTheScenesUnlessItIsStated) {
  Apply(R"({"materials": [{"match": "paint red", "model": "lecture", "alphaMode": "BLEND", "doubleSided": true},
                          {"match": "paint blue", "model": "enterprise", "parameters": {"cutoutOpacity": 0.5}},
                          {"match": "glass", "model": "lecture", "alphaCutoff": 0.75}]})");
  EXPECT_EQ(scene_.materials[0].alpha_mode, AlphaMode::Blend);
  EXPECT_TRUE(scene_.materials[0].double_sided);
  EXPECT_EQ(scene_.materials[1].alpha_mode, AlphaMode::Blend) << "a coverage is meant to be seen";
  EXPECT_EQ(scene_.materials[2].alpha_mode, AlphaMode::Mask);
  EXPECT_EQ(scene_.materials[2].alpha_cutoff, 0.75f);
}

TEST_F(MaterialFileTest, PrimitivesWithoutAMaterialGetOne) {
  scene_.meshes.emplace_back().primitives.resize(2);
  scene_.meshes[0].primitives[1].material = 0;
  Apply(R"({"materials": [{"match": "*", "model": "lecture"}]})");
  ASSERT_EQ(scene_.materials.size(), 4u);
  EXPECT_EQ(scene_.meshes[0].primitives[0].material, 3);
  EXPECT_EQ(scene_.meshes[0].primitives[1].material, 0);
  EXPECT_EQ(scene_.materials[3].model, ShadingModel::Lecture);
}

TEST_F(MaterialFileTest, InheritanceStartsFromWhatTheSceneStates) {
  WritePicture("a.png");
  scene_.images.push_back({"rust", nullptr});
  scene_.textures.push_back({"rust", 0, {}});
  Material& red = scene_.materials[0];
  red.base_color_factor = {0.8f, 0.1f, 0.05f, 1.0f};
  red.roughness_factor = 0.25f;
  red.metallic_roughness_texture.texture = 0;
  red.metallic_roughness_texture.tex_coord = 1;
  red.clearcoat_factor = 1.0f;
  const Material red_before = red;
  const LoadReport report = Apply(R"({"materials": [
      {"match": "paint*", "model": "lecture", "inherit": true, "parameters": {"metalness": 0.5},
       "textures": {"metalness": null, "albedo": "a.png"}}]})");
  const auto& block = std::get<LectureParameters>(*scene_.materials[0].parameters);
  EXPECT_EQ(block.albedo.value, glm::vec4(1.0f)) << "a new texture takes the value's place";
  EXPECT_EQ(block.albedo.texture.texture, 1);
  EXPECT_EQ(block.roughness, (Textured<float>{0.25f, red_before.metallic_roughness_texture, 1}));
  EXPECT_EQ(block.metalness.value, 0.5f);
  EXPECT_FALSE(block.metalness.texture) << "null takes it away";
  EXPECT_EQ(scene_.textures.size(), 2u) << "one entry's texture is added once";
  scene_.materials[0] = red_before;
  Apply(R"({"materials": [{"match": "paint red", "model": "lecture", "inherit": true,
                           "textures": {"roughness": "a.png"}}]})");
  const auto& replaced = std::get<LectureParameters>(*scene_.materials[0].parameters).roughness;
  EXPECT_EQ(replaced.channel, 0) << "nothing of the inherited texture stays";
  EXPECT_EQ(replaced.texture.tex_coord, 0);
  EXPECT_EQ(std::get<LectureParameters>(*scene_.materials[1].parameters).roughness.value, 1.0f) << "glTF's default";
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_NE(
      report.warnings[0].find("look.json: /materials/0: material 'paint red': the model \"lecture\" does not have "
                              "clear coat"),
      std::string::npos)
      << report.warnings[0];
  EXPECT_NE(ErrorOfEntry(R"("model": "enterprise", "inherit": true, "preset": "glass")").find("/preset: cannot go"),
            std::string::npos);
}

TEST_F(MaterialFileTest, MissingTextureCoordinatesAreSaid) {
  WritePicture("a.png");
  Primitive& primitive = scene_.meshes.emplace_back(Mesh{"body", {}, {}}).primitives.emplace_back();
  primitive.material = 0;
  primitive.tex_coords = {{{}, {}, {}}};
  const LoadReport report = Apply(R"({"materials": [{"match": "*", "model": "lecture", "textures":
      {"albedo": "a.png", "roughness": {"image": "a.png", "texCoord": 1}}}]})");
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_NE(
      report.warnings[0].find("look.json: /materials/0: mesh 'body' has no TEXCOORD_1, by which roughness is read"),
      std::string::npos)
      << report.warnings[0];
}

TEST_F(MaterialFileTest, WrongFilesAreRefusedWithThePlaceAndWhatIsAccepted) {
  const auto starts = [](const std::string& message, const std::string& start) {
    EXPECT_EQ(message.substr(0, start.size()), start);
  };
  starts(ErrorOf(R"({"materials": [)"), "look.json:1:");
  starts(ErrorOf(R"({"materials": [{"match": "*", "model": "lecture", "parameters": {"f0": 0.1, "f0": 0.2}}]})"),
         "look.json: /materials/0/parameters/f0: the key is twice in one object");
  starts(ErrorOf(R"({"materials": [{"match": "*", "model": 1e400}]})"), "look.json:1:");
  starts(ErrorOf(R"({"$schema": 3, "materials": []})"), "look.json: /$schema: is no string");
  starts(ErrorOf(R"({"materials": [{"match": [], "model": "lecture"}]})"), "look.json: /materials/0/match: is empty");
  starts(ErrorOfEntry(R"("model": "filament", "parameters": {"emissive": [1e39, 0, 0, 1]})"),
         "look.json: /materials/0/parameters/emissive/0: is too large");
  starts(ErrorOfEntry(R"("model": "filament", "parameters": {"blending": "add"}, "alphaMode": "BLEND")"),
         "look.json: /materials/0/alphaMode: cannot go together");
  starts(ErrorOf(R"({"material": []})"), "look.json: /material: unknown key");
  starts(ErrorOf(R"({})"), "look.json: has no list \"materials\"");
  starts(ErrorOf(R"({"materials": {}})"), "look.json: /materials: is no list");
  starts(ErrorOf(R"({"materials": [{"model": "lecture"}]})"), "look.json: /materials/0: has no \"match\"");
  starts(ErrorOf(R"({"materials": [{"match": "chrome*", "model": "lecture"}]})"),
         "look.json: /materials/0/match: no material's name matches 'chrome*'");
  starts(ErrorOf(R"({"materials": [{"match": ["glass", 3], "model": "lecture"}]})"),
         "look.json: /materials/0/match/1: is no string");
  starts(ErrorOfEntry(R"("model": "phong")"), "look.json: /materials/0/model: there is no model 'phong'");
  starts(ErrorOfEntry(R"("model": "lecture", "parameters": {"shine": 1})"),
         "look.json: /materials/0/parameters/shine: unknown key");
  starts(ErrorOfEntry(R"("model": "lecture", "parameters": {"roughness": 1.5})"),
         "look.json: /materials/0/parameters/roughness: 1.5 is out of range");
  starts(ErrorOfEntry(R"("model": "lecture", "parameters": {"roughness": "rough"})"),
         "look.json: /materials/0/parameters/roughness: is no number");
  starts(ErrorOfEntry(R"("model": "lecture", "parameters": {"albedo": [1, 1]})"),
         "look.json: /materials/0/parameters/albedo: has 2 numbers");
  starts(ErrorOfEntry(R"("model": "lecture", "parameters": {"albedo": [1, -1, 0]})"),
         "look.json: /materials/0/parameters/albedo/1: -1 is out of range");
  starts(ErrorOfEntry(R"("model": "lecture", "textures": {"shine": "a.png"})"),
         "look.json: /materials/0/textures/shine: unknown key");
  starts(ErrorOfEntry(R"("model": "lecture", "textures": {"albedo": "missing.png"})"),
         "look.json: /materials/0/textures/albedo: there is no file");
  starts(ErrorOfEntry(R"("model": "lecture", "textures": {"albedo": "../../etc/passwd"})"),
         "look.json: /materials/0/textures/albedo: ");
  WritePicture("a.png");
  starts(ErrorOfEntry(R"("model": "lecture", "textures": {"albedo": {"image": "a.png", "channel": "r"}})"),
         "look.json: /materials/0/textures/albedo/channel: unknown key");
  starts(ErrorOfEntry(R"("model": "lecture", "textures": {"roughness": {"image": "a.png", "channel": "x"}})"),
         "look.json: /materials/0/textures/roughness/channel: 'x' is unknown");
  starts(ErrorOfEntry(R"("model": "lecture", "textures": {"roughness": {"image": "a.png", "texCoord": 0.5}})"),
         "look.json: /materials/0/textures/roughness/texCoord: is no UV set");
  starts(ErrorOfEntry(R"("model": "lecture", "alphaMode": "GLOW")"),
         "look.json: /materials/0/alphaMode: 'GLOW' is unknown");
  EXPECT_EQ(scene_.images.size(), 0u) << "a file that fails leaves the scene as it is";
  EXPECT_EQ(scene_.materials[0].model, ShadingModel::MetallicRoughness);
}

}  // namespace
}  // namespace facet
