// Every parameter of a material, in core glTF and in extensions: where it stands, what it may be, and what is read of
// those that may not be. The rows repeat what specifications say and are no copy of the loader's table.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>
#include <vector>

#include "gltf_files.h"
#include "material/parameters.h"

namespace facet {
namespace {

using nlohmann::json;
using Pointer = json::json_pointer;
using testing::LoadBytes;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
const char* const kTransform = "KHR_texture_transform";

struct Replaced {
  const char* read;  // as the file says it, and as the warning does
  float used;
  const char* said;  // in the warning
};
const std::vector<Replaced> kShare = {{"-0.25", 0.0f, "0"}, {"1.5", 1.0f, "1"}, {"1.0000001", 1.0f, "1"}};
const std::vector<Replaced> kPositive = {{"-1", 0.0f, "0"}, {"-0.001", 0.0f, "0"}};
const std::vector<Replaced> kAny;

template <class Value>
struct Row {
  const char* pointer;  // in the material
  const char* name;     // in messages
  Value Material::*member;
  Value other;                     // not the default
  std::vector<Replaced> replaced;  // for colours: of one component
};

const Row<float> kNumbers[] = {
    {"/pbrMetallicRoughness/metallicFactor", "metallic factor", &Material::metallic_factor, 0.25f, kShare},
    {"/pbrMetallicRoughness/roughnessFactor", "roughness factor", &Material::roughness_factor, 0.25f, kShare},
    {"/normalTexture/scale", "normal scale", &Material::normal_scale, -3.0f, kAny},
    {"/occlusionTexture/strength", "occlusion strength", &Material::occlusion_strength, 0.25f, kShare},
    {"/alphaCutoff", "alpha cutoff", &Material::alpha_cutoff, 2.0f, kPositive},
    {"/extensions/KHR_materials_emissive_strength/emissiveStrength", "emissive strength", &Material::emissive_strength,
     20.0f, kPositive},
    {"/extensions/KHR_materials_clearcoat/clearcoatFactor", "clear coat factor", &Material::clearcoat_factor, 0.25f,
     kShare},
    {"/extensions/KHR_materials_clearcoat/clearcoatRoughnessFactor", "clear coat roughness factor",
     &Material::clearcoat_roughness_factor, 0.25f, kShare},
    {"/extensions/KHR_materials_clearcoat/clearcoatNormalTexture/scale", "clear coat normal scale",
     &Material::clearcoat_normal_scale, -3.0f, kAny},
    {"/extensions/KHR_materials_sheen/sheenRoughnessFactor", "sheen roughness factor",
     &Material::sheen_roughness_factor, 0.25f, kShare},
    {"/extensions/KHR_materials_specular/specularFactor", "specular factor", &Material::specular_factor, 0.25f, kShare},
    // 0 means a Fresnel term of 1.
    {"/extensions/KHR_materials_ior/ior",
     "index of refraction",
     &Material::ior,
     0.0f,
     {{"0.5", 1.0f, "1"}, {"-2", 1.0f, "1"}, {"0.9999999", 1.0f, "1"}}},
    {"/extensions/KHR_materials_transmission/transmissionFactor", "transmission factor", &Material::transmission_factor,
     0.25f, kShare},
    {"/extensions/KHR_materials_volume/thicknessFactor", "thickness factor", &Material::thickness_factor, 20.0f,
     kPositive},
    // What has no distance absorbs nothing; who writes 0 means that.
    {"/extensions/KHR_materials_volume/attenuationDistance",
     "attenuation distance",
     &Material::attenuation_distance,
     1e-30f,
     {{"0", kInfinity, "inf"}, {"-1", kInfinity, "inf"}}},
    {"/extensions/KHR_materials_dispersion/dispersion", "dispersion", &Material::dispersion, 20.0f, kPositive},
    {"/extensions/KHR_materials_diffuse_transmission/diffuseTransmissionFactor", "diffuse transmission factor",
     &Material::diffuse_transmission_factor, 0.25f, kShare},
    {"/extensions/KHR_materials_iridescence/iridescenceFactor", "iridescence factor", &Material::iridescence_factor,
     0.25f, kShare},
    {"/extensions/KHR_materials_iridescence/iridescenceIor",
     "iridescence index of refraction",
     &Material::iridescence_ior,
     3.0f,
     {{"0", 1.0f, "1"}, {"0.5", 1.0f, "1"}}},
    // A minimum above the maximum is allowed: the texture mixes from one to the other.
    {"/extensions/KHR_materials_iridescence/iridescenceThicknessMinimum", "iridescence thickness minimum",
     &Material::iridescence_thickness_minimum, 900.0f, kPositive},
    {"/extensions/KHR_materials_iridescence/iridescenceThicknessMaximum", "iridescence thickness maximum",
     &Material::iridescence_thickness_maximum, 0.0f, kPositive},
    {"/extensions/KHR_materials_anisotropy/anisotropyStrength", "anisotropy strength", &Material::anisotropy_strength,
     0.25f, kShare},
    {"/extensions/KHR_materials_anisotropy/anisotropyRotation", "anisotropy rotation", &Material::anisotropy_rotation,
     -30.0f, kAny},
    {"/extensions/KHR_materials_pbrSpecularGlossiness/glossinessFactor", "glossiness factor",
     &Material::glossiness_factor, 0.25f, kShare},
};

const glm::vec3 kOrange(1.0f, 0.5f, 0.25f), kBright(4.0f, 2.0f, 0.5f);
const Row<glm::vec3> kColors[] = {
    {"/emissiveFactor", "emissive factor", &Material::emissive_factor, kBright, kPositive},
    {"/extensions/KHR_materials_sheen/sheenColorFactor", "sheen colour factor", &Material::sheen_color_factor, kOrange,
     kShare},
    {"/extensions/KHR_materials_specular/specularColorFactor", "specular colour factor",
     &Material::specular_color_factor, kBright, kPositive},
    {"/extensions/KHR_materials_volume/attenuationColor", "attenuation colour", &Material::attenuation_color, kOrange,
     kShare},
    {"/extensions/KHR_materials_diffuse_transmission/diffuseTransmissionColorFactor",
     "diffuse transmission colour factor", &Material::diffuse_transmission_color_factor, kOrange, kShare},
    {"/extensions/KHR_materials_pbrSpecularGlossiness/specularFactor", "specular-glossiness specular factor",
     &Material::specular_glossiness_specular_factor, kOrange, kShare},
};

const glm::vec4 kSheer(1.0f, 0.5f, 0.25f, 0.75f);
const Row<glm::vec4> kColorsWithAlpha[] = {
    {"/pbrMetallicRoughness/baseColorFactor", "base colour factor", &Material::base_color_factor, kSheer, kShare},
    {"/extensions/KHR_materials_pbrSpecularGlossiness/diffuseFactor", "base colour factor",
     &Material::base_color_factor, kSheer, kShare},
};

struct TextureRow {
  const char* pointer;
  TextureRef Material::*member;
};
const TextureRow kTextures[] = {
    {"/pbrMetallicRoughness/baseColorTexture", &Material::base_color_texture},
    {"/pbrMetallicRoughness/metallicRoughnessTexture", &Material::metallic_roughness_texture},
    {"/normalTexture", &Material::normal_texture},
    {"/occlusionTexture", &Material::occlusion_texture},
    {"/emissiveTexture", &Material::emissive_texture},
    {"/extensions/KHR_materials_clearcoat/clearcoatTexture", &Material::clearcoat_texture},
    {"/extensions/KHR_materials_clearcoat/clearcoatRoughnessTexture", &Material::clearcoat_roughness_texture},
    {"/extensions/KHR_materials_clearcoat/clearcoatNormalTexture", &Material::clearcoat_normal_texture},
    {"/extensions/KHR_materials_sheen/sheenColorTexture", &Material::sheen_color_texture},
    {"/extensions/KHR_materials_sheen/sheenRoughnessTexture", &Material::sheen_roughness_texture},
    {"/extensions/KHR_materials_specular/specularTexture", &Material::specular_texture},
    {"/extensions/KHR_materials_specular/specularColorTexture", &Material::specular_color_texture},
    {"/extensions/KHR_materials_transmission/transmissionTexture", &Material::transmission_texture},
    {"/extensions/KHR_materials_volume/thicknessTexture", &Material::thickness_texture},
    {"/extensions/KHR_materials_diffuse_transmission/diffuseTransmissionTexture",
     &Material::diffuse_transmission_texture},
    {"/extensions/KHR_materials_diffuse_transmission/diffuseTransmissionColorTexture",
     &Material::diffuse_transmission_color_texture},
    {"/extensions/KHR_materials_iridescence/iridescenceTexture", &Material::iridescence_texture},
    {"/extensions/KHR_materials_iridescence/iridescenceThicknessTexture", &Material::iridescence_thickness_texture},
    {"/extensions/KHR_materials_anisotropy/anisotropyTexture", &Material::anisotropy_texture},
    {"/extensions/KHR_materials_pbrSpecularGlossiness/diffuseTexture", &Material::base_color_texture},
    {"/extensions/KHR_materials_pbrSpecularGlossiness/specularGlossinessTexture",
     &Material::specular_glossiness_texture},
};

// --- Files with one material ----------------------------------------------------------------------------------------

json FileWith(const json& material) {
  json extensions = {"KHR_texture_transform"};
  for (const char* name :
       {"anisotropy", "clearcoat", "diffuse_transmission", "dispersion", "emissive_strength", "ior", "iridescence",
        "pbrSpecularGlossiness", "sheen", "specular", "transmission", "unlit", "volume"}) {
    extensions.push_back(std::string("KHR_materials_") + name);
  }
  return {{"asset", {{"version", "2.0"}}},
          {"extensionsUsed", extensions},
          {"images", {{{"uri", "data:image/png;base64,AAAA"}}}},
          {"textures", {{{"source", 0}}, {{"source", 0}}}},
          {"materials", {material}}};
}

struct Read {
  Material material;
  std::vector<std::string> warnings;
};

Read ReadText(const std::string& file) {
  const LoadedScene loaded = LoadBytes(file);
  EXPECT_NO_THROW(ValidateScene(loaded.scene)) << file;
  return {loaded.scene.materials.at(0), loaded.report.warnings};
}

Read ReadMaterial(const json& material) { return ReadText(FileWith(material).dump()); }

json With(const char* pointer, const json& value) {
  json material = json::object();
  material[Pointer(pointer)] = value;
  // What has a scale or strength has to be a texture.
  const Pointer parent = Pointer(pointer).parent_pointer();
  if (!parent.empty() && parent.back().ends_with("Texture")) material[parent]["index"] = 1;
  return material;
}

// "/normalTexture/scale" to "materials[0].normalTexture.scale".
std::string PlaceOf(std::string pointer) {
  std::replace(pointer.begin(), pointer.end(), '/', '.');
  return "materials[0]" + pointer;
}

using Lines = std::vector<std::string>;

bool AnyStartsWith(const Lines& lines, const std::string& text) {
  return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) { return line.starts_with(text); });
}

