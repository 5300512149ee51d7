// Surfaces that are seen through: transmission, volume and dispersion.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "render/hand_built.h"

namespace facet {
namespace {

constexpr int kSize = 64;

Material Glass(const glm::vec3& color, float roughness = 0.0f) {
  Material m;
  m.base_color_factor = glm::vec4(color, 1.0f);
  m.metallic_factor = 0.0f;
  m.roughness_factor = roughness;
  m.transmission_factor = 1.0f;
  return m;
}

Material Slab(float thickness, float ior, float roughness = 0.0f) {
  Material m = Glass(glm::vec3(1.0f), roughness);
  m.thickness_factor = thickness;
  m.ior = ior;
  return m;
}

Transform At(const glm::dvec3& position, const glm::dquat& rotation = glm::dquat(1, 0, 0, 0),
             const glm::dvec3& scale = glm::dvec3(1.0)) {
  Transform t;
  t.translation = position;
  t.rotation = rotation;
  t.scale = scale;
  return t;
}

// Triangles of several colours, none of whose edges follow pixels.
void AddPattern(Scene& scene, float z) {
  for (int i = 0; i < 7; ++i) {
    const float a = 0.4f + float(i) * 0.83f;
    Primitive p;
    p.positions = {{std::cos(a), std::sin(a), z + 0.01f * float(i)},
                   {std::cos(a + 2.1f), std::sin(a + 2.1f), z + 0.01f * float(i)},
                   {0.6f * std::cos(a + 3.9f), 0.6f * std::sin(a + 3.9f), z + 0.01f * float(i)}};
    const int material = AddMaterial(scene, Unlit({0.1f + 0.1f * float(i), 0.9f - 0.1f * float(i), 0.5f, 1.0f}));
    Add(scene, std::move(p), material);
  }
}

// A wall behind everything, of one colour.
void AddWall(Scene& scene, float z, const glm::vec3& color) {
  Add(scene, Rectangle(-30, -30, 30, 30, z), AddMaterial(scene, Unlit(glm::vec4(color, 1.0f))));
}

void AddPane(Scene& scene, float z, const Material& material, float half = 2.0f) {
  Add(scene, Rectangle(-half, -half, half, half, z), AddMaterial(scene, material));
}

RenderSettings FlatView(int samples = 4) { return Settings(kSize, kSize, samples, Orthographic(1.0)); }

const glm::vec4& PixelAt(const Film& film, int x, int y) {
  return film.pixels[std::size_t(y) * std::size_t(film.width) + std::size_t(x)];
}

void ExpectNear(const glm::vec4& got, const glm::vec4& want, float tolerance) {
  for (int c = 0; c < 4; ++c) EXPECT_NEAR(got[c], want[c], tolerance) << "component " << c;
}

// A lamp far behind, which shines at the camera.
void AddLampBehind(Scene& scene) {
  Light light;
  light.type = LightType::Directional;
  light.intensity = 3.0f;
  scene.lights.push_back(light);
  Node node;
  node.light = 0;
  node.transform.rotation = glm::dquat(std::cos(1.4), 0.0, std::sin(1.4), 0.0);
  scene.nodes.push_back(node);
}

// What a smooth clear pane lets pass, straight ahead: 1 - 0.04.
constexpr float kClear = 0.96f;

TEST(Transmission, AThinPaneShowsWhatIsBehindTimesItsTint) {
  for (const int samples : {1, 2, 4, 8}) {
    Scene scene;
    AddWall(scene, -3, {0.2f, 0.3f, 0.4f});
    AddPattern(scene, -1);
    const Film bare = Render(scene, FlatView(samples));
    AddPane(scene, 0, Glass({0.5f, 0.75f, 1.0f}));
    const Film seen = Render(scene, FlatView(samples));
    for (std::size_t i = 0; i < bare.pixels.size(); ++i) {
      const glm::vec4 want = bare.pixels[i] * glm::vec4(0.5f * kClear, 0.75f * kClear, kClear, 1.0f);
      for (int c = 0; c < 4; ++c) ASSERT_NEAR(seen.pixels[i][c], want[c], 2e-3f) << i;
      // The pane is the same everywhere, also where several surfaces share a pixel.
      const float tint = seen.pixels[0].x / bare.pixels[0].x;
      ASSERT_NEAR(seen.pixels[i].x, bare.pixels[i].x * tint, 1e-6f) << i;
    }
  }
}

TEST(Transmission, PanesMultiplyInEitherOrderOfSubmission) {
  const Material red = Glass({1.0f, 0.5f, 0.25f}), blue = Glass({0.3f, 0.6f, 0.9f});
  Film films[2];
  for (const bool swapped : {false, true}) {
    Scene scene;
    AddWall(scene, -3, {0.8f, 0.6f, 0.5f});
    if (!swapped) AddPane(scene, 0, red);
    AddPane(scene, 1, blue);
    if (swapped) AddPane(scene, 0, red);
    films[swapped] = Render(scene, FlatView());
  }
  EXPECT_TRUE(SameBytes(films[0], films[1]));
  const float both = kClear * kClear;
  ExpectNear(PixelAt(films[0], 20, 30), {0.8f * 0.3f * both, 0.6f * 0.3f * both, 0.5f * 0.225f * both, 1.0f}, 2e-3f);
}

TEST(Transmission, BlendedSurfacesBetweenPanesAreInTheirPlace) {
  Scene scene;
  AddWall(scene, -3, {0.8f, 0.6f, 0.5f});
  AddPane(scene, 2, Glass({1.0f, 0.5f, 0.5f}));
  AddPane(scene, 0, Glass({0.5f, 1.0f, 0.5f}));
  AddPane(scene, 1, Unlit({0.2f, 0.4f, 0.6f, 0.25f}, AlphaMode::Blend));
  const Film film = Render(scene, FlatView());
  const glm::vec3 front = glm::vec3(1.0f, 0.5f, 0.5f) * kClear, rear = glm::vec3(0.5f, 1.0f, 0.5f) * kClear;
  const glm::vec3 want = front * (glm::vec3(0.2f, 0.4f, 0.6f) * 0.25f + 0.75f * rear * glm::vec3(0.8f, 0.6f, 0.5f));
  ExpectNear(PixelAt(film, 20, 30), glm::vec4(want, 1.0f), 2e-3f);
}

TEST(Transmission, AlphaIsCoverageOnTop) {
  for (const AlphaMode mode : {AlphaMode::Opaque, AlphaMode::Mask, AlphaMode::Blend}) {
    Scene scene;
    AddWall(scene, -3, {0.8f, 0.6f, 0.5f});
    Material m = Glass({0.5f, 0.5f, 0.5f});
    m.base_color_factor.a = 0.25f;
    m.alpha_mode = mode;
    AddPane(scene, 0, m);
    const float covers = mode == AlphaMode::Opaque ? 1.0f : mode == AlphaMode::Mask ? 0.0f : 0.25f;
    const float passes = covers * 0.5f * kClear + (1.0f - covers);
    ExpectNear(PixelAt(Render(scene, FlatView()), 9, 9), {0.8f * passes, 0.6f * passes, 0.5f * passes, 1.0f}, 2e-3f);
  }
}

TEST(Transmission, LeavesATransparentBackgroundTransparent) {
  Scene scene;
  AddPane(scene, 0, Glass({0.2f, 0.4f, 0.9f}));
  AddPane(scene, 1, Slab(0.2f, 1.5f, 0.5f));
  const Film film = Render(scene, FlatView());
  ExpectNear(PixelAt(film, 20, 20), {0, 0, 0, 1.0f - 0.5f * kClear * kClear}, 3e-3f);
}

// A background that is chosen for a picture shows through each channel by its own tint; alpha has only the mean.
TEST(Transmission, ABackgroundShowsThroughInTheColourOfTheGlass) {
  const glm::vec3 tint(0.2f, 0.4f, 0.9f), back(0.8f, 0.5f, 0.3f);
  DisplaySettings display;
  display.background_srgb = back;
  for (const int samples : {1, 4}) {
    Scene scene;
    AddPane(scene, 0, Glass(tint), 0.5f);
    Add(scene, Rectangle(-0.1f, -0.5f, 0.1f, 0.5f, 0.5f), AddMaterial(scene, Unlit({0.1f, 0.2f, 0.3f, 1.0f})));
    Material half = Glass({1.0f, 0.0f, 0.0f});
    half.alpha_mode = AlphaMode::Blend;
    half.base_color_factor.a = 0.5f;
    Add(scene, Rectangle(0.2f, -0.5f, 0.3f, 0.5f, 0.5f), AddMaterial(scene, half));
    Renderer renderer(scene);
    Film film;
    renderer.Render(FlatView(samples), film);
    const Image image = EncodeFilm(film, display, ChannelType::F32);
    ASSERT_EQ(image.channels, 3);
    const auto at = [&](int x, int y) {
      const float* p = image.As<float>() + 3 * (y * kSize + x);
      return glm::vec3(p[0], p[1], p[2]);
    };
    glm::vec3 linear;
    for (int c = 0; c < 3; ++c) linear[c] = std::pow((back[c] + 0.055f) / 1.055f, 2.4f);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(at(20, 32)[c], linear[c] * tint[c] * kClear, 2e-3f) << c;
      EXPECT_NEAR(at(2, 2)[c], linear[c], 1e-6f) << c;
      EXPECT_NEAR(at(32, 32)[c], 0.1f * float(c + 1), 1e-6f) << c;
      const float half_passes = 0.5f + (c == 0 ? 0.5f * kClear : 0.0f);
      EXPECT_NEAR(at(40, 32)[c], linear[c] * tint[c] * kClear * half_passes, 2e-3f) << c;
    }
    // The same in pictures that are encoded tile by tile, and in bands.
    for (const ChannelType type : {ChannelType::U8, ChannelType::U16, ChannelType::F32}) {
      const Image whole = EncodeFilm(film, display, type);
      Image direct;
      renderer.RenderImage(FlatView(samples), display, direct, nullptr, type);
      EXPECT_EQ(direct.bytes, whole.bytes);
      Image bands = whole;
      bands.bytes.clear();
      RenderBands(scene, FlatView(samples), 16, [&](const Film& band, int) {
        const Image part = EncodeFilm(band, display, type);
        bands.bytes.insert(bands.bytes.end(), part.bytes.begin(), part.bytes.end());
      });
      EXPECT_EQ(bands.bytes, whole.bytes);
    }
    // The next frame, which has no glass, has none of it.
    RenderSettings opaque = FlatView(samples);
    opaque.without = {Feature::Transmission};
    renderer.Render(opaque, film);
    EXPECT_TRUE(film.through.empty());
  }
}

TEST(Transmission, WhiteGlassInAnEvenLightCannotBeSeen) {
  for (const Material& glass :
       {Glass(glm::vec3(1.0f)), Glass(glm::vec3(1.0f), 0.6f), Slab(0.5f, 1.5f), Slab(0.5f, 2.0f, 0.4f), [] {
          Material m = Slab(0.5f, 1.7f, 0.1f);
          m.dispersion = 5.0f;
          return m;
        }()}) {
    Scene scene;
    Add(scene, Sphere(0.8f, 24, 48), AddMaterial(scene, glass));
    RenderSettings settings = Settings(kSize, kSize, 4, Perspective(0.3, {0, 0, 6}));
    settings.environment = ConstantEnvironment(2.0f);
    settings.background = Background::Environment;
    const Film film = Render(scene, settings);
    for (const glm::vec4& p : film.pixels) {
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(p[c], 2.0f, 0.01f);
      ASSERT_NEAR(p.a, 1.0f, 1e-6f);
    }
  }
}

// The sum over a row of a picture whose left part is dark and whose right part is bright is, up to a factor, where the
// edge between them is.
TEST(Transmission, ASlabShiftsWhatIsBehindBySnellsLaw) {
  for (const double angle : {0.0, 0.3, 0.9}) {
    for (const float ior : {1.0f, 1.5f, 2.4f}) {
      Scene scene;
      AddWall(scene, -9, {0.0f, 0.0f, 0.0f});
      Add(scene, Rectangle(0, -30, 30, 30, -8), AddMaterial(scene, Unlit(glm::vec4(1.0f))));
      const float scale = 0.5f, thickness = 0.6f;
      const auto turn = glm::dquat(std::cos(angle / 2), 0, std::sin(angle / 2), 0);
      Add(scene, Rectangle(-9, -9, 9, 9), AddMaterial(scene, Slab(thickness, ior)),
          At({0, 0, 0}, turn, glm::dvec3(double(scale))));
      const Film film = Render(scene, FlatView());
      double sum = 0.0;
      for (int x = 0; x < kSize; ++x) sum += double(PixelAt(film, x, 17).x / PixelAt(film, kSize - 1, 17).x);
      // The normal leans to +x, so the view is refracted to -x, and sees what is there further to the right.
      const double inside = std::asin(std::sin(angle) / double(ior));
      const double shift = -double(thickness * scale) * std::sin(angle - inside);
      const double edge = (1.0 - shift) * kSize / 2;
      EXPECT_NEAR(kSize - sum, edge, 1e-3) << angle << " " << ior;
    }
  }
}

// Light that passes a surface diffusely is absorbed by the volume behind it as what is seen through it is, over the
// thickness in metres; behind back faces there is none, nor where a texel says so.
TEST(Transmission, AVolumeAbsorbsWhatPassesDiffusely) {
  const float thickness = 0.6f, scale = 0.5f;
  for (const ShadingModel model : {ShadingModel::MetallicRoughness, ShadingModel::SpecularGlossiness}) {
    for (const float transmission : {0.0f, 0.5f}) {
      for (const int side : {0, 1, 2}) {  // front, back, front where the texture is 0
        Scene scene;
        AddLampBehind(scene);
        Material m;
        m.model = model;
        m.metallic_factor = 0.0f;
        m.specular_glossiness_specular_factor = glm::vec3(0.04f);
        m.diffuse_transmission_factor = 1.0f;
        m.transmission_factor = transmission;
        m.ior = 1.0f;
        m.double_sided = true;
        if (side == 2) {
          m.thickness_texture = Ref(AddTexture(scene, MakeImage(1, 1, [](int, int) { return glm::u8vec4(0); })));
        }
        const int material = AddMaterial(scene, m);
        const auto turn = side == 1 ? glm::dquat(0, 0, 1, 0) : glm::dquat(1, 0, 0, 0);
        Add(scene, Rectangle(-9, -9, 9, 9), material, At({0, 0, 0}, turn, glm::dvec3(double(scale))));
        RenderSettings settings = FlatView();
        settings.without = {Feature::Transmission};
        if (transmission > 0.0f) settings.without = {};
        const glm::vec4 thin = PixelAt(Render(scene, settings), 20, 20);
        EXPECT_GT(thin.y, 0.1f);
        Material& thick = scene.materials[std::size_t(material)];
        thick.thickness_factor = thickness;
        thick.attenuation_color = {0.5f, 1.0f, 0.25f};
        thick.attenuation_distance = 0.3f;
        const glm::vec4 pixel = PixelAt(Render(scene, settings), 20, 20);
        for (int c = 0; c < 3; ++c) {
          const float path = side == 0 ? thickness * scale / 0.3f : 0.0f;
          EXPECT_NEAR(pixel[c] / thin[c], std::pow(thick.attenuation_color[c], path), 1e-5f)
              << c << " of " << side << ", transmission " << transmission;
        }
      }
    }
  }
}

// Where no volume begins, a rough surface spreads light as a thin wall does: twice as wide as glass of 1.5 would.
TEST(Transmission, WhereNoVolumeBeginsTheWallIsThin) {
  const auto seen = [](int kind) {  // 0: a thin wall, 1: a volume, 2: from behind, 3: where the texture is 0
    Scene scene;
    AddWall(scene, -1.0001f, {0, 0, 0});
    Add(scene, Rectangle(0, -30, 30, 30, -1), AddMaterial(scene, Unlit(glm::vec4(1.0f))));
    Material m = Slab(kind == 0 ? 0.0f : 0.01f, 1.5f, 0.4f);
    m.double_sided = true;
    m.attenuation_color = glm::vec3(0.01f);
    m.attenuation_distance = 0.01f;
    if (kind == 3) {
      m.thickness_texture = Ref(AddTexture(scene, MakeImage(1, 1, [](int, int) { return glm::u8vec4(0); })));
    }
    Add(scene, Rectangle(-2, -2, 2, 2), AddMaterial(scene, m),
        At({0, 0, 0}, kind == 2 ? glm::dquat(0, 0, 1, 0) : glm::dquat(1, 0, 0, 0)));
    return Render(scene, Settings(kSize, kSize, 4, Perspective(0.3, {0, 0, 6})));
  };
  const Film thin = seen(0), volume = seen(1);
  for (const int kind : {2, 3}) {
    const Film film = seen(kind);
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
      for (int c = 0; c < 4; ++c) ASSERT_NEAR(film.pixels[i][c], thin.pixels[i][c], 1e-5f) << kind << " at " << i;
    }
  }
  const auto width = [](const Film& film) {  // of the blurred edge, in pixels, from its steepest step
    float steepest = 0.0f;
    for (int x = 1; x < kSize; ++x) {
      steepest = std::max(steepest, PixelAt(film, x, 32).x - PixelAt(film, x - 1, 32).x);
    }
    return PixelAt(film, kSize - 1, 32).x / steepest;
  };
  EXPECT_GT(width(thin), 2.5f * width(volume));
}

