// Features that are left out on request, and frames that use what they need not.
#include <gtest/gtest.h>

#include <algorithm>

#include <string_view>
#include <utility>

#include "facet/shader.h"
#include "material/models/models.h"
#include "material/parameters.h"
#include "plan/frame_plan.h"
#include "render/hand_built.h"

namespace facet {
namespace {

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

// A material of each feature that is an extension; each has no other of them but what it needs to show.
struct Layered {
  Feature feature;
  const char* extension;
  void (*state)(Material&, Scene&);
};
const Layered kLayered[] = {
    {Feature::Clearcoat, "KHR_materials_clearcoat",
     [](Material& m, Scene& scene) {
       m.clearcoat_factor = 0.9f;
       m.clearcoat_texture = Ref(Speckles(scene, 11));
       m.clearcoat_roughness_factor = 0.4f;
       m.clearcoat_roughness_texture = Ref(Speckles(scene, 12));
       m.clearcoat_normal_texture = Ref(Speckles(scene, 13));
       m.clearcoat_normal_scale = 0.5f;
     }},
    {Feature::Sheen, "KHR_materials_sheen",
     [](Material& m, Scene& scene) {
       m.sheen_color_factor = {0.9f, 0.5f, 0.3f};
       m.sheen_color_texture = Ref(Speckles(scene, 14));
       m.sheen_roughness_factor = 0.6f;
       m.sheen_roughness_texture = Ref(Speckles(scene, 15));
     }},
    {Feature::Specular, "KHR_materials_specular",
     [](Material& m, Scene& scene) {
       m.specular_factor = 0.7f;
       m.specular_texture = Ref(Speckles(scene, 16));
       m.specular_color_factor = {3.0f, 0.5f, 1.0f};
       m.specular_color_texture = Ref(Speckles(scene, 17));
     }},
    {Feature::Ior, "KHR_materials_ior", [](Material& m, Scene&) { m.ior = 2.4f; }},
    {Feature::Transmission, "KHR_materials_transmission",
     [](Material& m, Scene& scene) {
       m.transmission_factor = 0.8f;
       m.transmission_texture = Ref(Speckles(scene, 18));
     }},
    {Feature::Volume, "KHR_materials_volume",
     [](Material& m, Scene& scene) {
       m.transmission_factor = 0.9f;
       m.thickness_factor = 0.7f;
       m.thickness_texture = Ref(Speckles(scene, 19));
       m.attenuation_distance = 0.5f;
       m.attenuation_color = {0.9f, 0.4f, 0.2f};
     }},
    {Feature::Dispersion, "KHR_materials_dispersion",
     [](Material& m, Scene&) {
       m.transmission_factor = 0.9f;
       m.thickness_factor = 0.7f;
       m.dispersion = 5.0f;
     }},
    {Feature::DiffuseTransmission, "KHR_materials_diffuse_transmission",
     [](Material& m, Scene& scene) {
       m.diffuse_transmission_factor = 0.7f;
       m.diffuse_transmission_texture = Ref(Speckles(scene, 20));
       m.diffuse_transmission_color_factor = {0.9f, 0.7f, 0.2f};
       m.diffuse_transmission_color_texture = Ref(Speckles(scene, 21));
     }},
    {Feature::Iridescence, "KHR_materials_iridescence",
     [](Material& m, Scene& scene) {
       m.iridescence_factor = 0.8f;
       m.iridescence_texture = Ref(Speckles(scene, 22));
       m.iridescence_ior = 1.6f;
       m.iridescence_thickness_minimum = 700.0f;  // above the maximum
       m.iridescence_thickness_texture = Ref(Speckles(scene, 23));
     }},
    {Feature::Anisotropy, "KHR_materials_anisotropy",
     [](Material& m, Scene& scene) {
       m.roughness_factor = 0.3f;
       m.anisotropy_strength = 0.8f;
       m.anisotropy_rotation = 0.7f;
       m.anisotropy_texture = Ref(Speckles(scene, 24));
     }},
    {Feature::SpecularGlossinessTexture, nullptr,
     [](Material& m, Scene& scene) {
       m.model = ShadingModel::SpecularGlossiness;
       m.specular_glossiness_specular_factor = {0.9f, 0.6f, 0.3f};
       m.glossiness_factor = 0.8f;
       m.specular_glossiness_texture = Ref(Speckles(scene, 25));
     }},
};

// A material that is not all metal, with one extension.
Material LayeredMaterial(const Layered& layered, Scene& scene) {
  Material m;
  m.base_color_factor = {0.7f, 0.5f, 0.4f, 1.0f};
  m.metallic_factor = 0.2f;
  m.roughness_factor = 0.5f;
  layered.state(m, scene);
  return m;
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

  int place = 0;  // in two columns at the sides
  for (const Layered& layered : kLayered) {
    const double x = place % 2 == 0 ? -2.05 : 2.05, y = 1.7 - 0.65 * (place / 2);
    ++place;
    Add(scene, Sphere(0.32f, 10, 14), AddMaterial(scene, LayeredMaterial(layered, scene)), At(x, y));
  }

  Light lamp;
  lamp.intensity = 9.0f;
  scene.lights.push_back(lamp);
  scene.nodes.emplace_back();
  scene.nodes.back().light = 0;
  scene.nodes.back().transform.translation = {0.5, 0.4, 2.0};
  return scene;
}

RenderSettings SettingsFor(int samples = 2) {
  RenderSettings settings = Settings(96, 72, samples, Perspective(1.0, {0, 0, 4}));
  settings.environment.kind = EnvironmentSettings::Kind::Studio;
  return settings;
}

// All parameters of the extension, and not only those that the option sets, as if the material did not name it.
void ResetAllOf(std::string_view extension, Material& material) {
  ForEachParameter([&](const auto& parameter) {
    const std::string_view group = parameter.gltf_group != nullptr ? parameter.gltf_group : "";
    if (group.substr(0, group.find('.')) == extension) material.*parameter.member = Material().*parameter.member;
  });
}

// The same scene made without a feature.
void TakeOut(Feature feature, Scene& scene, RenderSettings& settings) {
  const auto layered = std::ranges::find(kLayered, feature, &Layered::feature);
  const char* const extension = layered != std::end(kLayered) ? layered->extension : nullptr;
  for (Material& m : scene.materials) {
    if (extension != nullptr) ResetAllOf(extension, m);
    if (feature == Feature::SpecularGlossinessTexture) m.specular_glossiness_texture = {};
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
  for (const auto& [feature, word] : kFeatureWords) {
    SCOPED_TRACE(word);
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

// Alone and beside one another: a material that has every layer, of which one is taken.
TEST(Without, OfManyLayersOneIsTheMaterialMadeWithout) {
  Scene scene;
  Material all;
  all.metallic_factor = 0.3f;
  for (const Layered& layered : kLayered) {
    if (layered.extension != nullptr) layered.state(all, scene);
  }
  Add(scene, Sphere(1.2f, 16, 24), AddMaterial(scene, all));
  all.model = ShadingModel::SpecularGlossiness;
  Add(scene, Rectangle(-0.4f, -0.4f, 0.4f, 0.4f, 1.3f), AddMaterial(scene, all));
  scene.lights.emplace_back().intensity = 9.0f;
  scene.nodes.emplace_back().light = 0;
  scene.nodes.back().transform.translation = {0.5, 0.4, 3.0};
  for (const Layered& layered : kLayered) {
    SCOPED_TRACE(layered.extension);
    RenderSettings settings = SettingsFor(), without = settings;
    without.without.Add(layered.feature);
    Scene made_without = scene;
    TakeOut(layered.feature, made_without, settings);
    EXPECT_TRUE(SameBytes(Render(scene, without), Render(made_without, settings)));
  }
}

// A surface that is anisotropic by its factor alone, on all that may or may not have a tangent space.
TEST(Without, AnisotropyLeavesNoTangentsBehind) {
  for (const bool has_uvs : {false, true}) {
    for (const bool has_normals : {false, true}) {
      for (const Topology topology : {Topology::Triangles, Topology::LineStrip, Topology::Points}) {
        SCOPED_TRACE(::testing::Message() << has_uvs << has_normals << int(topology));
        Scene scene;
        Material material;
        material.roughness_factor = 0.3f;
        material.anisotropy_strength = 0.9f;
        Primitive ball = Sphere(1.2f, 12, 16);
        ball.topology = topology;
        if (!has_uvs) ball.tex_coords.clear();
        if (!has_normals) ball.normals.clear();
        Add(scene, ball, AddMaterial(scene, material));
        RenderSettings settings = SettingsFor();
        RenderStats with_stats, stats;
        const Film whole = Render(scene, settings, &with_stats);
        settings.without = {Feature::Anisotropy};
        const Film without = Render(scene, settings, &stats);
        EXPECT_EQ(stats.pose_bytes, 0u);
        const bool is_surface = topology == Topology::Triangles;
        EXPECT_EQ(with_stats.pose_bytes > 0, is_surface);
        EXPECT_EQ(SameBytes(whole, without), !is_surface) << "only surfaces have tangents, and show it";
        for (const glm::vec4& pixel : whole.pixels) {
          ASSERT_TRUE(std::isfinite(pixel.r) && std::isfinite(pixel.g) && std::isfinite(pixel.b));
        }
        scene.materials[0].anisotropy_strength = 0.0f;
        EXPECT_TRUE(SameBytes(without, Render(scene, SettingsFor())));
      }
    }
  }
}

TEST(Without, AllTogether) {
  Scene scene = RichScene();
  RenderSettings settings = SettingsFor(), without = settings;
  for (const auto& [feature, word] : kFeatureWords) without.without.Add(feature);
  RenderStats stats;
  const Film disabled = Render(scene, without, &stats);
  EXPECT_EQ(stats.texture_bytes + stats.environment_bytes + stats.pose_bytes + stats.images_decoded, 0u);
  for (const auto& [feature, word] : kFeatureWords) TakeOut(feature, scene, settings);
  EXPECT_TRUE(SameBytes(disabled, Render(scene, settings)));
}

TEST(Without, ThePlanSaysWhoAsked) {
  const Scene scene = RichScene();
  RenderSettings settings = SettingsFor();
  const auto plan = [&] { return MakeFramePlan(scene, Pose(scene, PoseOf(settings)), settings); };
  const FramePlan whole = plan();
  for (const auto& [feature, word] : kFeatureWords) EXPECT_TRUE(whole.uses.Has(feature)) << word;
  for (const auto& [feature, word] : kFeatureWords) settings.without.Add(feature);
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
  TakeOut(Feature::Transmission, scene, settings);  // through which the background is seen
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
  EXPECT_LT(covered, 96 * 72 - 500);
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
    for (const auto& [feature, word] : kFeatureWords) {
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

// Layers with factors that make them invisible, in turn with each other layer visible, and in both models.
TEST(OmitUnused, InvisibleLayersChangeNoBit) {
  for (const Layered& layered : kLayered) {
    for (const ShadingModel model : {ShadingModel::MetallicRoughness, ShadingModel::SpecularGlossiness}) {
      for (const float metallic : {0.0f, 0.37f, 1.0f}) {
        SCOPED_TRACE(::testing::Message() << (layered.extension ? layered.extension : "") << " " << metallic);
        Scene scene;
        Material material = LayeredMaterial(layered, scene);
        material.model = model;
        material.metallic_factor = metallic;
        Add(scene, Sphere(1.2f, 12, 16), AddMaterial(scene, material));
        scene.lights.emplace_back().intensity = 9.0f;
        scene.nodes.emplace_back().light = 0;
        scene.nodes.back().transform.translation = {0.5, 0.4, 3.0};
        RenderSettings settings = SettingsFor(1);
        const Film film = Render(scene, settings);
        settings.omit_unused = false;
        EXPECT_TRUE(SameBytes(film, Render(scene, settings)));
        const FramePlan plan = MakeFramePlan(scene, Pose(scene, PoseOf(settings)), settings);
        const MaterialFeatures features = plan.materials[0].frame.features;
        for (const FactorFeature& factor : kFactorFeatures) {
          const bool is_read = (InfoOf(model).reads & factor.bit) != 0;
          const bool is_enabled = (features & factor.bit) != 0;
          EXPECT_TRUE(is_enabled || !is_read || !factor.is_neutral_at_zero) << factor.name;
        }
      }
    }
  }
}

// Materials of random parameters, among them many zeros and ones, and textures whose factors hide them.
TEST(OmitUnused, FalseChangesNoBitOfRandomMaterials) {
  Uniform random(7);
  for (int round = 0; round < 40; ++round) {
    SCOPED_TRACE(round);
    Scene scene;
    const int speckles = Speckles(scene, 31);
    Material material;
    ForEachParameter([&]<class Value>(const Parameter<Value>& parameter) {
      if (parameter.alternative || random() < 0.5) return;
      Value& value = material.*parameter.member;
      const ParameterRange& range = parameter.range;
      const auto number = [&] {
        const double kind = random();
        const double low = std::max(double(range.low), 0.0), high = std::min(double(range.high), 3.0);
        return static_cast<float>(kind < 0.3 ? low : kind < 0.5 ? std::min(high, 1.0 + low) : random(low, high));
      };
      if constexpr (std::is_same_v<Value, float>) {
        value = number();
      } else if constexpr (std::is_same_v<Value, glm::vec3> || std::is_same_v<Value, glm::vec4>) {
        for (int c = 0; c < Value::length(); ++c) value[c] = number();
        if (random() < 0.3) value = Value(0.0f);
      } else if constexpr (std::is_same_v<Value, TextureRef>) {
        value = Ref(speckles);
      } else if constexpr (std::is_same_v<Value, ShadingModel>) {
        value = ShadingModel(int(random(0, 3)));
      } else if constexpr (std::is_same_v<Value, bool>) {
        value = true;
      }
    });
    Add(scene, Sphere(1.2f, 10, 14), AddMaterial(scene, material));
    scene.lights.emplace_back().intensity = 9.0f;
    scene.nodes.emplace_back().light = 0;
    scene.nodes.back().transform.translation = {0.5, 0.4, 3.0};
    RenderSettings settings = SettingsFor(1);
    const Film film = Render(scene, settings);
    settings.omit_unused = false;
    EXPECT_TRUE(SameBytes(film, Render(scene, settings)));
  }
}

}  // namespace
}  // namespace facet
