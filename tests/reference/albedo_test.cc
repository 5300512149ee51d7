// The specular lobe's albedo without a table: closed form, another integral, and how far interpolation is off.
#include "reference/albedo_exact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "facet/shader/brdf-inl.h"
#include "light/dfg.h"

namespace facet {
namespace {

namespace lanes = HWY_NAMESPACE;

constexpr double kPi = 3.14159265358979324;

// At alpha = 1, D is 1 / pi and V is 1 / (2 (n_dot_l + n_dot_v)): the albedo is the integral over mu of mu / (mu +
// n_dot_v).
TEST(ExactAlbedo, ClosedFormAtFullRoughness) {
  for (double v : {1e-9, 1e-6, 1e-3, 0.01, 0.1, 0.37, 0.8, 1.0}) {
    const ExactAlbedo albedo = IntegrateAlbedo(v, 1.0);
    EXPECT_NEAR(albedo.a + albedo.b, 1.0 - v * std::log((1.0 + v) / v), 1e-10) << v;
  }
  // The mean of that, 2 * integral of mu d mu, by parts.
  const ExactAlbedo average = AlbedoSurface::Shared().Row(1.0).Average();
  EXPECT_NEAR(average.a + average.b, (4.0 - 4.0 * std::log(2.0)) / 3.0, 1e-7);
}

// Seen from above, v_dot_h depends on the polar angle alone, and n_dot_l with it: one integral over half vectors,
// 2 pi D V 4 v_dot_h n_dot_l sin, of one variable.
TEST(ExactAlbedo, FromAboveItIsOneIntegral) {
  for (double roughness : {0.045, 0.1, 0.3, 0.6, 1.0}) {
    const double alpha = roughness * roughness, low = std::log(alpha * 1e-5), high = 0.0;  // tan of at most 45 degrees
    constexpr int kSteps = 200000;
    const double step = (high - low) / kSteps;
    double a = 0.0, b = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const double tangent = std::exp(low + (i + 0.5) * step), cosine = 1.0 / std::sqrt(1.0 + tangent * tangent);
      const double sine = tangent * cosine, n_dot_l = 2.0 * cosine * cosine - 1.0;
      const double d_theta = tangent * cosine * cosine * step;
      const double lobe = 2.0 * kPi * lanes::DistributionGgx(cosine, sine * sine, alpha) *
                          lanes::VisibilitySmith(n_dot_l, 1.0, alpha) * 4.0 * cosine * n_dot_l * sine * d_theta;
      const double fresnel = lanes::SchlickWeight(cosine);
      a += lobe * (1.0 - fresnel);
      b += lobe * fresnel;
    }
    const ExactAlbedo albedo = IntegrateAlbedo(1.0, alpha);
    EXPECT_NEAR(albedo.a, a, 1e-7) << roughness;
    EXPECT_NEAR(albedo.b, b, 1e-7) << roughness;
  }
}

// Another way to integrate: over the hemisphere of light directions, in steps.
TEST(ExactAlbedo, EqualsTheSumOverDirections) {
  for (double roughness : {0.5, 0.8}) {
    const double alpha = roughness * roughness;
    for (double v : {0.05, 0.4, 0.9}) {
      const lanes::Vec3<double> normal = {0.0, 0.0, 1.0}, view = {std::sqrt(1.0 - v * v), 0.0, v};
      constexpr int kPolar = 2000, kAzimuth = 1000;
      double a = 0.0, b = 0.0;
      for (int i = 0; i < kPolar; ++i) {
        const double polar = 0.5 * kPi * (i + 0.5) / kPolar, s = std::sin(polar), c = std::cos(polar);
        for (int j = 0; j < kAzimuth; ++j) {
          const double azimuth = kPi * (j + 0.5) / kAzimuth;
          const lanes::Vec3<double> light = {s * std::cos(azimuth), s * std::sin(azimuth), c};
          const lanes::Vec3<double> half = lanes::NormalizeOr(view + light, normal);
          const double lobe = lanes::DistributionGgx(normal, half, alpha) * lanes::VisibilitySmith(c, v, alpha) * c * s;
          const double fresnel = lanes::SchlickWeight(lanes::Dot(view, half));
          a += lobe * (1.0 - fresnel);
          b += lobe * fresnel;
        }
      }
      const double share = 2.0 * (0.5 * kPi / kPolar) * (kPi / kAzimuth);
      const ExactAlbedo albedo = IntegrateAlbedo(v, alpha);
      EXPECT_NEAR(albedo.a, a * share, 2e-6) << roughness << " " << v;
      EXPECT_NEAR(albedo.b, b * share, 2e-6) << roughness << " " << v;
    }
  }
}

TEST(ExactAlbedo, AtGrazingViewsOfASmoothSurfaceAllIsReflected) {
  for (double roughness : {0.045, 0.1, 0.3}) {
    for (double v : {0.0, 1e-12}) {
      const ExactAlbedo albedo = IntegrateAlbedo(v, roughness * roughness);
      EXPECT_NEAR(albedo.a + albedo.b, 1.0, 1e-6) << roughness;
    }
  }
}

TEST(ExactAlbedo, InterpolationIsExactToSevenDigits) {
  const AlbedoSurface& surface = AlbedoSurface::Shared();
  double worst = 0.0;
  for (int i = 0; i < 23; ++i) {
    const double roughness =
        i == 0 ? double(lanes::kMinPerceptualRoughness) : 0.045 * std::exp(3.1 * (i - 0.37) / 22.0);
    const AlbedoRow row = surface.Row(std::min(roughness, 1.0));
    for (int j = 0; j < 61; ++j) {
      const double u = j == 0 ? 0.0 : (j - 0.4) / 60.0, v = u * u * u * u;
      const ExactAlbedo exact = IntegrateAlbedo(v, std::min(roughness, 1.0) * std::min(roughness, 1.0)),
                        read = row.At(v);
      worst = std::max({worst, std::fabs(exact.a - read.a), std::fabs(exact.b - read.b)});
    }
  }
  EXPECT_LT(worst, 1e-7);
  RecordProperty("worst", std::to_string(worst));
}

// The rasterizer's table states its error: 0.007. Both describe the same thing.
TEST(ExactAlbedo, TheTableIsAsGoodAsItSays) {
  const DfgTable& table = SharedDfgTable();
  for (int row = 0; row < DfgTable::kRows; row += 3) {
    const double root = 0.2 + 0.8 * row / (DfgTable::kRows - 1), alpha = (root * root) * (root * root);
    for (int column = 4; column < DfgTable::kColumns; column += 5) {
      const double u = double(column) / (DfgTable::kColumns - 1);
      const ExactAlbedo exact = IntegrateAlbedo((u * u) * (u * u), alpha);
      const float* at = table.albedo + 2 * (row * DfgTable::kColumns + column);
      EXPECT_NEAR(at[0], exact.a, 0.002) << row << " " << column;
      EXPECT_NEAR(at[1], exact.b, 0.002) << row << " " << column;
    }
  }
}

}  // namespace
}  // namespace facet
