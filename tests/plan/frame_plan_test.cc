// What a frame leaves out, why, and that leaving it out does not change the image.
#include <gtest/gtest.h>

#include <algorithm>

#include "plan/frame_plan.h"
#include "render/hand_built.h"

namespace facet {
namespace {

FramePlan PlanOf(const Scene& scene, const RenderSettings& settings) {
  return MakeFramePlan(scene, Pose(scene, PoseSettings()), settings);
}

bool IsDisabled(const FramePlan& plan, const std::string& what) {
  return std::any_of(plan.disabled.begin(), plan.disabled.end(),
                     [&](const std::string& line) { return line.rfind(what + ": ", 0) == 0; });
}

RenderSettings StudioSettings(int samples = 4) {
  RenderSettings settings = Settings(64, 64, samples, OrbitCamera{0.3, 1.3, 3.5, glm::dvec3(0.0), 0.8});
  settings.environment.kind = EnvironmentSettings::Kind::Studio;
  return settings;
}

Scene LitSphere(const Material& material = {}) {
  Scene scene;
  Add(scene, Sphere(1.0f, 16, 24), AddMaterial(scene, material));
  return scene;
}

int WhiteTexture(Scene& scene, int size) {
  return AddTexture(scene, MakeImage(size, size, [](int, int) { return glm::u8vec4(255); }));
}

TEST(FramePlan, WhatIsDisabledHasAReason) {
  const FramePlan plan = PlanOf(LitSphere(), StudioSettings());
  for (const std::string& line : plan.disabled) {
    const std::size_t colon = line.find(": ");
    ASSERT_NE(colon, std::string::npos) << line;
    EXPECT_GT(colon, 0u) << line;
    EXPECT_GT(line.size(), colon + 2) << line;
  }
  EXPECT_TRUE(plan.environment_light);
  EXPECT_FALSE(IsDisabled(plan, "environment light"));
  for (const char* what : {"environment background", "punctual lights", "alpha test", "blending", "tangents",
                           "vertex colours", "base colour textures", "metallic-roughness textures", "normal textures",
                           "occlusion textures", "emission", "skins", "morph targets", "planes besides colour"}) {
    EXPECT_TRUE(IsDisabled(plan, what)) << what;
  }
}

TEST(FramePlan, SaysThatUnlitMaterialsUseNoLayers) {
  Material material = Unlit(glm::vec4(1.0f));
  material.clearcoat_factor = material.transmission_factor = 1.0f;
  Scene scene = LitSphere(material);
  const char* const reason = "clear coat: only unlit materials state it, and show the base colour alone";
  const auto says = [&](const FramePlan& plan) {
    return std::find(plan.disabled.begin(), plan.disabled.end(), reason) != plan.disabled.end();
  };
  EXPECT_TRUE(says(PlanOf(scene, StudioSettings())));
  material.model = ShadingModel::MetallicRoughness;
  Add(scene, Sphere(1.0f, 4, 4), AddMaterial(scene, material));
  EXPECT_FALSE(IsDisabled(PlanOf(scene, StudioSettings()), "clear coat"));
}

TEST(FramePlan, MipFilterIsABoundOnWhatSamplersAskFor) {
  for (const MipFilter asked : {MipFilter::None, MipFilter::Nearest, MipFilter::Linear}) {
    for (const MipFilter bound : {MipFilter::None, MipFilter::Nearest, MipFilter::Linear}) {
      Scene scene = LitSphere();
      scene.materials[0].base_color_texture.texture = WhiteTexture(scene, 8);
      scene.textures[0].sampler.mip = asked;
      RenderSettings settings = StudioSettings();
      settings.mip_filter = bound;
      const FramePlan plan = PlanOf(scene, settings);
      EXPECT_EQ(plan.materials[0].frame.Texture(Slot::BaseColor).sampler.mip, std::min(asked, bound));
      EXPECT_EQ(plan.textures[0].mips, std::min(asked, bound) != MipFilter::None);
    }
  }
}

TEST(FramePlan, EachFeatureIsThereWhenSomethingNeedsIt) {
  const auto with = [&](const std::function<void(Scene&, RenderSettings&)>& change) {
    Scene scene = LitSphere();
    RenderSettings settings = StudioSettings();
    change(scene, settings);
    return PlanOf(scene, settings);
  };
  EXPECT_FALSE(IsDisabled(with([](Scene&, RenderSettings& s) { s.background = Background::Environment; }),
                          "environment background"));
  EXPECT_FALSE(IsDisabled(with([](Scene& s, RenderSettings&) {
                            s.lights.emplace_back();
                            s.nodes.emplace_back();
                            s.nodes.back().light = 0;
                          }),
                          "punctual lights"));
  EXPECT_FALSE(
      IsDisabled(with([](Scene& s, RenderSettings&) { s.materials[0].alpha_mode = AlphaMode::Mask; }), "alpha test"));
  EXPECT_FALSE(
      IsDisabled(with([](Scene& s, RenderSettings&) { s.materials[0].alpha_mode = AlphaMode::Blend; }), "blending"));
  const FramePlan normals =
      with([](Scene& s, RenderSettings&) { s.materials[0].normal_texture = Ref(WhiteTexture(s, 1)); });
  EXPECT_FALSE(IsDisabled(normals, "tangents"));
  EXPECT_FALSE(IsDisabled(normals, "normal textures"));
  EXPECT_FALSE(IsDisabled(with([](Scene& s, RenderSettings&) {
                            Primitive& p = s.meshes[0].primitives[0];
                            p.colors.assign(p.positions.size(), glm::vec4(1.0f));
                          }),
                          "vertex colours"));
  EXPECT_TRUE(IsDisabled(with([](Scene& s, RenderSettings&) { s.materials[0].model = ShadingModel::Unlit; }),
                         "environment light"));
  EXPECT_TRUE(IsDisabled(with([](Scene&, RenderSettings& s) { s.environment.kind = EnvironmentSettings::Kind::None; }),
                         "environment light"));
}

TEST(FramePlan, ANormalTextureWithoutAnImageNeedsNoTangents) {
  Scene scene = LitSphere();
  scene.textures.emplace_back();
  scene.materials[0].normal_texture = Ref(0);
  const FramePlan plan = PlanOf(scene, StudioSettings());
  ASSERT_EQ(plan.materials.size(), 1u);
  EXPECT_FALSE(plan.materials[0].frame.Has(kTangentSpaceBits));
  EXPECT_EQ(plan.materials[0].frame.uv_slots, 0);
  const auto disabled = [&](const char* line) {
    return std::find(plan.disabled.begin(), plan.disabled.end(), line) != plan.disabled.end();
  };
  EXPECT_TRUE(disabled("tangents: no normal texture is read, and no surface is anisotropic"));
  EXPECT_TRUE(IsDisabled(plan, "normal textures"));
}

TEST(FramePlan, TexturesAreSharedByRoleAndUvSetsByNumber) {
  Scene scene = LitSphere();
  Material& m = scene.materials[0];
  const int texture = WhiteTexture(scene, 4);
  Primitive& p = scene.meshes[0].primitives[0];
  p.tex_coords.resize(3, p.tex_coords[0]);
  for (TextureRef* ref :
       {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture, &m.occlusion_texture})
    *ref = Ref(texture);
  m.metallic_roughness_texture.tex_coord = 2;
  m.occlusion_texture.tex_coord = 2;
  const FramePlan plan = PlanOf(scene, StudioSettings());
  ASSERT_EQ(plan.textures.size(), 2u);
  EXPECT_NE(plan.textures[0].role, plan.textures[1].role);
  ASSERT_EQ(plan.materials.size(), 1u);
  const PlannedMaterial& planned = plan.materials[0];
  EXPECT_EQ(planned.frame.uv_slots, 2);
  EXPECT_EQ(planned.frame.uv_sets[planned.frame.Texture(Slot::BaseColor).uv_slot], 0);
  EXPECT_EQ(planned.frame.uv_sets[planned.frame.Texture(Slot::MetallicRoughness).uv_slot], 2);
  EXPECT_EQ(planned.frame.uv_sets[planned.frame.Texture(Slot::Occlusion).uv_slot], 2);
  EXPECT_EQ(planned.textures[1], planned.textures[2]);
  EXPECT_EQ(planned.textures[4], -1);
}

TEST(FramePlan, PointsAndLinesWithoutNormalsAreUnlitButEmit) {
  Scene scene;
  Material glowing;
  glowing.emissive_factor = {0, 0.5f, 0};
  const int material = AddMaterial(scene, glowing);
  for (Topology topology : {Topology::Points, Topology::Lines, Topology::Triangles}) {
    Primitive p;
    p.topology = topology;
    p.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 0, 0}, {2, 2, 0}};
    Add(scene, p, material);
    p.normals.assign(6, glm::vec3(0, 0, 1));
    Add(scene, p, material);
  }
  const FramePlan plan = PlanOf(scene, StudioSettings());
  const bool lit[6] = {false, true, false, true, true, true};
  for (std::size_t i = 0; i < 6; ++i) {
    const FrameMaterial& planned = plan.materials[std::size_t(plan.material_of_drawable[i])].frame;
    EXPECT_EQ(planned.Has(kLit), lit[i]) << i;
    EXPECT_TRUE(planned.Has(kEmission)) << i;
  }
  // What is used alike is planned once.
  EXPECT_EQ(plan.material_of_drawable[0], plan.material_of_drawable[2]);
  EXPECT_EQ(plan.material_of_drawable[1], plan.material_of_drawable[3]);
  EXPECT_EQ(plan.material_of_drawable[4], plan.material_of_drawable[5]);
}

