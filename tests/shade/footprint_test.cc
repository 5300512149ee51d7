// The widening of specular lobes by the solid angle that the normal sweeps over a pixel.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "light/environment-inl.h"
#include "material/lobes/microfacets-inl.h"
#include "render/frame_view.h"
#include "shade/interpolate-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace {

namespace lanes = HWY_NAMESPACE;

constexpr int kSize = 64;  // of the image, in pixels; one anchor square

ResolvedCamera CameraAtOrigin(bool orthographic) {
  ResolvedCamera camera;
  camera.lens.yfov = 1.0;
  camera.lens.aspect = 1.0;
  camera.lens.orthographic = orthographic;
  camera.lens.xmag = camera.lens.ymag = 2.0;
  return camera;
}

// One lit triangle.
struct Triangle {
  FrameMaterial material;
  std::vector<float> setup;
  bool orthographic;

  Triangle(bool is_orthographic, const glm::vec3 (&positions)[3], const glm::vec3 (&normals)[3],
           bool antialiasing = true)
      : orthographic(is_orthographic) {
    material.features = kLit;
    material.specular_antialiasing = antialiasing;
    Primitive p;
    p.positions.assign(positions, positions + 3);
    p.normals.assign(normals, normals + 3);
    Drawable placed;
    placed.geometry = &p;
    const FrameView view = MakeFrameView(CameraAtOrigin(orthographic), kSize, kSize);
    const FrameDrawable drawable = MakeFrameDrawable(view, placed);
    setup.resize(std::size_t(AttributeLayout::Stride(0)));
    ScreenTriangle record;
    record.drawable = record.primitive = 0;
    record.back_facing = false;
    record.kind = ScreenTriangleKind::Triangle;
    const ScreenTriangle* const records[] = {&record};
    SetUpTriangleAttributes({&view, &drawable, &drawable.geometry, &material, 0, 0, records, 1, setup.data()});
  }

  lanes::Surface<double> At(double x, double y) const {
    const std::vector<std::int32_t> index(16, 0);
    const std::vector<float> xs(16, float(x)), ys(16, float(y));
    ShadeTask task;
    task.setup = index.data();
    task.x = xs.data();
    task.y = ys.data();
    task.count = 1;
    task.setups = setup.data();
    task.material = &material;
    task.orthographic = orthographic;
    return lanes::InterpolateSurface<double>(task, 0);
  }

  glm::dvec3 NormalAt(double x, double y) const {
    const lanes::Vec3<double> n = At(x, y).normal;
    return {n.x, n.y, n.z};
  }
};

// An orthographic pixel of width h sees the solid angle h^2 / (R^2 cos theta) of the normals of a sphere of radius R.
TEST(Footprint, SphereHasItsClosedForm) {
  constexpr double kRadius = 1.5, kPixel = 4.0 / kSize;
  for (const double theta : {0.0, 0.4, 0.9, 1.2}) {
    glm::vec3 positions[3], normals[3];
    for (int i = 0; i < 3; ++i) {
      const double turn = 2.0943951 * i, spread = 0.01;
      const double a = theta + spread * std::cos(turn), b = spread * std::sin(turn);
      const glm::dvec3 n(std::sin(a) * std::cos(b), std::sin(b), std::cos(a) * std::cos(b));
      normals[i] = n;
      positions[i] = n * kRadius + glm::dvec3(0, 0, -5);
    }
    const Triangle triangle(true, positions, normals);
    const double x = kSize / 2 + kRadius * std::sin(theta) / kPixel, y = kSize / 2;
    const double expected = kPixel * kPixel / (kRadius * kRadius * std::cos(theta)) / 16.0;
    EXPECT_NEAR(triangle.At(x, y).footprint_alpha2, expected, 2e-3 * expected) << theta;
  }
}

