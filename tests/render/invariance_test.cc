// The image is a function of the scene and the settings alone: not of instruction sets, threads, tiles or the host's
// floating-point state.
#include <gtest/gtest.h>

#include <cfenv>

#include "render/hand_built.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace facet {
namespace {

// Something of everything: lit and textured, normal-mapped, masked, blended, lines, points, lights, an environment.
Scene Everything() {
  Scene scene;
  Uniform random(11);
  const auto noise = [&](int alpha) {
    return MakeImage(37, 53, [&](int, int) {
      return glm::u8vec4(random() * 256, random() * 256, random() * 256, alpha < 0 ? random() * 256 : alpha);
    });
  };
  const int colors = AddTexture(scene, noise(-1)), data = AddTexture(scene, noise(255));
  Material lit;
  lit.base_color_texture = Ref(colors);
  lit.metallic_roughness_texture = Ref(data);
  lit.normal_texture = Ref(data);
  lit.normal_scale = 0.3f;
  lit.occlusion_texture = Ref(data);
  lit.emissive_texture = Ref(colors);
  lit.emissive_factor = glm::vec3(0.1f);
  lit.base_color_texture.scale = {3.0f, 2.0f};
  lit.base_color_texture.rotation = 0.4f;
  Add(scene, Sphere(1.0f, 24, 40), AddMaterial(scene, lit));
  Material mask = lit;
  mask.alpha_mode = AlphaMode::Mask;
  mask.double_sided = true;
  Transform place;
  place.translation = {0.3, 0.0, 0.6};
  place.rotation = glm::normalize(glm::dquat(0.9, 0.3, 0.2, 0.1));
  Add(scene, Rectangle(-1.2f, -1.0f, 1.0f, 1.1f), AddMaterial(scene, mask), place);
  Material blend = lit;
  blend.alpha_mode = AlphaMode::Blend;
  blend.double_sided = true;
  blend.metallic_factor = 0.2f;
  for (int i = 0; i < 4; ++i) {
    place.rotation = glm::normalize(glm::dquat(random(-1, 1), random(-1, 1), random(-1, 1), random(-1, 1)));
    Add(scene, Rectangle(-1.2f, -1.0f, 1.0f, 1.1f), AddMaterial(scene, blend), place);
  }
  for (Topology topology : {Topology::LineStrip, Topology::Points}) {
    Primitive p;
    p.topology = topology;
    for (int i = 0; i < 40; ++i) {
      p.positions.emplace_back(random(-1.5, 1.5), random(-1.5, 1.5), random(-1.5, 1.5));
      p.colors.emplace_back(random(), random(), random(), 1.0);
    }
    Add(scene, p, -1);
  }
  for (LightType type : {LightType::Directional, LightType::Point, LightType::Spot}) {
    Light light;
    light.type = type;
    light.intensity = 5.0f;
    scene.lights.push_back(light);
    Node node;
    node.light = int(scene.lights.size()) - 1;
    node.transform.translation = {0.5, 0.4, 2.5};
    scene.nodes.push_back(node);
  }
  return scene;
}

RenderSettings EverythingSettings() {
  RenderSettings settings = Settings(150, 101, 4, OrbitCamera{0.4, 1.2, 3.0, glm::dvec3(0.0), 0.9});
  settings.environment.kind = EnvironmentSettings::Kind::Studio;
  settings.environment.rotation = 0.7;
  settings.background = Background::Environment;
  for (const PlaneInfo& plane : kPlanes) settings.planes.push_back(plane.kind);
  return settings;
}

void ExpectSameCounts(const RenderStats& a, const RenderStats& b) {
  EXPECT_EQ(a.fragments_shaded, b.fragments_shaded);
  EXPECT_EQ(a.fragments_blended, b.fragments_blended);
  EXPECT_EQ(a.covered_pixels, b.covered_pixels);
  EXPECT_EQ(a.triangles_binned, b.triangles_binned);
  EXPECT_EQ(a.triangles_culled, b.triangles_culled);
  EXPECT_EQ(a.triangles_clipped, b.triangles_clipped);
  EXPECT_EQ(a.non_finite_fragments, b.non_finite_fragments);
}

class Invariance : public testing::Test {
 protected:
  void SetUp() override { film_ = Render(scene_, settings_, &stats_); }

