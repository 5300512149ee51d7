// Planes of a film besides colour, against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "base/least_limit.h"
#include "facet/error.h"
#include "facet/film.h"
#include "frame/constants.h"
#include "render/hand_built.h"

namespace facet {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();
constexpr std::uint32_t kNobody = 0xffffffff;

Film RenderWith(const Scene& scene, RenderSettings settings, std::vector<PlaneKind> planes) {
  settings.planes = std::move(planes);
  return Render(scene, settings);
}

std::vector<float> Depths(const Scene& scene, const RenderSettings& settings) {
  const Film film = RenderWith(scene, settings, {PlaneKind::Depth});
  EXPECT_EQ(film.planes.size(), 1u);
  const std::span<const float> depths = film.planes.at(0).As<float>();
  EXPECT_EQ(depths.size(), film.pixels.size());
  return {depths.begin(), depths.end()};
}

std::vector<std::uint32_t> Triangles(const Scene& scene, const RenderSettings& settings) {
  const Film film = RenderWith(scene, settings, {PlaneKind::Triangle});
  const std::span<const std::uint32_t> triangles = film.planes.at(0).As<std::uint32_t>();
  EXPECT_EQ(triangles.size(), film.pixels.size());
  return {triangles.begin(), triangles.end()};
}

std::string Refusal(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::InvalidUsage) << error.what();
    return error.what();
  }
  return "accepted";
}

// A pixel's least distance over its samples, `distance` being of a point of the image in pixels.
template <class Distance>
double LeastDistance(int x, int y, int samples, const Distance& distance) {
  double least = std::numeric_limits<double>::infinity();
  for (int s = 0; s < samples; ++s) {
    const SamplePosition at = SamplePattern(samples)[s];
    least = std::min(least, distance(x + at.x / 16.0, y + at.y / 16.0));
  }
  return least;
}

// --- Depth ----------------------------------------------------------------------------------------------------------

TEST(DepthPlane, OfASurfaceThatFacesTheCameraIsItsDistance) {
  Scene scene;
  Add(scene, Rectangle(-0.5f, -10, 10, 10, -2.0f), AddMaterial(scene, Unlit(glm::vec4(1))));
  for (const int samples : {1, 2, 4, 8}) {
    for (const bool perspective : {true, false}) {
      // The left edge lies at pixel 8 of 32: the image is 2 wide at the surface.
      const FreeCamera camera =
          perspective ? Perspective(2.0 * std::atan(0.25), {0, 0, 2}) : Orthographic(1.0, {0, 0, 2});
      const std::vector<float> depths = Depths(scene, Settings(32, 32, samples, camera));
      for (std::size_t p = 0; p < depths.size(); ++p) {
        if (p % 32 < 8) {
          ASSERT_EQ(depths[p], kFar) << p;
        } else {
          ASSERT_NEAR(depths[p], 4.0, 1e-6) << p << ", " << samples << " samples";
        }
      }
    }
  }
}

TEST(DepthPlane, OfASlopeIsThatOfTheNearestSample) {
  // z = 0.5 x + 0.25 y, beyond the image on all sides.
  Scene scene;
  Primitive slope = Rectangle(-20, -20, 20, 20);
  for (glm::vec3& p : slope.positions) p.z = 0.5f * p.x + 0.25f * p.y;
  slope.normals.clear();
  Add(scene, slope, AddMaterial(scene, Unlit(glm::vec4(1))));
  constexpr int kSize = 48;
  const auto of_image = [](double px) { return px / (0.5 * kSize) - 1.0; };
  for (const int samples : {1, 2, 4, 8}) {
    const std::vector<float> flat = Depths(scene, Settings(kSize, kSize, samples, Orthographic(1.0, {0, 0, 10})));
    const double half = std::tan(0.4);
    const std::vector<float> wide = Depths(scene, Settings(kSize, kSize, samples, Perspective(0.8, {0, 0, 3})));
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const auto orthographic = [&](double px, double py) {
          return 10.0 - (0.5 * of_image(px) - 0.25 * of_image(py));
        };
        // The ray (h x, -h y, -1) d from z = 3 meets the slope where 3 - d = d h (0.5 x - 0.25 y).
        const auto perspective = [&](double px, double py) {
          return 3.0 / (1.0 + half * (0.5 * of_image(px) - 0.25 * of_image(py)));
        };
        const std::size_t p = std::size_t(y * kSize + x);
        ASSERT_NEAR(flat[p], LeastDistance(x, y, samples, orthographic), 1e-4) << x << " " << y << " " << samples;
        ASSERT_NEAR(wide[p], LeastDistance(x, y, samples, perspective), 2e-4) << x << " " << y << " " << samples;
      }
    }
  }
}

