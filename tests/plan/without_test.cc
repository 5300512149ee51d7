// Features that are left out on request, and frames that use what they need not.
#include <gtest/gtest.h>

#include <algorithm>

#include "facet/shader.h"
#include "plan/frame_plan.h"
#include "render/hand_built.h"

namespace facet {
namespace {

constexpr Feature kAll[kFeatureCount] = {Feature::BaseColorTexture,
                                         Feature::MetallicRoughnessTexture,
                                         Feature::NormalTexture,
                                         Feature::Occlusion,
                                         Feature::Emission,
                                         Feature::VertexColors,
                                         Feature::EnvironmentLight,
                                         Feature::PunctualLights,
                                         Feature::AlphaTest,
                                         Feature::Blending,
                                         Feature::Skins,
                                         Feature::MorphTargets};

int Speckles(Scene& scene, unsigned seed) {
  Uniform random(seed);
  return AddTexture(scene, MakeImage(8, 8, [&](int, int) {
                      return glm::u8vec4(random(90, 255), random(90, 255), random(160, 255), random(0, 255));
                    }));
}

Transform At(double x, double y) {
  Transform transform;
  transform.translation = {x, y, 0.0};
  return transform;
}

// One of everything, side by side.
Scene RichScene() {
  Scene scene;
  Material textured;
  textured.base_color_texture = Ref(Speckles(scene, 1));
  textured.metallic_roughness_texture = Ref(Speckles(scene, 2));
  textured.normal_texture = Ref(Speckles(scene, 3));
  textured.occlusion_texture = Ref(Speckles(scene, 4));
  textured.emissive_texture = Ref(Speckles(scene, 5));
  textured.emissive_factor = {0.3f, 0.2f, 0.1f};
  Primitive ball = Sphere(0.8f, 12, 16);
  ball.colors.assign(ball.positions.size(), glm::vec4(0.4f, 0.9f, 0.6f, 1.0f));
  Add(scene, ball, AddMaterial(scene, textured), At(-1, 1));
  Primitive faceted = Sphere(0.8f, 5, 7);
  faceted.normals.clear();
  Add(scene, faceted, 0, At(1, 1));

  Material tested;
  tested.alpha_mode = AlphaMode::Mask;
  tested.base_color_texture = Ref(Speckles(scene, 6));
  Add(scene, Rectangle(-0.8f, -0.8f, 0.8f, 0.8f, 0.3f), AddMaterial(scene, tested), At(-1, -1));
  Material blended;
  blended.alpha_mode = AlphaMode::Blend;
  blended.base_color_factor = {0.9f, 0.3f, 0.2f, 0.4f};
  Add(scene, Rectangle(-0.4f, -0.4f, 0.6f, 0.9f, 0.5f), AddMaterial(scene, blended), At(-1, -1));

  Primitive bent = Rectangle(-0.7f, -0.7f, 0.7f, 0.7f);
  bent.joints = {{{0, 1, 0, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}, {1, 0, 0, 0}}};
  bent.weights = {{{1, 0, 0, 0}, {1, 0, 0, 0}, {0.7f, 0.3f, 0, 0}, {1, 0, 0, 0}}};
  bent.targets.emplace_back();
  bent.targets[0].positions = {{0.3f, 0, 0}, {0, 0.2f, 0}, {-0.3f, 0, 0}, {0, 0, 0.2f}};
  const int body = Add(scene, bent, AddMaterial(scene, Material()), At(1, -1));
  scene.meshes[std::size_t(scene.nodes[std::size_t(body)].mesh)].weights = {0.8f};
  Skin skin;
  for (const double x : {0.9, 1.3}) {
    scene.nodes.emplace_back();
    scene.nodes.back().transform = At(x, -1.1);
    skin.joints.push_back(int(scene.nodes.size()) - 1);
  }
  scene.skins.push_back(skin);
  scene.nodes[std::size_t(body)].skin = 0;

  Light lamp;
  lamp.intensity = 9.0f;
  scene.lights.push_back(lamp);
  scene.nodes.emplace_back();
  scene.nodes.back().light = 0;
  scene.nodes.back().transform.translation = {0.5, 0.4, 2.0};
  return scene;
}

RenderSettings SettingsFor(int samples = 2) {
  RenderSettings settings = Settings(72, 64, samples, Perspective(1.0, {0, 0, 4}));
  settings.environment.kind = EnvironmentSettings::Kind::Studio;
  return settings;
}

// The same scene made without a feature.
void TakeOut(Feature feature, Scene& scene, RenderSettings& settings) {
  for (Material& m : scene.materials) {
    if (feature == Feature::BaseColorTexture) m.base_color_texture = {};
    if (feature == Feature::MetallicRoughnessTexture) m.metallic_roughness_texture = {};
    if (feature == Feature::NormalTexture) m.normal_texture = {};
    if (feature == Feature::Occlusion) m.occlusion_texture = {};
    if (feature == Feature::Emission) m.emissive_texture = {}, m.emissive_factor = glm::vec3(0.0f);
    if (feature == Feature::AlphaTest && m.alpha_mode == AlphaMode::Mask) m.alpha_mode = AlphaMode::Opaque;
    if (feature == Feature::Blending && m.alpha_mode == AlphaMode::Blend) m.alpha_mode = AlphaMode::Opaque;
  }
  for (Mesh& mesh : scene.meshes) {
    for (Primitive& p : mesh.primitives) {
      if (feature == Feature::VertexColors) p.colors.clear();
      if (feature == Feature::MorphTargets) p.targets.clear();
    }
    if (feature == Feature::MorphTargets) mesh.weights.clear();
  }
  for (Node& node : scene.nodes) {
    if (feature == Feature::PunctualLights) node.light = -1;
    if (feature == Feature::Skins) node.skin = -1;
  }
  if (feature == Feature::EnvironmentLight) settings.environment.kind = EnvironmentSettings::Kind::None;
}

TEST(Without, IsTheSceneMadeWithout) {
  const Film whole = Render(RichScene(), SettingsFor());
  for (const Feature feature : kAll) {
    SCOPED_TRACE(static_cast<std::uint32_t>(feature));
    Scene scene = RichScene();
    RenderSettings settings = SettingsFor(), without = settings;
    without.without.Add(feature);
    const Film disabled = Render(scene, without);
    EXPECT_FALSE(SameBytes(disabled, whole)) << "the scene does not show the feature";
    TakeOut(feature, scene, settings);
    EXPECT_TRUE(SameBytes(disabled, Render(scene, settings)));
    settings.without.Add(feature);
    EXPECT_TRUE(SameBytes(disabled, Render(scene, settings))) << "what is not there is left out";
  }
}

TEST(Without, AllTogether) {
  Scene scene = RichScene();
  RenderSettings settings = SettingsFor(), without = settings;
  for (const Feature feature : kAll) without.without.Add(feature);
  RenderStats stats;
  const Film disabled = Render(scene, without, &stats);
  EXPECT_EQ(stats.texture_bytes + stats.environment_bytes + stats.pose_bytes + stats.images_decoded, 0u);
  for (const Feature feature : kAll) TakeOut(feature, scene, settings);
  EXPECT_TRUE(SameBytes(disabled, Render(scene, settings)));
}

TEST(Without, ThePlanSaysWhoAsked) {
  const Scene scene = RichScene();
  RenderSettings settings = SettingsFor();
  const auto plan = [&] { return MakeFramePlan(scene, Pose(scene, PoseOf(settings)), settings); };
  const FramePlan whole = plan();
  for (const Feature feature : kAll) EXPECT_TRUE(whole.uses.Has(feature)) << static_cast<std::uint32_t>(feature);
  for (const Feature feature : kAll) settings.without.Add(feature);
  const FramePlan empty = plan();
  EXPECT_EQ(empty.uses, FeatureSet());
  EXPECT_EQ(std::count_if(empty.disabled.begin(), empty.disabled.end(),
                          [](const std::string& line) { return line.ends_with(": on request"); }),
            kFeatureCount);
}

TEST(Without, EnvironmentLightLeavesTheBackground) {
  Scene scene = RichScene();
  RenderSettings settings = SettingsFor(1);
  TakeOut(Feature::Blending, scene, settings);
  settings.background = Background::Environment;
  const Film lit = Render(scene, settings);
  settings.without = {Feature::EnvironmentLight};
  const Film shown = Render(scene, settings);
  settings.environment.kind = EnvironmentSettings::Kind::None;
  const Film dark = Render(scene, settings);
  int covered = 0;
  for (std::size_t i = 0; i < shown.pixels.size(); ++i) {
    const bool surface = dark.pixels[i].a > 0.0f;
    covered += surface;
    ASSERT_EQ(shown.pixels[i], surface ? dark.pixels[i] : lit.pixels[i]) << i;
  }
  EXPECT_GT(covered, 500);
  EXPECT_LT(covered, 72 * 64 - 500);
}

// --- Shaders of one's own -------------------------------------------------------------------------------------------

class Reader final : public FragmentShader {
 public:
  explicit Reader(LightUse use) : use_(use) {}
  void Shade(const ShadeTask&) const override {}
  LightUse Light() const override { return use_; }

