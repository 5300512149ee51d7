// facet explain, and the option --without.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "base/input_file.h"
#include "cli/program.h"
#include "cli/tiny_scene.h"
#include "facet/settings.h"
#include "image/codec.h"

namespace facet::test {
namespace {

const std::string kScenes = std::string(FACET_SOURCE_DIR) + "/assets/scenes/";

std::set<std::string> Words(const nlohmann::json& list, const char* key) {
  std::set<std::string> words;
  for (const nlohmann::json& item : list) words.insert(item[key].get<std::string>());
  return words;
}

TEST(FacetExplain, JsonSaysWhatTheSceneHas) {
  const Outcome run = RunFacet({"explain", kScenes + "showcase.glb", "--size", "48x48", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  const nlohmann::json json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["scene"], "showcase.glb");
  EXPECT_EQ(json["width"], 48);
  EXPECT_EQ(json["environment"]["picture"], "studio");

  // What facet info says is in the file.
  const nlohmann::json info = nlohmann::json::parse(RunFacet({"info", kScenes + "showcase.glb", "--json"}).out);
  std::uint64_t triangles = 0;
  for (const nlohmann::json& material : json["materials"]) triangles += material["triangles"].get<std::uint64_t>();
  EXPECT_EQ(triangles, json["geometry"]["triangles_in"].get<std::uint64_t>());
  EXPECT_FALSE(json["textures"].empty());
  std::size_t bytes = 0;
  for (const nlohmann::json& texture : json["textures"]) bytes += texture["bytes"].get<std::size_t>();
  EXPECT_GT(bytes, 0u);
  EXPECT_EQ(json["punctual_lights"]["directional"].get<int>() + json["punctual_lights"]["point"].get<int>() +
                json["punctual_lights"]["spot"].get<int>(),
            int(info["lights"].size()));

  // A feature is either kept and has a cost, or is left out and has a reason.
  const std::set<std::string> kept = Words(json["costs"], "feature"), out = Words(json["disabled"], "what");
  const std::vector<std::pair<std::string, std::string>> names = {
      {"base-color-texture", "base colour textures"},
      {"metallic-roughness-texture", "metallic-roughness textures"},
      {"normal-texture", "normal textures"},
      {"occlusion", "occlusion textures"},
      {"emission", "emission"},
      {"vertex-colors", "vertex colours"},
      {"environment-light", "environment light"},
      {"punctual-lights", "punctual lights"},
      {"alpha-test", "alpha test"},
      {"blending", "blending"},
      {"skins", "skins"},
      {"morph-targets", "morph targets"},
      {"background", "environment background"},
      {"multisampling", "multisampling"},
  };
  for (const auto& [word, what] : names) EXPECT_NE(kept.contains(word), out.contains(what)) << word;
  EXPECT_TRUE(kept.contains("base-color-texture"));
  EXPECT_TRUE(out.contains("skins"));
  EXPECT_EQ(kept.size(), json["costs"].size()) << "two costs have one name";
  for (const nlohmann::json& cost : json["costs"]) {
    EXPECT_GE(cost["pairs"], 5);
    EXPECT_LE(cost["seconds_low"], cost["seconds_high"]);
  }
}

TEST(FacetExplain, TextHasASectionForEach) {
  const Outcome run = RunFacet({"explain", kScenes + "animated.glb", "--size", "32x32", "--animation", "0"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const char* part : {"animated.glb, 32x32", "Geometry", "Materials", "Light", "Disabled", "The first frame",
                           "A later frame takes", "--without skins", "--samples 1"}) {
    EXPECT_NE(run.out.find(part), std::string::npos) << part << "\n" << run.out;
  }
}

TEST(FacetExplain, ErrorsAreThoseOfTheOtherCommands) {
  const Folder folder;
  const std::string in = folder / "in.gltf", broken = folder / "broken.gltf";
  WriteText(in, TinyScene());
  WriteText(broken, TinyScene().substr(0, 300));
  const std::vector<std::pair<std::vector<std::string>, int>> cases = {
      {{"explain"}, 2},
      {{"explain", in, "--jsn"}, 2},
      {{"explain", in, "--camera", "Nobody"}, 2},
      {{"explain", folder / "none.glb"}, 3},
      {{"explain", broken}, 4},
  };
  for (const auto& [arguments, code] : cases) {
    const Outcome run = RunFacet(arguments);
    EXPECT_EQ(run.exit_code, code) << run.err;
    EXPECT_TRUE(IsOneErrorLine(run.err)) << run.err;
    EXPECT_EQ(run.out, "");
  }
}

// --- Leaving out ----------------------------------------------------------------------------------------------------

TEST(FacetWithout, UnknownWordsAreAnsweredWithTheList) {
  const Folder folder;
  const std::string in = folder / "in.gltf";
  WriteText(in, TinyScene());
  for (const char* list : {"normals", "skins,", ",skins", "skins, blending", "Skins", "", "none,skins"}) {
    const Outcome run = RunFacet({"render", in, "-o", folder / "out.png", "--without", list});
    EXPECT_EQ(run.exit_code, 2) << list;
    EXPECT_TRUE(IsOneErrorLine(run.err)) << run.err;
    if (*list == '\0') continue;  // an option without a value
    EXPECT_NE(run.err.find("--without"), std::string::npos) << run.err;
    for (const FeatureWord& known : kFeatureWords) {
      EXPECT_NE(run.err.find(known.word), std::string::npos) << known.word << ": " << run.err;
    }
  }
}

TEST(FacetWithout, IsPartOfAPicturesSettings) {
  const Folder folder;
  const std::string scene = kScenes + "animated.glb", picture = folder / "out.png", whole = folder / "whole.png";
  const std::string list = "skins,environment-light";
  ASSERT_EQ(RunFacet({"render", scene, "-o", whole, "--size", "32x32"}).exit_code, 0);
  ASSERT_EQ(RunFacet({"render", scene, "-o", picture, "--size", "32x32", "--without", list}).exit_code, 0);
  const auto settings_of = [](const std::string& png) {
    return nlohmann::json::parse(ReadImageText(ReadFile(png).Span(), "picture").at("facet:settings"));
  };
  EXPECT_EQ(settings_of(whole)["without"], "none");
  EXPECT_EQ(settings_of(picture)["without"], list);
  EXPECT_EQ(RunFacet({"diff", picture, whole, "--max-difference", "0"}).exit_code, 1);
  EXPECT_EQ(RunFacet({"verify", picture, scene}).exit_code, 0);

  // In a manifest an entry may take back what all of them do without.
  const std::string manifest = folder / "goldens.json";
  const auto entry = [&](const std::string& name, const std::string& own, const std::string& expected) {
    return R"({"name": ")" + name + R"(", "scene": ")" + scene + R"(", "settings": {)" + own +
           R"(}, "expect": {"picture": ")" + expected + R"(", "max-difference": 0}})";
  };
  WriteText(manifest, R"({"version": 1, "settings": {"size": "32x32", "without": ")" + list + R"("}, "entries": [)" +
                          entry("less", "", picture) + "," + entry("whole", R"("without": "none")", whole) + "]}");
  const Outcome check = RunFacet({"check", manifest, "--root", "/"});
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
}

}  // namespace
}  // namespace facet::test
