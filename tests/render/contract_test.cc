// What Render() promises beyond the image: refusals, warnings, what is decoded, and a shader of one's own.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>

#include "facet/error.h"
#include "facet/shader.h"
#include "render/hand_built.h"
#include "shade/shade_task.h"

namespace facet {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// --- Refusals -------------------------------------------------------------------------------------------------------

TEST(Contract, SettingsOutOfRangeAreRefusedWithTheRange) {
  struct Case {
    const char* expected;  // a part of the message
    std::function<void(RenderSettings&)> spoil;
  };
  const Case cases[] = {
      {"1 to 16384", [](RenderSettings& s) { s.width = 0; }},
      {"1 to 16384", [](RenderSettings& s) { s.height = -3; }},
      {"1 to 16384", [](RenderSettings& s) { s.width = 16385; }},
      {"1, 2, 4 or 8", [](RenderSettings& s) { s.samples = 3; }},
      {"1, 2, 4 or 8", [](RenderSettings& s) { s.samples = 0; }},
      {"1, 2, 4 or 8", [](RenderSettings& s) { s.samples = 16; }},
      {"0 (one per core)", [](RenderSettings& s) { s.threads = -1; }},
      {"1 to 16", [](RenderSettings& s) { s.max_anisotropy = 0; }},
      {"1 to 16", [](RenderSettings& s) { s.max_anisotropy = 17; }},
      {"8, 16, 32 or 64", [](RenderSettings& s) { s.tile_size = 24; }},
      {"8, 16, 32 or 64", [](RenderSettings& s) { s.tile_size = 128; }},
      {"environment", [](RenderSettings& s) { s.environment.kind = EnvironmentSettings::Kind::Image; }},
      {"radians", [](RenderSettings& s) { s.environment.rotation = kNan; }},
      {"radians", [](RenderSettings& s) { s.environment.rotation = -kInfinity; }},
      {"0 to ", [](RenderSettings& s) { s.environment.intensity = kNan; }},
      {"0 to ", [](RenderSettings& s) { s.environment.intensity = kInfinity; }},
      {"0 to ", [](RenderSettings& s) { s.environment.intensity = -1.0; }},
      {"seconds", [](RenderSettings& s) { s.time = kNan; }},
      {"", [](RenderSettings& s) { s.scene = 1; }},
      {"", [](RenderSettings& s) { s.animation = 0; }},
      {"", [](RenderSettings& s) { s.variant = 0; }},
      {"camera", [](RenderSettings& s) { s.camera = SceneCamera{0}; }},
      {"field of view",
       [](RenderSettings& s) {
         s.camera = Perspective(4.0, {0, 0, 1});
       }},
  };
  Scene scene;
  Add(scene, Rectangle(-1, -1, 1, 1), -1);
  int index = 0;
  for (const Case& c : cases) {
    RenderSettings settings = Settings(8, 8, 1, AutoCamera());
    c.spoil(settings);
    try {
      Render(scene, settings);
      ADD_FAILURE() << "case " << index << " was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::InvalidUsage) << error.what();
      EXPECT_NE(std::string(error.what()).find(c.expected), std::string::npos) << error.what();
    }
    ++index;
  }
}

TEST(Contract, ScenesThatBreakTheirRulesAreRefused) {
  Scene scene;
  Primitive p = Rectangle(-1, -1, 1, 1);
  p.indices.push_back(4);
  Add(scene, p, -1);
  try {
    Render(scene, Settings(8, 8, 1, Orthographic(1.0)));
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::InvalidInput) << error.what();
  }
}

// --- Numbers that are not finite ------------------------------------------------------------------------------------