TEST(DepthPlane, IsAlongTheAxisAndFromTheNearestOfTheSurfaces) {
  Scene scene;
  const int white = AddMaterial(scene, Unlit(glm::vec4(1)));
  Add(scene, Rectangle(-50, -50, 50, 50, -6.0f), white);
  Add(scene, Rectangle(-50, -50, 0, 50, 1.0f), white);
  // A wide view: towards the corners a distance from the eye would be more than half as much again.
  const std::vector<float> depths = Depths(scene, Settings(64, 64, 4, Perspective(1.6, {0, 0, 3})));
  for (std::size_t p = 0; p < depths.size(); ++p) ASSERT_NEAR(depths[p], p % 64 < 32 ? 2.0 : 9.0, 1e-5) << p;
}

TEST(DepthPlane, OrthographicZeroHasNoSign) {
  Scene scene;
  Add(scene, Rectangle(-2, -2, 2, 2, 0.0f), AddMaterial(scene, Unlit(glm::vec4(1))));
  FreeCamera camera = Orthographic(1.0, {0, 0, 0});
  camera.lens.znear = 0.0;
  for (const float depth : Depths(scene, Settings(16, 16, 4, camera))) {
    ASSERT_EQ(depth, 0.0f);
    ASSERT_FALSE(std::signbit(depth));
  }
}

TEST(DepthPlane, AlphaTestedHolesShowWhatIsBehindAndBlendedLayersDoNotShow) {
  Scene scene;
  Add(scene, Rectangle(-2, -2, 2, 2, -3.0f), AddMaterial(scene, Unlit(glm::vec4(1))));
  Material mask = Unlit(glm::vec4(1), AlphaMode::Mask);
  Sampler nearest;
  nearest.magnification = nearest.minification = Filter::Nearest;
  nearest.mip = MipFilter::None;
  mask.base_color_texture = Ref(AddTexture(
      scene, MakeImage(2, 1, [](int x, int) { return glm::u8vec4(255, 255, 255, x == 0 ? 0 : 255); }), nearest));
  Add(scene, Rectangle(-1, -1, 1, 1, -1.0f), AddMaterial(scene, mask));
  Add(scene, Rectangle(-2, -2, 2, 2, 2.0f), AddMaterial(scene, Unlit(glm::vec4(0.5f), AlphaMode::Blend)));
  RenderSettings settings = Settings(32, 32, 4, Orthographic(1.0));
  const std::vector<float> depths = Depths(scene, settings);
  for (std::size_t p = 0; p < depths.size(); ++p) ASSERT_NEAR(depths[p], p % 32 < 16 ? 13.0 : 11.0, 1e-5) << p;
  settings.without = {Feature::AlphaTest, Feature::Blending};
  for (const float depth : Depths(scene, settings)) ASSERT_NEAR(depth, 8.0, 1e-5) << "the layer is opaque then";

  Scene layer;
  Add(layer, Rectangle(-2, -2, 2, 2), AddMaterial(layer, Unlit(glm::vec4(0.5f), AlphaMode::Blend)));
  const Film film = RenderWith(layer, Settings(32, 32, 4, Orthographic(1.0)), {PlaneKind::Depth, PlaneKind::Triangle});
  EXPECT_GT(film.pixels[0].a, 0.0f);
  for (const float depth : film.planes[0].As<float>()) ASSERT_EQ(depth, kFar);
  for (const std::uint32_t triangle : film.planes[1].As<std::uint32_t>()) ASSERT_EQ(triangle, kNobody);
}

