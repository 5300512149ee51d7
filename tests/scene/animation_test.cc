#include "scene/animation.h"

#include <gtest/gtest.h>

#include <random>

#include "scene/hierarchy.h"
#include "scene_helpers.h"

namespace facet {
namespace {

AnimationChannel Channel(AnimationPath path, Interpolation interpolation, std::vector<float> times,
                         std::vector<float> values) {
  return {0, path, interpolation, std::move(times), std::move(values)};
}

double AngleBetween(const glm::dquat& a, const glm::dquat& b) {
  const glm::dquat d = a - b, s = a + b;
  const double x = std::sqrt(glm::dot(d, d)), y = std::sqrt(glm::dot(s, s));
  return 4.0 * std::atan2(std::min(x, y), std::max(x, y));  // of the rotations, double that of the quaternions
}

TEST(Animation, LinearVectorsAreMixedAndClamped) {
  const AnimationChannel channel =
      Channel(AnimationPath::Translation, Interpolation::Linear, {1.0f, 3.0f, 4.0f}, {0, 0, 0, 2, 4, -8, 5, 5, 5});
  EXPECT_EQ(SampleVector(channel, -7.0), glm::dvec3(0, 0, 0));
  EXPECT_EQ(SampleVector(channel, 1.0), glm::dvec3(0, 0, 0));
  EXPECT_EQ(SampleVector(channel, 1.5), glm::dvec3(0.5, 1, -2));
  EXPECT_EQ(SampleVector(channel, 3.0), glm::dvec3(2, 4, -8));
  EXPECT_EQ(SampleVector(channel, 4.0), glm::dvec3(5, 5, 5));
  EXPECT_EQ(SampleVector(channel, std::numeric_limits<double>::infinity()), glm::dvec3(5, 5, 5));
}

TEST(Animation, StepHoldsUntilTheNextKey) {
  const AnimationChannel channel =
      Channel(AnimationPath::Scale, Interpolation::Step, {0.0f, 1.0f, 2.0f}, {1, 1, 1, 2, 2, 2, 3, 3, 3});
  EXPECT_EQ(SampleVector(channel, 0.999999), glm::dvec3(1));
  EXPECT_EQ(SampleVector(channel, 1.0), glm::dvec3(2));
  EXPECT_EQ(SampleVector(channel, 1.9), glm::dvec3(2));
  EXPECT_EQ(SampleVector(channel, 2.0), glm::dvec3(3));
}

// Two keys at one time make a jump: what comes before goes to the first, what comes after from the second on.
TEST(Animation, KeysAtOneTimeJump) {
  const float nan = std::numeric_limits<float>::quiet_NaN();  // tangents beside a jump are never read
  const std::vector<float> times = {0, 0, 1, 1, 1, 2, 2};
  const std::vector<float> x = {-1, 0, 10, 50, 20, 30, 40};
  std::vector<float> values, cubic;
  for (const float v : x) {
    values.insert(values.end(), {v, 0, 0});
    cubic.insert(cubic.end(), {10, 0, 0, v, 0, 0, 10, 0, 0});
  }
  cubic[3 * 9 + 0] = cubic[3 * 9 + 6] = nan;  // of the one in the middle, which no moment shows
  const auto at = [&](Interpolation interpolation, double time) {
    const bool is_cubic = interpolation == Interpolation::CubicSpline;
    return SampleVector(Channel(AnimationPath::Translation, interpolation, times, is_cubic ? cubic : values), time).x;
  };
  for (const Interpolation any : {Interpolation::Linear, Interpolation::Step, Interpolation::CubicSpline}) {
    EXPECT_EQ(at(any, -1.0), -1.0);
    EXPECT_EQ(at(any, 0.0), 0.0);
    EXPECT_EQ(at(any, 1.0), 20.0);
    EXPECT_EQ(at(any, 2.0), 40.0);
    EXPECT_EQ(at(any, 9.0), 40.0);
  }
  for (const Interpolation smooth : {Interpolation::Linear, Interpolation::CubicSpline}) {
    EXPECT_NEAR(at(smooth, 0.5), 5.0, 1e-12);
    EXPECT_NEAR(at(smooth, 1.5), 25.0, 1e-12);
    EXPECT_NEAR(at(smooth, std::nextafter(1.0, 0.0)), 10.0, 1e-12);
    EXPECT_NEAR(at(smooth, std::nextafter(1.0, 2.0)), 20.0, 1e-12);
  }
  EXPECT_EQ(at(Interpolation::Step, 0.5), 0.0);
  EXPECT_EQ(at(Interpolation::Step, 1.5), 20.0);
  AnimationChannel turns = Channel(AnimationPath::Rotation, Interpolation::Linear, {0, 1, 1, 2},
                                   {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0});
  EXPECT_EQ(SampleRotation(turns, 0.5), glm::dquat(1, 0, 0, 0));
  EXPECT_EQ(SampleRotation(turns, 1.5), glm::dquat(0, 0, 0, 1));
  const AnimationChannel weights = Channel(AnimationPath::Weights, Interpolation::Linear, {0, 1, 1}, {0, 1, 5});
  EXPECT_EQ(SampleWeights(weights, 0.5), std::vector<float>{0.5f});
  EXPECT_EQ(SampleWeights(weights, 1.0), std::vector<float>{5.0f});
}

// A cubic spline reproduces every cubic polynomial from its values and derivatives.
TEST(Animation, CubicSplineReproducesCubics) {
  const auto value = [](double t) { return 2.0 * t * t * t - 3.0 * t * t + 0.5 * t - 1.0; };
  const auto slope = [](double t) { return 6.0 * t * t - 6.0 * t + 0.5; };
  AnimationChannel channel = Channel(AnimationPath::Translation, Interpolation::CubicSpline, {0.5f, 1.0f, 3.0f}, {});
  for (const float t : channel.times) {
    for (const double v : {slope(t), value(t), slope(t)}) {
      channel.values.insert(channel.values.end(), {float(v), float(2 * v), 0.0f});
    }
  }
  for (double t = 0.5; t <= 3.0; t += 0.01) {
    EXPECT_NEAR(SampleVector(channel, t).x, value(t), 1e-12) << t;
    EXPECT_NEAR(SampleVector(channel, t).y, 2 * value(t), 1e-12) << t;
  }
  EXPECT_EQ(SampleVector(channel, 9.0).x, value(3.0));
}

TEST(Animation, CubicRotationsAreUnit) {
  const AnimationChannel channel = Channel(AnimationPath::Rotation, Interpolation::CubicSpline, {0.0f, 1.0f},
                                           {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 3, 0,  //
                                            0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0});
  for (double t = 0.0; t <= 1.0; t += 0.1) {
    const glm::dquat rotation = SampleRotation(channel, t);
    EXPECT_NEAR(glm::dot(rotation, rotation), 1.0, 1e-15);
  }
  EXPECT_EQ(SampleRotation(channel, 0.0), glm::dquat(1, 0, 0, 0));
  EXPECT_EQ(SampleRotation(channel, 1.0), glm::dquat(0, 0, 1, 0));
  // Halfway: value = (q0 + q1) / 2 + duration * (out0 - in1) / 8 = (0, 0.5, 3/8 - 1/8, 0.5), made unit.
  const glm::dquat expected = NormalizedOrIdentity(glm::dquat(0.5, 0.0, 0.5, 0.25));
  EXPECT_LT(AngleBetween(SampleRotation(channel, 0.5), expected), 1e-15);
}

TEST(Slerp, TurnsAtConstantSpeedAroundAnyAxis) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 axis = glm::normalize(glm::dvec3(uniform(random), uniform(random), uniform(random)));
    const glm::dquat from = NormalizedOrIdentity(
        glm::dquat(uniform(random), uniform(random), uniform(random), uniform(random)));
    const double angle = i < 100 ? std::pow(10.0, -12.0 + 0.12 * i) : kTestPi * std::abs(uniform(random));
    const glm::dquat to = RotationAbout(axis, angle) * from;
    for (const double s : {0.0, 0.1, 0.5, 0.77, 1.0}) {
      const glm::dquat expected = RotationAbout(axis, s * angle) * from;
      EXPECT_LT(AngleBetween(Slerp(from, to, s), expected), 1e-14) << angle << " " << s;
      EXPECT_LT(AngleBetween(Slerp(from, -to, s), expected), 1e-14) << "the other sign is the same rotation";
    }
  }
}

