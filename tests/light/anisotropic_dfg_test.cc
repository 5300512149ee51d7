// The albedo table of anisotropic surfaces against closed forms, an integration over other variables and the table of
// isotropic surfaces; its average; its bits.
#include "light/anisotropic_dfg.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <random>
#include <string>

#include "base/parallel.h"
#include "facet/shader/dispatch.h"
#include "light/lighting-inl.h"

namespace facet {
namespace {

namespace lanes = HWY_NAMESPACE;
using Albedo = lanes::SpecularAlbedo<double>;

constexpr double kPi = 3.14159265358979324;

Albedo Read(double n_dot_v, double azimuth, double roughness, double strength) {
  const double t_dot_v = std::sqrt(1.0 - n_dot_v * n_dot_v) * std::cos(azimuth);
  return lanes::LookupAnisotropicDfg(SharedAnisotropicDfgTable(), n_dot_v, t_dot_v, roughness, strength);
}

// The integral of D V n_dot_l dl over half vectors, with dl = 4 v_dot_h dh, in polar coordinates of their slopes over
// alpha: (slope_t, slope_b) = x (alpha_t cos, alpha_b sin), even in log x.
Albedo Integrate(double n_dot_v, double azimuth, double roughness, double strength, int polar, int azimuths) {
  const double alpha_b = roughness * roughness, alpha_t = alpha_b + (1.0 - alpha_b) * strength * strength;
  const double sin_v = std::sqrt(1.0 - n_dot_v * n_dot_v);
  const double t = sin_v * std::cos(azimuth), b = sin_v * std::sin(azimuth);
  const auto length = [&](double x, double y, double z) {
    return std::sqrt(alpha_t * alpha_t * x * x + alpha_b * alpha_b * y * y + z * z);
  };
  const double view_length = length(t, b, n_dot_v);
  const double low = -6.0, high = 12.0, step = (high - low) / polar;
  Albedo sum;
  for (int i = 0; i < polar; ++i) {
    const double x = std::exp(low + (i + 0.5) * step), x2 = x * x;
    Albedo ring;
    for (int j = 0; j < azimuths; ++j) {
      const double around = 2.0 * kPi * (j + 0.5) / azimuths;
      const double slope_t = x * alpha_t * std::cos(around), slope_b = x * alpha_b * std::sin(around);
      const double h_n = 1.0 / std::sqrt(1.0 + slope_t * slope_t + slope_b * slope_b);
      const double h_t = slope_t * h_n, h_b = slope_b * h_n;
      const double v_dot_h = t * h_t + b * h_b + n_dot_v * h_n;
      const double n_dot_l = 2.0 * v_dot_h * h_n - n_dot_v;
      if (n_dot_l <= 0.0 || v_dot_h <= 0.0) continue;
      const double light_length = length(2.0 * v_dot_h * h_t - t, 2.0 * v_dot_h * h_b - b, n_dot_l);
      const double visibility = 0.5 / (n_dot_l * view_length + n_dot_v * light_length);
      // D dh = x^2 / (1 + x^2)^2 / (pi n_dot_h) d(log x) d(around).
      const double weight = visibility * n_dot_l * 4.0 * v_dot_h / h_n;
      const double fresnel = weight * std::pow(1.0 - std::min(v_dot_h, 1.0), 5.0);
      ring.a += weight - fresnel;
      ring.b += fresnel;
    }
    const double scale = x2 / ((1.0 + x2) * (1.0 + x2)) / kPi * step * (2.0 * kPi / azimuths);
    sum.a += ring.a * scale;
    sum.b += ring.b * scale;
  }
  return sum;
}

// Known values of grooves, alpha_t 1 and alpha_b 0. From above, and from any angle across the tangent, slopes s along
// the tangent are as probable as 1 / (2 (1 + s^2)^1.5) and 1 - s^2 of the light that falls on them is not shadowed, so
// that sqrt(2) - asinh(1) is reflected.
TEST(AnisotropicDfg, OfGrooves) {
  const double expected = std::sqrt(2.0) - std::asinh(1.0);
  for (double degrees : {0.0, 30.0, 60.0, 85.0}) {
    const Albedo read = Read(std::cos(degrees * kPi / 180.0), 0.5 * kPi, 0.045, 1.0);
    EXPECT_NEAR(read.a + read.b, expected, 0.003) << degrees;
  }
}

TEST(AnisotropicDfg, IsCloseToIntegration) {
  std::mt19937 random(3);
  const auto uniform = [&] { return double(random()) / 4294967296.0; };
  double most = 0.0, least = 0.0, squares = 0.0, most_b = 0.0;
  constexpr int kCount = 800;
  for (int i = 0; i < kCount; ++i) {
    const double u = 0.21 + 0.79 * uniform(), n_dot_v = u * u * u * u;  // 0.002 to 1
    // Half of the views crowd where they are across the tangent.
    const double azimuth = i % 2 == 0 ? 0.5 * kPi * uniform() : std::acos(std::pow(uniform(), 4.0));
    const double roughness = 0.1 + 0.9 * uniform(), strength = i % 8 == 0 ? 1.0 : uniform();
    const Albedo read = Read(n_dot_v, azimuth, roughness, strength);
    const Albedo exact = Integrate(n_dot_v, azimuth, roughness, strength, 200, 200);
    const double error = read.a + read.b - exact.a - exact.b;
    EXPECT_NEAR(error, 0.0, 0.007) << n_dot_v << " " << azimuth * 180.0 / kPi << " " << roughness << " " << strength;
    most = std::max(most, error);
    least = std::min(least, error);
    most_b = std::max(most_b, std::fabs(read.b - exact.b));
    squares += error * error;
  }
  RecordProperty("error", std::to_string(least) + " to " + std::to_string(most));
  RecordProperty("most_b", std::to_string(most_b));
  RecordProperty("rms", std::to_string(std::sqrt(squares / kCount)));
  EXPECT_LT(std::sqrt(squares / kCount), 0.0015);
  EXPECT_LT(most_b, 0.011);
}

// The integration that the table is compared with has converged.
TEST(AnisotropicDfg, IntegrationConverges) {
  for (double n_dot_v : {0.003, 0.05, 0.5}) {
    for (double azimuth : {0.0, 0.8, 1.5}) {
      for (double roughness : {0.1, 0.5}) {
        for (double strength : {0.0, 0.4, 1.0}) {
          const Albedo coarse = Integrate(n_dot_v, azimuth, roughness, strength, 200, 200);
          const Albedo fine = Integrate(n_dot_v, azimuth, roughness, strength, 320, 420);
          EXPECT_NEAR(coarse.a + coarse.b, fine.a + fine.b, 5e-4) << n_dot_v << " " << azimuth << " " << roughness;
          EXPECT_NEAR(coarse.b, fine.b, 5e-4) << n_dot_v << " " << azimuth << " " << roughness << " " << strength;
        }
      }
    }
  }
}

TEST(AnisotropicDfg, OfStrengthZeroIsIsotropic) {
  double most = 0.0;
  for (double roughness : {0.045, 0.1, 0.2, 0.35, 0.5, 0.7, 0.9, 1.0}) {
    for (double n_dot_v : {0.002, 0.01, 0.03, 0.1, 0.3, 0.6, 1.0}) {
      const Albedo isotropic = lanes::LookupDfg(SharedDfgTable(), n_dot_v, roughness);
      for (double azimuth : {0.0, 0.5, 1.0, 1.5, 0.5 * kPi}) {
        const Albedo read = Read(n_dot_v, azimuth, roughness, 0.0);
        const double error = read.a + read.b - isotropic.a - isotropic.b;
        EXPECT_NEAR(error, 0.0, 0.007) << roughness << " " << n_dot_v << " " << azimuth;
        most = std::max(most, std::fabs(error));
      }
    }
    const Albedo average = lanes::LookupAnisotropicDfgAverage(SharedAnisotropicDfgTable(), roughness, 0.0);
    const Albedo isotropic = lanes::LookupDfgAverage(SharedDfgTable(), roughness);
    EXPECT_NEAR(average.a, isotropic.a, 0.003) << roughness;
    EXPECT_NEAR(average.b, isotropic.b, 0.003) << roughness;
  }
  RecordProperty("most", std::to_string(most));
}

TEST(AnisotropicDfg, AverageIsTheTablesOwn) {
  for (double roughness : {0.05, 0.3, 1.0}) {
    for (double strength : {0.0, 0.3, 0.55, 1.0}) {
      Albedo sum;
      constexpr int kCosines = 600, kAzimuths = 300;
      for (int i = 0; i < kCosines; ++i) {
        const double s = (i + 0.5) / kCosines, mu = s * s, weight = 4.0 * s * mu / (kCosines * kAzimuths);
        for (int j = 0; j < kAzimuths; ++j) {
          const Albedo read = Read(mu, 0.5 * kPi * (j + 0.5) / kAzimuths, roughness, strength);
          sum.a += weight * read.a;
          sum.b += weight * read.b;
        }
      }
      const Albedo average = lanes::LookupAnisotropicDfgAverage(SharedAnisotropicDfgTable(), roughness, strength);
      EXPECT_NEAR(average.a, sum.a, 3e-5) << roughness << " " << strength;
      EXPECT_NEAR(average.b, sum.b, 3e-5) << roughness << " " << strength;
    }
  }
}

TEST(AnisotropicDfg, StaysInRange) {
  const AnisotropicDfgTable& table = SharedAnisotropicDfgTable();
  for (std::size_t i = 0; i < std::size(table.albedo); i += 2) {
    EXPECT_GE(table.albedo[i], 0.0f);
    EXPECT_GE(table.albedo[i + 1], 0.0f);
    EXPECT_LE(table.albedo[i] + table.albedo[i + 1], 1.0005f);
  }
  for (float wrong : {-1.0f, 0.0f, 2.0f, std::nanf("")}) {  // reading never leaves the table
    const auto read = lanes::LookupAnisotropicDfg(table, wrong, wrong, wrong, wrong);
    EXPECT_TRUE(read.a >= 0.0f && read.a + read.b <= 1.0005f) << wrong;
  }
}

TEST(AnisotropicDfg, SameBitsForAnyNumberOfThreads) {
  for (int threads : {1, 3}) {
    auto table = std::make_unique<AnisotropicDfgTable>();
    RunWithThreads(threads, [&] { ComputeAnisotropicDfgTable(table.get()); });
    EXPECT_EQ(std::memcmp(table.get(), &SharedAnisotropicDfgTable(), sizeof(AnisotropicDfgTable)), 0) << threads;
  }
}

TEST(AnisotropicDfg, SameBitsOnEveryInstructionSet) {
  auto scalar = std::make_unique<AnisotropicDfgTable>(), other = std::make_unique<AnisotropicDfgTable>();
  {
    const ScopedTarget forced(Target::Scalar);
    ComputeAnisotropicDfgTable(scalar.get());
  }
  for (Target target : {Target::Sse4, Target::Avx2, Target::Avx3, Target::Neon}) {
    if (!TargetIsAvailable(target)) continue;
    const ScopedTarget forced(target);
    ComputeAnisotropicDfgTable(other.get());
    EXPECT_EQ(std::memcmp(scalar.get(), other.get(), sizeof(AnisotropicDfgTable)), 0) << TargetName(target);
  }
}

TEST(AnisotropicDfg, LightingHasTheTableOnlyIfAsked) {
  EXPECT_EQ(MakeLightingData({}, nullptr).anisotropic_dfg, nullptr);
  const LightingData data = MakeLightingData({}, nullptr, 0.0, 1.0, {.anisotropic_dfg = true});
  ASSERT_EQ(data.anisotropic_dfg, &SharedAnisotropicDfgTable());
  const Albedo read = lanes::LightingView<double>(data).AnisotropicDfg(0.6, 0.7, 0.3, 0.5);
  EXPECT_EQ(read.a, lanes::LookupAnisotropicDfg(*data.anisotropic_dfg, 0.6, 0.7, 0.3, 0.5).a);
}

}  // namespace
}  // namespace facet
