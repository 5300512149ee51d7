// The shading stage in double against the same stage on lanes: the difference is rounding, it is small, and it is
// there.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "facet/load.h"
#include "light/lighting-inl.h"
#include "material/models/metallic_roughness-inl.h"
#include "render/hand_built.h"
#include "shade/attribute_setup.h"
#include "shade/interpolate-inl.h"
#include "shade/material_view-inl.h"
#include "shade/shade_fragments.h"
#include "shade/shade_in_double.h"

namespace facet {
namespace {

// How far two floats of the same sign are apart, in numbers between them.
std::int64_t Ulps(float a, float b) {
  return std::abs(std::int64_t{std::bit_cast<std::int32_t>(a)} - std::int64_t{std::bit_cast<std::int32_t>(b)});
}

struct Films {
  Film lanes, exact;
};

Films Draw(const Scene& scene, RenderSettings settings) {
  settings.environment_size = 256;
  Films films;
  films.lanes = Render(scene, settings);
  const auto shader = MakeDoubleShader();
  settings.shader = shader.get();
  films.exact = Render(scene, settings);
  return films;
}

struct Rounding {
  double relative_rmse = 0;  // over all numbers of the film
  // How far the numbers that are not zero are from exact: half of them at most, and 90 of 100.
  std::int64_t median_ulps = 0, ulps_90 = 0;
};

Rounding Measure(const Films& films) {
  double squared = 0, power = 0;
  std::vector<std::int64_t> ulps;
  for (std::size_t i = 0; i < films.exact.pixels.size(); ++i) {
    for (int c = 0; c < 4; ++c) {
      const float a = films.lanes.pixels[i][c], b = films.exact.pixels[i][c];
      squared += (double(a) - double(b)) * (double(a) - double(b));
      power += double(b) * double(b);
      if (b != 0.0f && c < 3) ulps.push_back(Ulps(a, b));
    }
  }
  std::sort(ulps.begin(), ulps.end());
  const std::size_t n = ulps.size();
  if (n == 0) return {NAN, 0, 0};
  return {std::sqrt(squared / power), ulps[n / 2], ulps[n * 9 / 10]};
}

// What rounding may do to a film, with room for other scenes than those measured.
struct Bounds {
  double relative_rmse;
  std::int64_t median_ulps;
};
// Some tens of roundings of 6e-8, and in the environment maps coordinates of up to 256 texels, right to 2e-5 of a
// texel.
constexpr Bounds kUntextured = {1e-5, 4};
// Textures too: the weights of texels are rounded to 1/16384, some ten times a sample, and texels are as different from
// their neighbours as they can be.
constexpr Bounds kTextured = {5e-5, 512};
// The narrowest highlight, alpha = 0.002, falls off by up to 2 / alpha = 1000 times the angle: directions that are
// right to 2e-7 give it to 2e-4, and where it is in the image it is what the squares add up to. It has textures, too.
constexpr Bounds kHighlight = {5e-4, 64};

void ExpectRounding(const Films& films, const std::string& name, const Bounds& bounds) {
  const Rounding r = Measure(films);
  SCOPED_TRACE(name + ": relative RMSE " + std::to_string(r.relative_rmse * 1e9) + "e-9, ULPs: median " +
               std::to_string(r.median_ulps) + ", 90 % within " + std::to_string(r.ulps_90));
  EXPECT_LT(r.relative_rmse, bounds.relative_rmse);
  EXPECT_GT(r.relative_rmse, 0.0) << "the double shader draws the lanes' very bits";
  EXPECT_LE(r.median_ulps, bounds.median_ulps);
  EXPECT_LE(r.ulps_90, 16 * bounds.median_ulps);
}

std::string Bundled(const char* name) { return std::string(FACET_SOURCE_DIR "/assets/scenes/") + name + ".glb"; }

TEST(DoubleShader, BundledScenesDifferByRoundingAlone) {
  for (const char* name : {"animated", "gallery", "material_grid", "materials", "room", "showcase"}) {
    const Scene scene = LoadGltf(Bundled(name)).scene;
    RenderSettings settings;
    settings.width = settings.height = 96;
    const bool highlights = name == std::string("showcase") || name == std::string("gallery");
    ExpectRounding(Draw(scene, settings), name, highlights ? kHighlight : kUntextured);
  }
}

// Everything that the stage reads: five textures of either depth, with mips and anisotropy, wrapped, mirrored and
// turned; normal maps and vertex colours; lights of all types and an environment.
Scene EverythingTextured() {
  Scene scene;
  const auto pattern = [](int phase) {
    return [phase](int x, int y) {
      const auto wave = [&](int a, int b) { return std::uint8_t(40 + ((x * a + y * b + phase) * 37) % 200); };
      return glm::u8vec4(wave(1, 3), wave(2, 1), wave(5, 2), wave(3, 4));
    };
  };
  const auto bumps = [](int x, int y) {
    return glm::u8vec4(128 + (x * 7) % 40 - 20, 128 + (y * 11) % 40 - 20, 240, 255);
  };
  Sampler mirrored;
  mirrored.wrap_u = Wrap::MirroredRepeat;
  mirrored.wrap_v = Wrap::ClampToEdge;
  Material material;
  material.base_color_texture = Ref(AddTexture(scene, MakeImage(64, 64, pattern(0))));
  material.base_color_texture.rotation = 0.3f;
  material.base_color_texture.scale = {7.0f, 5.0f};
  material.metallic_roughness_texture = Ref(AddTexture(scene, MakeImage(32, 16, pattern(9)), mirrored));
  material.normal_texture = Ref(AddTexture(scene, MakeImage(33, 21, bumps)));
  material.normal_texture.scale = {3.0f, 3.0f};
  material.occlusion_texture = Ref(AddTexture(scene, MakeImage(16, 16, pattern(5))));
  material.emissive_texture = Ref(AddTexture(scene, MakeImage(8, 8, pattern(3))));
  material.emissive_factor = glm::vec3(0.1f, 0.2f, 0.05f);
  material.double_sided = true;
  const int index = AddMaterial(scene, material);
  Primitive sphere = Sphere(1.0f, 24, 48);
  for (const glm::vec3& n : sphere.normals)
    sphere.colors.emplace_back(0.6f + 0.4f * n.x, 0.8f, 0.7f - 0.3f * n.y, 1.0f);
  Add(scene, sphere, index);
  Transform lying;  // seen at a slant: several taps
  lying.translation = {0, -1, 0};
  lying.rotation = glm::dquat(std::sqrt(0.5), -std::sqrt(0.5), 0, 0);
  Add(scene, Rectangle(-6, -6, 6, 6), index, lying);
  for (LightType type : {LightType::Directional, LightType::Point, LightType::Spot}) {
    Light light;
    light.type = type;
    light.intensity = type == LightType::Directional ? 1.0f : 9.0f;
    light.color = {1.0f, 0.9f, 0.7f};
    scene.lights.push_back(light);
    Node node;
    node.light = int(scene.lights.size()) - 1;
    node.transform.translation = {1.5, 1.2, 2.5};
    scene.nodes.push_back(node);
  }
  return scene;
}

TEST(DoubleShader, EveryTextureAndLightDiffersByRoundingAlone) {
  const Scene scene = EverythingTextured();
  for (int samples : {1, 4}) {
    RenderSettings settings = Settings(128, 128, samples, Perspective(0.7, {0, 0.2, 5}));
    settings.environment.kind = EnvironmentSettings::Kind::Studio;
    ExpectRounding(Draw(scene, settings), std::to_string(samples) + " samples", kTextured);
  }
  RenderSettings settings = Settings(96, 96, 1, Orthographic(1.5));
  settings.environment.kind = EnvironmentSettings::Kind::Studio;
  ExpectRounding(Draw(scene, settings), "orthographic", kTextured);
}

// One source: with T = float, fragment by fragment, it gives the lanes' very bits. So what double changes is precision
// alone, not what is computed.
class FloatShader final : public FragmentShader {
 public:
  void Shade(const ShadeTask& task) const override {
    namespace lanes = HWY_NAMESPACE;
    const lanes::MaterialView<float> material(*task.material);
    const lanes::LightingView<float> lighting(*task.lighting);
    for (std::size_t i = 0; i < task.count; ++i) {
      const lanes::Shaded<float> shaded =
          lanes::MetallicRoughness()(lanes::InterpolateSurface<float>(task, i), material, lighting);
      task.red[i] = shaded.color.x;
      task.green[i] = shaded.color.y;
      task.blue[i] = shaded.color.z;
      task.alpha[i] = std::clamp(shaded.alpha, 0.0f, 1.0f);
    }
  }
};

// The first textures of the material alike, and so the others: read at the same places, together.
Scene TexturedInGroups(int first_group) {
  Scene scene = EverythingTextured();
  Material& m = scene.materials[0];
  TextureRef* const refs[5] = {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture,
                               &m.occlusion_texture, &m.emissive_texture};
  for (int k = 0; k < 5; ++k) {
    const int size = k < first_group ? 64 : 24;
    const Image image = MakeImage(size, size, [k](int x, int y) {
      return glm::u8vec4(60 + (x * 37 + k * 50) % 190, 50 + (y * 53 + k * 31) % 200, 90 + (x * y * 7 + k) % 160, 255);
    });
    *refs[k] = Ref(AddTexture(scene, image));
    refs[k]->scale = {9.0f, 4.0f};
  }
  return scene;
}

// Emission in spots, on a texture like that of another size or like the base colour's: some packets are in the dark,
// some are not, and some are at its edge.
Scene SpotsOfEmission(int base_size) {
  constexpr int kSize = 1024;
  Scene scene = EverythingTextured();
  Material& m = scene.materials[0];
  m.base_color_texture = Ref(AddTexture(scene, MakeImage(base_size, base_size, [](int x, int y) {
                                          return glm::u8vec4(60 + x * 37 % 190, 50 + y * 53 % 200, 90, 255);
                                        })));
  m.emissive_texture = Ref(AddTexture(scene, MakeImage(kSize, kSize, [](int x, int y) {
                                        const bool lit = x / 32 % 6 == 0 && y / 32 % 5 == 0;
                                        return lit ? glm::u8vec4(250, 30 + x % 32, 99, 255) : glm::u8vec4(0, 0, 0, 255);
                                      })));
  m.base_color_texture.scale = m.emissive_texture.scale = {0.3f, 0.2f};
  return scene;
}

TEST(ShadeFragments, FloatByFloatGivesTheLanesBits) {
  const FloatShader shader;
  std::vector<Scene> scenes = {EverythingTextured(), SpotsOfEmission(1024), SpotsOfEmission(64)};
  for (const int first_group : {5, 4, 3}) scenes.push_back(TexturedInGroups(first_group));
  for (const char* name : {"room", "showcase"}) scenes.push_back(LoadGltf(Bundled(name)).scene);
  for (const Scene& scene : scenes) {
    RenderSettings settings;
    settings.width = settings.height = 96;
    settings.environment_size = 256;
    settings.shader = &shader;
    const Film one_by_one = Render(scene, settings);
    settings.shader = nullptr;
    for (const Target target : AvailableTargets()) {
      const ScopedTarget scoped(target);
      EXPECT_TRUE(SameBytes(Render(scene, settings), one_by_one)) << TargetName(target);
    }
  }
}

TEST(DoubleShader, UnlitTexelsAndColorsAreTheSameBits) {
  Scene scene;
  Sampler nearest;
  nearest.magnification = nearest.minification = Filter::Nearest;
  nearest.mip = MipFilter::None;
  Material textured = Unlit(glm::vec4(1.0f));
  textured.base_color_texture = Ref(AddTexture(
      scene, MakeImage(5, 5, [](int x, int y) { return glm::u8vec4(40 * x + 7, 30 * y + 11, 17 * (x + y) + 3, 255); }),
      nearest));
  Add(scene, Rectangle(-1, -1, 0, 1), AddMaterial(scene, textured));
  Add(scene, Rectangle(0, -1, 1, 0), AddMaterial(scene, Unlit({0.3f, 0.7f, 0.123f, 1.0f})));
  Add(scene, Rectangle(0, 0, 1, 1), AddMaterial(scene, Unlit({0.3f, 1.0f, 0.1f, 0.6f}, AlphaMode::Blend)));
  // 100 pixels to 5 texels a side: no pixel's centre is on the edge of two.
  const Films films = Draw(scene, Settings(200, 200, 1, Orthographic(1.0)));
  EXPECT_TRUE(SameBytes(films.lanes, films.exact));
  EXPECT_GT(films.exact.pixels[std::size_t(150) * 200 + 150].r, 0.0f);
}

// What the alpha test keeps is the lanes' choice, so coverage has the same bits; what is blended differs by roundings.
TEST(DoubleShader, MaskedAndBlendedMaterials) {
  for (AlphaMode mode : {AlphaMode::Mask, AlphaMode::Blend}) {
    Scene scene = EverythingTextured();
    scene.materials[0].alpha_mode = mode;
    scene.materials[0].alpha_cutoff = 0.6f;
    RenderSettings settings = Settings(96, 96, 4, Perspective(0.7, {0, 0.2, 5}));
    settings.environment.kind = EnvironmentSettings::Kind::Studio;
    const Films films = Draw(scene, settings);
    ExpectRounding(films, mode == AlphaMode::Mask ? "mask" : "blend", kTextured);
    if (mode == AlphaMode::Blend) continue;
    for (std::size_t i = 0; i < films.exact.pixels.size(); ++i) {
      ASSERT_EQ(films.lanes.pixels[i].a, films.exact.pixels[i].a) << i;
    }
  }
}

// --- Single fragments
// ---------------------------------------------------------------------------------------------------

constexpr std::size_t kCount = 4096;

// Unlit fragments of vertex colours, one setup each.
struct Fragments {
  std::vector<std::int32_t> setup;
  std::vector<float> x, y, setups, red, green, blue, alpha;
  FrameMaterial material;
  LightingData lighting;
  std::uint64_t non_finite = 0;