// Of vertices, which may hold anything, and of factors whose product no float holds. (Factors that are not finite
// themselves are refused.)
TEST(Contract, NumbersThatAreNotFiniteDoNotReachTheFilm) {
  struct Case {
    const char* name;
    bool counted;  // else the material's range swallows it
    std::function<void(Material&, glm::vec4&)> spoil;
  };
  const Case cases[] = {
      {"unlit colour NaN", true, [](Material& m, glm::vec4& color) { m.model = ShadingModel::Unlit, color.g = kNan; }},
      {"unlit colour infinite", true,
       [](Material& m, glm::vec4& color) { m.model = ShadingModel::Unlit, color.r = kInfinity; }},
      {"emission overflows", true,
       [](Material& m, glm::vec4&) { m.emissive_factor.r = 1e30f, m.emissive_strength = 1e30f; }},
      {"colour NaN", false, [](Material&, glm::vec4& color) { color = glm::vec4(kNan); }},
      {"colour infinite", false, [](Material&, glm::vec4& color) { color.b = kInfinity; }},
      {"colour negative infinite", false, [](Material&, glm::vec4& color) { color.b = -kInfinity; }},
      {"alpha NaN", false, [](Material&, glm::vec4& color) { color.a = kNan; }},
  };
  for (AlphaMode mode : {AlphaMode::Opaque, AlphaMode::Mask, AlphaMode::Blend}) {
    for (const Case& c : cases) {
      Scene scene;
      Material material;
      material.alpha_mode = mode;
      glm::vec4 color(1.0f);
      c.spoil(material, color);
      Primitive square = Rectangle(-1, -1, 1, 1);
      square.colors.assign(4, color);
      Add(scene, square, AddMaterial(scene, material));
      RenderSettings settings = Settings(16, 16, 1, Orthographic(1.0));
      settings.environment.kind = EnvironmentSettings::Kind::Studio;
      RenderStats stats;
      const Film film = Render(scene, settings, &stats);
      for (const glm::vec4& pixel : film.pixels) {
        for (int k = 0; k < 4; ++k) ASSERT_TRUE(std::isfinite(pixel[k])) << c.name;
      }
      if (c.counted) {
        EXPECT_EQ(stats.non_finite_fragments, 256u) << c.name;
      }
      if (mode == AlphaMode::Opaque) {
        EXPECT_EQ(stats.covered_pixels, 256u) << c.name;
      }
    }
  }
}

TEST(Contract, VerticesThatAreNotFiniteAreCulled) {
  Scene scene;
  const int material = AddMaterial(scene, Unlit(glm::vec4(1.0f)));
  Primitive p = Rectangle(-1, -1, 1, 1);
  p.positions.emplace_back(kNan, 0.0f, 0.0f);
  p.positions.emplace_back(kInfinity, 0.0f, 0.0f);
  p.normals.resize(6, glm::vec3(0, 0, 1));
  p.tex_coords[0].resize(6);
  p.indices.insert(p.indices.end(), {0, 1, 4, 0, 1, 5});
  Add(scene, p, material);
  RenderStats stats;
  Render(scene, Settings(16, 16, 4, Orthographic(1.0)), &stats);
  EXPECT_EQ(stats.covered_pixels, 256u);
  EXPECT_EQ(stats.triangles_clipped, 2u);
}

// --- Images ---------------------------------------------------------------------------------------------------------

class CountedSource : public ImageSource {
 public:
  explicit CountedSource(bool broken = false) : broken_(broken) {}
  Image Decode() const override {
    ++calls;
    if (broken_) throw Error(ErrorCode::InvalidInput, "the picture is torn", Name());
    return MakeImage(2, 2, [](int, int) { return glm::u8vec4(0, 255, 0, 255); });
  }
  std::string Name() const override { return "torn.png"; }
  mutable std::atomic<int> calls{0};

 private:
  bool broken_;
};

TEST(Contract, AnImageThatCannotBeDecodedIsAWarning) {
  const auto source = std::make_shared<CountedSource>(true);
  Scene scene;
  Material material = Unlit({0.25f, 0.5f, 1.0f, 1.0f});
  material.base_color_texture = Ref(AddTexture(scene, source));
  Add(scene, Rectangle(-1, -1, 1, 1), AddMaterial(scene, material));
  RenderStats stats;
  const Film film = Render(scene, Settings(8, 8, 1, Orthographic(1.0)), &stats);
  ASSERT_EQ(stats.warnings.size(), 1u);
  EXPECT_NE(stats.warnings[0].find("torn.png"), std::string::npos) << stats.warnings[0];
  EXPECT_NE(stats.warnings[0].find("the picture is torn"), std::string::npos) << stats.warnings[0];
  EXPECT_EQ(stats.images_decoded, 0u);
  for (const glm::vec4& pixel : film.pixels) ASSERT_EQ(pixel, glm::vec4(0.25f, 0.5f, 1.0f, 1.0f));
}

// Whether the materials that it shades need tangents.
class TangentSpaceSeen : public FragmentShader {
 public:
  void Shade(const ShadeTask& task) const override {
    (task.material->Has(kTangentSpaceBits) ? with : without) += task.count;
    std::fill_n(task.red, task.count, 0.0f);
    std::fill_n(task.green, task.count, 0.0f);
    std::fill_n(task.blue, task.count, 0.0f);
    std::fill_n(task.alpha, task.count, 1.0f);
  }
  mutable std::atomic<std::uint64_t> with{0}, without{0};
};

