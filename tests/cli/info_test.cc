// What `facet info` says.
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "cli/tiny_scene.h"

namespace facet::test {
namespace {

std::filesystem::path Corpus() {
  const char* given = std::getenv("FACET_CORPUS");
  return given != nullptr ? std::filesystem::path(given) : std::filesystem::path(FACET_SOURCE_DIR) / "../shared/corpus";
}

nlohmann::json Info(const std::string& path) {
  const Outcome run = RunFacet({"info", path, "--json"});
  EXPECT_EQ(run.exit_code, 0) << path << ": " << run.err;
  EXPECT_EQ(run.err, "") << path;
  return run.exit_code == 0 ? nlohmann::json::parse(run.out) : nlohmann::json();
}

TEST(FacetInfo, JsonHoldsWhatTheFileHolds) {
  const Folder folder;
  const std::string in = folder / "in.gltf";
  WriteText(in, TinyScene(R"("extensionsUsed": ["KHR_materials_unlit", "KHR_materials_variants", "ABC_unheard_of"],
                             "extensionsRequired": ["ABC_unheard_of"],)"));
  const nlohmann::json info = Info(in);
  EXPECT_EQ(info.at("asset").at("version"), "2.0");
  EXPECT_EQ(info.at("asset").at("generator"), "facet's tests");
  EXPECT_EQ(info.at("nodes"), 5);
  EXPECT_EQ(info.at("geometry").at("triangles"), 4);
  EXPECT_EQ(info.at("geometry").at("vertices"), 8);
  ASSERT_EQ(info.at("scenes").size(), 3u);
  EXPECT_EQ(info.at("default_scene"), 0);
  EXPECT_EQ(info.at("scenes")[0].at("name"), "Main");
  EXPECT_EQ(info.at("scenes")[0].at("nodes"), 3);
  EXPECT_EQ(info.at("scenes")[0].at("drawn").at("triangles"), 2);
  EXPECT_EQ(info.at("scenes")[0].at("bounds").at("high"), (nlohmann::json{1.0, 1.0, 0.0}));
  EXPECT_EQ(info.at("scenes")[1].at("bounds").at("low"), (nlohmann::json{-0.25, -0.25, 0.0}));
  ASSERT_EQ(info.at("meshes").size(), 2u);
  EXPECT_EQ(info.at("meshes")[0].at("normals"), false);
  ASSERT_EQ(info.at("materials").size(), 3u);
  EXPECT_EQ(info.at("materials")[0].at("name"), "Red");
  EXPECT_EQ(info.at("materials")[0].at("unlit"), true);
  EXPECT_EQ(info.at("materials")[0].at("model"), "unlit");
  EXPECT_EQ(info.at("materials")[1].at("primitives"), 1) << "used by a variant";
  EXPECT_EQ(info.at("materials")[2].at("double_sided"), true);
  EXPECT_EQ(info.at("materials")[2].at("metallic_factor"), 0.0);
  ASSERT_EQ(info.at("cameras").size(), 2u);
  EXPECT_EQ(info.at("cameras")[0].at("type"), "perspective");
  EXPECT_EQ(info.at("cameras")[1].at("xmag"), 4.0);
  ASSERT_EQ(info.at("animations").size(), 1u);
  EXPECT_EQ(info.at("animations")[0].at("duration"), 1.0);
  EXPECT_EQ(info.at("animations")[0].at("translations"), 1);
  EXPECT_EQ(info.at("variants"), (nlohmann::json{"Plain", "Blue"}));
  ASSERT_EQ(info.at("extensions").size(), 3u);
  EXPECT_EQ(info.at("extensions")[0].at("name"), "ABC_unheard_of");
  EXPECT_EQ(info.at("extensions")[0].at("required"), true);
  EXPECT_EQ(info.at("extensions")[0].at("supported"), false);
  EXPECT_EQ(info.at("extensions")[1].at("supported"), true);
}

TEST(FacetInfo, TextNamesEverything) {
  const Folder folder;
  const std::string in = folder / "in.gltf";
  WriteText(in, TinyScene(R"("extensionsUsed": ["ABC_unheard_of"], "extensionsRequired": ["ABC_unheard_of"],)"));
  const Outcome run = RunFacet({"info", in});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const char* word : {"glTF 2.0", "Main", "Small", "4 triangles", "Red", "unlit", "double-sided", "Front", "Flat",
                           "orthographic", "Slide", "1 s", "Blue", "ABC_unheard_of", "NOT SUPPORTED"}) {
    EXPECT_NE(run.out.find(word), std::string::npos) << word << " is missing in\n" << run.out;
  }
}

// A file with these materials and no geometry.
std::string WithMaterials(const char* materials) {
  return std::string(R"({"asset": {"version": "2.0"}, "images": [{"uri": "data:image/png;base64,AAAA"}],
      "textures": [{"source": 0}], "materials": [)") +
         materials + "]}";
}

std::vector<std::string> Keys(const nlohmann::json& object) {
  std::vector<std::string> keys;
  for (const auto& item : object.items()) keys.push_back(item.key());
  return keys;
}

const std::vector<std::string> kKeysOfEveryMaterial = {"alpha_cutoff",
                                                       "alpha_mode",
                                                       "base_color_factor",
                                                       "double_sided",
                                                       "emissive_factor",
                                                       "emissive_strength",
                                                       "metallic_factor",
                                                       "model",
                                                       "name",
                                                       "primitives",
                                                       "roughness_factor",
                                                       "textures",
                                                       "unlit"};

TEST(FacetInfo, JsonStatesParametersThatAreNotTheDefaults) {
  const Folder folder;
  const std::string in = folder / "in.gltf";
  WriteText(in, WithMaterials(R"(
      {}, {"normalTexture": {"index": 0, "scale": 0.5}, "occlusionTexture": {"index": 0, "strength": 0.25}},
      {"extensions": {
        "KHR_materials_clearcoat": {"clearcoatFactor": 0.5, "clearcoatRoughnessFactor": 0.25,
                                    "clearcoatNormalTexture": {"index": 0, "scale": 2}},
        "KHR_materials_sheen": {"sheenColorFactor": [1, 0.5, 0.25], "sheenRoughnessFactor": 0},
        "KHR_materials_specular": {"specularFactor": 0.5, "specularColorFactor": [2, 1, 0.5]},
        "KHR_materials_ior": {"ior": 1.25}, "KHR_materials_dispersion": {"dispersion": 0.125},
        "KHR_materials_transmission": {"transmissionFactor": 0.75},
        "KHR_materials_volume": {"thicknessFactor": 3, "attenuationDistance": 0.5, "attenuationColor": [1, 0.5, 0]},
        "KHR_materials_diffuse_transmission": {"diffuseTransmissionFactor": 0.5,
                                               "diffuseTransmissionColorFactor": [0, 0.5, 1]},
        "KHR_materials_iridescence": {"iridescenceFactor": 1, "iridescenceIor": 1.5,
                                      "iridescenceThicknessMinimum": 50, "iridescenceThicknessMaximum": 550},
        "KHR_materials_anisotropy": {"anisotropyStrength": 0.5, "anisotropyRotation": -1,
                                     "anisotropyTexture": {"index": 0}}}},
      {"extensions": {"KHR_materials_pbrSpecularGlossiness": {
        "diffuseFactor": [0.5, 0.25, 0, 1], "specularFactor": [0.5, 0.25, 0], "glossinessFactor": 0.5}}})"));
  const nlohmann::json materials = Info(in).at("materials");
  EXPECT_EQ(Keys(materials[0]), kKeysOfEveryMaterial);
  EXPECT_EQ(materials[0].at("base_color_factor"), (nlohmann::json{1.0, 1.0, 1.0, 1.0}));

  // What a material states beyond the keys of every one.
  const auto stated = [](nlohmann::json material) {
    for (const std::string& key : kKeysOfEveryMaterial) material.erase(key);
    return material;
  };
  EXPECT_EQ(stated(materials[1]), (nlohmann::json{{"normal_scale", 0.5}, {"occlusion_strength", 0.25}}));
  EXPECT_EQ(stated(materials[2]), (nlohmann::json{{"clearcoat_factor", 0.5},
                                                  {"clearcoat_roughness_factor", 0.25},
                                                  {"clearcoat_normal_scale", 2.0},
                                                  {"sheen_color_factor", {1.0, 0.5, 0.25}},
                                                  {"specular_factor", 0.5},
                                                  {"specular_color_factor", {2.0, 1.0, 0.5}},
                                                  {"ior", 1.25},
                                                  {"dispersion", 0.125},
                                                  {"transmission_factor", 0.75},
                                                  {"thickness_factor", 3.0},
                                                  {"attenuation_distance", 0.5},
                                                  {"attenuation_color", {1.0, 0.5, 0.0}},
                                                  {"diffuse_transmission_factor", 0.5},
                                                  {"diffuse_transmission_color_factor", {0.0, 0.5, 1.0}},
                                                  {"iridescence_factor", 1.0},
                                                  {"iridescence_ior", 1.5},
                                                  {"iridescence_thickness_minimum", 50.0},
                                                  {"iridescence_thickness_maximum", 550.0},
                                                  {"anisotropy_strength", 0.5},
                                                  {"anisotropy_rotation", -1.0}}));
  EXPECT_EQ(Keys(materials[2].at("textures")), (std::vector<std::string>{"anisotropy", "clearcoat_normal"}));
  EXPECT_EQ(stated(materials[3]),
            (nlohmann::json{{"specular_glossiness_specular_factor", {0.5, 0.25, 0.0}}, {"glossiness_factor", 0.5}}));
  EXPECT_EQ(materials[3].at("model"), "specular-glossiness");
  EXPECT_EQ(materials[3].at("base_color_factor"), (nlohmann::json{0.5, 0.25, 0.0, 1.0}));

  const std::string human = RunFacet({"info", in}).out;
  for (const char* words :
       {"opaque, metallic 1, roughness 1; no textures; not used", "clear coat factor 0.5, clear coat roughness factor",
        "sheen colour factor 1 0.5 0.25", "specular colour factor 2 1 0.5, index of refraction 1.25",
        "attenuation distance 0.5, attenuation colour 1 0.5 0", "iridescence thickness maximum 550",
        "specular-glossiness, specular-glossiness specular factor 0.5 0.25 0, glossiness factor 0.5",
        "textures: clearcoat normal, anisotropy"}) {
    EXPECT_NE(human.find(words), std::string::npos) << words << " is missing in\n" << human;
  }
}

TEST(FacetInfo, SaysWhatAMaterialDoesNotUse) {
  const Folder folder;
  const std::string in = folder / "in.gltf";
  WriteText(in, WithMaterials(R"(
      {"extensions": {"KHR_materials_unlit": {}, "KHR_materials_ior": {"ior": 1.25},
                      "KHR_materials_clearcoat": {"clearcoatFactor": 1}}},
      {"extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 1}}},
      {"extensions": {"KHR_materials_pbrSpecularGlossiness": {}, "KHR_materials_ior": {"ior": 1.25}}})"));
  const nlohmann::json materials = Info(in).at("materials");
  EXPECT_EQ(materials[0].at("ignored"), (nlohmann::json{"clear coat", "index of refraction"}));
  EXPECT_FALSE(materials[1].contains("ignored"));
  EXPECT_EQ(materials[2].at("ignored"), (nlohmann::json{"index of refraction"}));
  const std::string human = RunFacet({"info", in}).out;
  EXPECT_NE(human.find("not used because it is unlit: clear coat, index of refraction"), std::string::npos) << human;
}

TEST(FacetInfo, PicturesAreDescribedWithoutDecoding) {
  const Folder folder;
  // The headers of a grey-and-alpha PNG of 640 x 480, and of a JPEG that ends before its size.
  const std::string images = R"("images": [
      {"name": "Wood", "uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAoAAAAHgCAQAAAA="},
      {"name": "Cut off", "uri": "data:image/jpeg;base64,/9j/4A=="},
      {"name": "Nowhere", "uri": "nowhere.png"}],)";
  const std::string in = folder / "in.gltf";
  WriteText(in, TinyScene(images));
  const nlohmann::json info = Info(in).at("images");
  ASSERT_EQ(info.size(), 3u);
  EXPECT_EQ(info[0], (nlohmann::json{{"name", "Wood"},
                                     {"source", "image 0 of in.gltf"},
                                     {"format", "PNG"},
                                     {"width", 640},
                                     {"height", 480},
                                     {"channels", 2},
                                     {"bits", 8},
                                     {"bytes", 29},
                                     {"textures", 0}}));
  EXPECT_EQ(info[1].at("format"), "JPEG");
  EXPECT_EQ(info[1].at("bytes"), 4);
  for (const char* key : {"width", "height", "channels", "bits"}) EXPECT_TRUE(info[1].at(key).is_null()) << key;
  for (const char* key : {"format", "width", "height", "channels", "bits", "bytes"}) {
    EXPECT_TRUE(info[2].at(key).is_null()) << key;
  }
  const std::string human = RunFacet({"info", in}).out;
  for (const char* words : {"PNG, 640x480, 2 x 8 bits, 29 bytes, not used", "JPEG, unknown size, 4 bytes, not used",
                            "unknown format, not used"}) {
    EXPECT_NE(human.find(words), std::string::npos) << words << " is missing in\n" << human;
  }
}

TEST(FacetInfo, NamesOfAnyLengthStayApartFromWhatFollows) {
  const Folder folder;
  const std::string in = folder / "in.gltf";
  const std::string name(60, 'n');
  for (const bool all : {true, false}) {
    std::string text = TinyScene();
    text.replace(text.find("\"name\": \"Unlit\""), 15, "\"name\": \"" + name + "\"");
    if (all) text.replace(text.find("\"name\": \"Lit\", \"prim") + 9, 3, name);
    WriteText(in, text);
    const std::string human = RunFacet({"info", in}).out;
    EXPECT_NE(human.find("  0  " + name + "  2 triangles"), std::string::npos) << human;
    EXPECT_NE(human.find(all ? "  1  " + name + "  2 triangles" : "  1  Lit  2 triangles"), std::string::npos) << human;
  }
}

TEST(FacetInfo, NamesThatAreNoUtf8StillMakeJson) {
  const Folder folder;
  const std::string in = folder / "in.gltf";
  std::string text = TinyScene();
  text.replace(text.find("Square"), 6,
               "Squ\x7f"
               "re");
  text.replace(text.find("\"Main\""), 6, "\"Ma\\n\\u0007\"");
  WriteText(in, text);
  EXPECT_EQ(Info(in).at("scenes")[0].at("name"), "Ma\n\a");
  const std::string human = RunFacet({"info", in}).out;
  EXPECT_NE(human.find("Ma\\x0a\\x07"), std::string::npos) << human;
}

TEST(FacetInfo, DamagedHelmet) {
  const std::filesystem::path folder = Corpus() / "models/DamagedHelmet";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no corpus at " << Corpus();
  std::filesystem::path file;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".glb" || extension == ".gltf") file = entry.path();
  }
  const nlohmann::json info = Info(file.string());
  EXPECT_EQ(info.at("geometry").at("triangles"), 15452);
  ASSERT_EQ(info.at("materials").size(), 1u);
  EXPECT_EQ(info.at("materials")[0].at("textures").size(), 5u);
  ASSERT_EQ(info.at("images").size(), 5u);
  for (const auto& image : info.at("images")) {
    EXPECT_EQ(image.at("format"), "JPEG");
    EXPECT_EQ(image.at("width"), 2048);
    EXPECT_EQ(image.at("height"), 2048);
    EXPECT_EQ(image.at("channels"), 3);
    EXPECT_GT(image.at("bytes"), 90000);
  }
  EXPECT_TRUE(info.at("warnings").empty());
}

TEST(FacetInfo, DescribesEveryModelOfTheCorpus) {
  if (!std::filesystem::exists(Corpus() / "models")) GTEST_SKIP() << "no corpus at " << Corpus();
  int described = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(Corpus() / "models")) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".glb" && extension != ".gltf") continue;
    const nlohmann::json info = Info(entry.path().string());
    EXPECT_TRUE(info.contains("scenes")) << entry.path();
    for (const auto& image : info.at("images")) {
      for (const char* key : {"format", "width", "height", "channels", "bits", "bytes"}) {
        EXPECT_FALSE(image.at(key).is_null()) << entry.path() << ": " << key << " of " << image;
      }
    }
    ++described;
  }
  EXPECT_GE(described, 78);
}

}  // namespace
}  // namespace facet::test
