#include "color/tone_curve-inl.h"

#include "color/gt7_curve-inl.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace facet {
namespace {

namespace lane = HWY_NAMESPACE;
using Color = std::array<double, 3>;

struct Curve {
  const char* name;
  lane::Vec3<float> (*in_float)(lane::Vec3<float>);
  lane::Vec3<double> (*in_double)(lane::Vec3<double>);
};

const Curve kCurves[] = {
    {"clamp", lane::ClampCurve<float>, lane::ClampCurve<double>},
    {"Reinhard", lane::ReinhardCurve<float>, lane::ReinhardCurve<double>},
    {"ACES", lane::AcesCurve<float>, lane::AcesCurve<double>},
    {"AgX", lane::AgXCurve<float>, lane::AgXCurve<double>},
    {"Neutral", lane::NeutralCurve<float>, lane::NeutralCurve<double>},
    {"filmic", lane::FilmicCurve<float>, lane::FilmicCurve<double>},
    {"generic", lane::GenericCurve<float>, lane::GenericCurve<double>},
    {"GT7", lane::Gt7Curve<float>, lane::Gt7Curve<double>},
};

void ExpectNear(const lane::Vec3<double>& result, const Color& expected, double tolerance) {
  EXPECT_NEAR(result.x, expected[0], tolerance);
  EXPECT_NEAR(result.y, expected[1], tolerance);
  EXPECT_NEAR(result.z, expected[2], tolerance);
}

TEST(ToneCurve, AnyInputGivesADisplayableColour) {
  std::mt19937 random(3);
  const float special[] = {0.0f, -0.0f, 1.0f, -1.0f, NAN, HUGE_VALF, -HUGE_VALF, 3e38f, 1e-40f, 0.08f, 0.76f, 0.8f};
  const auto channel = [&] {
    const std::uint32_t bits = static_cast<std::uint32_t>(random());
    if (bits % 8 == 0) return special[(bits >> 8) % std::size(special)];
    return std::ldexp(static_cast<float>(bits) * 0x1p-32f, static_cast<int>(bits % 60) - 30);
  };
  for (int i = 0; i < 200000; ++i) {
    const lane::Vec3<float> light{channel(), channel(), channel()};
    for (const Curve& curve : kCurves) {
      const lane::Vec3<float> shown = curve.in_float(light);
      for (const float c : {shown.x, shown.y, shown.z}) {
        ASSERT_TRUE(c >= 0.0f && c <= 1.0f) << curve.name << " of " << light.x << ", " << light.y << ", " << light.z;
      }
    }
  }
}

TEST(ToneCurve, GreysRiseAndStayGrey) {
  for (const Curve& curve : kCurves) {
    double before = -1.0;
    for (double stops = -16.0; stops < 16.0; stops += 0.01) {
      const double light = std::exp2(stops);
      const lane::Vec3<double> shown = curve.in_double({light, light, light});
      ASSERT_GE(shown.x, before - 1e-12) << curve.name << " at " << light;
      // The matrices of AgX and ACES are printed with four and five digits.
      ASSERT_NEAR(shown.x, shown.y, 1.5e-3) << curve.name << " at " << light;
      ASSERT_NEAR(shown.x, shown.z, 1.5e-3) << curve.name << " at " << light;
      before = shown.x;
    }
    EXPECT_GT(before, 0.98) << curve.name;
    EXPECT_LT(curve.in_double({0.0, 0.0, 0.0}).x, 1e-6) << curve.name;
  }
}

TEST(ToneCurve, FloatIsCloseToDouble) {
  std::mt19937 random(4);
  for (int i = 0; i < 20000; ++i) {
    const auto channel = [&] { return std::exp2(static_cast<double>(random()) * 0x1p-32 * 20.0 - 12.0); };
    const lane::Vec3<double> light{channel(), channel(), channel()};
    const lane::Vec3<float> light_float{float(light.x), float(light.y), float(light.z)};
    for (const Curve& curve : kCurves) {
      const lane::Vec3<double> exact = curve.in_double(light);
      const lane::Vec3<float> shown = curve.in_float(light_float);
      SCOPED_TRACE(curve.name);
      // AgX' polynomial has coefficients up to 40; the step between two 8-bit codes is 3e-4 at least. GT7 mixes by codes
      // of a quantizer with a power of 79, which multiplies rounding errors as much.
      const double tolerance = std::string_view(curve.name) == "GT7" ? 4e-4 : 1e-5;
      ASSERT_NEAR(shown.x, exact.x, tolerance);
      ASSERT_NEAR(shown.y, exact.y, tolerance);
      ASSERT_NEAR(shown.z, exact.z, tolerance);
    }
  }
}

TEST(ToneCurve, ReinhardIsTheLecturesFormula) {
  ExpectNear(lane::ReinhardCurve<double>({0.0, 1.0, 3.0}), {0.0, 0.5, 0.75}, 1e-15);
}

// Computed by hand from Hill's formula: grey stays grey to the digits of the matrices.
TEST(ToneCurve, AcesOfGrey) {
  for (const double grey : {0.01, 0.18, 1.0, 4.0}) {
    const double v = grey / 0.6;
    const double fit = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
    ExpectNear(lane::AcesCurve<double>({grey, grey, grey}), {fit, fit, fit}, 2e-5);
  }
}

// A saturated red, written out with the published matrices.
TEST(ToneCurve, AcesOfRed) {
  const double v[3] = {0.59719 / 0.6, 0.07600 / 0.6, 0.02840 / 0.6};
  double f[3];
  for (int i = 0; i < 3; ++i) {
    f[i] = (v[i] * (v[i] + 0.0245786) - 0.000090537) / (v[i] * (0.983729 * v[i] + 0.4329510) + 0.238081);
  }
  ExpectNear(lane::AcesCurve<double>({1.0, 0.0, 0.0}),
             {1.60475 * f[0] - 0.53108 * f[1] - 0.07367 * f[2],
              std::max(0.0, -0.10208 * f[0] + 1.10813 * f[1] - 0.00605 * f[2]),
              std::max(0.0, -0.00327 * f[0] - 0.07276 * f[1] + 1.07602 * f[2])},
             1e-6);
}

// Grey passes AgX' matrices unchanged, so that only the curve is left.
TEST(ToneCurve, AgXOfGrey) {
  for (const double grey : {0.001, 0.18, 1.0, 8.0}) {
    const double t = (std::log2(grey) + 12.47393) / (12.47393 + 4.026069);
    const double contrast = 15.5 * std::pow(t, 6) - 40.14 * std::pow(t, 5) + 31.96 * std::pow(t, 4) -
                            6.868 * std::pow(t, 3) + 0.4298 * t * t + 0.1191 * t - 0.00232;
    const double shown = std::pow(contrast, 2.2);
    ExpectNear(lane::AgXCurve<double>({grey, grey, grey}), {shown, shown, shown}, 1e-3);
  }
  // Middle grey is shown at half of the display's signal.
  EXPECT_NEAR(lane::AgXCurve<double>({0.18, 0.18, 0.18}).x, std::pow(0.5, 2.2), 0.005);
}

TEST(ToneCurve, NeutralKeepsBaseColours) {
  // Fresnel's 4 % over a base colour, lit by white: the base colour comes out.
  for (const double base : {0.1, 0.4, 0.75}) {
    ExpectNear(lane::NeutralCurve<double>({base + 0.04, base * 0.5 + 0.08, base + 0.04}),
               {base, base * 0.5 + 0.04, base}, 1e-7);
  }
  // Below 0.08 the offset vanishes smoothly: x - 6.25 x^2.
  ExpectNear(lane::NeutralCurve<double>({0.04, 0.5, 0.6}), {6.25 * 0.04 * 0.04, 0.5 - 0.03, 0.6 - 0.03}, 1e-7);
}

// The specification's formula with its numbers, for one bright orange.
TEST(ToneCurve, NeutralCompressesHighlights) {
  const Color light = {3.0, 1.0, 0.2};
  const double peak = 3.0 - 0.04, start = 0.76, d = 0.24;
  const double new_peak = 1.0 - d * d / (peak + d - start);
  const double g = 1.0 - 1.0 / (0.15 * (peak - new_peak) + 1.0);
  Color expected;
  for (std::size_t i = 0; i < 3; ++i) expected[i] = (light[i] - 0.04) * new_peak / peak * (1.0 - g) + new_peak * g;
  ExpectNear(lane::NeutralCurve<double>({light[0], light[1], light[2]}), expected, 1e-7);
}

TEST(ToneCurve, FilmicGenericAndGt7HaveTheirPublishedValues) {
  const auto grey = [](double light) { return lane::Vec3<double>{light, light, light}; };
  ExpectNear(lane::FilmicCurve(grey(1.0)), {2.54 / 3.16, 2.54 / 3.16, 2.54 / 3.16}, 1e-7);
  ExpectNear(lane::GenericCurve(grey(0.18)), {0.215, 0.215, 0.215}, 1e-6);
  ExpectNear(lane::GenericCurve(grey(10.0)), {1.0, 1.0, 1.0}, 1e-6);
  // Of grey light: the straight part at and above the middle, and the shoulder at the display's white.
  for (const double light : {0.538, 0.8, 1.1}) {
    ExpectNear(lane::Gt7Curve(grey(light)), {light / 2.5, light / 2.5, light / 2.5}, 2e-4);
  }
  const double k = 0.556 / 0.75, white = 0.444 + k - k * std::exp((1.11 - 2.5) / (2.5 * k));
  ExpectNear(lane::Gt7Curve(grey(2.5)), {white, white, white}, 2e-4);
}

TEST(ToneCurve, AgXLooksSaturateAndDarken) {
  const lane::Vec3<double> light{0.5, 0.2, 0.1};
  const lane::Vec3<double> base = lane::AgXCurve(light), punchy = lane::AgXCurve(light, lane::kAgXPunchy);
  EXPECT_GT(punchy.x / punchy.z, base.x / base.z);
  EXPECT_LT(punchy.y, base.y);
  const lane::Vec3<double> golden = lane::AgXCurve(lane::Vec3<double>{0.4, 0.4, 0.4}, lane::kAgXGolden);
  EXPECT_GT(golden.x, golden.z);
}

TEST(Pq, HoldsTenThousandNitsAndIsInverted) {
  EXPECT_NEAR(lane::PqFromLight(100.0), 1.0, 1e-6);
  EXPECT_NEAR(lane::PqFromLight(1.0), 0.5080784, 1e-6) << "100 cd/m2, by ST 2084";
  for (const double light : {0.001, 0.1, 1.0, 40.0}) {
    EXPECT_NEAR(lane::LightFromPq(lane::PqFromLight(light)) / light, 1.0, 1e-5);
  }
}

}  // namespace
}  // namespace facet
