// `facet models`, and --materials.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "cli/tiny_scene.h"
#include "facet/image.h"

namespace facet::test {
namespace {

TEST(FacetModels, ListsModelsAndTheirParameters) {
  const Outcome all = RunFacet({"models"});
  EXPECT_EQ(all.exit_code, 0) << all.err;
  for (const char* word : {"lecture", "filament", "enterprise", "facet is implementing DSPBR"}) {
    EXPECT_NE(all.out.find(word), std::string::npos) << word;
  }
  const Outcome one = RunFacet({"models", "filament"});
  EXPECT_NE(one.out.find("baseColor"), std::string::npos) << one.out;
  const auto json = nlohmann::json::parse(RunFacet({"models", "lecture", "--json"}).out);
  ASSERT_EQ(json.size(), 1u);
  EXPECT_EQ(json[0].at("parameters")[0].at("name"), "albedo");
  EXPECT_EQ(json[0].at("parameters")[0].at("default"), (nlohmann::json{1.0, 1.0, 1.0, 1.0}));
  const auto enterprise = nlohmann::json::parse(RunFacet({"models", "enterprise", "--json"}).out);
  EXPECT_EQ(enterprise[0].at("presets").at("glass").at("transparency"), 1.0);
  EXPECT_EQ(enterprise[0].at("presets").at("glass").at("thinWalled"), false) << "as in a material file";
  EXPECT_NE(RunFacet({"models", "enterprise"}).out.find("transparency 1; "), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(RunFacet({"models", "--schema"}).out).at("title"), "facet material file");
}

TEST(FacetModels, RefusesWhatIsNoModel) {
  const Outcome unknown = RunFacet({"models", "phong"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_TRUE(IsOneErrorLine(unknown.err)) << unknown.err;
  EXPECT_NE(unknown.err.find("lecture, filament, enterprise"), std::string::npos) << unknown.err;
  EXPECT_EQ(RunFacet({"models", "--chart", "x.png"}).exit_code, 2);
}

TEST(FacetModels, DrawsAChart) {
  const Folder folder;
  const Outcome run = RunFacet({"models", "lecture", "--chart", folder / "chart.png"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const Image chart = LoadImage(folder / "chart.png");
  EXPECT_GT(chart.width, 500);
  EXPECT_GT(chart.height, 300);
}

class FacetMaterials : public testing::Test {
 protected:
  FacetMaterials() { WriteText(in_, TinyScene()); }
  Outcome Hash(const std::string& materials) {
    WriteText(folder_ / "look.json", materials);
    return RunFacet({"hash", in_, "--scene", "Lit", "--size", "32x32", "--materials", folder_ / "look.json"});
  }
  const Folder folder_;
  const std::string in_ = folder_ / "in.gltf";
};

TEST_F(FacetMaterials, ChangeThePictureAndTheDescription) {
  const auto pixels = [](const Outcome& run) {
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return run.out;
  };
  const std::string before = pixels(RunFacet({"hash", in_, "--scene", "Lit", "--size", "32x32"}));
  const std::string rough =
      pixels(Hash(R"({"materials": [{"match": "*", "model": "filament", "parameters": {"roughness": 1}}]})"));
  const std::string smooth =
      pixels(Hash(R"({"materials": [{"match": "*", "model": "filament", "parameters": {"roughness": 0}}]})"));
  EXPECT_NE(before, rough);
  EXPECT_NE(rough, smooth);
}

TEST_F(FacetMaterials, OneModelForAllIsAnEntryThatInherits) {
  const auto hash = [&](const std::string& model) {
    const Outcome run = RunFacet({"hash", in_, "--scene", "Lit", "--size", "32x32", "--model", model});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return run.out;
  };
  // The description may differ: unlit materials, which the picture does not show, stay as they are.
  const auto film = [](const std::string& hashes) { return hashes.substr(0, hashes.find("description")); };
  for (const std::string model : {"lecture", "filament", "enterprise"}) {
    const std::string file = R"({"materials": [{"match": "*", "inherit": true, "model": ")" + model + "\"}]}";
    EXPECT_EQ(film(hash(model)), film(Hash(file).out));
  }
  EXPECT_NE(hash("lecture"), hash("filament"));
  const Outcome unknown = RunFacet({"hash", in_, "--model", "phong"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.err.find("lecture, filament or enterprise"), std::string::npos) << unknown.err;
}

TEST_F(FacetMaterials, WrongFilesAreOneLineWithThePlace) {
  const Outcome run = Hash(R"({"materials": [{"match": "*", "model": "lecture", "parameters": {"roughness": 2}}]})");
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_TRUE(IsOneErrorLine(run.err)) << run.err;
  EXPECT_NE(run.err.find("look.json: /materials/0/parameters/roughness: 2 is out of range"), std::string::npos);
  const Outcome missing = RunFacet({"hash", in_, "--materials", folder_ / "nowhere.json"});
  EXPECT_EQ(missing.exit_code, 3);
  EXPECT_TRUE(IsOneErrorLine(missing.err)) << missing.err;
}

TEST_F(FacetMaterials, StandInThePictureForVerify) {
  WriteText(folder_ / "look.json", R"({"materials": [{"match": "*", "model": "lecture"}]})");
  const std::string out = folder_ / "out.png";
  const Outcome drawn =
      RunFacet({"render", in_, "-o", out, "--scene", "Lit", "--size", "32x32", "--materials", folder_ / "look.json"});
  ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
  EXPECT_EQ(RunFacet({"verify", out, in_}).exit_code, 0) << "the file of that name beside the scene";
  WriteText(folder_ / "other.json", R"({"materials": [{"match": "*", "model": "filament"}]})");
  EXPECT_EQ(RunFacet({"verify", out, in_, "--materials", folder_ / "other.json"}).exit_code, 1);
}

}  // namespace
}  // namespace facet::test