TEST(Contract, ANormalTextureThatCannotBeDecodedNeedsNoTangents) {
  for (const bool broken : {false, true}) {
    Scene scene;
    Material material;
    material.base_color_factor = {0.5f, 0.5f, 0.5f, 1.0f};  // white reflects all light, wherever its normal points
    Add(scene, Rectangle(-1, -1, 1, 1), AddMaterial(scene, material));
    RenderSettings settings = Settings(8, 8, 1, Orthographic(1.0));
    settings.environment = ConstantEnvironment(1.0f);
    const Film smooth = Render(scene, settings);
    scene.materials[0].normal_texture = Ref(AddTexture(scene, std::make_shared<CountedSource>(broken)));
    EXPECT_EQ(SameBytes(Render(scene, settings), smooth), broken);
    const TangentSpaceSeen shader;
    settings.shader = &shader;
    Render(scene, settings);
    EXPECT_EQ(shader.with, broken ? 0u : 64u);
    EXPECT_EQ(shader.without, broken ? 64u : 0u);
  }
}

// A source of one's own may hand over nonsense.
TEST(Contract, AnImageWhoseBytesDoNotFitItsSizeIsAWarning) {
  const std::function<void(Image&)> spoil[] = {
      [](Image& i) { i.bytes.resize(15); },
      [](Image& i) { i.bytes.clear(); },
      [](Image& i) { i.width = 0; },
      [](Image& i) { i.height = -1; },
      [](Image& i) { i.channels = 5; },
      [](Image& i) { i.channels = 0; },
      [](Image& i) { i.type = ChannelType::F32; },
      [](Image& i) { i.width = i.height = 2000000000; },
  };
  for (const auto& change : spoil) {
    Image image = MakeImage(2, 2, [](int, int) { return glm::u8vec4(7); });
    change(image);
    Scene scene;
    Material material = Unlit({0.25f, 0.5f, 1.0f, 1.0f});
    material.base_color_texture = Ref(AddTexture(scene, image));
    Add(scene, Rectangle(-1, -1, 1, 1), AddMaterial(scene, material));
    RenderStats stats;
    const Film film = Render(scene, Settings(8, 8, 1, Orthographic(1.0)), &stats);
    ASSERT_EQ(stats.warnings.size(), 1u);
    EXPECT_EQ(stats.warnings[0].rfind("picture: ", 0), 0u) << stats.warnings[0];  // its name
    for (const glm::vec4& pixel : film.pixels) ASSERT_EQ(pixel, glm::vec4(0.25f, 0.5f, 1.0f, 1.0f));
  }
}

TEST(Contract, PicturesOfWhatIsNotVisibleAreNotDecoded) {
  const auto source = std::make_shared<CountedSource>();
  const auto render = [&](const std::function<void(Scene&)>& change) {
    Scene scene;
    Material material;
    material.base_color_texture = Ref(AddTexture(scene, source));
    Add(scene, Rectangle(-1, -1, 1, 1), AddMaterial(scene, material));
    change(scene);
    source->calls = 0;
    RenderStats stats;
    Render(scene, Settings(8, 8, 1, Orthographic(1.0)), &stats);
    EXPECT_EQ(stats.images_decoded, std::uint64_t(source->calls));
    return int(source->calls);
  };
  EXPECT_EQ(render([](Scene&) {}), 1);
  EXPECT_EQ(render([](Scene& s) { s.nodes[0].transform.translation.x = 5.0; }), 0) << "beside the picture";
  EXPECT_EQ(render([](Scene& s) { s.nodes[0].transform.translation.z = 50.0; }), 0) << "behind the camera";
  EXPECT_EQ(render([](Scene& s) { s.nodes[0].visible = false; }), 0) << "an invisible node";
  EXPECT_EQ(render([](Scene& s) { s.nodes[0].transform.rotation = glm::dquat(0, 0, 1, 0); }), 0) << "a back face";
  EXPECT_EQ(render([](Scene& s) { s.nodes[0].transform.scale = glm::dvec3(0.0); }), 0) << "a point";
  EXPECT_EQ(render([](Scene& s) { s.meshes[0].primitives[0].material = -1; }), 0) << "a material nothing uses";
  EXPECT_EQ(render([](Scene& s) { std::swap(s.materials[0].base_color_texture, s.materials[0].emissive_texture); }), 0)
      << "emission of nothing";
  EXPECT_EQ(render([](Scene& s) {
              s.materials[0].model = ShadingModel::Unlit;
              std::swap(s.materials[0].base_color_texture, s.materials[0].normal_texture);
            }),
            0)
      << "normals of what is unlit";
}

TEST(Contract, AnImageInTwoRolesIsDecodedOnce) {
  const auto source = std::make_shared<CountedSource>();
  Scene scene;
  Material material;
  const int texture = AddTexture(scene, source);
  material.base_color_texture = material.metallic_roughness_texture = material.occlusion_texture = Ref(texture);
  material.emissive_texture = Ref(texture);
  material.emissive_factor = glm::vec3(1.0f);
  Add(scene, Rectangle(-1, -1, 0, 1), AddMaterial(scene, material));
  Add(scene, Rectangle(0, -1, 1, 1), AddMaterial(scene, material));
  RenderStats stats;
  Render(scene, Settings(8, 8, 1, Orthographic(1.0)), &stats);
  EXPECT_EQ(source->calls, 1);
  EXPECT_EQ(stats.images_decoded, 1u);
  EXPECT_GT(stats.texture_bytes, 0u);
}