template <class Value>
json ToJson(const Value& value) {
  if constexpr (std::is_same_v<Value, float>) {
    return value;
  } else {
    json array = json::array();
    for (int c = 0; c < Value::length(); ++c) array.push_back(value[c]);
    return array;
  }
}

template <class Body>
void ForEachNumberRow(const Body& body) {
  for (const auto& row : kNumbers) body(row);
  for (const auto& row : kColors) body(row);
  for (const auto& row : kColorsWithAlpha) body(row);
}

// Whether two materials agree in all but one member.
template <class Value>
bool AgreeBut(const Material& a, const Material& b, Value Material::*member) {
  bool agree = true;
  ForEachParameter([&]<class Other>(const Parameter<Other>& parameter) {
    if constexpr (std::is_same_v<Other, Value>) {
      if (parameter.member == member) return;
    }
    if constexpr (std::is_same_v<Other, TextureRef>) {
      agree = agree && (a.*parameter.member).texture == (b.*parameter.member).texture;
    } else {
      agree = agree && a.*parameter.member == b.*parameter.member;
    }
  });
  return agree;
}

// What the file's other members make of a material without the parameter.
Material WithoutParameter(const char* pointer) {
  json material = With(pointer, 0);
  material[Pointer(pointer).parent_pointer()].erase(Pointer(pointer).back());
  return ReadMaterial(material).material;
}

