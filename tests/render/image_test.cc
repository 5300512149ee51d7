// What is drawn where, and with which number: closed forms on scenes built by hand.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "facet/error.h"
#include "render/hand_built.h"

namespace facet {
namespace {

Scene OneRectangle(const glm::vec4& color, float x0, float y0, float x1, float y1) {
  Scene scene;
  const int material = AddMaterial(scene, Unlit(color));
  Add(scene, Rectangle(x0, y0, x1, y1), material);
  return scene;
}

void ExpectSquare(const Film& film, const glm::vec4& color, int low, int high, const std::string& what) {
  for (int y = 0; y < film.height; ++y) {
    for (int x = 0; x < film.width; ++x) {
      const bool inside = x >= low && x < high && y >= low && y < high;
      const glm::vec4 expected = inside ? color : glm::vec4(0.0f);
      const glm::vec4 pixel = film.pixels[std::size_t(y * film.width + x)];
      ASSERT_EQ(std::memcmp(&pixel, &expected, sizeof pixel), 0)
          << what << " at " << x << ", " << y << ": " << pixel.r << " " << pixel.g << " " << pixel.b << " " << pixel.a;
    }
  }
}

TEST(RenderedImage, ARectangleCoversItsPixelsAndItsColorIsExact) {
  const glm::vec4 color(0.1f, 0.2f, 0.7f, 1.0f);
  const Scene scene = OneRectangle(color, -0.5f, -0.5f, 0.5f, 0.5f);
  RenderStats stats;
  ExpectSquare(Render(scene, Settings(16, 16, 1, Orthographic(1.0)), &stats), color, 4, 12, "orthographic");
  EXPECT_EQ(stats.covered_pixels, 64u);
  EXPECT_EQ(stats.fragments_shaded, 64u);
  EXPECT_EQ(stats.triangles_in, 2u);
  EXPECT_EQ(stats.triangles_binned, 2u);
  const double right_angle = 1.5707963267948966;  // the image spans [-1, 1] at distance 1
  ExpectSquare(Render(scene, Settings(16, 16, 1, Perspective(right_angle, {0, 0, 1}))), color, 4, 12, "perspective");
}

// Numbers of few digits add up without rounding where two triangles share a pixel.
TEST(RenderedImage, MultisampledPixelsThatAreFullAreExact) {
  const glm::vec4 color(0.25f, 0.5f, 0.75f, 1.0f);
  const Scene scene = OneRectangle(color, -0.5f, -0.5f, 0.5f, 0.5f);
  for (int samples : {2, 4, 8}) {
    ExpectSquare(Render(scene, Settings(16, 16, samples, Orthographic(1.0))), color, 4, 12, std::to_string(samples));
  }
}

TEST(RenderedImage, OpaqueMaterialsIgnoreAlpha) {
  const Scene scene = OneRectangle({0.5f, 0.25f, 1.0f, 0.1f}, -0.5f, -0.5f, 0.5f, 0.5f);
  ExpectSquare(Render(scene, Settings(16, 16, 1, Orthographic(1.0))), {0.5f, 0.25f, 1.0f, 1.0f}, 4, 12, "opaque");
}

// glTF 2.0, section 3.9.6: without normals points and lines show base colour plus emission, each with its texture and
// whatever the light; KHR_materials_unlit knows no emission.
TEST(RenderedImage, PointsAndLinesWithoutNormalsEmit) {
  for (const Topology topology : {Topology::Points, Topology::Lines, Topology::LineStrip, Topology::LineLoop}) {
    for (const bool unlit : {false, true}) {
      for (const bool textured : {false, true}) {
        Scene scene;
        Material material;
        material.model = unlit ? ShadingModel::Unlit : ShadingModel::MetallicRoughness;
        material.base_color_factor = {0.25f, 0.5f, 0, 1};
        material.emissive_factor = {0, 0.25f, 0.5f};
        material.emissive_strength = 2.0f;
        if (textured) {
          material.emissive_texture =
              Ref(AddTexture(scene, MakeImage(1, 1, [](int, int) { return glm::u8vec4(255, 0, 255, 255); })));
        }
        Primitive p;
        p.topology = topology;
        p.positions = {{-0.9f, 0.05f, 0}, {0.9f, 0.05f, 0}};
        p.tex_coords = {{{0, 0}, {1, 1}}};
        Add(scene, p, AddMaterial(scene, material));
        RenderSettings settings = Settings(16, 16, 1, Orthographic(1.0));
        settings.environment = ConstantEnvironment(3.0f);
        const glm::vec4 emission = unlit ? glm::vec4(0) : textured ? glm::vec4(0, 0, 1, 0) : glm::vec4(0, 0.5f, 1, 0);
        const glm::vec4 expected = material.base_color_factor + emission;
        int covered = 0;
        for (const glm::vec4& pixel : Render(scene, settings).pixels) {
          if (pixel.a == 0.0f) continue;
          ++covered;
          EXPECT_EQ(pixel, expected) << int(topology) << unlit << textured;
        }
        EXPECT_GT(covered, 1);
        settings.without = {Feature::Emission};
        for (const glm::vec4& pixel : Render(scene, settings).pixels) {
          EXPECT_TRUE(pixel.a == 0.0f || pixel == material.base_color_factor);
        }
      }
    }
  }
}

// A normal map that KHR_texture_transform turns and mirrors is lit as one whose UVs are written out that way.
TEST(RenderedImage, NormalMapsFollowTheTextureTransform) {
  const Image bumps = MakeImage(16, 16, [](int x, int y) {
    return glm::u8vec4(128 + 60 * ((x / 2) % 3 - 1), 128 + 50 * ((y / 3) % 3 - 1), 220, 255);
  });
  Transform tilted;
  tilted.rotation = glm::dquat(0.8880738, -0.3250576, 0.3250576, 0.0);
  for (const glm::vec2 scale : {glm::vec2(1, 1), glm::vec2(-1, 1), glm::vec2(2, -1)}) {
    for (const float rotation : {0.0f, 1.5707963f, 3.1415927f, 0.5f}) {
      const TextureRef transform{0, 0, {0.5f, 1}, scale, rotation};
      const auto lit = [&](const TextureRef& ref, const Primitive& surface) {
        Scene scene;
        AddTexture(scene, bumps);
        Material material;
        material.metallic_factor = 0.0f;
        material.normal_texture = ref;
        Add(scene, surface, AddMaterial(scene, material));
        scene.lights.push_back({"", LightType::Directional, glm::vec3(1), 3.0f});
        scene.nodes.emplace_back().light = 0;
        scene.nodes.back().transform = tilted;
        return Render(scene, Settings(32, 32, 1, Orthographic(1.0)));
      };
      Primitive surface = Rectangle(-0.9f, -0.9f, 0.9f, 0.9f), baked = surface;
      const double c = std::cos(double(rotation)), s = std::sin(double(rotation));
      for (glm::vec2& uv : baked.tex_coords[0]) {
        const glm::dvec2 scaled = glm::dvec2(scale) * glm::dvec2(uv);
        uv = glm::vec2(glm::dvec2(transform.offset) +
                       glm::dvec2(c * scaled.x + s * scaled.y, c * scaled.y - s * scaled.x));
      }
      const Film film = lit(transform, surface), expected = lit(Ref(0), baked);
      float largest = 0.0f, contrast = 0.0f;
      for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        largest = std::max(largest, std::fabs(film.pixels[i].r - expected.pixels[i].r));
        contrast = std::max(contrast, std::fabs(expected.pixels[i].r - expected.pixels[528].r));
      }
      EXPECT_LT(largest, 1e-4f) << scale.x << " " << scale.y << " " << rotation;
      EXPECT_GT(contrast, 0.1f) << "the bumps show";
    }
  }
}

TEST(RenderedImage, VertexColorsMultiply) {
  Scene scene;
  Primitive p = Rectangle(-0.5f, -0.5f, 0.5f, 0.5f);
  p.colors.assign(4, glm::vec4(0.5f, 0.25f, 1.0f, 1.0f));
  Add(scene, p, AddMaterial(scene, Unlit({0.5f, 1.0f, 0.125f, 1.0f})));
  ExpectSquare(Render(scene, Settings(16, 16, 1, Orthographic(1.0))), {0.25f, 0.25f, 0.125f, 1.0f}, 4, 12, "colours");
}

// A texel per pixel, read by nearest and by linear filters: each pixel's centre is a texel's centre.
TEST(RenderedImage, ATextureOfAsManyTexelsAsPixelsIsCopied) {
  const Image image = MakeImage(16, 16, [](int x, int y) { return glm::u8vec4((x * 16 + y) & 255, 255, 0, 255); });
  for (Filter filter : {Filter::Nearest, Filter::Linear}) {
    Scene scene;
    Material material = Unlit(glm::vec4(1.0f));
    Sampler sampler;
    sampler.magnification = sampler.minification = filter;
    material.base_color_texture = Ref(AddTexture(scene, image, sampler));
    Add(scene, Rectangle(-1, -1, 1, 1), AddMaterial(scene, material));
    const Film film = Render(scene, Settings(16, 16, 1, Orthographic(1.0)));
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x) {
        const double s = ((x * 16 + y) & 255) / 255.0;
        const double linear = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
        const glm::vec4 pixel = film.pixels[std::size_t(y * 16 + x)];
        EXPECT_NEAR(pixel.r, linear, 1.2e-5) << x << ", " << y;  // 16 bits, and a bilinear weight near 0
        EXPECT_NEAR(pixel.g, 1.0, 1e-6);
        EXPECT_NEAR(pixel.b, 0.0, 1e-6);
      }
    }
  }
}

