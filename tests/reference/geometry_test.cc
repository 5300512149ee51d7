// Visibility by trying: who is hit, exactly once, from which side, and where on the triangle.
#include "reference/geometry_exact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "render/hand_built.h"

namespace facet {
namespace {

constexpr double kPi = 3.14159265358979324;

// A scene posed and seen.
struct Seen {
  Seen(Scene made, const FreeCamera& camera, int width, int height, bool double_sided = true)
      : scene(std::move(made)),
        posed(Pose(scene, {})),
        view(ResolveCamera(camera, scene, posed, width, height), width, height),
        geometry(view, posed, std::vector<bool>(posed.drawables.size(), double_sided)) {
    all.resize(geometry.PrimitiveCount());
    std::iota(all.begin(), all.end(), 0u);
  }
  std::vector<ExactGeometry::Hit> At(const glm::dvec2& place) const {
    std::vector<ExactGeometry::Hit> hits;
    geometry.HitsAt(place, all, hits);
    return hits;
  }

  Scene scene;
  PosedScene posed;
  ExactView view;
  ExactGeometry geometry;
  std::vector<std::uint32_t> all;
};

Scene OnePrimitive(Primitive primitive, const Transform& transform = {}) {
  Scene scene;
  Add(scene, std::move(primitive), AddMaterial(scene, Material{}), transform);
  return scene;
}

Primitive RandomSoup(Topology topology, unsigned seed, int count) {
  Uniform random(seed);
  Primitive p;
  p.topology = topology;
  for (int i = 0; i < count; ++i) {
    const glm::vec3 centre(random(-4, 4), random(-3, 3), random(-12, 4));  // the eye is among them
    for (int k = 0; k < 3; ++k) p.positions.push_back(centre + glm::vec3(random(-1, 1), random(-1, 1), random(-1, 1)));
  }
  return p;
}

TEST(ExactGeometry, CandidatesAreAMereSaving) {
  for (const Topology topology : {Topology::Triangles, Topology::Lines, Topology::Points}) {
    for (const bool orthographic : {false, true}) {
      const FreeCamera camera = orthographic ? Orthographic(3.0, {0, 0, 2}) : Perspective(1.2, {0, 0, 0});
      const Seen seen(OnePrimitive(RandomSoup(topology, 11, 300)), camera, 40, 24);
      std::vector<std::uint32_t> candidates;
      std::vector<ExactGeometry::Hit> few;
      std::size_t hits = 0, tried = 0;
      Uniform random(2);
      for (int y = 0; y < 24; ++y) {
        for (int x = 0; x < 40; ++x) {
          seen.geometry.CandidatesOf(x, y, candidates);
          tried += candidates.size();
          for (int s = 0; s < 4; ++s) {
            const glm::dvec2 place(x + random(), y + random());
            seen.geometry.HitsAt(place, candidates, few);
            const auto every = seen.At(place);
            ASSERT_EQ(few.size(), every.size());
            for (std::size_t i = 0; i < few.size(); ++i) {
              ASSERT_EQ(few[i].primitive, every[i].primitive);
              ASSERT_EQ(few[i].depth, every[i].depth);
            }
            hits += few.size();
          }
        }
      }
      EXPECT_GT(hits, 100u);
      EXPECT_LT(tried, 40u * 24u * seen.all.size());
    }
  }
}

// The interpolated point of a hit lies on the ray through its place, at the distance that its depth says.
TEST(ExactGeometry, HitsLieOnTheirRays) {
  for (const bool orthographic : {false, true}) {
    const FreeCamera camera = orthographic ? Orthographic(3.0, {0, 0, 2}) : Perspective(1.2, {0.1, 0, 0});
    const Seen seen(OnePrimitive(RandomSoup(Topology::Triangles, 5, 300)), camera, 40, 24);
    Uniform random(8);
    std::size_t hits = 0;
    for (int i = 0; i < 2000; ++i) {
      const glm::dvec2 place(random(0, 40), random(0, 24));
      for (const auto& hit : seen.At(place)) {
        const SurfacePoint point = seen.geometry.SurfaceAt(hit);
        ASSERT_GE(std::min({hit.weight.x, hit.weight.y, hit.weight.z}), 0.0);
        ASSERT_NEAR(hit.weight.x + hit.weight.y + hit.weight.z, 1.0, 1e-12);
        const glm::dvec3 in_camera = seen.view.camera_from_world * point.position;
        const glm::dvec2 back = seen.view.PlaceOf(seen.view.ScreenOf(in_camera));
        ASSERT_NEAR(back.x, place.x, 1e-8);
        ASSERT_NEAR(back.y, place.y, 1e-8);
        ASSERT_EQ(hit.depth, seen.view.DepthAt(-in_camera.z)) << orthographic;
        ASSERT_NEAR(glm::dot(point.view, seen.view.DirectionThrough(place)), -1.0, 1e-12);
        ++hits;
      }
    }
    EXPECT_GT(hits, 200u);
  }
}

// Places that are exactly on edges and corners of a grid of squares, cut along both diagonals: one triangle each.
TEST(ExactGeometry, SharedEdgesBelongToOneTriangle) {
  for (const bool orthographic : {false, true}) {
    Primitive p;
    constexpr int kSize = 8;
    for (int y = 0; y <= kSize; ++y) {
      for (int x = 0; x <= kSize; ++x) p.positions.emplace_back(x - 4, y - 4, 0);
    }
    for (std::uint32_t y = 0; y < kSize; ++y) {
      for (std::uint32_t x = 0; x < kSize; ++x) {
        const std::uint32_t a = y * (kSize + 1) + x, b = a + 1, c = b + kSize + 1, d = c - 1;
        if ((x + y) & 1) {
          p.indices.insert(p.indices.end(), {a, b, c, a, c, d});
        } else {
          p.indices.insert(p.indices.end(), {a, b, d, b, c, d});
        }
      }
    }
    // A pixel is a quarter of a square.
    const FreeCamera camera = orthographic ? Orthographic(4.0) : Perspective(0.5 * kPi, {0, 0, 4});
    const Seen seen(OnePrimitive(p), camera, 32, 32);
    int on_edges = 0;
    for (int y = 1; y < 64; ++y) {
      for (int x = 1; x < 64; ++x) {
        const glm::dvec2 place(x * 0.5, y * 0.5);
        on_edges += x % 8 == 0 || y % 8 == 0;
        ASSERT_EQ(seen.At(place).size(), 1u) << place.x << ", " << place.y << (orthographic ? " orthographic" : "");
      }
    }
    EXPECT_GT(on_edges, 500);
  }
}

TEST(ExactGeometry, FrontBackAndMirrored) {
  for (const bool mirrored : {false, true}) {
    for (const bool turned : {false, true}) {
      for (const bool orthographic : {false, true}) {
        Transform transform;
        if (mirrored) transform.scale.x = -1.0;
        if (turned) transform.rotation = glm::dquat(0, 0, 1, 0);  // half a turn about +Y
        const Scene scene = OnePrimitive(Rectangle(-1, -1, 1, 1), transform);
        const FreeCamera camera = orthographic ? Orthographic(2.0) : Perspective(0.5, {0, 0, 10});
        const Seen single(scene, camera, 8, 8, /*double_sided=*/false), both(scene, camera, 8, 8);
        EXPECT_EQ(single.At({4.1, 4.2}).size(), turned ? 0u : 1u) << mirrored;
        const auto hits = both.At({4.1, 4.2});
        ASSERT_EQ(hits.size(), 1u);
        const SurfacePoint point = both.geometry.SurfaceAt(hits[0]);
        EXPECT_NEAR(point.normal.z, 1.0, 1e-15);  // on the viewer's side
      }
    }
  }
}

// The sphere's silhouette is a circle: its area in the image.
TEST(ExactGeometry, ASphereCoversItsDisc) {
  const Seen seen(OnePrimitive(Sphere(1.0f, 100, 200)), Orthographic(1.25), 16, 16, false);
  int inside = 0;
  constexpr int kSide = 96;
  std::vector<std::uint32_t> candidates;
  std::vector<ExactGeometry::Hit> hits;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const glm::dvec2 place((x + 0.5) * 16 / kSide, (y + 0.5) * 16 / kSide);
      seen.geometry.CandidatesOf(int(place.x), int(place.y), candidates);
      seen.geometry.HitsAt(place, candidates, hits);
      ASSERT_LE(hits.size(), 1u);  // the front, once
      inside += !hits.empty();
      if (!hits.empty()) {
        const glm::dvec3 world = seen.geometry.SurfaceAt(hits[0]).position + seen.view.eye_world;
        ASSERT_NEAR(glm::length(world), 1.0, 5e-4);
      }
    }
  }
  EXPECT_NEAR(double(inside) / (kSide * kSide), kPi / 6.25, 0.0015);
}