TEST(Transmission, NothingInFrontIsSeenThrough) {
  for (const float roughness : {0.0f, 0.2f, 0.7f}) {
    for (const float thickness : {0.0f, 0.5f, 3.0f}) {
      const auto add_front = [](Scene& scene) {
        Add(scene, Rectangle(-0.1f, -2, 0.15f, 2, 1.5f), AddMaterial(scene, Unlit({1, 0, 0, 1})));
        Add(scene, Rectangle(0.4f, -0.3f, 0.6f, 0.3f, 1.2f), AddMaterial(scene, Unlit({1, 0, 0, 1})));
      };
      Scene front, scene;
      add_front(front), add_front(scene);
      AddWall(scene, -3, {0, 1, 0});
      Material slab = Slab(thickness, 1.5f, roughness);
      slab.dispersion = 2.0f;
      Add(scene, Sphere(0.9f, 40, 80), AddMaterial(scene, slab));
      const RenderSettings settings = Settings(kSize, kSize, 4, Perspective(0.5, {0, 0, 5}));
      const Film covered = Render(front, settings), film = Render(scene, settings);
      for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        if (covered.pixels[i].a > 0.0f) continue;
        ASSERT_EQ(film.pixels[i].x, 0.0f) << i << " " << roughness << " " << thickness;
      }
    }
  }
}

