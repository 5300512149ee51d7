// Transparency and alpha tests through the whole renderer, against a ray caster in double at the sample positions.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "render/hand_built.h"

namespace facet {
namespace {

constexpr int kSize = 64;
constexpr double kYfov = 0.9;
const glm::dvec3 kEye(0.25, -0.125, 5.0);

// The standard patterns, sixteenths of a pixel.
std::vector<glm::dvec2> Pattern(int samples) {
  if (samples == 1) return {{8, 8}};
  if (samples == 2) return {{12, 12}, {4, 4}};
  if (samples == 4) return {{6, 2}, {14, 6}, {2, 10}, {10, 14}};
  return {{9, 5}, {7, 11}, {13, 9}, {5, 3}, {3, 13}, {1, 7}, {11, 15}, {15, 1}};
}

struct Triangle {
  glm::dvec3 corners[3];  // world
  glm::dvec4 color;       // straight alpha
  AlphaMode mode = AlphaMode::Blend;
};

// One drawable and one material for each triangle, in the order given.
Scene SceneOf(const std::vector<Triangle>& triangles) {
  Scene scene;
  for (const Triangle& t : triangles) {
    Primitive p;
    for (const glm::dvec3& corner : t.corners) p.positions.emplace_back(corner);
    Add(scene, p, AddMaterial(scene, Unlit(glm::vec4(t.color), t.mode)));
  }
  return scene;
}

struct Hit {
  double depth, tolerance;  // 1 / distance
  glm::dvec4 color;
  AlphaMode mode;
};

class Caster {
 public:
  explicit Caster(const std::vector<Triangle>& triangles) {
    const double focal = kSize * 0.5 / std::tan(kYfov * 0.5);
    for (const Triangle& t : triangles) {
      Flat flat{{}, {}, t.color, t.mode, 0, 0, 0};
      for (std::size_t i = 0; i < 3; ++i) {
        // As the scene states them, in float.
        const glm::dvec3 p = glm::dvec3(glm::vec3(t.corners[i])) - kEye;
        flat.at[i] = {kSize * 0.5 + focal * p.x / -p.z, kSize * 0.5 - focal * p.y / -p.z};
        flat.depth[i] = 1.0 / -p.z;
      }
      const glm::dvec2 a = flat.at[1] - flat.at[0], b = flat.at[2] - flat.at[0];
      flat.area = a.x * b.y - a.y * b.x;
      const double za = flat.depth[1] - flat.depth[0], zb = flat.depth[2] - flat.depth[0];
      flat.dx = (za * b.y - zb * a.y) / flat.area;
      flat.dy = (zb * a.x - za * b.x) / flat.area;
      flats_.push_back(flat);
    }
  }

  // False where the answer hangs on how edges and planes are rounded: vertices are snapped to 1/256 pixel.
  bool Cast(const glm::dvec2& at, glm::dvec4& color) const {
    std::vector<Hit> hits;
    for (const Flat& f : flats_) {
      double inside = 1e30;
      for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec2 p = f.at[i], d = f.at[(i + 1) % 3] - p;
        const double distance = (d.x * (at.y - p.y) - d.y * (at.x - p.x)) / glm::length(d);
        inside = std::min(inside, f.area > 0 ? distance : -distance);
      }
      if (std::fabs(inside) < 0.006) return false;
      if (inside < 0.0) continue;
      const double depth = f.depth[0] + f.dx * (at.x - f.at[0].x) + f.dy * (at.y - f.at[0].y);
      hits.push_back({depth, 0.008 * (std::fabs(f.dx) + std::fabs(f.dy)) + 1e-6, f.color, f.mode});
    }
    std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.depth < b.depth; });
    for (std::size_t i = 1; i < hits.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        if (hits[i].depth - hits[k].depth < hits[i].tolerance + hits[k].tolerance) return false;
      }
    }
    color = glm::dvec4(0.0);
    for (const Hit& hit : hits) {
      const double a = hit.mode == AlphaMode::Blend ? hit.color.a : 1.0;
      color = glm::dvec4(glm::dvec3(hit.color), 1.0) * a + color * (1.0 - a);
    }
    return true;
  }

 private:
  struct Flat {
    std::array<glm::dvec2, 3> at;
    std::array<double, 3> depth;
    glm::dvec4 color;
    AlphaMode mode;
    double area, dx, dy;
  };
  std::vector<Flat> flats_;
};