// The standard patterns, written down once more: sixteenths of a pixel.
const std::array<std::vector<glm::ivec2>, 4> kPatterns = {{
    {{8, 8}},
    {{12, 12}, {4, 4}},
    {{6, 2}, {14, 6}, {2, 10}, {10, 14}},
    {{9, 5}, {7, 11}, {13, 9}, {5, 3}, {3, 13}, {1, 7}, {11, 15}, {15, 1}},
}};

TEST(RenderedImage, AnEdgeCoversTheExpectedShareOfSamples) {
  for (const auto& pattern : kPatterns) {
    const int samples = int(pattern.size());
    for (int f = 1; f < 32; f += 2) {                              // between the samples' sixteenths
      const float edge = (8.0f + float(f) / 32.0f) / 8.0f - 1.0f;  // pixel 8 of 16
      int left = 0, above = 0;
      for (const glm::ivec2& s : pattern) left += 2 * s.x < f, above += 2 * s.y < f;
      const Film by_x =
          Render(OneRectangle(glm::vec4(1.0f), -3, -3, edge, 3), Settings(16, 16, samples, Orthographic(1.0)));
      const Film by_y =
          Render(OneRectangle(glm::vec4(1.0f), -3, -edge, 3, 3), Settings(16, 16, samples, Orthographic(1.0)));
      for (int i = 0; i < 16; ++i) {
        EXPECT_EQ(by_x.pixels[std::size_t(i * 16 + 8)].a, float(left) / float(samples)) << samples << " " << f;
        EXPECT_EQ(by_y.pixels[std::size_t(8 * 16 + i)].a, float(above) / float(samples)) << samples << " " << f;
        EXPECT_EQ(by_x.pixels[std::size_t(i * 16 + 7)].a, 1.0f);
        EXPECT_EQ(by_x.pixels[std::size_t(i * 16 + 9)].a, 0.0f);
      }
    }
  }
}