// For any triangle it is a sixteenth of n . (dn/dx x dn/dy), with the derivatives of the unit normal, up to the bound.
TEST(Footprint, IsTheSolidAngleOfTheNormals) {
  std::mt19937 random(7);
  const auto uniform = [&](double low, double high) { return low + (high - low) * double(random() >> 8) / 16777216.0; };
  int compared = 0;
  for (int round = 0; round < 2000; ++round) {
    const bool orthographic = round % 2 == 0;
    glm::vec3 positions[3], normals[3];
    for (int i = 0; i < 3; ++i) {
      positions[i] = glm::dvec3(uniform(-2, 2), uniform(-2, 2), uniform(-9, -2));
      normals[i] = glm::normalize(glm::dvec3(uniform(-1, 1), uniform(-1, 1), uniform(0.5, 1)));
    }
    const Triangle triangle(orthographic, positions, normals);
    const double x = kSize / 2, y = kSize / 2, h = 0.125;
    const auto inside = [&](double at_x, double at_y) {
      const auto w = lanes::InterpolationWeights<double>(triangle.setup.data(), lanes::UniformSetup{0}, at_x, at_y);
      return w.b[0] > 0.0 && w.b[1] > 0.0 && w.b[2] > 0.0;
    };
    if (!inside(x - h, y - h) || !inside(x + h, y - h) || !inside(x - h, y + h) || !inside(x + h, y + h)) continue;
    const glm::dvec3 dx = (triangle.NormalAt(x + h, y) - triangle.NormalAt(x - h, y)) / (2 * h);
    const glm::dvec3 dy = (triangle.NormalAt(x, y + h) - triangle.NormalAt(x, y - h)) / (2 * h);
    const double expected = std::fabs(glm::dot(triangle.NormalAt(x, y), glm::cross(dx, dy))) / 16.0;
    const double got = triangle.At(x, y).footprint_alpha2;
    EXPECT_LE(got, 0.18f);
    if (expected > 0.1) continue;
    EXPECT_NEAR(got, expected, 2e-2 * expected + 1e-9) << round;
    ++compared;
  }
  EXPECT_GT(compared, 100);
}

// Where the normal is constant, it is exactly 0, whatever the place and the normal; also where it is disabled.
TEST(Footprint, PlanesAreLeftAsTheyAre) {
  std::mt19937 random(3);
  const auto uniform = [&](double low, double high) { return low + (high - low) * double(random() >> 8) / 16777216.0; };
  for (int round = 0; round < 300; ++round) {
    glm::vec3 positions[3], same[3], others[3];
    const glm::vec3 normal(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    for (int i = 0; i < 3; ++i) {
      positions[i] = glm::dvec3(uniform(-2, 2), uniform(-2, 2), uniform(-9, -2));
      same[i] = normal;
      others[i] = glm::dvec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    }
    EXPECT_EQ(Triangle(round % 2 == 0, positions, same).At(32, 32).footprint_alpha2, 0.0);
    EXPECT_EQ(Triangle(round % 2 == 0, positions, others, false).At(32, 32).footprint_alpha2, 0.0);
  }
}

TEST(Footprint, ZeroWidensNothing) {
  for (int i = 0; i <= 1000; ++i) {
    const float roughness = float(i) / 1000.0f;
    EXPECT_EQ(lanes::WidenedRoughness(roughness, 0.0f), roughness);
    EXPECT_FALSE(lanes::IsWidened(roughness, 0.0f));
  }
}

// Squares of alpha add up. Lobes that are so wide that it would not show are left as they are.
TEST(Footprint, SquaresOfAlphaAddUp) {
  for (double roughness = 0.0; roughness <= 1.0; roughness += 1.0 / 64) {
    for (const double alpha2 : {1e-8, 1e-5, 1e-3, 0.02, 0.18}) {
      const double own = std::pow(roughness, 4);
      const bool wider = lanes::IsWidened(roughness, alpha2);
      EXPECT_EQ(wider, alpha2 > own / 64);
      EXPECT_NEAR(std::pow(lanes::WidenedRoughness(roughness, alpha2), 4), wider ? own + alpha2 : own, 1e-12);
    }
  }
}

// A mixture of two levels of the prefiltered environment has the mean of their squares.
TEST(Footprint, MixturesAreAsWideAsTheLobe) {
  constexpr int kLast = EnvironmentMap::kLevels - 1;
  for (double roughness = 1.0 / 512; roughness < 1.0; roughness += 1.0 / 256) {
    const double looked_up = lanes::RoughnessOfMixture(roughness);
    EXPECT_LE(looked_up, roughness);
    const double at = looked_up * kLast, level = std::floor(at);
    const double mixture =
        std::pow(level / kLast, 4) * (level + 1 - at) + std::pow((level + 1) / kLast, 4) * (at - level);
    EXPECT_NEAR(mixture, std::pow(roughness, 4), 1e-12);
  }
  for (int k = 0; k <= kLast; ++k) EXPECT_EQ(lanes::RoughnessOfMixture(double(k) / kLast), double(k) / kLast);
}

}  // namespace
}  // namespace facet
HWY_AFTER_NAMESPACE();