TEST(Slerp, TakesTheShorterWay) {
  const glm::dvec3 y(0, 1, 0);
  const glm::dquat halfway = Slerp(RotationAbout(y, 0.1), RotationAbout(y, 2 * kTestPi - 0.1), 0.5);
  EXPECT_LT(AngleBetween(halfway, glm::dquat(1, 0, 0, 0)), 1e-14);
}

TEST(Slerp, SurvivesDegenerateInputs) {
  const glm::dquat identity(1, 0, 0, 0);
  EXPECT_EQ(Slerp(identity, identity, 0.3), identity);
  EXPECT_EQ(Slerp(identity, -identity, 0.3), identity);
  const glm::dquat half_turn = Slerp(identity, glm::dquat(0, 0, 0, 1), 0.5);  // the largest angle there is
  EXPECT_LT(AngleBetween(half_turn, RotationAbout({0, 0, 1}, kTestPi / 2)), 1e-15);
  EXPECT_EQ(NormalizedOrIdentity(glm::dquat(0, 0, 0, 0)), identity);
}

TEST(Animation, KeysThatAreNotUnitAreNormalized) {
  const AnimationChannel channel = Channel(AnimationPath::Rotation, Interpolation::Linear, {0.0f, 1.0f},
                                           {0, 0, 0, 5, 0, 0, 0.01f, 0.01f});
  EXPECT_LT(AngleBetween(SampleRotation(channel, 0.5), RotationAbout({0, 0, 1}, kTestPi / 4)), 1e-14);
}