TEST(RenderedImage, ASceneAMillionUnitsAwayIsTheSame) {
  for (bool orthographic : {false, true}) {
    std::vector<Film> films;
    for (const glm::dvec3 offset : {glm::dvec3(0.0), glm::dvec3(1e6, -1e6, 1e6), glm::dvec3(0, 0, -1.6e7)}) {
      Scene scene;
      Material lit;
      lit.roughness_factor = 0.4f;
      Transform place;
      place.translation = offset;
      place.rotation = glm::dquat(0.8, 0.0, 0.6, 0.0);
      Add(scene, Sphere(1.0f, 12, 24), AddMaterial(scene, lit), place);
      const FreeCamera camera = orthographic ? Orthographic(1.25, offset + glm::dvec3(0, 0, 4))
                                             : Perspective(0.75, offset + glm::dvec3(0.25, 0.5, 4.0));
      RenderSettings settings = Settings(96, 96, 4, camera);
      settings.environment.kind = EnvironmentSettings::Kind::Studio;
      films.push_back(Render(scene, settings));
    }
    EXPECT_TRUE(SameBytes(films[0], films[1])) << orthographic;
    EXPECT_TRUE(SameBytes(films[0], films[2])) << orthographic;
    EXPECT_GT(films[0].pixels[48 * 96 + 48].a, 0.0f);
  }
}