// Compares every pixel whose samples are all certain; returns the share of pixels compared.
double Compare(const std::vector<Triangle>& triangles, const Film& film, int samples, const std::string& what) {
  const Caster caster(triangles);
  const std::vector<glm::dvec2> pattern = Pattern(samples);
  int compared = 0;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      glm::dvec4 mean(0.0);
      bool certain = true;
      for (const glm::dvec2& s : pattern) {
        glm::dvec4 color;
        certain = certain && caster.Cast(glm::dvec2(x, y) + s / 16.0, color);
        if (certain) mean += color / double(samples);
      }
      if (!certain) continue;
      ++compared;
      const glm::vec4 pixel = film.pixels[std::size_t(y * kSize + x)];
      for (int c = 0; c < 4; ++c) {
        if (std::fabs(pixel[c] - mean[c]) > 1e-5) {  // some thirty layers of float arithmetic
          ADD_FAILURE() << what << " samples " << samples << " at " << x << ", " << y << " channel " << c << ": "
                        << pixel[c] << " instead of " << mean[c];
          return 1.0;
        }
      }
    }
  }
  return double(compared) / (kSize * kSize);
}

RenderSettings BlendSettings(int samples) {
  RenderSettings settings = Settings(kSize, kSize, samples, Perspective(kYfov, kEye));
  settings.tile_size = 16;
  return settings;
}

Triangle RandomTriangle(Uniform& random) {
  Triangle t;
  for (glm::dvec3& corner : t.corners) corner = {random(-2.5, 2.5), random(-2.5, 2.5), random(-2, 2)};
  t.color = {random(), random(), random(), random(0.1, 0.95)};
  return t;
}

TEST(Blend, RandomIntersectingTriangles) {
  Uniform random(21);
  for (int samples : {1, 2, 4, 8}) {
    for (int round = 0; round < 6; ++round) {
      std::vector<Triangle> triangles;
      for (int i = 0; i < 12; ++i) triangles.push_back(RandomTriangle(random));
      const double share = Compare(triangles, Render(SceneOf(triangles), BlendSettings(samples)), samples,
                                   "round " + std::to_string(round));
      EXPECT_GT(share, samples == 8 ? 0.4 : 0.6);
    }
  }
}

TEST(Blend, MixedWithOpaqueAndMaskedOnes) {
  Uniform random(22);
  for (int round = 0; round < 8; ++round) {
    std::vector<Triangle> triangles;
    for (int i = 0; i < 12; ++i) {
      triangles.push_back(RandomTriangle(random));
      triangles.back().mode = i % 3 == 0 ? AlphaMode::Blend : i % 3 == 1 ? AlphaMode::Opaque : AlphaMode::Mask;
    }
    // What the alpha test throws away is not there at all.
    std::vector<Triangle> kept;
    for (const Triangle& t : triangles) {
      if (t.mode != AlphaMode::Mask || float(t.color.a) >= 0.5f) kept.push_back(t);
    }
    EXPECT_LT(kept.size(), triangles.size());
    EXPECT_GT(Compare(kept, Render(SceneOf(triangles), BlendSettings(4)), 4, "round " + std::to_string(round)), 0.5);
  }
}

std::vector<Triangle> Quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d,
                           const glm::dvec4& color) {
  return {{{a, b, c}, color}, {{a, c, d}, color}};
}