  Scene scene_ = Everything();
  RenderSettings settings_ = EverythingSettings();
  RenderStats stats_;
  Film film_;
};

TEST_F(Invariance, TheSceneShowsSomethingOfEverything) {
  EXPECT_GT(stats_.fragments_shaded, 5000u);
  EXPECT_GT(stats_.fragments_blended, 2000u);
  EXPECT_EQ(stats_.images_decoded, 2u);
  EXPECT_EQ(stats_.non_finite_fragments, 0u);
  EXPECT_EQ(stats_.threads, 2);
  for (const glm::vec4& pixel : film_.pixels) {
    for (int c = 0; c < 4; ++c) ASSERT_TRUE(std::isfinite(pixel[c]) && pixel[c] >= 0.0f);
  }
  EXPECT_EQ(film_.planes.size(), std::size(kPlanes));
}

TEST_F(Invariance, InstructionSets) {
  for (Target target : AvailableTargets()) {
    const ScopedTarget forced(target);
    RenderStats stats;
    EXPECT_TRUE(SameBytes(Render(scene_, settings_, &stats), film_)) << TargetName(target);
    EXPECT_EQ(stats.target, TargetName(target));
    ExpectSameCounts(stats, stats_);
  }
}

TEST_F(Invariance, Threads) {
  for (int threads : {1, 2, 3, 8}) {
    settings_.threads = threads;
    RenderStats stats;
    EXPECT_TRUE(SameBytes(Render(scene_, settings_, &stats), film_)) << threads;
    ExpectSameCounts(stats, stats_);
  }
}

TEST_F(Invariance, TileSizes) {
  for (int samples : {1, 2, 4, 8}) {
    settings_.samples = samples;
    settings_.tile_size = 32;
    const Film expected = Render(scene_, settings_);
    for (int tile_size : {8, 16, 64}) {
      settings_.tile_size = tile_size;
      EXPECT_TRUE(SameBytes(Render(scene_, settings_), expected)) << samples << " samples, tiles of " << tile_size;
    }
  }
}

// Where each alpha test is decided must not depend on what else happens to lie in the same tile.
TEST(InvarianceOfMasks, TileSizesAndOrder) {
  Scene scene;
  Uniform random(3);
  Material mask = Unlit(glm::vec4(1.0f), AlphaMode::Mask);
  mask.base_color_texture =
      Ref(AddTexture(scene, MakeImage(64, 64, [&](int, int) {
                       return glm::u8vec4(random() * 256, random() * 256, random() * 256, random() * 256);
                     })));
  const int material = AddMaterial(scene, mask);
  Primitive p;
  p.tex_coords.resize(1);
  for (int i = 0; i < 3 * 600; ++i) {
    p.positions.emplace_back(random(-1, 1), random(-1, 1), random(-1, 1));
    p.tex_coords[0].emplace_back(random(0, 3), random(0, 3));
  }
  Add(scene, p, material);
  RenderSettings settings = Settings(96, 96, 4, Orthographic(1.0));
  settings.planes = {PlaneKind::Depth};
  settings.tile_size = 64;
  const Film expected = Render(scene, settings);
  for (int tile_size : {8, 16, 32}) {
    settings.tile_size = tile_size;
    EXPECT_TRUE(SameBytes(Render(scene, settings), expected)) << tile_size;
  }
  Primitive& shuffled = scene.meshes[0].primitives[0];
  for (std::size_t i = 0; i + 1 < 600; ++i) {
    const std::size_t k = i + std::size_t(random() * double(600 - i));
    for (std::size_t v = 0; v < 3; ++v) {
      std::swap(shuffled.positions[3 * i + v], shuffled.positions[3 * k + v]);
      std::swap(shuffled.tex_coords[0][3 * i + v], shuffled.tex_coords[0][3 * k + v]);
    }
  }
  EXPECT_TRUE(SameBytes(Render(scene, settings), expected)) << "in another order";
}

// A tile of a million fragments is shaded in pieces.
TEST(InvarianceOfLayers, TileSizes) {
  Scene scene;
  Material material;
  material.alpha_mode = AlphaMode::Blend;
  material.base_color_factor = {0.9f, 0.5f, 0.2f, 0.02f};
  const int thin = AddMaterial(scene, material);
  material.base_color_factor = {0.1f, 0.6f, 0.9f, 0.03f};
  material.metallic_factor = 0.0f;
  const int other = AddMaterial(scene, material);
  constexpr int kLayers = 600;
  for (int i = 0; i < kLayers; ++i) Add(scene, Rectangle(-1, -1, 1, 1, float(i) * 1e-3f), i % 2 == 0 ? thin : other);
  RenderSettings settings = Settings(64, 64, 1, Orthographic(1.0));
  settings.environment = ConstantEnvironment(1.0f);
  settings.environment_size = 64;
  settings.tile_size = 64;
  RenderStats stats;
  const Film film = Render(scene, settings, &stats);
  EXPECT_EQ(stats.fragments_blended, std::uint64_t{64 * 64 * kLayers});
  settings.tile_size = 8;
  EXPECT_TRUE(SameBytes(Render(scene, settings), film));
}

TEST_F(Invariance, Repetition) {
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(SameBytes(Render(scene_, settings_), film_));
}

TEST_F(Invariance, TheHostsFloatingPointState) {
  for (int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    ASSERT_EQ(std::fesetround(mode), 0);
#if defined(__x86_64__)
    constexpr unsigned kFlush = 0x8040;  // FTZ and DAZ
    _mm_setcsr(_mm_getcsr() | kFlush);
#endif
    RenderStats stats;
    const Film film = Render(scene_, settings_, &stats);
    const int mode_after = std::fegetround();
#if defined(__x86_64__)
    const unsigned flush_after = _mm_getcsr() & kFlush;
    _mm_setcsr(_mm_getcsr() & ~kFlush);
#endif
    std::fesetround(FE_TONEAREST);
    EXPECT_EQ(mode_after, mode) << "the host's rounding mode is given back";
#if defined(__x86_64__)
    EXPECT_EQ(flush_after, kFlush);
#endif
    EXPECT_TRUE(SameBytes(film, film_)) << mode;
    ExpectSameCounts(stats, stats_);
  }
}

}  // namespace
}  // namespace facet