TEST(Contract, ATextureWithoutAnImageIsWhite) {
  Scene scene;
  Material material = Unlit({0.25f, 0.5f, 1.0f, 1.0f});
  scene.textures.emplace_back();
  material.base_color_texture = Ref(0);
  Add(scene, Rectangle(-1, -1, 1, 1), AddMaterial(scene, material));
  for (const glm::vec4& pixel : Render(scene, Settings(8, 8, 1, Orthographic(1.0))).pixels) {
    ASSERT_EQ(pixel, glm::vec4(0.25f, 0.5f, 1.0f, 1.0f));
  }
}

// --- A shader of one's own ------------------------------------------------------------------------------------------

class Gradient : public FragmentShader {
 public:
  void Shade(const ShadeTask& task) const override {
    fragments += task.count;
    ++calls;
    for (std::size_t i = 0; i < task.count; ++i) {
      task.red[i] = task.x[i];
      task.green[i] = task.y[i];
      task.blue[i] = 0.5f;
      task.alpha[i] = 0.25f;
    }
  }
  mutable std::atomic<std::uint64_t> fragments{0}, calls{0};
};

// A shader of one material leaves the others to their models, or to the shader of all.
TEST(Contract, AShaderOfOnesOwnMayBeOneMaterials) {
  const Gradient one, all;
  Scene scene;
  Add(scene, Rectangle(-1, -1, 0, 1), AddMaterial(scene, Unlit(glm::vec4(1.0f, 0.0f, 0.0f, 1.0f))));
  Add(scene, Rectangle(0, -1, 1, 1), AddMaterial(scene, Unlit(glm::vec4(0.0f, 1.0f, 0.0f, 1.0f))));
  RenderSettings settings = Settings(40, 40, 1, Orthographic(1.0));
  settings.material_shaders = {nullptr, &one};
  const Film film = Render(scene, settings);
  EXPECT_EQ(one.fragments, 800u);
  EXPECT_EQ(film.pixels[5], glm::vec4(1.0f, 0.0f, 0.0f, 1.0f));
  EXPECT_EQ(film.pixels[35], glm::vec4(35.5f, 0.5f, 0.5f, 1.0f));
  settings.shader = &all;
  Render(scene, settings);
  EXPECT_EQ(one.fragments, 1600u);
  EXPECT_EQ(all.fragments, 800u);
}

TEST(Contract, AShaderOfOnesOwnSeesEveryFragment) {
  const Gradient shader;
  Scene scene;
  Add(scene, Rectangle(-1, -1, 1, 1), AddMaterial(scene, Unlit(glm::vec4(1.0f))));
  RenderSettings settings = Settings(40, 40, 1, Orthographic(1.0));
  settings.shader = &shader;
  RenderStats stats;
  const Film film = Render(scene, settings, &stats);
  EXPECT_EQ(shader.fragments, 1600u);
  EXPECT_EQ(stats.fragments_shaded, 1600u);
  EXPECT_GE(shader.calls, 1u);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {  // one anchor square: places count from the image's corner
      ASSERT_EQ(film.pixels[std::size_t(y * 40 + x)], glm::vec4(float(x) + 0.5f, float(y) + 0.5f, 0.5f, 1.0f));
    }
  }

  scene.materials[0].alpha_mode = AlphaMode::Blend;
  const Film blended = Render(scene, settings, &stats);
  EXPECT_EQ(shader.fragments, 3200u);
  EXPECT_EQ(stats.fragments_shaded, 0u);
  EXPECT_EQ(stats.fragments_blended, 1600u);
  EXPECT_EQ(blended.pixels[0], glm::vec4(0.125f, 0.125f, 0.125f, 0.25f));
}

TEST(Contract, ProgressEndsAtOne) {
  Scene scene;
  Add(scene, Rectangle(-1, -1, 1, 1), -1);
  RenderSettings settings = Settings(128, 128, 1, Orthographic(1.0));
  settings.tile_size = 8;
  std::mutex mutex;
  std::vector<double> shares;
  settings.progress = [&](double share) {
    const std::lock_guard lock(mutex);
    shares.push_back(share);
  };
  Render(scene, settings);
  ASSERT_FALSE(shares.empty());
  EXPECT_EQ(shares.back(), 1.0);
  for (double share : shares) EXPECT_TRUE(share >= 0.0 && share <= 1.0);
}

}  // namespace
}  // namespace facet