// --- Triangle -------------------------------------------------------------------------------------------------------

// A row of four rectangles, the last one first, each of two triangles.
Primitive Row() {
  Primitive row;
  for (int i = 3; i >= 0; --i) {
    const float x0 = float(i) - 2.0f;
    const std::uint32_t base = std::uint32_t(row.positions.size());
    row.positions.insert(row.positions.end(), {{x0, -1, 0}, {x0 + 1, -1, 0}, {x0 + 1, 1, 0}, {x0, 1, 0}});
    for (const std::uint32_t v : {0u, 1u, 2u, 0u, 2u, 3u}) row.indices.push_back(base + v);
  }
  return row;
}

TEST(TrianglePlane, NamesTheTriangleOfAKnownMesh) {
  Scene scene;
  const int white = AddMaterial(scene, Unlit(glm::vec4(1)));
  Add(scene, Rectangle(-9, -9, 9, 9, -1.0f), white);  // numbers of another drawable do not go on from this one's
  Add(scene, Row(), white);
  for (const int tile_size : {8, 32}) {
    // Rectangles of 8 x 16 pixels; their diagonals, from the lower left to the upper right, pass between pixels'
    // centres.
    RenderSettings settings = Settings(32, 16, 1, Orthographic(1.0, {0, 0, 10}, 2.0));
    settings.tile_size = tile_size;
    const std::vector<std::uint32_t> triangles = Triangles(scene, settings);
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 32; ++x) {
        const double in_x = (x % 8 + 0.5) / 8.0, up = 1.0 - (y + 0.5) / 16.0;
        const std::uint32_t expected = std::uint32_t(2 * (3 - x / 8) + (up > in_x ? 1 : 0));
        ASSERT_EQ(triangles[std::size_t(y * 32 + x)], expected) << x << " " << y;
      }
    }
  }
}

TEST(TrianglePlane, CountsPointsAndLinesAndTheClippedAsWholes) {
  Scene scene;
  Primitive points;
  points.topology = Topology::Points;
  for (const float x : {0.75f, -0.25f, 0.25f}) points.positions.emplace_back(x, 0.5f, 0.0f);
  Add(scene, points, AddMaterial(scene, Unlit(glm::vec4(1))));
  const std::vector<std::uint32_t> triangles = Triangles(scene, Settings(16, 16, 4, Orthographic(1.0)));
  std::vector<std::uint32_t> seen;
  for (const std::uint32_t t : triangles) {
    if (t != kNobody && std::find(seen.begin(), seen.end(), t) == seen.end()) seen.push_back(t);
  }
  EXPECT_EQ(seen, (std::vector<std::uint32_t>{1, 2, 0})) << "from left to right";

  // A floor under the eye, which the near plane cuts.
  Scene floor;
  Primitive wide = Rectangle(-40, -40, 40, 40);
  for (glm::vec3& p : wide.positions) p = {p.x, -1.0f, -p.y};
  wide.normals.clear();
  Add(floor, wide, AddMaterial(floor, Unlit(glm::vec4(1))));
  const std::vector<std::uint32_t> under = Triangles(floor, Settings(32, 32, 1, Perspective(1.0, {0, 0, 0})));
  for (std::size_t p = 0; p < under.size(); ++p) {
    if (p < 512) {
      ASSERT_TRUE(under[p] == kNobody || under[p] < 2u) << p;
    } else if (p >= 20 * 32) {
      ASSERT_LT(under[p], 2u) << p;
    }
  }
}

// --- The request ----------------------------------------------------------------------------------------------------

