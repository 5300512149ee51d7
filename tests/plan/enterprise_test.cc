// What the plan measures on the mesh for the model "enterprise".
#include <gtest/gtest.h>

#include <memory>

#include "facet/models.h"
#include "material/model_parameters.h"
#include "plan/enterprise_measures.h"
#include "plan/frame_plan.h"
#include "render/hand_built.h"

namespace facet {
namespace {

Material MaterialOf(const EnterpriseParameters& p) {
  Material material;
  material.model = ShadingModel::Enterprise;
  material.parameters = std::make_shared<const ModelParameters>(p);
  return material;
}

FramePlan PlanOf(const Scene& scene) { return MakeFramePlan(scene, Pose(scene, PoseSettings()), RenderSettings()); }

const EnterpriseParameters& PlannedAt(const FramePlan& plan, std::size_t drawable) {
  return plan.materials[std::size_t(plan.material_of_drawable[drawable])].frame.Parameters<EnterpriseParameters>();
}

Transform Scaled(double scale) {
  Transform transform;
  transform.scale = glm::dvec3(scale);
  return transform;
}

// Lumens become lumens per square metre, on each mesh by its own area.
TEST(EnterprisePlan, PowerIsSpreadOverTheSurface) {
  EnterpriseParameters p;
  p.emission_value = 100.0f;
  p.emission_mode = EnterpriseEmissionMode::LuminousPower;
  Scene scene;
  const int material = AddMaterial(scene, MaterialOf(p));
  Add(scene, Rectangle(0.0f, 0.0f, 2.0f, 1.0f), material);
  Add(scene, Rectangle(0.0f, 0.0f, 2.0f, 1.0f), material, Scaled(3.0));
  Add(scene, Rectangle(0.0f, 0.0f, 2.0f, 1.0f), material);
  const FramePlan plan = PlanOf(scene);
  EXPECT_NEAR(PlannedAt(plan, 0).emission_value, 50.0f, 1e-4f);
  EXPECT_NEAR(PlannedAt(plan, 1).emission_value, 100.0f / 18.0f, 1e-4f);
  EXPECT_EQ(plan.material_of_drawable[0], plan.material_of_drawable[2]);
  EXPECT_EQ(plan.materials.size(), 2u);
}

// The mean chord of a ball is 4/3 of its radius.
TEST(EnterprisePlan, AVolumeWithoutThicknessHasTheMeanChord) {
  EnterpriseParameters p = EnterprisePreset("glass");
  Scene scene;
  const int measured = AddMaterial(scene, MaterialOf(p));
  p.thickness = 0.25f;
  const int stated = AddMaterial(scene, MaterialOf(p));
  Add(scene, Sphere(0.5f, 64, 128), measured, Scaled(2.0));
  Add(scene, Sphere(0.5f, 64, 128), stated, Scaled(2.0));
  const FramePlan plan = PlanOf(scene);
  EXPECT_NEAR(PlannedAt(plan, 0).thickness, 2.0f / 3.0f, 0.005f) << "in units of the mesh";
  EXPECT_NEAR(PlannedAt(plan, 1).thickness, 0.25f, 1e-6f);
  EXPECT_TRUE(plan.materials[0].frame.is_seen_through);
  EXPECT_NEAR(plan.materials[1].frame.factors.thickness, 0.25f, 1e-6f);
}

TEST(EnterprisePlan, FlakesKnowTheScaleOfTheTexture) {
  EnterpriseParameters p = EnterprisePreset("carpaint");
  Scene scene;
  Primitive wall = Rectangle(0.0f, 0.0f, 1.0f, 1.0f);
  wall.tex_coords = {{{0, 0}, {4, 0}, {4, 4}, {0, 4}}};
  const int material = AddMaterial(scene, MaterialOf(p));
  Add(scene, wall, material, Scaled(2.0));
  wall.tex_coords.clear();
  Add(scene, wall, material);
  const FramePlan plan = PlanOf(scene);
  EXPECT_NEAR(PlannedAt(plan, 0).texture_scale, 0.5f, 1e-6f);
  EXPECT_EQ(PlannedAt(plan, 1).texture_scale, 0.0f);
  EXPECT_EQ(plan.materials[0].frame.uv_slots, 1);
  EXPECT_TRUE(plan.materials[0].frame.Has(kFlakes));
  // A stated scale needs texture coordinates to scale.
  p.texture_scale = 0.25f;
  scene.materials[std::size_t(material)] = MaterialOf(p);
  const FramePlan stated = PlanOf(scene);
  EXPECT_EQ(PlannedAt(stated, 0).texture_scale, 0.25f);
  EXPECT_EQ(PlannedAt(stated, 1).texture_scale, 0.0f);
}

// Lines without normals are unlit, but their coverage is what it is on surfaces: a number, of one channel.
TEST(EnterprisePlan, CoverageOfLinesIsANumber) {
  EnterpriseParameters p;
  Scene scene;
  const int texture = AddTexture(scene, MakeImage(2, 2, [](int, int) { return glm::u8vec4(128); }));
  p.cutout_opacity.texture.texture = p.roughness.texture.texture = texture;
  p.roughness.value = 0.5f;
  p.cutout_opacity.channel = 1;
  Material material = MaterialOf(p);
  material.alpha_mode = AlphaMode::Blend;
  Primitive lines = Rectangle(0.0f, 0.0f, 1.0f, 1.0f);
  lines.topology = Topology::LineStrip;
  lines.indices.clear();
  lines.normals.clear();
  Add(scene, lines, AddMaterial(scene, material));
  const FramePlan plan = PlanOf(scene);
  const FrameMaterial& planned = plan.materials[0].frame;
  EXPECT_EQ(planned.model, ShadingModel::Unlit);
  EXPECT_TRUE(planned.ReadsCoverage());
  ASSERT_EQ(plan.textures.size(), 1u) << "what needs light is not read";
  EXPECT_EQ(plan.textures[0].role, TextureRole::Data);
  EXPECT_EQ(plan.textures[0].channels, kG);
}

// Lines get no tangents from anyone.
TEST(EnterprisePlan, LinesWithoutTangentsAreNotAnisotropic) {
  EnterpriseParameters p;
  p.anisotropy.value = 0.5f;
  FilamentParameters brushed;
  brushed.anisotropy.value = 0.5f;
  Material filament;
  filament.model = ShadingModel::Filament;
  filament.parameters = std::make_shared<const ModelParameters>(brushed);
  for (const Material& material : {MaterialOf(p), filament}) {
    for (const bool has_tangents : {false, true}) {
      Scene scene;
      Primitive lines = Rectangle(0.0f, 0.0f, 1.0f, 1.0f);
      lines.topology = Topology::LineStrip;
      lines.indices.clear();
      if (has_tangents) lines.tangents.assign(lines.positions.size(), glm::vec4(1, 0, 0, 1));
      if (!has_tangents) lines.tangents.clear();
      Add(scene, lines, AddMaterial(scene, material));
      EXPECT_EQ(PlanOf(scene).materials[0].frame.Has(kAnisotropy | kTangents), has_tangents);
    }
  }
}

// What the features are called decides, not the numbers that slots have in glTF's models.
TEST(EnterprisePlan, TangentsDependOnFeatures) {
  RenderSettings settings;
  settings.without = {Feature::Occlusion, Feature::Clearcoat, Feature::Sheen};
  EXPECT_EQ(PoseOf(settings).without, (FeatureSet{Feature::Occlusion, Feature::Clearcoat}));
}

// What is not used is not measured, so that all meshes share a plan.
TEST(EnterprisePlan, OtherMaterialsShareTheirPlan) {
  Scene scene;
  const int material = AddMaterial(scene, MaterialOf(EnterprisePreset("wood")));
  Add(scene, Sphere(0.5f, 8, 8), material);
  Add(scene, Sphere(1.5f, 8, 8), material, Scaled(2.0));
  EXPECT_EQ(PlanOf(scene).materials.size(), 1u);
}

// All of its textures reach the shader, whatever the numbers of their slots mean to glTF's models.
TEST(EnterprisePlan, TexturesAreKeptWithoutTransmission) {
  EnterpriseParameters p;
  Scene scene;
  const int texture = AddTexture(scene, MakeImage(2, 2, [](int, int) { return glm::u8vec4(128); }));
  std::size_t textures = 0;
  ForEachParameterOf(p, [&]<class Value>(const auto& row, Value& value) {
    if constexpr (std::is_same_v<Value, Textured<float>> || std::is_same_v<Value, Textured<glm::vec3>>) {
      if (row.is_coverage || row.name == std::string("transparency")) return;
      using Bare = decltype(value.value);
      if (value.value == Bare(0.0f)) value.value = Bare(0.5f);
      value.texture.texture = texture;
      ++textures;
    }
  });
  Add(scene, Sphere(1.0f, 8, 8), AddMaterial(scene, MaterialOf(p)));
  const FramePlan plan = PlanOf(scene);
  std::size_t bound = 0;
  for (const int index : plan.materials[0].textures) bound += index >= 0 ? 1 : 0;
  EXPECT_EQ(bound, textures);
  EXPECT_EQ(bound, 22u);
}

}  // namespace
}  // namespace facet
