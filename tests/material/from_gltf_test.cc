// What glTF's materials become in other models.
#include "material/from_gltf.h"

#include <gtest/gtest.h>

#include <cmath>

#include "material/models/models.h"

namespace facet {
namespace {

Material Painted() {
  Material m;
  m.base_color_factor = {0.5f, 0.25f, 0.125f, 0.75f};
  m.metallic_factor = 0.25f;
  m.roughness_factor = 0.5f;
  m.emissive_factor = {1.0f, 0.5f, 0.25f};
  m.emissive_strength = 4.0f;
  return m;
}

template <class Block>
Block As(const Material& m, ShadingModel model, std::size_t lost = 0) {
  const FromGltf converted = ConvertFromGltf(m, model);
  EXPECT_EQ(converted.lost.size(), lost) << testing::PrintToString(converted.lost);
  return std::get<Block>(converted.parameters);
}

TEST(FromGltf, KeepsCoreMaterialsInEveryModel) {
  const Material m = Painted();
  const auto lecture = As<LectureParameters>(m, ShadingModel::Lecture);
  EXPECT_EQ(lecture.albedo.value, m.base_color_factor);
  EXPECT_EQ(lecture.metalness.value, 0.25f);
  EXPECT_EQ(lecture.roughness.value, 0.5f);
  EXPECT_FLOAT_EQ(lecture.f0, 0.04f);
  EXPECT_EQ(lecture.emission.value, glm::vec3(4.0f, 2.0f, 1.0f));
  const auto filament = As<FilamentParameters>(m, ShadingModel::Filament);
  EXPECT_EQ(filament.base_color.value, m.base_color_factor);
  EXPECT_FLOAT_EQ(filament.reflectance.value, 0.5f) << "0.16 times its square is 0.04";
  EXPECT_EQ(filament.emissive.value, glm::vec4(4.0f, 2.0f, 1.0f, 1.0f));
  EXPECT_EQ(filament.refraction_mode, FilamentParameters::RefractionMode::None);
  const auto enterprise = As<EnterpriseParameters>(m, ShadingModel::Enterprise);
  EXPECT_EQ(enterprise.albedo.value, glm::vec3(0.5f, 0.25f, 0.125f));
  EXPECT_EQ(enterprise.cutout_opacity.value, 0.75f) << "which opaque materials ignore";
  EXPECT_FLOAT_EQ(enterprise.emission_value, 4.0f * 3.14159265f) << "of a radiance of 4";
}

TEST(FromGltf, GivesFilamentTheLayers) {
  Material m = Painted();
  m.clearcoat_factor = 0.5f;
  m.clearcoat_roughness_texture.texture = 3;
  m.transmission_factor = 1.0f;
  m.thickness_factor = 0.1f;
  m.attenuation_distance = 2.0f;
  m.attenuation_color = {1.0f, 0.5f, 0.0f};
  m.ior = 1.7f;
  m.anisotropy_strength = 0.5f;
  m.anisotropy_rotation = 1.5707963f;
  const auto p = As<FilamentParameters>(m, ShadingModel::Filament);
  EXPECT_EQ(p.clear_coat.value, 0.5f);
  EXPECT_EQ(p.clear_coat_roughness.texture.texture, 3);
  EXPECT_EQ(p.clear_coat_roughness.channel, 1);
  EXPECT_FALSE(p.clear_coat_ior_change);
  EXPECT_EQ(p.refraction_type, FilamentParameters::RefractionType::Solid);
  EXPECT_EQ(p.ior, 1.7f);
  EXPECT_EQ(p.absorption.value.x, 0.0f);
  EXPECT_FLOAT_EQ(p.absorption.value.y, std::log(2.0f) / 2.0f) << "half of the light after 2 m";
  EXPECT_TRUE(std::isfinite(p.absorption.value.z));
  EXPECT_NEAR(p.anisotropy_direction.value.x, 0.0f, 1e-6f);
  EXPECT_FLOAT_EQ(p.anisotropy_direction.value.y, 1.0f);
}

TEST(FromGltf, NamesWhatIsLost) {
  Material m = Painted();
  m.clearcoat_factor = m.iridescence_factor = 1.0f;
  m.occlusion_texture.texture = 0;
  m.occlusion_strength = 0.5f;
  EXPECT_EQ(ConvertFromGltf(m, ShadingModel::Lecture).lost,
            (std::vector<std::string>{"the strength of its occlusion", "clear coat", "iridescence"}));
  EXPECT_EQ(ConvertFromGltf(m, ShadingModel::Enterprise).lost, (std::vector<std::string>{"ambient occlusion"}));
  EXPECT_EQ(SentenceOf({"a", "b"}, ShadingModel::Lecture), "the model \"lecture\" does not have a, b");
}

TEST(FromGltf, KeepsUnlitColours) {
  Material m = Painted();
  m.model = ShadingModel::Unlit;
  EXPECT_EQ(As<FilamentParameters>(m, ShadingModel::Filament).shading_model, FilamentParameters::Shading::Unlit);
  const auto lecture = As<LectureParameters>(m, ShadingModel::Lecture, 1);
  EXPECT_EQ(lecture.albedo.value, m.base_color_factor) << "what points and lines show";
  EXPECT_EQ(lecture.diffuse, LectureDiffuse::None);
  EXPECT_EQ(lecture.specular, LectureSpecular::None);
  EXPECT_EQ(lecture.emission.value, glm::vec3(0.5f, 0.25f, 0.125f));
}

TEST(FromGltf, LeavesUnlitMaterialsToModelsThatHaveThem) {
  Scene scene;
  scene.materials = {Painted()};
  scene.materials[0].model = ShadingModel::Unlit;
  EXPECT_TRUE(ConvertMaterials(scene, ShadingModel::Enterprise).empty());
  EXPECT_EQ(scene.materials[0].model, ShadingModel::Unlit);
  ConvertMaterials(scene, ShadingModel::Filament);
  EXPECT_EQ(scene.materials[0].model, ShadingModel::Filament);
}

TEST(FromGltf, ConvertsScenes) {
  Scene scene;
  scene.materials = {Painted(), Painted(), Painted()};
  scene.materials[1].clearcoat_factor = scene.materials[2].clearcoat_factor = 1.0f;
  scene.materials[1].name = "lacquer";
  scene.meshes.emplace_back().primitives.emplace_back();
  const auto sentences = ConvertMaterials(scene, ShadingModel::Lecture);
  ASSERT_EQ(sentences.size(), 1u) << "one for what is lost in the same way";
  EXPECT_EQ(sentences[0], "material 'lacquer' and 1 more: the model \"lecture\" does not have clear coat");
  ASSERT_EQ(scene.materials.size(), 4u) << "one for the part without a material";
  EXPECT_EQ(scene.meshes[0].primitives[0].material, 3);
  for (const Material& material : scene.materials) EXPECT_EQ(material.model, ShadingModel::Lecture);
  EXPECT_NO_THROW(ValidateScene(scene));
}

}  // namespace
}  // namespace facet