TEST(Animation, WeightsOfSeveralTargets) {
  const AnimationChannel linear =
      Channel(AnimationPath::Weights, Interpolation::Linear, {0.0f, 2.0f}, {0, 1, 0.5f, 1, 0, 0.5f});
  EXPECT_EQ(SampleWeights(linear, 0.5), (std::vector<float>{0.25f, 0.75f, 0.5f}));
  const AnimationChannel cubic = Channel(AnimationPath::Weights, Interpolation::CubicSpline, {0.0f, 1.0f},
                                         {9, 9, 1, 2, 0, 4,  //
                                          0, 8, 3, 6, 9, 9});
  // (v0 + v1) / 2 + duration * (out0 - in1) / 8
  EXPECT_EQ(SampleWeights(cubic, 0.5), (std::vector<float>{2.0f, 3.5f}));
}

TEST(Hierarchy, MatricesAndTheirParts) {
  Transform transform{{1, 2, 3}, RotationAbout(glm::normalize(glm::dvec3(1, 2, 3)), 1.1), {2, 3, 4}};
  const Transform parts = ToTransform(ToMatrix(transform));
  EXPECT_LT(Distance(parts.translation, transform.translation), 1e-15);
  EXPECT_LT(Distance(parts.scale, transform.scale), 1e-14);
  EXPECT_LT(AngleBetween(parts.rotation, transform.rotation), 1e-14);
  transform.scale = {-2, 3, 4};
  const glm::dmat4 mirrored = ToMatrix(transform), again = ToMatrix(ToTransform(mirrored));
  for (int c = 0; c < 4; ++c) EXPECT_LT(glm::length(mirrored[c] - again[c]), 1e-14);
}

}  // namespace
}  // namespace facet