TEST(Planes, AreThoseThatWereAskedForInTheirOrder) {
  Scene scene;
  Add(scene, Sphere(0.8f, 12, 16), AddMaterial(scene, Material()));
  const RenderSettings settings = Settings(50, 37, 4, Perspective(1.0, {0, 0, 3}));
  const Film plain = Render(scene, settings);
  EXPECT_TRUE(plain.planes.empty());
  const Film one = RenderWith(scene, settings, {PlaneKind::Triangle});
  const Film two = RenderWith(scene, settings, {PlaneKind::Triangle, PlaneKind::Depth});
  EXPECT_EQ(HashFilm(one), HashFilm(plain));
  EXPECT_EQ(HashFilm(two), HashFilm(plain));
  ASSERT_EQ(two.planes.size(), 2u);
  EXPECT_EQ(two.planes[0].kind, PlaneKind::Triangle);
  EXPECT_EQ(two.planes[1].kind, PlaneKind::Depth);
  EXPECT_EQ(HashPlane(two, 0), HashPlane(one, 0));
  // Where colour is, they are, and nowhere else.
  const std::span<const std::uint32_t> triangles = two.planes[0].As<std::uint32_t>();
  const std::span<const float> depths = two.planes[1].As<float>();
  for (std::size_t p = 0; p < two.pixels.size(); ++p) {
    ASSERT_EQ(two.pixels[p].a > 0.0f, triangles[p] != kNobody) << p;
    ASSERT_EQ(two.pixels[p].a > 0.0f, depths[p] != kFar) << p;
  }
}

TEST(Planes, ARendererTakesThemUpAndDropsThem) {
  Scene scene;
  Add(scene, Sphere(0.8f, 12, 16), AddMaterial(scene, Material()));
  Renderer renderer(scene);
  Film film;
  for (const int size : {40, 24, 40}) {
    for (const std::vector<PlaneKind>& planes :
         std::vector<std::vector<PlaneKind>>{{PlaneKind::Depth, PlaneKind::Triangle}, {}, {PlaneKind::Triangle}}) {
      RenderSettings settings = Settings(size, size, 4, Perspective(1.0, {0, 0, 3}));
      settings.planes = planes;
      renderer.Render(settings, film);
      EXPECT_TRUE(SameBytes(film, Render(scene, settings))) << size << ", " << planes.size() << " planes";
    }
  }
}

TEST(Planes, AreRefusedTwiceUnknownOrOfAnImage) {
  Scene scene;
  RenderSettings settings = Settings(16, 16, 1, Perspective(1.0, {0, 0, 3}));
  const auto render = [&] { Render(scene, settings); };
  settings.planes = {PlaneKind::Depth, PlaneKind::Triangle, PlaneKind::Depth};
  EXPECT_NE(Refusal(render).find("the plane depth is asked for twice"), std::string::npos);
  settings.planes = {static_cast<PlaneKind>(std::size(kPlanes))};
  EXPECT_NE(Refusal(render).find("a plane of kind "), std::string::npos);
  settings.planes = {PlaneKind::Depth};
  Image image;
  const auto render_image = [&] { Renderer(scene).RenderImage(settings, {}, image); };
  EXPECT_NE(Refusal(render_image).find("RenderImage() gives no planes besides colour"), std::string::npos);
  settings.planes.clear();
  render_image();
}

TEST(Planes, TheirMemoryCounts) {
  Scene scene;
  Add(scene, Rectangle(-1, -1, 1, 1), AddMaterial(scene, Unlit(glm::vec4(1))));
  RenderSettings settings = Settings(512, 512, 1, Orthographic(1.0));
  const auto least = [&] {
    return LeastLimit([&](std::uint64_t limit) {
      RenderSettings limited = settings;
      limited.memory_limit = limit;
      Render(scene, limited);
    });
  };
  const std::uint64_t without = least();
  settings.planes = {PlaneKind::Depth, PlaneKind::Triangle};
  EXPECT_EQ(least(), without + 512 * 512 * 8);
  settings.memory_limit = 5 << 20;
  const std::string refusal = MemoryRefusal([&] { Render(scene, settings); });
  EXPECT_NE(refusal.find("2.0 MiB for planes besides colour"), std::string::npos) << refusal;
}

}  // namespace
}  // namespace facet