// A bar in front of a ball hides a part of what the ball shows elsewhere. What is missing is filled from around: over a
// wall whose colour changes evenly, that is what is there, and nowhere is there a seam.
TEST(Transmission, WhatABarInFrontHidesIsFilledWithoutASeam) {
  const auto add_all = [](Scene& scene, float roughness, bool bar) {
    Primitive wall = Rectangle(-9, -9, 9, 9, -3);
    for (const glm::vec3& at : wall.positions) wall.colors.emplace_back(0.5 + at.x / 6.0, 0.5 + at.y / 6.0, 0.5, 1.0);
    Add(scene, std::move(wall), AddMaterial(scene, Unlit(glm::vec4(1.0f))));
    Add(scene, Sphere(0.9f, 64, 128), AddMaterial(scene, Slab(0.9f, 1.5f, roughness)));
    if (bar) Add(scene, Rectangle(-0.07f, -2, 0.08f, 2, 1.5f), AddMaterial(scene, Unlit({1, 0, 0, 1})));
  };
  for (const float roughness : {0.0f, 0.2f}) {
    Scene with, without, front;
    add_all(with, roughness, true), add_all(without, roughness, false);
    Add(front, Rectangle(-0.07f, -2, 0.08f, 2, 1.5f), AddMaterial(front, Unlit({1, 0, 0, 1})));
    const RenderSettings settings = Settings(96, 96, 4, Perspective(0.4, {0, 0, 6}));
    const Film covered = Render(front, settings), film = Render(with, settings), whole = Render(without, settings);
    double largest = 0.0, sum = 0.0;
    int changed = 0;
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
      if (covered.pixels[i].a > 0.0f || film.pixels[i] == whole.pixels[i]) continue;
      ++changed;
      for (int c = 0; c < 3; ++c) {
        const double off = std::fabs(double(film.pixels[i][c] - whole.pixels[i][c]));
        largest = std::max(largest, off), sum += off / 3;
      }
    }
    EXPECT_GT(changed, 100);
    EXPECT_LT(largest, 0.03) << roughness;
    EXPECT_LT(sum / changed, 0.01) << roughness;
  }
}