// Two sheets that cut through each other: on one side of the cut the one lies in front, on the other the other.
TEST(Blend, TwoSheetsThatIntersect) {
  std::vector<Triangle> triangles = Quad({-2, -2, -1}, {2, -2, 1}, {2, 2, 1}, {-2, 2, -1}, {1, 0, 0, 0.5});
  for (const Triangle& t : Quad({-2, -2, 1}, {2, -2, -1}, {2, 2, -1}, {-2, 2, 1}, {0, 1, 0, 0.5}))
    triangles.push_back(t);
  for (int samples : {1, 4, 8}) {
    const Film film = Render(SceneOf(triangles), BlendSettings(samples));
    EXPECT_GT(Compare(triangles, film, samples, "sheets"), 0.8);
    // Left: green in front (1/2 green over 1/4 red); right: the other way round.
    EXPECT_EQ(film.pixels[32 * kSize + 18], glm::vec4(0.25f, 0.5f, 0.0f, 0.75f));
    EXPECT_EQ(film.pixels[32 * kSize + 40], glm::vec4(0.5f, 0.25f, 0.0f, 0.75f));
  }
}

TEST(Blend, AStackOfThirtyLayers) {
  Uniform random(23);
  std::vector<Triangle> triangles;
  for (int i = 0; i < 30; ++i) {
    const double z = -2.0 + 0.13 * i;
    for (const Triangle& t :
         Quad({-2, -2, z}, {2, -2, z}, {2, 2, z}, {-2, 2, z}, {random(), random(), random(), random(0.05, 0.3)})) {
      triangles.push_back(t);
    }
  }
  for (std::size_t i = triangles.size() - 1; i > 0; --i) {
    std::swap(triangles[i], triangles[std::size_t(random() * double(i + 1))]);
  }
  EXPECT_GT(Compare(triangles, Render(SceneOf(triangles), BlendSettings(4)), 4, "stack"), 0.3);
}

// To the bit: surfaces are sorted by depth, so the order in which they come does not matter.
TEST(Blend, TheOrderOfDrawablesDoesNotMatter) {
  Uniform random(24);
  std::vector<Triangle> triangles;
  for (int i = 0; i < 40; ++i) {
    triangles.push_back(RandomTriangle(random));
    if (i % 4 == 1) triangles.back().mode = AlphaMode::Opaque;
    if (i % 4 == 2) triangles.back().mode = AlphaMode::Mask;
  }
  for (int samples : {1, 4}) {
    const Film expected = Render(SceneOf(triangles), BlendSettings(samples));
    for (int round = 0; round < 4; ++round) {
      for (std::size_t i = triangles.size() - 1; i > 0; --i) {
        std::swap(triangles[i], triangles[std::size_t(random() * double(i + 1))]);
      }
      EXPECT_TRUE(SameBytes(Render(SceneOf(triangles), BlendSettings(samples)), expected)) << samples;
    }
  }
}

// Exact ties are decided by order: what comes later lies over what came before.
TEST(Blend, AtEqualDepthTheLaterLiesOver) {
  std::vector<Triangle> triangles = Quad({-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}, {1, 0, 0, 0.5});
  for (const Triangle& t : Quad({-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}, {0, 1, 0, 0.5})) triangles.push_back(t);
  for (const glm::vec4& pixel : Render(SceneOf(triangles), BlendSettings(4)).pixels) {
    ASSERT_EQ(pixel, glm::vec4(0.25f, 0.5f, 0.0f, 0.75f));
  }
}

TEST(Blend, OpaqueSurfacesHideWhatIsBehind) {
  std::vector<Triangle> triangles = Quad({-4, -4, -1}, {4, -4, -1}, {4, 4, -1}, {-4, 4, -1}, {1, 0, 0, 0.5});
  for (Triangle t : Quad({-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}, {0.25, 0.5, 0.75, 1})) {
    t.mode = AlphaMode::Opaque;
    triangles.push_back(t);
  }
  RenderStats stats;
  const Film film = Render(SceneOf(triangles), BlendSettings(4), &stats);
  for (const glm::vec4& pixel : film.pixels) ASSERT_EQ(pixel, glm::vec4(0.25f, 0.5f, 0.75f, 1.0f));
  EXPECT_EQ(stats.fragments_blended, 0u);
}