// --- Tests ----------------------------------------------------------------------------------------------------------

TEST(MaterialParameters, EachHasARowHere) {
  std::set<std::string> rows = {"/alphaMode", "/doubleSided"};
  ForEachNumberRow([&](const auto& row) { rows.insert(row.pointer); });
  for (const TextureRow& row : kTextures) rows.insert(row.pointer);
  std::set<std::string> known;
  ForEachParameter([&](const auto& parameter) {
    if (parameter.gltf_name == nullptr) return;  // the shading model
    std::string group = parameter.gltf_group != nullptr ? parameter.gltf_group : "";
    std::replace(group.begin(), group.end(), '.', '/');
    if (IsExtension(group)) group = "extensions/" + group;
    known.insert((group.empty() ? "/" : "/" + group + "/") + parameter.gltf_name);
  });
  EXPECT_EQ(known, rows);
}

TEST(MaterialParameters, AreReadFromTheirPlaces) {
  ForEachNumberRow([](const auto& row) {
    SCOPED_TRACE(row.pointer);
    ASSERT_NE(Material().*row.member, row.other) << "the row shows nothing";
    const Read read = ReadMaterial(With(row.pointer, ToJson(row.other)));
    EXPECT_EQ(read.material.*row.member, row.other);
    EXPECT_EQ(read.warnings, Lines());
    EXPECT_TRUE(AgreeBut(read.material, WithoutParameter(row.pointer), row.member));
  });
}

