// The table of the specular lobe's albedo against integration in double.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <memory>

#include "facet/shader/dispatch.h"
#include "light/lighting-inl.h"

namespace facet {
namespace {

namespace lanes = HWY_NAMESPACE;

constexpr double kPi = 3.14159265358979324;

struct Albedo {
  double a, b;
};

// By incoming directions when the lobe is broad: another variable of integration than the table's.
Albedo IntegrateOverLight(double n_dot_v, double alpha) {
  const lanes::Vec3<double> view = {std::sqrt(1.0 - n_dot_v * n_dot_v), 0.0, n_dot_v};
  constexpr int kPolar = 700, kAzimuth = 700;
  Albedo sum = {0.0, 0.0};
  for (int i = 0; i < kPolar; ++i) {
    const double t = (i + 0.5) / kPolar;
    const double z = t * t;  // crowded at the horizon; dz = 2 t dt
    const double s = std::sqrt(1.0 - z * z);
    for (int j = 0; j < kAzimuth; ++j) {
      // Crowded at the azimuth of the reflection, pi: phi = pi - pi w^2, dphi = 2 pi w dw; both halves.
      const double w = (j + 0.5) / kAzimuth;
      const double phi = kPi - kPi * w * w;
      const lanes::Vec3<double> light = {s * std::cos(phi), s * std::sin(phi), z};
      const lanes::Vec3<double> sum_vl = view + light;
      const lanes::Vec3<double> half = sum_vl / std::sqrt(Dot(sum_vl, sum_vl));
      const double v_dot_h = Dot(view, half);
      const double d = lanes::DistributionGgx(half.z, half.x * half.x + half.y * half.y, alpha);
      const double weight = d * lanes::VisibilitySmith(z, n_dot_v, alpha) * z * (2.0 * t / kPolar) *
                            (2.0 * 2.0 * kPi * w / kAzimuth);
      const double fresnel = std::pow(1.0 - v_dot_h, 5.0);
      sum.a += weight * (1.0 - fresnel);
      sum.b += weight * fresnel;
    }
  }
  return sum;
}

TEST(Dfg, AgreesWithIntegrationInDouble) {
  const DfgTable& table = SharedDfgTable();
  for (double roughness : {0.35, 0.52, 0.77, 1.0}) {
    for (double n_dot_v : {0.02, 0.11, 0.37, 0.72, 1.0}) {
      const Albedo exact = IntegrateOverLight(n_dot_v, roughness * roughness);
      const auto read = lanes::LookupDfg(table, n_dot_v, roughness);
      EXPECT_NEAR(read.a, exact.a, 0.004) << roughness << " " << n_dot_v;
      EXPECT_NEAR(read.b, exact.b, 0.004) << roughness << " " << n_dot_v;
    }
  }
}

TEST(Dfg, ApproachesAMirror) {
  const DfgTable& table = SharedDfgTable();
  for (double n_dot_v : {0.1, 0.3, 0.6, 1.0}) {
    const auto read = lanes::LookupDfg(table, n_dot_v, 0.0);
    const double fresnel = std::pow(1.0 - n_dot_v, 5.0);
    EXPECT_NEAR(read.a, 1.0 - fresnel, 0.005) << n_dot_v;
    EXPECT_NEAR(read.b, fresnel, 0.005) << n_dot_v;
  }
}

// Known value: alpha 1 seen from above reflects 1 - ln 2 of the light. (D = 1/pi, V = 1 / (2 (1 + z)), and the integral
// of z / (1 + z) over [0, 1] is 1 - ln 2; dl = 2 pi dz.)
TEST(Dfg, RoughestFromAbove) {
  const auto read = lanes::LookupDfg(SharedDfgTable(), 1.0, 1.0);
  EXPECT_NEAR(read.a + read.b, 1.0 - std::log(2.0), 0.0015);
}

TEST(Dfg, AverageIsTheTablesOwn) {
  const DfgTable& table = SharedDfgTable();
  for (double roughness : {0.05, 0.3, 0.6, 1.0}) {
    double a = 0.0, b = 0.0;
    constexpr int kCount = 20000;
    for (int i = 0; i < kCount; ++i) {
      const double mu = (i + 0.5) / kCount;
      const auto read = lanes::LookupDfg(table, mu, roughness);
      a += 2.0 * mu * read.a / kCount;
      b += 2.0 * mu * read.b / kCount;
    }
    const auto average = lanes::LookupDfgAverage(table, roughness);
    EXPECT_NEAR(average.a, a, 2e-6) << roughness;
    EXPECT_NEAR(average.b, b, 2e-6) << roughness;
  }
}

TEST(Dfg, StaysInRange) {
  const DfgTable& table = SharedDfgTable();
  for (int i = 0; i < DfgTable::kRows * DfgTable::kColumns; ++i) {
    EXPECT_GE(table.albedo[2 * i], 0.0f);
    EXPECT_GE(table.albedo[2 * i + 1], 0.0f);
    EXPECT_LE(table.albedo[2 * i] + table.albedo[2 * i + 1], 1.001f);
  }
  for (float wrong : {-1.0f, 2.0f, std::nanf("")}) {  // reading never leaves the table
    const auto read = lanes::LookupDfg(table, wrong, wrong);
    EXPECT_TRUE(read.a >= 0.0f && read.a + read.b <= 1.001f);
  }
}

TEST(Dfg, SameBitsOnEveryInstructionSet) {
  auto scalar = std::make_unique<DfgTable>(), other = std::make_unique<DfgTable>();
  {
    const ScopedTarget forced(Target::Scalar);
    ComputeDfgTable(scalar.get());
  }
  for (Target target : {Target::Sse4, Target::Avx2, Target::Avx3, Target::Neon}) {
    if (!TargetIsAvailable(target)) continue;
    const ScopedTarget forced(target);
    ComputeDfgTable(other.get());
    EXPECT_EQ(std::memcmp(scalar.get(), other.get(), sizeof(DfgTable)), 0) << TargetName(target);
  }
}

}  // namespace
}  // namespace facet
