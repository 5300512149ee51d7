#include <gtest/gtest.h>

#include <cmath>

#include "color/grading-inl.h"

namespace facet {
namespace {

namespace lane = HWY_NAMESPACE;
using Light = lane::Vec3<double>;

void ExpectNear(const Light& result, const Light& expected, double tolerance) {
  EXPECT_NEAR(result.x, expected.x, tolerance);
  EXPECT_NEAR(result.y, expected.y, tolerance);
  EXPECT_NEAR(result.z, expected.z, tolerance);
}

TEST(Grading, ChangesNothingByDefault) {
  const GradingFactors factors;
  EXPECT_TRUE(factors.ChangesNothing());
  ExpectNear(lane::Grade(factors, Light{0.1, 2.0, 30.0}), {0.1, 2.0, 30.0}, 0.0);
}

TEST(Grading, WhiteBalanceKeepsD65AndTurnsThePictureBlueYellowAndMagenta) {
  GradingFactors factors;
  SetWhiteBalance(0.0, 0.0, factors.white_balance);
  factors.balances_white = true;
  ExpectNear(lane::Grade(factors, Light{0.5, 0.5, 0.5}), {0.5, 0.5, 0.5}, 1e-6);
  SetWhiteBalance(-1.0, 0.0, factors.white_balance);
  const Light bluish = lane::Grade(factors, Light{0.5, 0.5, 0.5});
  SetWhiteBalance(1.0, 0.0, factors.white_balance);
  const Light yellowish = lane::Grade(factors, Light{0.5, 0.5, 0.5});
  EXPECT_GT(yellowish.x / yellowish.z, 1.0);
  EXPECT_LT(bluish.x / bluish.z, 1.0);
  SetWhiteBalance(0.0, 1.0, factors.white_balance);
  const Light tinted = lane::Grade(factors, Light{0.5, 0.5, 0.5});
  EXPECT_LT(tinted.y, 0.5);
}

TEST(Grading, ContrastKeepsMiddleGrey) {
  GradingFactors factors;
  factors.contrast = 1.5f;
  ExpectNear(lane::Grade(factors, Light{0.18, 0.36, 0.09}),
             {0.18, 0.18 * std::pow(2.0, 1.5), 0.18 * std::pow(0.5, 1.5)}, 1e-6);
}

TEST(Grading, SaturationMovesAlongTheLuminance) {
  GradingFactors factors;
  factors.saturation = 0.0f;
  const double luminance = 0.2126 * 0.5 + 0.7152 * 0.25 + 0.0722 * 1.0;
  ExpectNear(lane::Grade(factors, Light{0.5, 0.25, 1.0}), {luminance, luminance, luminance}, 1e-6);
  factors.saturation = 2.0f;
  const Light more = lane::Grade(factors, Light{0.3, 0.25, 0.35});
  EXPECT_NEAR(0.2126 * more.x + 0.7152 * more.y + 0.0722 * more.z, 0.2126 * 0.3 + 0.7152 * 0.25 + 0.0722 * 0.35, 1e-6);
}

TEST(Grading, CurvesMeetAtTheMiddle) {
  GradingFactors factors;
  factors.has_curves = true;
  for (int c = 0; c < 3; ++c) factors.gamma[c] = 2.0f, factors.middle[c] = 0.5f, factors.scale[c] = 0.5f;
  ExpectNear(lane::Grade(factors, Light{0.5, 0.25, 1.5}), {0.5, 0.125, 1.0}, 1e-6);
}

TEST(Grading, AnyInputComesOutFiniteAndPositive) {
  GradingFactors factors;
  factors.balances_white = factors.has_curves = true;
  SetWhiteBalance(1.0, -1.0, factors.white_balance);
  factors.contrast = 2.0f, factors.saturation = 2.0f;
  for (int c = 0; c < 3; ++c) factors.gamma[c] = 100.0f, factors.middle[c] = 0.01f, factors.scale[c] = 100.0f;
  for (const float x : {0.0f, -1.0f, 1e-38f, 1.0f, 3e38f, HUGE_VALF, NAN}) {
    const lane::Vec3<float> graded = lane::Grade(factors, lane::Vec3<float>{x, 0.5f, 2.0f});
    for (const float c : {graded.x, graded.y, graded.z}) EXPECT_TRUE(c >= 0.0f && std::isfinite(c)) << x;
  }
}

}  // namespace
}  // namespace facet