  explicit Fragments(std::size_t count)
      : setup(count),
        x(count),
        y(count),
        setups(count * std::size_t(AttributeLayout::Stride(0))),
        red(count),
        green(count),
        blue(count),
        alpha(count) {
    for (std::size_t i = 0; i < count; ++i) setup[i] = std::int32_t(i);
    material.vertex_colors = true;
    material.model = ShadingModel::Unlit;
  }
  ShadeTask Task() {
    ShadeTask task;
    task.setup = setup.data();
    task.x = x.data();
    task.y = y.data();
    task.count = setup.size();
    task.setups = setups.data();
    task.material = &material;
    task.lighting = &lighting;
    task.red = red.data();
    task.green = green.data();
    task.blue = blue.data();
    task.alpha = alpha.data();
    task.non_finite = &non_finite;
    return task;
  }
};

// Perspective-correct colours from the setup's floats in long double: the double shader gives that number rounded to
// float, the lanes one that is some roundings away.
TEST(DoubleShader, GivesTheExactNumberRoundedOnce) {
  Uniform random(7);
  Fragments f(kCount);
  std::vector<float> expected(kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    float* setup = &f.setups[i * std::size_t(AttributeLayout::Stride(0))];
    f.x[i] = float(random(0, 64)), f.y[i] = float(random(0, 64));
    long double sum = 0, weighted = 0;
    for (int v = 0; v < 3; ++v) {
      float* plane = setup + AttributeLayout::kPlanes + 3 * v;
      plane[0] = float(random(0, 0.01)), plane[1] = float(random(0, 0.01)), plane[2] = float(random(0.1, 1));
      float* color = setup + AttributeLayout::kColors + 4 * v;
      for (int c = 0; c < 4; ++c) color[c] = float(random(0.1, 1));
      const long double e = (long double)plane[0] * f.x[i] + (long double)plane[1] * f.y[i] + (long double)plane[2];
      sum += e, weighted += e * color[0];
    }
    expected[i] = float(weighted / sum);
  }
  MakeDoubleShader()->Shade(f.Task());
  std::size_t inexact = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    inexact += f.red[i] != expected[i];
    EXPECT_LE(Ulps(f.red[i], expected[i]), 1) << i;
  }
  EXPECT_LE(inexact, 1u);  // halfway between two floats, to within a double's rounding: one in a hundred million
  ShadeFragments(f.Task());
  std::size_t rounded = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    rounded += f.red[i] != expected[i];
    EXPECT_LE(Ulps(f.red[i], expected[i]), 8) << i;
  }
  EXPECT_GT(rounded, kCount / 10);
}