TEST(MaterialParameters, OutOfRangeAreReplacedWithAWarningThatSaysAll) {
  for (const Row<float>& row : kNumbers) {
    for (const Replaced& replaced : row.replaced) {
      SCOPED_TRACE(std::string(row.pointer) + " = " + replaced.read);
      const Read read = ReadMaterial(With(row.pointer, json::parse(replaced.read)));
      EXPECT_EQ(read.material.*row.member, replaced.used);
      ASSERT_EQ(read.warnings.size(), 1u);
      EXPECT_TRUE(read.warnings[0].starts_with(PlaceOf(row.pointer) + ": " + row.name + " " + replaced.read))
          << read.warnings[0];
      EXPECT_TRUE(read.warnings[0].ends_with(std::string(" is out of range; ") + replaced.said + " is used"))
          << read.warnings[0];
    }
  }
  const auto colors = [](const auto& rows) {
    for (const auto& row : rows) {
      for (const Replaced& replaced : row.replaced) {
        SCOPED_TRACE(std::string(row.pointer) + " with " + replaced.read);
        for (int c = 0; c < row.other.length(); ++c) {
          json value = ToJson(row.other);
          value[std::size_t(c)] = json::parse(replaced.read);
          auto expected = row.other;
          expected[c] = replaced.used;
          const Read read = ReadMaterial(With(row.pointer, value));
          EXPECT_EQ(read.material.*row.member, expected);
          ASSERT_EQ(read.warnings.size(), 1u);
          const std::string place = PlaceOf(row.pointer) + "[" + std::to_string(c) + "]: ";
          EXPECT_TRUE(read.warnings[0].starts_with(place + row.name + " " + replaced.read)) << read.warnings[0];
        }
      }
    }
  };
  colors(kColors);
  colors(kColorsWithAlpha);
}

// Exporters repeat their mistakes: the same one in many materials is one line, whatever the values, and others stay
// apart.
TEST(MaterialParameters, TheSameMistakeIsSaidOnce) {
  json file = FileWith(With("/extensions/KHR_materials_ior/ior", 0.5));
  file["materials"].push_back(file["materials"][0]);
  file["materials"].push_back(With("/extensions/KHR_materials_ior/ior", 0.25));
  file["materials"].push_back(With("/extensions/KHR_materials_ior/ior", -1e-30));
  file["materials"].push_back(With("/extensions/KHR_materials_clearcoat/clearcoatFactor", 2));
  EXPECT_EQ(ReadText(file.dump()).warnings,
            (Lines{"materials[0].extensions.KHR_materials_ior.ior: index of refraction 0.5 is out of range; 1 is used "
                   "(and in 3 more places)",
                   "materials[4].extensions.KHR_materials_clearcoat.clearcoatFactor: clear coat factor 2 is out of "
                   "range; 1 is used"}));
}