// Depth in front of an orthographic camera: the nearer of two rectangles shows, whichever comes first.
TEST(RenderedImage, TheNearerSurfaceShows) {
  for (bool orthographic : {false, true}) {
    for (bool near_first : {false, true}) {
      Scene scene;
      const int red = AddMaterial(scene, Unlit({1, 0, 0, 1})), green = AddMaterial(scene, Unlit({0, 1, 0, 1}));
      for (int i = 0; i < 2; ++i) {
        const bool is_near = (i == 0) == near_first;
        Add(scene, Rectangle(-5, -5, 5, 5, is_near ? 0.5f : 0.499f), is_near ? red : green);
      }
      const CameraChoice camera =
          orthographic ? CameraChoice(Orthographic(1.0)) : CameraChoice(Perspective(0.8, {0, 0, 3}));
      const Film film = Render(scene, Settings(16, 16, 4, camera));
      for (const glm::vec4& pixel : film.pixels) ASSERT_EQ(pixel, glm::vec4(1, 0, 0, 1));
    }
  }
}

TEST(RenderedImage, AnEmptySceneIsEmpty) {
  for (const CameraChoice& camera :
       {CameraChoice(AutoCamera()), CameraChoice(OrbitCamera()), CameraChoice(Orthographic(1))}) {
    RenderStats stats;
    const Film film = Render(Scene(), Settings(33, 17, 4, camera), &stats);
    ASSERT_EQ(film.pixels.size(), 33u * 17u);
    for (const glm::vec4& pixel : film.pixels) ASSERT_EQ(pixel, glm::vec4(0.0f));
    EXPECT_EQ(stats.covered_pixels, 0u);
    EXPECT_EQ(stats.drawables, 0u);
    EXPECT_EQ(stats.images_decoded, 0u);
  }
}

TEST(RenderedImage, BackFacesAreCulledUnlessDoubleSided) {
  for (bool mirrored : {false, true}) {
    for (bool turned : {false, true}) {
      for (bool double_sided : {false, true}) {
        Scene scene;
        Material material = Unlit(glm::vec4(1.0f));
        material.double_sided = double_sided;
        Transform place;
        place.scale.x = mirrored ? -1.0 : 1.0;
        if (turned) place.rotation = glm::dquat(0, 0, 1, 0);  // half a turn about Y
        Add(scene, Rectangle(-1, -1, 1, 1), AddMaterial(scene, material), place);
        RenderStats stats;
        Render(scene, Settings(8, 8, 1, Orthographic(1.0)), &stats);
        EXPECT_EQ(stats.covered_pixels, !turned || double_sided ? 64u : 0u) << mirrored << turned << double_sided;
        EXPECT_EQ(stats.triangles_culled, !turned || double_sided ? 0u : 2u);
      }
    }
  }
}

// --- Light ----------------------------------------------------------------------------------------------------------