TEST(ExactGeometry, NearAndFarPlanesCut) {
  // A floor below the eye, from behind it to far away.
  Primitive floor;
  floor.positions = {{-100, -1, 50}, {100, -1, 50}, {100, -1, -150}, {-100, -1, -150}};
  floor.indices = {0, 1, 2, 0, 2, 3};
  FreeCamera camera = Perspective(0.5 * kPi, {0, 0, 0});
  camera.lens.znear = 4.0;
  camera.lens.zfar = 10.0;
  const Seen seen(OnePrimitive(floor), camera, 40, 40);
  for (int y = 0; y < 40; ++y) {
    const double slope = (y + 0.5 - 20.0) / 20.0, distance = slope > 0.0 ? 1.0 / slope : -1.0;
    EXPECT_EQ(seen.At({20.3, y + 0.5}).size(), distance >= 4.0 && distance <= 10.0 ? 1u : 0u) << y;
  }
}

TEST(ExactGeometry, LinesAndPointsAreOnePixelWide) {
  Primitive line;
  line.topology = Topology::Lines;
  line.positions = {{-4, 0.25, 0}, {4, 0.25, -8}};
  line.colors = {{0, 0, 0, 1}, {1, 0, 0, 1}};
  const Seen seen(OnePrimitive(line), Perspective(0.5 * kPi, {0, 0.25, 8}), 16, 16);
  // From pixel (4, 8) to (10, 8): half way on the screen is not half way along.
  for (double x : {4.1, 7.0, 9.9}) {
    for (double y : {7.6, 8.4}) {
      const auto hits = seen.At({x, y});
      ASSERT_EQ(hits.size(), 1u) << x << " " << y;
      const double u = (x - 4.0) / 6.0, share = (u / 16.0) / ((1.0 - u) / 8.0 + u / 16.0);
      EXPECT_NEAR(seen.geometry.SurfaceAt(hits[0]).color.x, share, 1e-9);
      EXPECT_NEAR(hits[0].depth, (1.0 - u) / 8.0 + u / 16.0, 1e-8);
    }
  }
  for (const glm::dvec2& place : {glm::dvec2(3.9, 8), {10.1, 8}, {7, 7.4}, {7, 8.6}})
    EXPECT_TRUE(seen.At(place).empty());

  Primitive point;
  point.topology = Topology::Points;
  point.positions = {{0.5f, 0, 0}, {100, 0, 0}};
  const Seen points(OnePrimitive(point), Orthographic(8.0), 16, 16);
  EXPECT_EQ(points.At({8.9, 7.6}).size(), 1u);
  EXPECT_TRUE(points.At({9.1, 7.6}).empty());
  EXPECT_TRUE(points.At({8.5, 7.4}).empty());
}

TEST(ExactGeometry, WhatIsNotFiniteIsCulled) {
  Primitive p = Rectangle(-1, -1, 1, 1);
  p.positions[1].x = NAN;  // of the first triangle alone
  const Seen seen(OnePrimitive(p), Orthographic(2.0), 8, 8);
  EXPECT_EQ(seen.all.size(), 1u);
}

}  // namespace
}  // namespace facet