// A name that an extension does not have is most likely misspelt.
TEST(MaterialParameters, UnknownNamesInExtensionsAreIgnoredWithAWarning) {
  json file = FileWith(With("/extensions/KHR_materials_clearcoat/clearcoatRoughnes", 0.5));
  file["materials"].push_back(file["materials"][0]);
  file["materials"].push_back(With("/extensions/KHR_materials_unlit/color", 0.5));
  json nested = With("/extensions/KHR_materials_ior/extensions/ABC_more/any", 1);
  nested["extensions"]["KHR_materials_ior"]["extras"]["any"] = 1;
  file["materials"].push_back(nested);
  file["extensionsUsed"].push_back("ABC_more");
  Lines lines = ReadText(file.dump()).warnings;
  std::erase_if(lines, [](const std::string& line) { return line.find("no such property") == line.npos; });
  EXPECT_EQ(lines, (Lines{"materials[0].extensions.KHR_materials_clearcoat.clearcoatRoughnes: ignored: "
                          "KHR_materials_clearcoat has no such property, but clearcoatFactor, clearcoatNormalTexture, "
                          "clearcoatRoughnessFactor, clearcoatRoughnessTexture, clearcoatTexture (and in 1 more place)",
                          "materials[2].extensions.KHR_materials_unlit.color: ignored: KHR_materials_unlit has no such "
                          "property, and no other"}));
}

TEST(MaterialParameters, ExtensionsThatAreNotListedAreReadWithAWarning) {
  json file = FileWith(With("/extensions/KHR_materials_ior/ior", 1.25));
  file["materials"].push_back(file["materials"][0]);
  file["materials"][1]["extensions"]["ABC_unheard_of"] = json::object();
  file["materials"][1]["extras"]["extensions"]["ABC_of_others"] = json::object();
  file.erase("extensionsUsed");
  const Read read = ReadText(file.dump());
  EXPECT_EQ(read.material.ior, 1.25f);
  EXPECT_EQ(
      read.warnings,
      (Lines{"materials[1].extensions.ABC_unheard_of: ignored: is not supported, and extensionsUsed does not list "
             "it",
             "materials[0].extensions.KHR_materials_ior: is read, although extensionsUsed does not list it (and "
             "in 1 more place)"}));
}

TEST(MaterialParameters, NumbersTooLargeForFloatsBecomeTheLargest) {
  for (const Row<float>& row : kNumbers) {
    SCOPED_TRACE(row.pointer);
    for (const char* huge : {"1e39", "1e300", "1e999"}) {
      std::string file = FileWith(With(row.pointer, 123456789)).dump();
      file.replace(file.find("123456789"), 9, huge);
      const Read read = ReadText(file);
      const bool is_share = !row.replaced.empty() && row.replaced.back().used == 1.0f && row.replaced[0].used == 0.0f;
      EXPECT_EQ(read.material.*row.member, is_share ? 1.0f : std::numeric_limits<float>::max());
    }
  }
}

TEST(MaterialParameters, OfWrongTypesAreIgnoredWithAWarning) {
  const std::vector<json> not_numbers = {json("0.5"),   json("NaN"),        json("Infinity"), json(true),
                                         json::array(), json::array({0.5}), json::object(),   json({{"value", 1}})};
  const std::vector<json> not_colors = {json("#ff8000"),
                                        json(0.5),
                                        json(true),
                                        json::object(),
                                        json::array(),
                                        json::array({0.5, 0.5}),
                                        json::array({0.5, 0.5, "NaN"}),
                                        json::array({0.5, true, 0.5}),
                                        json::array({json::array({0.5, 0.5, 0.5}), 0.5, 0.5}),
                                        json::array({"a", "b", "c", "d"})};
  ForEachNumberRow([&]<class Value>(const Row<Value>& row) {
    const Material without = WithoutParameter(row.pointer);
    for (const json& wrong : std::is_same_v<Value, float> ? not_numbers : not_colors) {
      SCOPED_TRACE(row.pointer + (" = " + wrong.dump()));
      const Read read = ReadMaterial(With(row.pointer, wrong));
      EXPECT_EQ(read.material.*row.member, Material().*row.member);
      EXPECT_TRUE(AgreeBut(read.material, without, row.member));
      EXPECT_TRUE(AnyStartsWith(read.warnings, PlaceOf(row.pointer) + ": ignored")) << json(read.warnings).dump(1);
    }
    SCOPED_TRACE(row.pointer);
    const Read null = ReadMaterial(With(row.pointer, nullptr));
    EXPECT_EQ(null.material.*row.member, Material().*row.member);
    EXPECT_EQ(null.warnings, Lines{PlaceOf(row.pointer) + ": null is read as absent"});
  });
}