// A white surface in constant light reflects all of it.
TEST(RenderedImage, WhiteFurnace) {
  Scene scene;
  Add(scene, Sphere(1.0f, 48, 96), AddMaterial(scene, Material()));
  Material& material = scene.materials[0];
  RenderSettings settings = Settings(64, 64, 4, Perspective(0.55, {0, 0, 4.0}));
  settings.environment = ConstantEnvironment(1.0f);
  for (float roughness : {0.0f, 0.1f, 0.3f, 0.6f, 1.0f}) {
    for (float metallic : {0.0f, 0.5f, 1.0f}) {
      material.roughness_factor = roughness;
      material.metallic_factor = metallic;
      RenderStats stats;
      const Film film = Render(scene, settings, &stats);
      int seen = 0;
      for (const glm::vec4& pixel : film.pixels) {
        if (pixel.a < 1.0f) continue;
        ++seen;
        for (int c = 0; c < 3; ++c) {
          ASSERT_GE(pixel[c], 0.98f) << roughness << " " << metallic;
          ASSERT_LE(pixel[c], 1.005f) << roughness << " " << metallic;
        }
      }
      EXPECT_GT(seen, 1000);
      EXPECT_EQ(stats.non_finite_fragments, 0u);
    }
  }
}

// Nearly Lambert: at roughness 1 a dielectric of base colour 0.8 reflects within a few percent of 0.8 / pi * E * cos.
TEST(RenderedImage, DirectionalLightOnARoughSurface) {
  for (double degrees : {0.0, 30.0, 60.0}) {
    const double angle = degrees * 3.14159265358979 / 180.0;
    Scene scene;
    Material material;
    material.base_color_factor = {0.8f, 0.4f, 0.2f, 1.0f};
    material.metallic_factor = 0.0f;
    Add(scene, Rectangle(-2, -2, 2, 2), AddMaterial(scene, material));
    Light light;
    light.type = LightType::Directional;
    light.intensity = 10.0f;
    scene.lights.push_back(light);
    Node node;
    node.light = 0;
    node.transform.rotation = glm::dquat(std::cos(angle / 2), 0.0, std::sin(angle / 2), 0.0);  // about +Y
    scene.nodes.push_back(node);
    const Film film = Render(scene, Settings(8, 8, 1, Orthographic(1.0)));
    scene.lights[0].intensity = 20.0f;
    const Film twice = Render(scene, Settings(8, 8, 1, Orthographic(1.0)));
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
      const double expected = 0.8 / 3.14159265358979 * 10.0 * std::cos(angle);
      ASSERT_NEAR(film.pixels[i].r / expected, 1.0, 0.04) << degrees;
      // Linear in the light, to the last bit for a power of two.
      ASSERT_EQ(twice.pixels[i], glm::vec4(glm::vec3(film.pixels[i]) * 2.0f, 1.0f));
      // The specular part is the same in all channels; the rest is proportional to the base colour.
      const double slope_rg = (film.pixels[i].r - film.pixels[i].g) / 0.4,
                   slope_gb = (film.pixels[i].g - film.pixels[i].b) / 0.2;
      ASSERT_NEAR(slope_rg / slope_gb, 1.0, 1e-4);
    }
  }
}

TEST(RenderedImage, AnEnvironmentBehindTheImage) {
  Scene scene;
  Add(scene, Rectangle(-0.5f, -0.5f, 0.5f, 0.5f), AddMaterial(scene, Unlit({0.25f, 0.5f, 0.75f, 1.0f})));
  RenderSettings settings = Settings(16, 16, 4, Perspective(1.5707963267948966, {0, 0, 1}));
  settings.environment = ConstantEnvironment(0.5f);
  settings.environment.intensity = 3.0;
  settings.background = Background::Environment;
  const Film film = Render(scene, settings);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      const bool inside = x >= 4 && x < 12 && y >= 4 && y < 12;
      const glm::vec4 expected = inside ? glm::vec4(0.25f, 0.5f, 0.75f, 1.0f) : glm::vec4(1.5f, 1.5f, 1.5f, 1.0f);
      for (int c = 0; c < 4; ++c)
        ASSERT_NEAR(film.pixels[std::size_t(y * 16 + x)][c], expected[c], 1e-5) << x << " " << y;
    }
  }
}

}  // namespace
}  // namespace facet