TEST(Transmission, BlurGrowsWithTheDistanceBehind) {
  double before = 0.0;
  for (const float behind : {-0.001f, -0.3f, -1.0f}) {
    Scene scene;
    AddWall(scene, behind - 1e-4f, {0, 0, 0});
    Add(scene, Rectangle(0, -30, 30, 30, behind), AddMaterial(scene, Unlit(glm::vec4(1.0f))));
    AddPane(scene, 0, Glass(glm::vec3(1.0f), 0.4f));
    const Film film = Render(scene, Settings(kSize, kSize, 4, Perspective(0.3, {0, 0, 6})));
    double gradient = 0.0;  // sums squares: less for a softer edge
    for (int x = 1; x < kSize; ++x) {
      const double step = double(PixelAt(film, x, 32).x - PixelAt(film, x - 1, 32).x);
      gradient += step * step;
    }
    if (before == 0.0) {
      EXPECT_GT(gradient, 0.4);  // in contact, it is sharp
    } else {
      EXPECT_LT(gradient, 0.7 * before) << behind;
    }
    before = gradient;
  }
}

// Smooth, rough and dispersing glass, blended surfaces, objects in front and behind.
Scene Everything() {
  Scene scene;
  AddWall(scene, -3, {0.2f, 0.3f, 0.4f});
  AddPattern(scene, -1);
  Material disperses = Slab(0.4f, 1.6f);
  disperses.dispersion = 4.0f;
  disperses.attenuation_color = {0.9f, 0.5f, 0.4f};
  disperses.attenuation_distance = 0.7f;
  Add(scene, Sphere(0.4f, 16, 32), AddMaterial(scene, disperses), At({-0.4f, 0.3f, 0.5f}));
  Add(scene, Sphere(0.4f, 16, 32), AddMaterial(scene, Slab(0.3f, 1.4f, 0.35f)), At({0.3f, -0.2f, 0.9f}));
  AddPane(scene, 0.7f, Unlit({0.9f, 0.2f, 0.1f, 0.3f}, AlphaMode::Blend), 0.5f);
  AddPane(scene, 0.8f, Glass({0.7f, 0.9f, 0.8f}, 0.2f), 0.6f);
  Add(scene, Rectangle(-0.05f, -0.6f, 0.07f, 0.8f, 1.5f), AddMaterial(scene, Unlit({0.9f, 0.1f, 0.9f, 1.0f})));
  return scene;
}