TEST(Blend, NothingOfAlphaZeroIsSeenAndAlphaOneHides) {
  std::vector<Triangle> triangles = Quad({-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}, {1, 1, 1, 0});
  RenderStats stats;
  for (const glm::vec4& pixel : Render(SceneOf(triangles), BlendSettings(4), &stats).pixels) {
    ASSERT_EQ(pixel, glm::vec4(0.0f));
  }
  EXPECT_EQ(stats.covered_pixels, 0u);
  for (const Triangle& t : Quad({-4, -4, 1}, {4, -4, 1}, {4, 4, 1}, {-4, 4, 1}, {0.25, 0.5, 0.75, 1}))
    triangles.push_back(t);
  for (const glm::vec4& pixel : Render(SceneOf(triangles), BlendSettings(4)).pixels) {
    ASSERT_EQ(pixel, glm::vec4(0.25f, 0.5f, 0.75f, 1.0f));
  }
}

TEST(Blend, OverTheEnvironment) {
  const std::vector<Triangle> triangles = Quad({-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}, {1, 0, 0, 0.5});
  RenderSettings settings = BlendSettings(4);
  settings.environment = ConstantEnvironment(2.0f);
  settings.background = Background::Environment;
  for (const glm::vec4& pixel : Render(SceneOf(triangles), settings).pixels) {
    ASSERT_NEAR(pixel.r, 1.5f, 1e-5);
    ASSERT_NEAR(pixel.g, 1.0f, 1e-5);
    ASSERT_EQ(pixel.a, 1.0f);
  }
}

// --- Alpha test
// --------------------------------------------------------------------------------------------------------

TEST(Mask, KeepsWhatReachesTheCutoff) {
  // Alpha of pixel (x, y) is its texel's, x * 16 + y in 255ths.
  const Image image = MakeImage(16, 16, [](int x, int y) { return glm::u8vec4(255, 255, 255, x * 16 + y); });
  Sampler sampler;
  sampler.magnification = sampler.minification = Filter::Nearest;
  for (int cutoff : {0, 1, 100, 128, 254, 255, 256}) {
    Scene scene;
    Material material = Unlit(glm::vec4(0.5f, 0.25f, 1.0f, 1.0f), AlphaMode::Mask);
    material.alpha_cutoff = std::max(float(cutoff) - 0.5f, 0.0f) / 255.0f;
    material.base_color_texture = Ref(AddTexture(scene, image, sampler));
    Add(scene, Rectangle(-1, -1, 1, 1), AddMaterial(scene, material));
    const Film film = Render(scene, Settings(16, 16, 1, Orthographic(1.0)));
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x) {
        const glm::vec4 pixel = film.pixels[std::size_t(y * 16 + x)];
        ASSERT_EQ(pixel.a, x * 16 + y >= cutoff ? 1.0f : 0.0f) << x << ", " << y << " cutoff " << cutoff;
        ASSERT_NEAR(pixel.r, 0.5f * pixel.a, 1e-6);
      }
    }
  }
}

TEST(Mask, AlphaEqualToTheCutoffStays) {
  for (float alpha : {0.5f, std::nextafter(0.5f, 0.0f)}) {
    Scene scene;
    Add(scene, Rectangle(-1, -1, 1, 1), AddMaterial(scene, Unlit(glm::vec4(1, 1, 1, alpha), AlphaMode::Mask)));
    RenderStats stats;
    Render(scene, Settings(8, 8, 4, Orthographic(1.0)), &stats);
    EXPECT_EQ(stats.covered_pixels, alpha == 0.5f ? 64u : 0u);
  }
}

// What fails the test hides nothing, though it is nearer.
TEST(Mask, WhatIsThrownAwayHidesNothing) {
  Scene scene;
  Add(scene, Rectangle(-1, -1, 1, 1, 0.5f), AddMaterial(scene, Unlit({1, 0, 0, 0.25f}, AlphaMode::Mask)));
  Add(scene, Rectangle(-1, -1, 1, 1, 0.25f), AddMaterial(scene, Unlit({0, 1, 0, 0.75f}, AlphaMode::Mask)));
  Add(scene, Rectangle(-1, -1, 1, 1, 0.0f), AddMaterial(scene, Unlit({0, 0, 1, 1})));
  for (const glm::vec4& pixel : Render(scene, Settings(8, 8, 4, Orthographic(1.0))).pixels) {
    ASSERT_EQ(pixel, glm::vec4(0, 1, 0, 1));
  }
}

}  // namespace
}  // namespace facet