 private:
  LightUse use_;
};

struct Functor {
  static constexpr LightUse kLight = LightUse::None;
};

TEST(Without, LightIsPreparedForShadersThatReadIt) {
  Scene lit, unlit;
  Add(lit, Rectangle(-1, -1, 1, 1), AddMaterial(lit, Material()));
  Add(unlit, Rectangle(-1, -1, 1, 1), AddMaterial(unlit, Unlit(glm::vec4(1.0f))));
  for (Scene* scene : {&lit, &unlit}) {
    scene->lights.emplace_back();
    scene->nodes.emplace_back();
    scene->nodes.back().light = 0;
  }
  struct Case {
    LightUse use;
    const Scene& scene;
    bool prepared;
  };
  for (const Case& c : {Case{LightUse::None, lit, false}, Case{LightUse::None, unlit, false},
                        Case{LightUse::LitMaterials, lit, true}, Case{LightUse::LitMaterials, unlit, false},
                        Case{LightUse::EveryMaterial, lit, true}, Case{LightUse::EveryMaterial, unlit, true}}) {
    const Reader reader(c.use);
    RenderSettings settings = SettingsFor();
    settings.shader = &reader;
    const FramePlan plan = MakeFramePlan(c.scene, Pose(c.scene, PoseOf(settings)), settings);
    EXPECT_EQ(plan.environment_light, c.prepared);
    EXPECT_EQ(plan.punctual_lights, c.prepared);
  }
  EXPECT_EQ(LightUseOf<Functor>(), LightUse::None);
  EXPECT_EQ(LightUseOf<int>(), LightUse::LitMaterials);
}

// --- Using what is not needed ---------------------------------------------------------------------------------------

TEST(OmitUnused, FalseUsesMoreForTheSameBits) {
  for (const int samples : {1, 4}) {
    Scene plain = RichScene();
    RenderSettings settings = SettingsFor(samples);
    for (const Feature feature : kAll) {
      if (feature != Feature::EnvironmentLight) TakeOut(feature, plain, settings);
    }
    Scene unlit = plain;
    for (Material& m : unlit.materials) m.model = ShadingModel::Unlit;
    const Scene rich = RichScene();
    for (const Scene* scene : {&std::as_const(plain), &std::as_const(unlit), &rich}) {
      settings.omit_unused = true;
      RenderStats lean, full;
      const Film film = Render(*scene, settings, &lean);
      settings.omit_unused = false;
      EXPECT_TRUE(SameBytes(Render(*scene, settings, &full), film));
      EXPECT_GT(full.textures.size(), lean.textures.size());
      const FramePlan plan = MakeFramePlan(*scene, Pose(*scene, PoseOf(settings)), settings);
      EXPECT_TRUE(plan.environment_light && plan.alpha_test && (plan.zero_light || plan.punctual_lights));
      EXPECT_GT(full.environment_bytes, 0u);
    }
    // The features that are left out on request come back with values that change nothing, too.
    settings.without = {Feature::BaseColorTexture, Feature::Occlusion, Feature::PunctualLights, Feature::AlphaTest};
    const Film without_all = Render(rich, settings);
    settings.omit_unused = true;
    EXPECT_TRUE(SameBytes(Render(rich, settings), without_all));
  }
}

}  // namespace
}  // namespace facet