// --- The same bits with and without
// -----------------------------------------------------------------------------------

void ExpectSameBits(const std::function<void(Scene&)>& change, const std::string& what, int samples = 4) {
  Material plain;
  plain.base_color_factor = {0.7f, 0.3f, 0.1f, 1.0f};
  plain.metallic_factor = 0.3f;
  plain.roughness_factor = 0.45f;
  Scene scene = LitSphere(plain);
  const Film without = Render(scene, StudioSettings(samples));
  change(scene);
  EXPECT_TRUE(SameBytes(Render(scene, StudioSettings(samples)), without)) << what;
}

TEST(FramePlan, FeaturesThatMeanNothingDoNotChangeTheImage) {
  // A white texel is (2^n - 1) * round(1 / (2^n - 1)) = 1 exactly, and mixtures of 1 are 1.
  for (int size : {1, 4, 64}) {
    ExpectSameBits([&](Scene& s) { s.materials[0].base_color_texture = Ref(WhiteTexture(s, size)); },
                   "white base colour");
    ExpectSameBits([&](Scene& s) { s.materials[0].metallic_roughness_texture = Ref(WhiteTexture(s, size)); },
                   "white factors");
    ExpectSameBits([&](Scene& s) { s.materials[0].occlusion_texture = Ref(WhiteTexture(s, size)); }, "no occlusion");
  }
  ExpectSameBits([](Scene& s) { s.materials[0].emissive_texture = Ref(WhiteTexture(s, 4)); }, "emission of factor 0");
  ExpectSameBits(
      [](Scene& s) {
        s.materials[0].occlusion_texture = Ref(
            AddTexture(s, MakeImage(2, 2, [](int x, int y) { return glm::u8vec4(std::uint8_t(x * 90 + y * 70)); })));
        s.materials[0].occlusion_strength = 0.0f;
      },
      "occlusion of strength 0");
  ExpectSameBits([](Scene& s) { s.materials[0].alpha_mode = AlphaMode::Mask; }, "an alpha test that all pass");
  ExpectSameBits([](Scene& s) { s.materials[0].alpha_mode = AlphaMode::Blend; }, "blending of alpha 1", 1);
  ExpectSameBits([](Scene& s) { s.materials[0].double_sided = true; }, "double-sided, closed");
  ExpectSameBits(
      [](Scene& s) {
        Light light;
        light.intensity = 0.0f;
        s.lights.push_back(light);
        s.nodes.emplace_back();
        s.nodes.back().light = 0;
        s.nodes.back().transform.translation = {2, 2, 2};
      },
      "a light of intensity 0");
  ExpectSameBits(
      [](Scene& s) {
        s.materials.push_back(Unlit(glm::vec4(1.0f)));
        s.materials.back().base_color_texture = Ref(WhiteTexture(s, 4));
        s.textures.emplace_back();
        s.variants.push_back("unused");
      },
      "things that nothing uses");
  ExpectSameBits(
      [](Scene& s) {
        s.textures.emplace_back();  // without an image
        s.materials[0].base_color_texture = Ref(0);
        s.materials[0].normal_texture = Ref(0);
      },
      "textures without pictures");
}

TEST(FramePlan, AnEnvironmentOfIntensityZeroIsNone) {
  const Scene scene = LitSphere();
  RenderSettings settings = StudioSettings();
  settings.environment.intensity = 0.0;
  const Film zero = Render(scene, settings);
  settings.environment.kind = EnvironmentSettings::Kind::None;
  EXPECT_TRUE(SameBytes(Render(scene, settings), zero));
}

}  // namespace
}  // namespace facet