TEST(Transmission, TheImageIsTheSameForTilesThreadsBandsAndInstructionSets) {
  const Scene scene = Everything();
  for (const int samples : {1, 4}) {
    RenderSettings settings = Settings(109, 83, samples, Perspective(0.5, {0.2, 0.1, 4.5}));
    settings.environment = ConstantEnvironment(0.7f);
    settings.background = samples == 1 ? Background::Transparent : Background::Environment;
    const Film want = Render(scene, settings);
    for (const int tile : {8, 32, 64}) {
      settings.tile_size = tile;
      settings.threads = tile == 8 ? 1 : 3;
      EXPECT_TRUE(SameBytes(Render(scene, settings), want)) << tile;
      for (const int rows : {1, 40}) {
        Film whole{settings.width, 0, {}};
        RenderBands(scene, settings, rows, [&](const Film& band, int) {
          whole.pixels.insert(whole.pixels.end(), band.pixels.begin(), band.pixels.end());
          whole.height += band.height;
        });
        EXPECT_TRUE(SameBytes(whole, want)) << tile << " " << rows;
      }
    }
    for (const Target target : AvailableTargets()) {
      const ScopedTarget forced(target);
      EXPECT_TRUE(SameBytes(Render(scene, settings), want)) << TargetName(target);
    }
  }
}

