// The table of the sheen lobe's albedo against integration with many more points, and the lookup.
#include "light/sheen_albedo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>

#include "base/parallel.h"
#include "facet/shader/dispatch.h"
#include "light/lighting-inl.h"
#include "material/lobes/sheen-inl.h"

namespace facet {
namespace {

namespace lanes = HWY_NAMESPACE;
using lanes::Vec3;

constexpr double kPi = 3.14159265358979324;

// Lambda with the C library's functions, from the extension's text.
double Lambda(double cosine, double alpha) {
  const double s = (1.0 - alpha) * (1.0 - alpha);
  const auto mix = [&](double at_one, double at_zero) { return at_one * (1.0 - s) + at_zero * s; };
  const double a = mix(21.5473, 25.3245), b = mix(3.82987, 3.32435), c = mix(0.19823, 0.16801);
  const double d = mix(-1.97760, -1.27393), e = mix(-4.32054, -4.85967);
  const auto l = [&](double x) { return a / (1.0 + b * std::pow(x, c)) + d * x + e; };
  return cosine < 0.5 ? std::exp(l(cosine)) : std::exp(2.0 * l(0.5) - l(1.0 - cosine));
}

// By half vectors from view and light, and other variables of integration than the table's.
double Integrate(double n_dot_v, double roughness, int polar, int azimuths) {
  const double alpha = roughness * roughness;
  const Vec3<double> view = {std::sqrt(1.0 - n_dot_v * n_dot_v), 0.0, n_dot_v};
  const double of_view = Lambda(n_dot_v, alpha);
  double sum = 0.0;
  for (int i = 0; i < polar; ++i) {
    const double t = (i + 0.5) / polar;
    const double z = t * t * t * t, s = std::sqrt(1.0 - z * z), dz = 4.0 * t * t * t / polar;
    double ring = 0.0;
    for (int j = 0; j < azimuths; ++j) {
      // Crowded at the azimuth of the mirror direction, pi, where sin(theta_h) is small.
      const double w = (j + 0.5) / azimuths, phi = kPi * (1.0 - w * w);
      const Vec3<double> between = view + Vec3<double>{s * std::cos(phi), s * std::sin(phi), z};
      const double across2 = between.x * between.x + between.y * between.y;
      const double sin_h = std::sqrt(across2 / (across2 + between.z * between.z));
      ring += (2.0 + 1.0 / alpha) * std::pow(sin_h, 1.0 / alpha) / (2.0 * kPi) * (2.0 * 2.0 * kPi * w / azimuths);
    }
    sum += ring * dz / ((1.0 + of_view + Lambda(z, alpha)) * 4.0 * n_dot_v);
  }
  return sum;
}

// Errors that are relative where E is above 1, because the lobe is divided by E there.
double Error(double read, double exact) { return (read - exact) / std::max(1.0, exact); }

TEST(SheenAlbedo, IntegralAgreesWithOneOfManyMorePoints) {
  double most = 0.0;
  for (double roughness : {0.07, 0.09, 0.15, 0.3, 0.55, 0.8, 1.0}) {
    for (double n_dot_v : {1e-4, 0.0021, 0.02, 0.05, 0.13, 0.4, 0.75, 1.0}) {
      const double exact = Integrate(n_dot_v, roughness, 400, 300);
      const double error = Error(IntegrateSheenAlbedo(n_dot_v, roughness), exact);
      EXPECT_NEAR(error, 0.0, 5e-5) << roughness << " " << n_dot_v;
      most = std::max(most, std::fabs(error));
    }
  }
  RecordProperty("most", std::to_string(most));
}

// Halfway between neighbouring samples, along both axes and along each, where interpolation is off the most.
TEST(SheenAlbedo, InterpolationIsCloseBetweenTheSamples) {
  const SheenTable& table = SharedSheenTable();
  const auto at = [](float first, double position, int count) {
    const double root = double(first) + (1.0 - double(first)) * position / (count - 1);
    return root * root * root * root;
  };
  double most = 0.0, squares = 0.0;
  int count = 0;
  for (int row = 0; row < 2 * SheenTable::kRows - 1; ++row) {
    const double roughness = std::max(at(SheenTable::kFirstRow, 0.5 * row, SheenTable::kRows), 0.07);
    for (int column = 0; column < 2 * SheenTable::kColumns - 1; ++column) {
      if (row % 2 == 0 && column % 2 == 0) continue;
      const double n_dot_v = at(SheenTable::kFirstColumn, 0.5 * column, SheenTable::kColumns);
      const double error =
          Error(lanes::LookupSheen(table, n_dot_v, roughness), IntegrateSheenAlbedo(n_dot_v, roughness));
      EXPECT_NEAR(error, 0.0, 0.0025) << roughness << " " << n_dot_v;
      most = std::max(most, std::fabs(error));
      squares += error * error;
      ++count;
    }
  }
  RecordProperty("most", std::to_string(most));
  RecordProperty("rms", std::to_string(std::sqrt(squares / count)));
}

TEST(SheenAlbedo, SamplesAreRead) {
  const SheenTable& table = SharedSheenTable();
  for (double roughness : {0.07, 0.3, 1.0}) {
    EXPECT_NEAR(lanes::LookupSheen(table, 1.0, roughness), IntegrateSheenAlbedo(1.0, roughness), 5e-4);
    EXPECT_NEAR(Error(lanes::LookupSheen(table, 1e-4, roughness), IntegrateSheenAlbedo(1e-4, roughness)), 0.0, 0.001);
  }
  EXPECT_NEAR(lanes::LookupSheen(table, 1.0, 1.0), IntegrateSheenAlbedo(1.0, 1.0), 1e-6);
}

TEST(SheenAlbedo, StaysInRange) {
  const SheenTable& table = SharedSheenTable();
  for (float e : table.albedo) EXPECT_TRUE(e >= 0.0f && e < 3.0f) << e;
  for (float wrong : {-1.0f, 0.0f, 2.0f, std::nanf("")}) {  // reading never leaves the table
    const float e = lanes::LookupSheen(table, wrong, wrong);
    EXPECT_TRUE(e >= 0.0f && e < 3.0f) << wrong << " " << e;
  }
}

// Rough sheen never reflects more than it receives, so that its lobe is not bounded.
TEST(SheenAlbedo, RoughSheenGainsNothing) {
  for (double roughness : {0.3, 0.5, 0.7, 0.9, 0.95, 1.0}) {
    for (double n_dot_v : {1e-4, 0.001, 0.004, 0.007, 0.01, 0.05, 0.3, 1.0}) {
      EXPECT_LT(IntegrateSheenAlbedo(n_dot_v, roughness), 1.0) << roughness << " " << n_dot_v;
    }
  }
}

TEST(SheenAlbedo, SameBitsForAnyNumberOfThreads) {
  for (int threads : {1, 2, 7}) {
    auto table = std::make_unique<SheenTable>();
    RunWithThreads(threads, [&] { ComputeSheenTable(table.get()); });
    EXPECT_EQ(std::memcmp(table.get(), &SharedSheenTable(), sizeof(SheenTable)), 0) << threads;
  }
}

TEST(SheenAlbedo, SameBitsOnEveryInstructionSet) {
  auto scalar = std::make_unique<SheenTable>(), other = std::make_unique<SheenTable>();
  const auto compute = [](Target target, SheenTable* table) {
    const ScopedTarget forced(target);
    ComputeSheenTable(table);
    return IntegrateSheenAlbedo(0.2, 0.4);
  };
  const double expected = compute(Target::Scalar, scalar.get());
  for (Target target : {Target::Sse4, Target::Avx2, Target::Avx3, Target::Neon}) {
    if (!TargetIsAvailable(target)) continue;
    EXPECT_EQ(compute(target, other.get()), expected);
    EXPECT_EQ(std::memcmp(scalar.get(), other.get(), sizeof(SheenTable)), 0) << TargetName(target);
  }
}

TEST(SheenAlbedo, LightingHasTheTableOnlyIfAsked) {
  EXPECT_EQ(MakeLightingData({}, nullptr).sheen, nullptr);
  const LightingData data = MakeLightingData({}, nullptr, 0.0, 1.0, {.sheen = true});
  ASSERT_EQ(data.sheen, &SharedSheenTable());
  EXPECT_EQ(lanes::LightingView<double>(data).SheenAlbedo(0.2, 0.4), lanes::LookupSheen(*data.sheen, 0.2, 0.4));
}

}  // namespace
}  // namespace facet
