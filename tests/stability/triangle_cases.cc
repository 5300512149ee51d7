// Triangles of extreme shape: huge, hair-thin, empty, broken.
#include <cmath>
#include <limits>

#include "render/hand_built.h"
#include "stability/stability_case.h"

namespace facet::stability {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr int kSize = 64;

// A camera in whose image one unit is one pixel; (0, 0) is the image's centre.
RenderSettings PixelSettings(int samples) { return Settings(kSize, kSize, samples, Orthographic(kSize * 0.5)); }

int AddWhite(Scene& scene, AlphaMode mode = AlphaMode::Opaque, float alpha = 1.0f) {
  return AddMaterial(scene, Unlit({1, 1, 1, alpha}, mode));
}

// A triangle whose corners lie up to 1e6 pixels away and that covers all of the image; its vertex colours are an
// affine function over the screen. Bound: the weights are floats relative to an anchor within 64 pixels, which lose
// 2^-24 of their largest number each, three of them: 4 * 2^-23 of full scale.
Measured MeasureHugeTriangles() {
  Measured m;
  for (const float extent : {1e2f, 1e4f, 1e5f, 1e6f, 1e8f}) {
    for (const bool perspective : {false, true}) {
      Scene scene;
      Primitive p;
      p.positions = {{-extent, -extent, 0}, {extent * 2, -extent, 0}, {-extent, extent * 2, 0}};
      p.colors = {{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}};
      Add(scene, p, AddWhite(scene));
      RenderSettings settings = PixelSettings(4);
      if (perspective) settings.camera = Perspective(2.0 * std::atan(0.5), {0, 0, double(kSize)});
      RenderStats stats;
      const Film film = Draw(scene, settings, m, &stats);
      m.Expect(stats.covered_pixels == kSize * kSize, "a triangle over everything leaves holes");
      for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
          const double e = double(extent);
          const double red = (x + 0.5 - kSize / 2 + e) / (3 * e), green = (kSize / 2 - y - 0.5 + e) / (3 * e);
          const glm::vec4 pixel = film.pixels[std::size_t(y * kSize + x)];
          m.Error(std::fabs(double(pixel.r) - red));
          m.Error(std::fabs(double(pixel.g) - green));
        }
      }
    }
  }
  return m;
}

// The image cut into strips `width` pixels wide, two triangles each. Blended fragments count what is covered: each
// sample once, whatever the width, so `fragments * alpha` never shows twice.
Measured MeasureSlivers() {
  Measured m;
  for (const double width : {1.0, 0.1, 1e-2, 1e-4, 1e-6}) {
    Scene scene;
    Primitive p;
    // Around one column of samples, so that the narrowest do not number millions; plain rectangles on both sides.
    const double centre = 0.5, half = 400 * width;
    const auto column = [&p](double x) {
      p.positions.emplace_back(float(x), -40.0f, 0.0f);
      p.positions.emplace_back(float(x), 40.0f, 0.0f);
    };
    column(-40.0);
    for (int i = -400; i <= 400; ++i) column(centre + i * width);
    column(40.0 + centre + half);
    for (std::uint32_t i = 0; i + 3 < p.positions.size(); i += 2) {
      p.indices.insert(p.indices.end(), {i, i + 2, i + 1, i + 1, i + 2, i + 3});
    }
    Add(scene, p, AddWhite(scene, AlphaMode::Blend, 0.5f));
    for (const int samples : {1, 4}) {
      const Film film = Draw(scene, PixelSettings(samples), m);
      for (const glm::vec4& pixel : film.pixels) m.Error(std::fabs(double(pixel.a) - 0.5));
    }
  }
  return m;
}

// A hair of 1e-6 pixels alone, at places between and on samples: it covers what its snapped edges enclose, here
// nothing, and a needle of many pixels length and 1e-6 width at its foot covers no area either.
Measured MeasureHair() {
  Measured m;
  for (const double x : {0.0, 0.125, 0.5, 0.6, 1.0 / 512.0}) {
    for (const double width : {1e-6, 1e-12}) {
      Scene scene;
      Primitive p;
      p.positions = {{float(x), -30, 0}, {float(x + width), -30, 0}, {float(x), 30, 0}};
      Add(scene, p, AddWhite(scene));
      RenderStats stats;
      Draw(scene, PixelSettings(8), m, &stats);
      m.Error(double(stats.covered_pixels));
    }
  }
  return m;
}