TEST(Transmission, GlassOutOfSightChangesNoBit) {
  Scene scene;
  AddWall(scene, -3, {0.2f, 0.3f, 0.4f});
  AddPattern(scene, -1);
  AddPane(scene, 0.2f, Unlit({0.9f, 0.2f, 0.1f, 0.3f}, AlphaMode::Blend), 0.5f);
  RenderStats bare_stats, stats;
  const Film bare = Render(scene, FlatView(), &bare_stats);
  Add(scene, Rectangle(5, 5, 6, 6), AddMaterial(scene, Slab(1.0f, 1.5f)));
  EXPECT_TRUE(SameBytes(Render(scene, FlatView(), &stats), bare));
  EXPECT_EQ(stats.fragments_shaded, bare_stats.fragments_shaded);
}

TEST(Transmission, ExtremesAreFinite) {
  for (const float thickness : {0.0f, 1.0f, 1e9f, 3e38f}) {
    for (const float ior : {0.0f, 1.0f, 1.5f, 1e30f}) {
      for (const glm::dvec3& scale : {glm::dvec3(1.0), glm::dvec3(0.0, 1.0, 1.0), glm::dvec3(-1.0), glm::dvec3(1e9)}) {
        for (const float distance : {1e-30f, 1.0f, 3e38f}) {
          Scene scene;
          AddWall(scene, -3, {0.2f, 0.3f, 0.4f});
          Material m = Slab(thickness, ior, 0.3f);
          m.attenuation_color = {0.0f, 1.0f, 0.5f};
          m.attenuation_distance = distance;
          m.dispersion = 20.0f;
          m.double_sided = true;
          Add(scene, Rectangle(-1, -1, 1, 1), AddMaterial(scene, m),
              At({0, 0, 0}, glm::dquat(0.9, 0.3, 0.2, 0.1), scale));
          for (const bool flat : {false, true}) {
            const CameraChoice camera =
                flat ? CameraChoice(Orthographic(1.0)) : CameraChoice(Perspective(0.5, {0, 0, 5}));
            RenderStats stats;
            RenderSettings settings = Settings(16, 16, 1, camera);
            if (thickness == 1.0f && distance == 1.0f) settings.environment = ConstantEnvironment(1.0f);
            const Film film = Render(scene, settings, &stats);
            EXPECT_EQ(stats.non_finite_fragments, 0u);
            for (const glm::vec4& p : film.pixels) {
              for (int c = 0; c < 4; ++c) ASSERT_TRUE(std::isfinite(p[c]) && p[c] >= 0.0f) << thickness << " " << ior;
            }
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace facet