TEST(DoubleShader, WhatNoFloatHoldsIsBlackAndCounted) {
  Fragments f(16);
  f.material.factors.base_color[0] = 2.0f;
  const float largest = std::numeric_limits<float>::max();
  const float reds[3] = {largest, std::numeric_limits<float>::quiet_NaN(), 0.25f};
  for (std::size_t i = 0; i < 16; ++i) {
    float* setup = &f.setups[i * std::size_t(AttributeLayout::Stride(0))];
    for (int v = 0; v < 3; ++v) {
      setup[AttributeLayout::kPlanes + 3 * v + 2] = 1.0f;
      for (int c = 0; c < 4; ++c)
        setup[AttributeLayout::kColors + 4 * v + c] = c == 0 ? reds[i % 3] : c == 3 ? 3.0f : 0.5f;
    }
  }
  for (bool in_double : {true, false}) {
    f.non_finite = 0;
    if (in_double) {
      MakeDoubleShader()->Shade(f.Task());
    } else {
      ShadeFragments(f.Task());
    }
    EXPECT_EQ(f.non_finite, 11u) << in_double;  // 6 too large, 5 not a number
    for (std::size_t i = 0; i < 16; ++i) {
      const bool good = i % 3 == 2;
      EXPECT_EQ(f.red[i], good ? 0.5f : 0.0f) << i;
      EXPECT_NEAR(f.green[i], good ? 0.5f : 0.0f, 1e-6) << i;
      EXPECT_EQ(f.alpha[i], good ? 1.0f : 0.0f) << i;
    }
  }
}

// Min and Max are selections on lanes and in double alike: a zero's sign is the same.
TEST(DoubleShader, NegativeZeroOfAlphaIsZero) {
  Fragments f(16);
  for (std::size_t i = 0; i < 16; ++i) {
    float* setup = &f.setups[i * std::size_t(AttributeLayout::Stride(0))];
    for (int v = 0; v < 3; ++v) {
      setup[AttributeLayout::kPlanes + 3 * v + 2] = 1.0f;
      setup[AttributeLayout::kColors + 4 * v + 3] = -0.0f;
    }
  }
  MakeDoubleShader()->Shade(f.Task());
  const std::vector<float> in_double = f.alpha;
  ShadeFragments(f.Task());
  for (std::size_t i = 0; i < 16; ++i) {
    EXPECT_EQ(std::bit_cast<std::uint32_t>(in_double[i]), 0u) << i;
    EXPECT_EQ(std::bit_cast<std::uint32_t>(f.alpha[i]), 0u) << i;
  }
}

}  // namespace
}  // namespace facet