TEST(MaterialParameters, OfColorsWithMoreNumbersTheFirstAreRead) {
  const auto expect = [](const auto& rows) {
    for (const auto& row : rows) {
      SCOPED_TRACE(row.pointer);
      json value = ToJson(row.other);
      value.push_back(0.125);
      value.push_back("text");
      const Read read = ReadMaterial(With(row.pointer, value));
      EXPECT_EQ(read.material.*row.member, row.other);
      ASSERT_EQ(read.warnings.size(), 1u);
      EXPECT_TRUE(read.warnings[0].ends_with("; the first are read")) << read.warnings[0];
    }
  };
  expect(kColors);
  expect(kColorsWithAlpha);
  for (const auto& row : kColorsWithAlpha) {
    EXPECT_EQ(ReadMaterial(With(row.pointer, {1, 0.5, 0.25})).material.*row.member, glm::vec4(kOrange, 1.0f))
        << "colours with alpha are often written without it";
  }
}

TEST(MaterialParameters, TexturesAreReadFromTheirPlaces) {
  for (const TextureRow& row : kTextures) {
    SCOPED_TRACE(row.pointer);
    const json plain = {{"index", 1}, {"texCoord", 3}};
    const Read read = ReadMaterial(With(row.pointer, plain));
    const TextureRef& ref = read.material.*row.member;
    EXPECT_EQ(ref.texture, 1);
    EXPECT_EQ(ref.tex_coord, 3);
    EXPECT_EQ(ref.offset, glm::vec2(0));
    EXPECT_EQ(ref.scale, glm::vec2(1));
    EXPECT_EQ(ref.rotation, 0.0f);
    EXPECT_EQ(read.warnings, Lines());
    EXPECT_TRUE(AgreeBut(read.material, WithoutParameter(row.pointer), row.member));

    json moved = plain;
    moved["extensions"][kTransform] = {{"offset", {0.5, -1}}, {"rotation", 1.5}, {"scale", {2, 3}}, {"texCoord", 1}};
    const TextureRef transformed = ReadMaterial(With(row.pointer, moved)).material.*row.member;
    EXPECT_EQ(transformed.tex_coord, 1) << "the extension's set wins";
    EXPECT_EQ(transformed.offset, glm::vec2(0.5f, -1.0f));
    EXPECT_EQ(transformed.scale, glm::vec2(2, 3));
    EXPECT_EQ(transformed.rotation, 1.5f);
  }
}

TEST(MaterialParameters, OfTexturesThatDoNotExistFactorsStay) {
  for (const TextureRow& row : kTextures) {
    for (const json& wrong :
         {json({{"index", 7}}), json({{"index", -1}}), json({{"index", "0"}}), json({{"index", 0.5}}),
          json({{"texCoord", 0}}), json::object(), json(0), json("a.png"), json::array({0})}) {
      SCOPED_TRACE(row.pointer + (" = " + wrong.dump()));
      json material = With(row.pointer, wrong);
      // All factors beside it.
      const Pointer group = Pointer(row.pointer).parent_pointer();
      ForEachNumberRow([&](const auto& factor) {
        if (Pointer(factor.pointer).parent_pointer() == group) material[Pointer(factor.pointer)] = ToJson(factor.other);
      });
      const Read read = ReadMaterial(material);
      EXPECT_FALSE(read.material.*row.member);
      EXPECT_TRUE(AnyStartsWith(read.warnings, PlaceOf(row.pointer))) << json(read.warnings).dump(1);
      ForEachNumberRow([&](const auto& factor) {
        if (Pointer(factor.pointer).parent_pointer() != group) return;
        EXPECT_EQ(read.material.*factor.member, factor.other) << factor.pointer;
      });
    }
    SCOPED_TRACE(row.pointer);
    const Read read = ReadMaterial(
        With(row.pointer,
             {{"index", 1}, {"texCoord", "first"}, {"extensions", {{kTransform, {{"scale", 2}, {"offset", {1}}}}}}}));
    EXPECT_EQ((read.material.*row.member).texture, 1);
    EXPECT_EQ((read.material.*row.member).tex_coord, 0);
    EXPECT_EQ((read.material.*row.member).scale, glm::vec2(1));
    EXPECT_EQ((read.material.*row.member).offset, glm::vec2(0));
    EXPECT_EQ(read.warnings.size(), 3u);
  }
}

