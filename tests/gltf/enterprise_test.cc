// Materials that state parameters of DSPBR: in extensions, in extras, and in the files of its validation suite.
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "facet/models.h"
#include "gltf/enterprise.h"
#include "gltf/extensions.h"
#include "gltf_files.h"
#include "material/parameters.h"

namespace facet {
namespace {

using testing::CorpusPath;
using testing::LoadBytes;
using testing::TempFolder;

LoadedScene LoadMaterial(const std::string& members, const std::string& root = {}) {
  return LoadBytes(R"({"asset":{"version":"2.0"},)" + root + R"("materials":[{)" + members + "}]}");
}

EnterpriseParameters ParametersOf(const LoadedScene& loaded) {
  const Material& material = loaded.scene.materials.at(0);
  EXPECT_EQ(material.model, ShadingModel::Enterprise);
  return material.parameters != nullptr ? std::get<EnterpriseParameters>(*material.parameters) : EnterpriseParameters();
}

TEST(EnterpriseGltf, ItsExtensionsAreSupported) {
  for (const std::string_view name : gltf::kEnterpriseExtensions) EXPECT_TRUE(gltf::IsSupported(std::string(name)));
  EXPECT_FALSE(gltf::IsSupported("3DS_materials"));
  const LoadedScene loaded =
      LoadMaterial(R"("extensions":{"3DS_materials_emission":{}})", R"("extensionsUsed":["3DS_materials_emission"],)");
  ASSERT_EQ(loaded.report.extensions.size(), 1u);
  EXPECT_TRUE(loaded.report.extensions[0].supported);
}

TEST(EnterpriseGltf, OtherMaterialsStayGltfs) {
  for (const char* members : {"", R"("extras":{"roughness":1})", R"("extras":{"3DS_materials":{}})",
                              R"("extensions":{"KHR_materials_ior":{"ior":1.2}})"}) {
    const LoadedScene loaded = LoadMaterial(members);
    EXPECT_EQ(loaded.scene.materials.at(0).model, ShadingModel::MetallicRoughness) << members;
    EXPECT_EQ(loaded.scene.materials.at(0).parameters, nullptr) << members;
  }
}

TEST(EnterpriseGltf, MisspeltPropertiesAreSaid) {
  const LoadedScene loaded = LoadMaterial(R"("extensions":{"3DS_materials_translucency":{"translucency":0.5}})");
  const auto& warnings = loaded.report.warnings;
  EXPECT_TRUE(std::ranges::any_of(warnings, [](const std::string& warning) {
    return warning.find(
               "3DS_materials_translucency.translucency: ignored: 3DS_materials_translucency has no such "
               "property, but translucencyFactor, translucencyTexture") != std::string::npos;
  })) << ::testing::PrintToString(warnings);
}

TEST(EnterpriseGltf, CoreAndKhronosParametersAreMapped) {
  const LoadedScene loaded = LoadMaterial(
      R"("name":"m","doubleSided":true,"alphaMode":"BLEND","emissiveFactor":[0.5,0.25,0],
      "pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.3,0.4],"metallicFactor":0.25,"roughnessFactor":0.75},
      "extensions":{"3DS_materials_translucency":{"translucencyFactor":0.5},
      "3DS_materials_anisotropy":{"anisotropyFactor":0.6,"anisotropyRotationFactor":0.125},
      "3DS_materials_sss":{"subsurfaceColor":[0.9,0.8,0.7],"subsurfaceAsymmetry":-0.5},
      "KHR_materials_clearcoat":{"clearcoatFactor":0.3,"clearcoatRoughnessFactor":0.2},
      "KHR_materials_transmission":{"transmissionFactor":0.7},"KHR_materials_ior":{"ior":1.7},
      "KHR_materials_specular":{"specularFactor":0.8,"specularColorFactor":[1,0.5,2]},
      "KHR_materials_volume":{"thicknessFactor":0.1,"attenuationDistance":3,"attenuationColor":[0.5,1,1]},
      "KHR_materials_dispersion":{"dispersion":0.5},"KHR_materials_emissive_strength":{"emissiveStrength":2},
      "KHR_materials_iridescence":{"iridescenceFactor":0.9,"iridescenceThicknessMaximum":500},
      "KHR_materials_sheen":{"sheenColorFactor":[0.1,0.2,0.3],"sheenRoughnessFactor":0.4}})");
  // Tests of other extensions say that those that are not listed give a warning.
  int lost = 0;
  for (const std::string& warning : loaded.report.warnings) {
    if (warning.find("does not have a specular colour above 1") != std::string::npos) {
      ++lost;
    } else {
      EXPECT_NE(warning.find("extensionsUsed"), std::string::npos) << warning;
    }
  }
  EXPECT_EQ(lost, 1);
  const Material& material = loaded.scene.materials.at(0);
  EXPECT_EQ(material.name, "m");
  EXPECT_TRUE(material.double_sided);
  EXPECT_EQ(material.alpha_mode, AlphaMode::Blend);
  const EnterpriseParameters p = ParametersOf(loaded);
  EXPECT_EQ(p.albedo.value, glm::vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(p.cutout_opacity.value, 0.4f);
  EXPECT_EQ(p.metallic.value, 0.25f);
  EXPECT_EQ(p.roughness.value, 0.75f);
  EXPECT_EQ(p.translucency.value, 0.5f);
  EXPECT_EQ(p.profile, EnterpriseProfile::V2022x);
  EXPECT_EQ(p.anisotropy.value, 0.6f);
  EXPECT_EQ(p.anisotropy_rotation.value, 0.125f);
  EXPECT_EQ(p.subsurface_color, glm::vec3(0.9f, 0.8f, 0.7f));
  EXPECT_EQ(p.subsurface_anisotropy, -0.5f);
  EXPECT_EQ(p.clearcoat.value, 0.3f);
  EXPECT_EQ(p.clearcoat_roughness.value, 0.2f);
  EXPECT_EQ(p.transparency.value, 0.7f);
  EXPECT_EQ(p.ior, 1.7f);
  EXPECT_EQ(p.specular.value, 0.8f);
  EXPECT_EQ(p.specular_tint.value, glm::vec3(1.0f, 0.5f, 1.0f));
  EXPECT_FALSE(p.thin_walled);
  EXPECT_EQ(p.thickness, 0.1f);
  EXPECT_EQ(p.attenuation_distance, 3.0f);
  EXPECT_EQ(p.attenuation_color, glm::vec3(0.5f, 1.0f, 1.0f));
  EXPECT_EQ(p.abbe_number, 40.0f);
  EXPECT_EQ(p.thin_film.value, 0.9f);
  EXPECT_EQ(p.thin_film_thickness.value, 0.5f);
  EXPECT_EQ(p.sheen_color.value, glm::vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(p.sheen_roughness.value, 0.4f);
  EXPECT_EQ(p.emission_color.value, glm::vec3(0.5f, 0.25f, 0.0f));
  EXPECT_NEAR(p.emission_value, 2.0f * 3.14159265f, 1e-5f) << "glTF states radiance";
}

TEST(EnterpriseGltf, EmissionAndItsModes) {
  const EnterpriseParameters p = ParametersOf(LoadMaterial(
      R"("emissiveFactor":[1,0.5,0.25],"extensions":{"3DS_materials_emission":{"emissionValue":800,
      "emissionMode":"LUMINOUS_POWER","emissionEnergyNormalization":true}})"));
  EXPECT_EQ(p.emission_value, 800.0f);
  EXPECT_EQ(p.emission_mode, EnterpriseEmissionMode::LuminousPower);
  EXPECT_TRUE(p.emission_energy_normalization);
  EXPECT_EQ(p.emission_color.value, glm::vec3(1.0f, 0.5f, 0.25f));
  EXPECT_EQ(p.sheen_roughness.value, 0.5f) << "the default of DSPBR";
}

TEST(EnterpriseGltf, ExtrasCountAsExtensions) {
  const LoadedScene loaded = LoadMaterial(
      R"("extras":{"3DS_materials_translucency":{"translucencyFactor":0.25},"3DS_materials_other":3,"mine":null},
      "extensions":{"3DS_materials_translucency":{"translucencyFactor":0.75}})");
  EXPECT_EQ(ParametersOf(loaded).translucency.value, 0.75f) << "the extension wins";
  EXPECT_EQ(
      ParametersOf(LoadMaterial(R"("extras":{"3DS_materials_sss":{"subsurfaceColor":[1,1,1]}})")).subsurface_color,
      glm::vec3(1.0f));
}

TEST(EnterpriseGltf, ParametersByTheirOwnNames) {
  const LoadedScene loaded = LoadMaterial(
      R"("extensions":{"3DS_materials_enterprise_pbr":{"albedo":[0.5,0.25,0.125],"flakeCoverage":0.5,"flakeSize":2,
      "emissionMode":"POWER","thinWalled":false,"ior":0.5,"thinFilmIor":9,"displacement":[0,0,1]}})");
  const EnterpriseParameters p = ParametersOf(loaded);
  EXPECT_EQ(p.albedo.value, glm::vec3(0.5f, 0.25f, 0.125f));
  EXPECT_EQ(p.flake_coverage.value, 0.5f);
  EXPECT_EQ(p.flake_size.value, 2.0f);
  EXPECT_EQ(p.emission_mode, EnterpriseEmissionMode::LuminousPower);
  EXPECT_FALSE(p.thin_walled);
  EXPECT_EQ(p.ior, 1.0f);
  EXPECT_EQ(p.thin_film_ior, 2.5f);
  EXPECT_EQ(loaded.report.warnings.size(), 3u) << "two numbers out of range, and displacement";
}

TEST(EnterpriseGltf, StatedCoverageBlends) {
  const auto mode = [](const std::string& members, const std::string& stated) {
    const std::string group = R"("extensions":{"3DS_materials_enterprise_pbr":{)" + stated + "}}";
    return LoadMaterial(members + group).scene.materials.at(0).alpha_mode;
  };
  EXPECT_EQ(mode("", R"("cutoutOpacity":0.5)"), AlphaMode::Blend);
  EXPECT_EQ(mode(R"("alphaMode":"MASK",)", R"("cutoutOpacity":0.5)"), AlphaMode::Mask);
  EXPECT_EQ(mode(R"("alphaMode":"OPAQUE",)", R"("cutoutOpacity":0.5)"), AlphaMode::Opaque);
  EXPECT_EQ(mode("", R"("roughness":0.5)"), AlphaMode::Opaque);
}

TEST(EnterpriseGltf, ExtremesOfKhronosParameters) {
  const auto load = [](const std::string& extension, const std::string& stated) {
    return ParametersOf(
        LoadMaterial(R"("extensions":{"3DS_materials_sss":{},")" + extension + R"(":{)" + stated + "}}"));
  };
  const EnterpriseParameters mirror = load("KHR_materials_ior", R"("ior":0)");
  Material material;
  material.model = ShadingModel::Enterprise;
  material.parameters = std::make_shared<const ModelParameters>(mirror);
  EXPECT_EQ(FactorsOf(material).dielectric_f0, 1.0f) << "as glTF's index of 0 has it";
  EXPECT_EQ(load("KHR_materials_ior", R"("ior":1)").ior, 1.0f);
  EXPECT_EQ(load("KHR_materials_dispersion", R"("dispersion":1e-38)").abbe_number, std::numeric_limits<float>::max());
  EXPECT_EQ(load("KHR_materials_dispersion", R"("dispersion":0)").abbe_number, 0.0f);
}

TEST(EnterpriseGltf, TexturesScaleWhatTheyShould) {
  const LoadedScene loaded = LoadMaterial(
      R"("pbrMetallicRoughness":{"baseColorTexture":{"index":1},"metallicRoughnessTexture":{"index":0}},
      "normalTexture":{"index":2,"scale":0.5},"alphaMode":"MASK","extensions":{"3DS_materials_anisotropy":
      {"ansiotropyFactor":1,"anisotropyTexture":{"index":3,"texCoord":1}},"3DS_materials_translucency":
      {"translucencyFactor":1,"translucencyTexture":{"index":4}}})",
      R"("images":[{"uri":"data:image/png;base64,AAAA"}],
      "textures":[{"source":0},{"source":0},{"source":0},{"source":0},{"source":0}],)");
  const EnterpriseParameters p = ParametersOf(loaded);
  EXPECT_EQ(p.albedo.texture.texture, 1);
  EXPECT_EQ(p.cutout_opacity.texture.texture, 1);
  EXPECT_EQ(p.cutout_opacity.channel, 3);
  EXPECT_EQ(p.metallic.channel, 2);
  EXPECT_EQ(p.roughness.channel, 1);
  EXPECT_EQ(p.normal.texture.texture, 2);
  EXPECT_EQ(p.normal.scale, 0.5f);
  EXPECT_EQ(p.anisotropy.value, 1.0f) << "as the schema of the draft spells it";
  EXPECT_EQ(p.anisotropy.texture.tex_coord, 1);
  EXPECT_EQ(p.anisotropy_rotation.channel, 1);
  EXPECT_EQ(p.translucency.texture.texture, 4);
}

// The corpus has three files of the suite without their buffers. Their materials are read; one of their trees of nodes
// is none, because two nodes have the same child.
TEST(EnterpriseGltf, MaterialsOfTheValidationSuite) {
  const std::filesystem::path folder = CorpusPath() / "enterprise-pbr" / "scenes";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "the corpus is not at " << folder.string();
  int enterprise = 0, files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".gltf") continue;
    std::ifstream file(entry.path());
    auto json = nlohmann::json::parse(file);
    for (const char* geometry : {"scene", "scenes", "nodes", "meshes", "accessors", "bufferViews", "buffers"}) {
      json.erase(geometry);
    }
    const TempFolder temporary;
    const LoadedScene loaded = LoadGltf(temporary.Write("scene.gltf", json.dump()));
    ++files;
    for (const Material& material : loaded.scene.materials) {
      if (material.model != ShadingModel::Enterprise) continue;
      ++enterprise;
      const auto& p = std::get<EnterpriseParameters>(*material.parameters);
      EXPECT_EQ(p.translucency.value, 1.0f);
      EXPECT_EQ(p.metallic.value, 0.0f);
    }
  }
  EXPECT_EQ(files, 3);
  EXPECT_EQ(enterprise, 1);
}

}  // namespace
}  // namespace facet
