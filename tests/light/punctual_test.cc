// KHR_lights_punctual's formulas, in double.
#include <gtest/gtest.h>

#include <cmath>

#include "light/lighting-inl.h"

namespace facet {
namespace {

namespace lanes = HWY_NAMESPACE;
using lanes::Vec3;

constexpr double kPi = 3.14159265358979324;

Light MakeLight(LightType type, float intensity) {
  Light light;
  light.type = type;
  light.color = {1.0f, 0.5f, 0.0f};
  light.intensity = intensity;
  return light;
}

PunctualLight Prepare(const Light& light, glm::dvec3 position, glm::dvec3 direction, glm::dvec3 eye = {}) {
  const auto prepared = MakePunctualLights({{&light, position, direction}}, eye);
  EXPECT_EQ(prepared.size(), 1u);
  return prepared.at(0);
}

TEST(PunctualLights, DirectionalIsTheSameEverywhere) {
  const Light light = MakeLight(LightType::Directional, 3.0f);
  const PunctualLight p = Prepare(light, {5, 5, 5}, {0.0, -0.6, 0.8});
  for (Vec3<double> at : {Vec3<double>{0, 0, 0}, {100, -20, 3}}) {
    const auto sample = lanes::SamplePunctual(p, at);
    EXPECT_NEAR(sample.direction.y, 0.6, 1e-7);
    EXPECT_NEAR(sample.direction.z, -0.8, 1e-7);
    EXPECT_EQ(sample.irradiance.x, 3.0);
    EXPECT_EQ(sample.irradiance.y, 1.5);
    EXPECT_EQ(sample.irradiance.z, 0.0);
  }
}

TEST(PunctualLights, PointFallsWithTheSquareRelativeToTheEye) {
  const Light light = MakeLight(LightType::Point, 8.0f);
  const glm::dvec3 eye = {1e6, -2e6, 3e6};
  const PunctualLight p = Prepare(light, eye + glm::dvec3(0.0, 3.0, 4.0), {0, 0, -1}, eye);
  const auto sample = lanes::SamplePunctual(p, Vec3<double>{0, 0, 0});
  EXPECT_NEAR(sample.irradiance.x, 8.0 / 25.0, 1e-7);
  EXPECT_NEAR(sample.direction.y, 0.6, 1e-7);
  EXPECT_NEAR(sample.direction.z, 0.8, 1e-7);
}

TEST(PunctualLights, RangeIsAWindow) {
  Light light = MakeLight(LightType::Point, 1.0f);
  light.range = 2.0f;
  const PunctualLight p = Prepare(light, {0, 0, 0}, {0, 0, -1});
  for (double d : {0.1, 0.5, 1.0, 1.5, 1.99, 2.0, 3.0, 1e12}) {
    const double expected = std::max(std::min(1.0 - std::pow(d / 2.0, 4.0), 1.0), 0.0) / (d * d);
    EXPECT_NEAR(lanes::SamplePunctual(p, Vec3<double>{d, 0, 0}).irradiance.x, expected, 1e-6 * expected) << d;
    const float in_float = lanes::SamplePunctual(p, Vec3<float>{float(d), 0, 0}).irradiance.x;
    EXPECT_NEAR(in_float, expected, 2e-5 * expected) << d;
  }
}

TEST(PunctualLights, SpotFollowsTheExtension) {
  Light light = MakeLight(LightType::Spot, 10.0f);
  light.inner_cone_angle = 0.2f;
  light.outer_cone_angle = 0.6f;
  const PunctualLight p = Prepare(light, {0, 2, 0}, {0, -1, 0});
  for (double angle : {0.0, 0.1, 0.199, 0.3, 0.5, 0.599, 0.601, 1.0, 3.0}) {
    const Vec3<double> at = {2.0 * std::sin(angle), 2.0 - 2.0 * std::cos(angle), 0.0};
    const double t = (std::cos(angle) - std::cos(0.6)) / (std::cos(0.2) - std::cos(0.6));
    const double s = std::min(std::max(t, 0.0), 1.0);
    EXPECT_NEAR(lanes::SamplePunctual(p, at).irradiance.x, 10.0 / 4.0 * s * s, 2e-6) << angle;
  }
}

TEST(PunctualLights, EqualConesMakeAHardEdge) {
  Light light = MakeLight(LightType::Spot, 1.0f);
  light.inner_cone_angle = light.outer_cone_angle = float(kPi / 4);
  const PunctualLight p = Prepare(light, {0, 0, 0}, {1, 0, 0});
  EXPECT_NEAR(lanes::SamplePunctual(p, Vec3<double>{1, 0.99, 0}).irradiance.x * (1 + 0.99 * 0.99), 1.0, 1e-5);
  EXPECT_EQ(lanes::SamplePunctual(p, Vec3<double>{1, 1.01, 0}).irradiance.x, 0.0);
}

TEST(PunctualLights, ZeroDistanceIsFinite) {
  Light light = MakeLight(LightType::Point, 1000.0f);
  for (float range : {HUGE_VALF, 1e-20f, 1.0f}) {
    light.range = range;
    const PunctualLight p = Prepare(light, {0, 0, 0}, {0, 0, -1});
    const auto sample = lanes::SamplePunctual(p, Vec3<float>{0, 0, 0});
    EXPECT_TRUE(std::isfinite(sample.irradiance.x) && std::isfinite(sample.direction.x)) << range;
  }
}

TEST(PunctualLights, LightsThatCannotShineAreCulled) {
  const Light black = MakeLight(LightType::Point, 0.0f);
  Light short_range = MakeLight(LightType::Point, 1.0f);
  short_range.range = 0.0f;
  const Light good = MakeLight(LightType::Spot, 1.0f);
  const auto prepared = MakePunctualLights({{&black, {}, {0, 0, -1}}, {&short_range, {}, {0, 0, -1}},
                                            {&good, {}, {0, 0, -1}}}, {});
  ASSERT_EQ(prepared.size(), 1u);
  EXPECT_EQ(prepared[0].type, LightType::Spot);
}

// Beyond all floats there is no direction to a light: it would make all that it lights black.
TEST(PunctualLights, BeyondAllFloatsShineNothing) {
  const Light point = MakeLight(LightType::Point, 1.0f), spot = MakeLight(LightType::Spot, 1.0f),
              sun = MakeLight(LightType::Directional, 1.0f);
  for (const double x : {1e39, -1e300, double(INFINITY), double(NAN)}) {
    const glm::dvec3 place(0.0, x, 0.0), down(0.0, -1.0, 0.0);
    const auto prepared = MakePunctualLights({{&point, place, down}, {&spot, place, down}, {&sun, place, down}}, {});
    ASSERT_EQ(prepared.size(), 1u) << x;
    EXPECT_EQ(prepared[0].type, LightType::Directional);
  }
  EXPECT_EQ(MakePunctualLights({{&point, {3e38, 0, 0}, {0, -1, 0}}}, {}).size(), 1u);
}

}  // namespace
}  // namespace facet