TEST(MaterialParameters, ExtensionsOfWrongTypesAreIgnored) {
  std::set<std::string> extensions = {"KHR_materials_unlit"};
  ForEachParameter([&](const auto& parameter) {
    if (parameter.gltf_group == nullptr || !IsExtension(parameter.gltf_group)) return;
    const std::string group = parameter.gltf_group;
    extensions.insert(group.substr(0, group.find('.')));
  });
  EXPECT_EQ(extensions.size(), 13u);
  for (const std::string& extension : extensions) {
    for (const json& wrong : {json(1), json(true), json("yes"), json::array(), json::array({json::object()})}) {
      SCOPED_TRACE(extension + " = " + wrong.dump());
      const Read read = ReadMaterial({{"extensions", {{extension, wrong}}}});
      EXPECT_TRUE(AgreeBut<float>(read.material, Material(), nullptr));
      EXPECT_EQ(read.warnings, Lines{"materials[0].extensions." + extension + ": ignored (is not an object)"});
    }
    SCOPED_TRACE(extension);
    const Read empty = ReadMaterial({{"extensions", {{extension, json::object()}}}});
    EXPECT_EQ(empty.warnings, Lines());
    Material expected;
    expected.model = extension == "KHR_materials_unlit"                   ? ShadingModel::Unlit
                     : extension == "KHR_materials_pbrSpecularGlossiness" ? ShadingModel::SpecularGlossiness
                                                                          : ShadingModel::MetallicRoughness;
    EXPECT_TRUE(AgreeBut<float>(empty.material, expected, nullptr)) << "an extension without members has its defaults";
  }
  EXPECT_EQ(ReadMaterial({{"extensions", 5}}).warnings, Lines{"materials[0].extensions: ignored (is not an object)"});
}

// The older model states its own base colour, and what stands in pbrMetallicRoughness is for other viewers. Unlit
// materials have the base colour of pbrMetallicRoughness.
TEST(MaterialParameters, TheOlderModelWinsOverMetallicRoughnessAndUnlitOverBoth) {
  const json both = {
      {"pbrMetallicRoughness",
       {{"baseColorFactor", {0, 0, 1, 1}}, {"baseColorTexture", {{"index", 0}}}, {"metallicFactor", 0.5}}},
      {"extensions",
       {{"KHR_materials_pbrSpecularGlossiness",
         {{"diffuseFactor", {1, 0, 0, 0.5}}, {"diffuseTexture", {{"index", 1}}}, {"glossinessFactor", 0.25}}}}}};
  const Read older = ReadMaterial(both);
  EXPECT_EQ(older.warnings, Lines());
  EXPECT_EQ(older.material.model, ShadingModel::SpecularGlossiness);
  EXPECT_EQ(older.material.base_color_factor, glm::vec4(1, 0, 0, 0.5f));
  EXPECT_EQ(older.material.base_color_texture.texture, 1);
  EXPECT_EQ(older.material.metallic_factor, 1.0f);
  EXPECT_EQ(older.material.glossiness_factor, 0.25f);

  json without_texture = both;
  without_texture["extensions"]["KHR_materials_pbrSpecularGlossiness"].erase("diffuseTexture");
  EXPECT_FALSE(ReadMaterial(without_texture).material.base_color_texture) << "nothing is mixed";

  json unlit = both;
  unlit["extensions"]["KHR_materials_unlit"] = json::object();
  const Read shown = ReadMaterial(unlit);
  EXPECT_EQ(shown.material.model, ShadingModel::Unlit);
  EXPECT_EQ(shown.material.base_color_factor, glm::vec4(0, 0, 1, 1));
  EXPECT_EQ(shown.material.base_color_texture.texture, 0);

  json broken = both;
  broken["extensions"]["KHR_materials_pbrSpecularGlossiness"] = true;
  const Read fallback = ReadMaterial(broken);
  EXPECT_EQ(fallback.material.model, ShadingModel::MetallicRoughness);
  EXPECT_EQ(fallback.material.base_color_factor, glm::vec4(0, 0, 1, 1));
  EXPECT_EQ(fallback.material.metallic_factor, 0.5f);
  unlit["extensions"]["KHR_materials_unlit"] = true;
  EXPECT_EQ(ReadMaterial(unlit).material.model, ShadingModel::SpecularGlossiness);
}

}  // namespace
}  // namespace facet