Primitive Disc(int segments, float radius) {
  Primitive p;
  p.positions.emplace_back(0.0f, 0.0f, 0.0f);
  for (int i = 0; i <= segments; ++i) {
    const double angle = 2 * 3.14159265358979324 * i / segments;
    p.positions.emplace_back(float(radius * std::cos(angle)), float(radius * std::sin(angle)), 0.0f);
  }
  for (int i = 1; i <= segments; ++i) {
    p.indices.insert(p.indices.end(), {0u, std::uint32_t(i), std::uint32_t(i + 1)});
  }
  p.normals.assign(p.positions.size(), glm::vec3(0, 0, 1));
  return p;
}

Film DrawDisc(const Primitive& p, Measured& m, RenderStats* stats = nullptr) {
  Scene scene;
  Material material;
  material.double_sided = true;
  Add(scene, p, AddMaterial(scene, material));
  RenderSettings settings = PixelSettings(4);
  settings.environment = ConstantEnvironment(1.0f);
  return Draw(scene, settings, m, stats);
}

// Triangles without area or with vertices that are no numbers change nothing, and cost nothing but their count.
Measured MeasureBrokenTriangles() {
  Measured m;
  const Primitive whole = Disc(17, 25.3f);
  const Film expected = DrawDisc(whole, m);
  Primitive broken = whole;
  const auto spare = std::uint32_t(broken.positions.size());
  for (const glm::vec3& v : {glm::vec3(kNan, 0, 0), glm::vec3(0, kInfinity, 0), glm::vec3(0, 0, -kInfinity),
                             glm::vec3(3e38f), glm::vec3(1e-40f, 1e-45f, 0)}) {
    broken.positions.push_back(v);
    broken.normals.push_back(glm::vec3(kNan));
  }
  const std::vector<std::uint32_t> good = broken.indices;
  broken.indices.clear();
  std::uint64_t added = 0;
  for (std::size_t i = 0; i < good.size(); i += 3) {
    const std::uint32_t a = good[i], b = good[i + 1], c = good[i + 2];
    const std::uint32_t more[] = {a, a, b, b, c, b, a, a, a, a, spare, b, spare + 1, b, c, a, b, spare + 2};
    broken.indices.insert(broken.indices.end(), std::begin(more), std::end(more));
    broken.indices.insert(broken.indices.end(), {a, b, c});
    added += std::size(more) / 3;
  }
  RenderStats stats;
  m.Error(double(DifferingPixels(DrawDisc(broken, m, &stats), expected)));
  m.Expect(stats.triangles_culled + stats.triangles_clipped == added, "broken triangles are not all counted");
  return m;
}

// All of it broken at once: nothing is drawn.
Measured MeasureNothingLeft() {
  Measured m;
  for (const glm::vec3& v : {glm::vec3(kNan), glm::vec3(kInfinity), glm::vec3(-kInfinity, 0, 0), glm::vec3(0)}) {
    for (const Topology topology : {Topology::Triangles, Topology::Lines, Topology::TriangleStrip}) {
      Scene scene;
      Primitive p;
      p.topology = topology;
      p.positions.assign(6, v);
      p.normals.assign(6, v);
      p.colors.assign(6, glm::vec4(kNan));
      Add(scene, p, AddMaterial(scene, Material()));
      RenderSettings settings = PixelSettings(4);
      settings.environment.kind = EnvironmentSettings::Kind::Studio;
      RenderStats stats;
      Draw(scene, settings, m, &stats);
      m.Error(double(stats.covered_pixels));
      settings.camera = AutoCamera();  // frames what is there: nothing
      Draw(scene, settings, m);
    }
  }
  return m;
}

}  // namespace

std::vector<Case> TriangleCases() {
  return {
      {"triangles", "corners up to 1e8 pixels away", "fixed point overflows; interpolation loses the last digits",
       "a guard band, exact integers; weights in double, rounded near the pixel", "of full scale", 4 * 0x1p-23,
       MeasureHugeTriangles},
      {"triangles", "strips 1 to 1e-6 pixels wide", "cracks and pixels that are blended twice",
       "snapped once, exact edges, the top-left rule", "of a pixel's alpha", 0.0, MeasureSlivers},
      {"triangles", "a hair 1e-6 pixels wide", "a line of pixels, or a division by its area",
       "no area on the grid of 1/256 pixel: nothing", "pixels covered", 0.0, MeasureHair},
      {"triangles", "zero area, repeated and non-finite vertices", "NaN spreads to neighbours, tiles and bounds",
       "culled and counted", "pixels that differ", 0.0, MeasureBrokenTriangles},
      {"triangles", "nothing but broken vertices", "an endless loop or an empty bounding box inside out",
       "an empty picture, an automatic camera too", "pixels covered", 0.0, MeasureNothingLeft},
  };
}

}  // namespace facet::stability
