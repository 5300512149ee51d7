// Rays through the reference's scene: the hierarchy of boxes finds what trying all triangles finds.
#include "reference/rays_exact.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/hand_built.h"

namespace facet {
namespace {

struct Traced {
  explicit Traced(Scene made)
      : scene(std::move(made)),
        posed(Pose(scene, {})),
        view(ResolveCamera(Orthographic(1.0, {0, 0, 0}), scene, posed, 4, 4), 4, 4),
        geometry(view, posed, std::vector<bool>(posed.drawables.size(), true)),
        rays(geometry) {}

  Scene scene;
  PosedScene posed;
  ExactView view;
  ExactGeometry geometry;
  ExactRays rays;
};

glm::dvec3 RandomDirection(Uniform& random) {
  glm::dvec3 d;
  do {
    d = {random(-1, 1), random(-1, 1), random(-1, 1)};
  } while (glm::dot(d, d) > 1.0 || glm::dot(d, d) < 0.01);
  return glm::normalize(d);
}

const auto kAll = [](const ExactRays::Hit&) { return true; };

Scene Soup(unsigned seed, int count) {
  Uniform random(seed);
  Scene scene;
  for (int mesh = 0; mesh < 2; ++mesh) {
    Primitive p;
    for (int i = 0; i < count; ++i) {
      const glm::vec3 centre(random(-4, 4), random(-3, 3), random(-5, 5));
      for (int k = 0; k < 3; ++k) {
        p.positions.push_back(centre + glm::vec3(random(-1, 1), random(-1, 1), random(-1, 1)));
      }
    }
    Transform transform;
    if (mesh == 1) transform.scale = {1.0, -0.5, 1.5};  // mirrored
    Add(scene, p, AddMaterial(scene, Material{}), transform);
  }
  return scene;
}

TEST(ExactRays, TheHierarchyIsAMereSaving) {
  const Traced traced(Soup(3, 400));
  ASSERT_EQ(traced.rays.TriangleCount(), 800u);
  Uniform random(4);
  int hits = 0;
  for (int i = 0; i < 1500; ++i) {
    ExactRay ray{{random(-5, 5), random(-5, 5), random(-5, 5)}, RandomDirection(random)};
    if (i % 10 == 0) ray.direction = {0.0, i % 20 == 0 ? 1.0 : -1.0, 0.0};
    // By Cramer's rule, one after the other.
    double nearest = 1e300;
    TriangleId which;
    for (std::uint32_t d = 0; d < 2; ++d) {
      for (std::uint32_t t = 0; t < 400; ++t) {
        const auto corner = traced.geometry.CornersOf({d, t});
        const glm::dmat3 columns(corner[1] - corner[0], corner[2] - corner[0], -ray.direction);
        const glm::dvec3 x = glm::inverse(columns) * (ray.origin - corner[0]);
        if (x.x < 0.0 || x.y < 0.0 || x.x + x.y > 1.0 || x.z <= 0.0 || x.z >= nearest) continue;
        nearest = x.z;
        which = {d, t};
      }
    }
    const auto hit = traced.rays.Nearest(ray, kAll);
    ASSERT_EQ(hit.has_value(), nearest < 1e300) << i;
    if (!hit) continue;
    ++hits;
    ASSERT_EQ(hit->triangle, which);
    ASSERT_NEAR(hit->distance, nearest, 1e-9);
    const SurfacePoint point = traced.geometry.SurfaceOf(which, hit->weight, hit->is_back, -ray.direction);
    ASSERT_LT(glm::length(point.position - (ray.origin + ray.direction * nearest)), 1e-9);
    ASSERT_LE(glm::dot(point.flat_normal, ray.direction), 0.0);  // on the side that it comes from
    // Behind what is not accepted there is the next.
    const auto next = traced.rays.Nearest(ray, [&](const ExactRays::Hit& h) { return !(h.triangle == which); });
    ExactRay on = ray;
    on.origin = point.position;
    on.from = which;
    const auto after = traced.rays.Nearest(on, kAll);
    ASSERT_EQ(after.has_value(), next.has_value());
    if (!next) continue;
    ASSERT_GE(next->distance, hit->distance);
    ASSERT_EQ(after->triangle, next->triangle);
  }
  EXPECT_GT(hits, 500);
}

// From inside a sphere every ray meets a back once, also through its edges and corners, and nothing after that.
TEST(ExactRays, NoneSlipsThroughAClosedMesh) {
  Scene scene;
  Add(scene, Sphere(1.0f, 12, 24), AddMaterial(scene, Material{}));
  const Traced traced(std::move(scene));
  Uniform random(6);
  const auto check = [&](const glm::dvec3& direction) {
    const ExactRay ray{glm::dvec3(0.0), direction};
    const auto hit = traced.rays.Nearest(ray, kAll);
    ASSERT_TRUE(hit);
    EXPECT_TRUE(hit->is_back);
    EXPECT_NEAR(hit->distance, 1.0, 0.03);
    EXPECT_FALSE(traced.rays.Nearest({direction * 2.0, direction}, kAll));
    const auto front = traced.rays.Nearest({direction * 2.0, -direction}, kAll);
    ASSERT_TRUE(front);
    EXPECT_FALSE(front->is_back);
  };
  for (int i = 0; i < 1000; ++i) check(RandomDirection(random));
  const Primitive& sphere = traced.scene.meshes[0].primitives[0];
  for (std::size_t i = 0; i < sphere.indices.size(); i += 3) {
    const glm::dvec3 a(sphere.positions[sphere.indices[i]]), b(sphere.positions[sphere.indices[i + 1]]);
    check(glm::normalize(a));
    check(glm::normalize(a + b));
  }
}

TEST(ExactRays, WithoutTrianglesNothingIsHit) {
  Scene scene;
  Primitive points;
  points.topology = Topology::Points;
  points.positions = {{0, 0, -1}};
  Add(scene, points, AddMaterial(scene, Material{}));
  const Traced traced(std::move(scene));
  EXPECT_EQ(traced.rays.TriangleCount(), 0u);
  EXPECT_FALSE(traced.rays.Nearest({}, kAll));
}

}  // namespace
}  // namespace facet
