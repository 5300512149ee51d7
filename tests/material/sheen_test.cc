// The sheen lobe alone: closed forms of its terms, the energy that it reflects and leaves, and extreme inputs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "light/lighting-inl.h"
#include "material/lobes/sheen-inl.h"

namespace facet {
namespace {

namespace lanes = HWY_NAMESPACE;
using lanes::Incidence;
using lanes::LightingView;
using lanes::SheenLobe;
using lanes::SurfaceView;
using lanes::Vec3;

constexpr double kPi = 3.14159265358979324;
constexpr double kNDotV[] = {0.002, 0.01, 0.03, 0.1, 0.3, 0.6, 1.0};

std::vector<double> Roughnesses() {
  std::vector<double> result = {0.0};
  for (int i = 1; i <= 20; ++i) result.push_back(0.05 * i);
  return result;
}

template <class T>
SurfaceView<T> SeenFrom(T n_dot_v) {
  return {{T(0), T(0), T(1)}, {std::sqrt(T(1) - n_dot_v * n_dot_v), T(0), n_dot_v}, n_dot_v};
}

template <class T>
Incidence<T> From(const SurfaceView<T>& at, const Vec3<T>& direction) {
  Incidence<T> from{};
  from.n_dot_l = lanes::Clamp(Dot(at.normal, direction), T(0), T(1));
  from.half = lanes::NormalizeOr(at.view + direction, at.normal);
  from.v_dot_h = lanes::Clamp(Dot(at.view, from.half), T(0), T(1));
  return from;
}

template <class T>
Vec3<T> Direction(T n_dot_l, T azimuth) {
  const T s = std::sqrt(T(1) - n_dot_l * n_dot_l);
  return {s * std::cos(azimuth), s * std::sin(azimuth), n_dot_l};
}

LightingData WithSheen(const EnvironmentMap* environment = nullptr) {
  return MakeLightingData({}, environment, 0.0, 1.0, {.sheen = true});
}

// The integral of the lobe's BRDF times n_dot_l over the hemisphere.
Vec3<double> Reflected(const SheenLobe<double>& lobe, const SurfaceView<double>& at) {
  constexpr int kPolar = 150, kAzimuth = 100;
  Vec3<double> sum{};
  for (int i = 0; i < kPolar; ++i) {
    const double t = (i + 0.5) / kPolar, z = t * t * t * t;  // crowded at the horizon
    for (int j = 0; j < kAzimuth; ++j) {
      const double w = (j + 0.5) / kAzimuth, azimuth = kPi * (1.0 - w * w);  // and at the mirror's azimuth
      const double weight = z * (4.0 * t * t * t / kPolar) * (4.0 * kPi * w / kAzimuth);
      sum += lobe.Direct(at, From(at, Direction(z, azimuth))) * weight;
    }
  }
  return sum;
}

TEST(Charlie, IntegratesToOneOverProjectedHemisphere) {
  for (double roughness : {0.07, 0.2, 0.5, 1.0}) {
    constexpr int kCount = 20000;
    double sum = 0.0;
    for (int i = 0; i < kCount; ++i) {  // over sin2 = x: 2 pi cos sin dtheta = pi dx
      sum += kPi / kCount * lanes::DistributionCharlie((i + 0.5) / kCount, 1.0 / (roughness * roughness));
    }
    EXPECT_NEAR(sum, 1.0, 1e-4) << roughness;
  }
}

TEST(Charlie, IsGreatestOnItsHorizonAndZeroOnTheNormal) {
  for (double roughness : {0.07, 0.5, 1.0}) {
    const double inverse_alpha = 1.0 / (roughness * roughness);
    EXPECT_NEAR(lanes::DistributionCharlie(1.0, inverse_alpha), (2.0 + inverse_alpha) / (2.0 * kPi), 1e-5);
    EXPECT_EQ(lanes::DistributionCharlie(0.0, inverse_alpha), 0.0);
  }
  EXPECT_NEAR(lanes::DistributionCharlie(0.25, 1.0), 3.0 * 0.5 / (2.0 * kPi), 1e-7);
}

// The two halves of Lambda's fit, about the point (0.5, L(0.5)), by which the upper is the lower one's reflection.
TEST(Charlie, MaskingIsAContinuousFallingFunction) {
  for (double alpha : {0.0049, 0.1, 0.5, 1.0}) {
    const lanes::CharlieMasking<double> masking(alpha);
    EXPECT_NEAR(masking.Lambda(0.5 - 1e-9), masking.Lambda(0.5), 1e-7);
    for (double x : {0.0, 0.01, 0.2, 0.4}) {
      const double middle = masking.Lambda(0.5);
      EXPECT_NEAR(masking.Lambda(x) * masking.Lambda(1.0 - x) / (middle * middle), 1.0, 1e-9) << alpha << " " << x;
    }
    for (int i = 0; i < 100; ++i) EXPECT_GT(masking.Lambda(i * 0.01), masking.Lambda(i * 0.01 + 0.01)) << alpha;
  }
  // At alpha 1 and 0.25: exp(21.5473 / (1 + 3.82987 * 0.25^0.19823) - 1.97760 * 0.25 - 4.32054).
  const double exponent = 21.5473 / (1.0 + 3.82987 * std::pow(0.25, 0.19823)) - 1.97760 * 0.25 - 4.32054;
  EXPECT_NEAR(lanes::CharlieMasking<double>(1.0).Lambda(0.25), std::exp(exponent), 1e-5);
}

// What the lobe reflects in a white furnace and what it leaves to the layers under it are 1 together.
TEST(Sheen, ReflectsItsAlbedoUnderDirectionalLights) {
  const LightingData data = WithSheen();
  const LightingView<double> lighting(data);
  double most = 0.0;
  for (double roughness : Roughnesses()) {
    for (double n_dot_v : kNDotV) {
      const SurfaceView<double> at = SeenFrom(n_dot_v);
      const SheenLobe<double> lobe(at, {{1.0, 0.5, 0.25}, roughness}, lighting);
      const Vec3<double> reflected = Reflected(lobe, at);
      EXPECT_NEAR(reflected.x, lobe.albedo, 0.003) << roughness << " " << n_dot_v;
      EXPECT_NEAR(reflected.x + lobe.EnergyLeft(), 1.0, 0.003) << roughness << " " << n_dot_v;
      EXPECT_NEAR(reflected.y, 0.5 * reflected.x, 1e-12);
      EXPECT_NEAR(reflected.z, 0.25 * reflected.x, 1e-12);
      most = std::max(most, std::fabs(reflected.x - lobe.albedo));
    }
  }
  RecordProperty("most", std::to_string(most));
}

Image ConstantImage(float r, float g, float b) {
  Image image{64, 32, 3, ChannelType::F32, Encoding::Linear, {}};
  image.bytes.resize(image.PixelCount() * 3 * sizeof(float));
  for (std::size_t i = 0; i < image.PixelCount(); ++i) {
    image.As<float>()[3 * i] = r;
    image.As<float>()[3 * i + 1] = g;
    image.As<float>()[3 * i + 2] = b;
  }
  return image;
}

TEST(Sheen, ReflectsItsAlbedoInAConstantEnvironment) {
  const auto environment = PrefilterEnvironment(ConstantImage(1.0f, 2.0f, 0.5f));
  const LightingData data = WithSheen(environment.get());
  const LightingView<double> lighting(data);
  for (double roughness : Roughnesses()) {
    for (double n_dot_v : kNDotV) {
      const SurfaceView<double> at = SeenFrom(n_dot_v);
      const SheenLobe<double> lobe(at, {{1.0, 0.5, 0.25}, roughness}, lighting);
      const lanes::EnvironmentTerms<double> terms = lobe.Environment(at, lighting);
      EXPECT_NEAR(terms.radiance.x, lobe.albedo, 1e-4 * lobe.albedo);
      EXPECT_NEAR(terms.radiance.y, lobe.albedo, 1e-4 * lobe.albedo);
      EXPECT_NEAR(terms.radiance.z, 0.125 * lobe.albedo, 1e-4 * lobe.albedo);
      EXPECT_EQ(MaxComponent(terms.of_irradiance_over_pi), 0.0);
    }
  }
}

TEST(Sheen, AlbedoAndEnergyLeftAreShares) {
  const LightingData data = WithSheen();
  const LightingView<float> lighting(data);
  for (double roughness : Roughnesses()) {
    for (double n_dot_v : {1e-4, 3e-4, 0.001, 0.005, 0.05, 0.5, 1.0}) {
      for (float color : {0.0f, 0.7f, 1.0f}) {
        const SheenLobe<float> lobe(SeenFrom(float(n_dot_v)), {{0.1f * color, color, 0.5f * color}, float(roughness)},
                                    lighting);
        EXPECT_TRUE(lobe.albedo >= 0.0f && lobe.albedo <= 1.0f);
        EXPECT_EQ(lobe.EnergyLeft(), 1.0f - color * lobe.albedo);
        EXPECT_GE(lobe.EnergyLeft(), 0.0f);
      }
    }
  }
}

TEST(Sheen, IsReciprocalWhereItIsNotBounded) {
  const LightingData data = WithSheen();
  const LightingView<double> lighting(data);
  std::mt19937 random(3);
  const auto uniform = [&] { return double(random()) / 4294967296.0; };
  for (int trial = 0; trial < 2000; ++trial) {
    const double roughness = 0.3 + 0.7 * uniform();
    SurfaceView<double> a = SeenFrom(0.001 + 0.999 * uniform()), b = a;
    b.n_dot_v = 0.001 + 0.999 * uniform();
    b.view = Direction(b.n_dot_v, 2.0 * kPi * uniform());
    const Vec3<double> white = {1.0, 1.0, 1.0};
    const double ab = SheenLobe<double>(a, {white, roughness}, lighting).Direct(a, From(a, b.view)).x;
    const double ba = SheenLobe<double>(b, {white, roughness}, lighting).Direct(b, From(b, a.view)).x;
    EXPECT_NEAR(ab, ba, 1e-9 * ab);
  }
}

// Light from the horizon, half vectors along the normal and opposite to the view, and roughness 0.
TEST(Sheen, IsFiniteForExtremeInputs) {
  const LightingData data = WithSheen();
  const LightingView<float> lighting(data);
  for (float roughness : {0.0f, 0.01f, 0.07f, 0.5f, 1.0f}) {
    for (float n_dot_v : {lanes::kMinNDotV, 0.01f, 0.5f, 1.0f}) {
      const SurfaceView<float> at = SeenFrom(n_dot_v);
      const SheenLobe<float> lobe(at, {{1.0f, 1.0f, 1.0f}, roughness}, lighting);
      std::vector<Vec3<float>> directions = {at.view, -at.view, {-at.view.x, 0.0f, at.view.z}, at.normal, -at.normal};
      for (float n_dot_l : {0.0f, 1e-20f, 1e-7f, 1e-4f, 0.3f}) {
        for (float azimuth : {0.0f, 1.5f, 3.14159274f}) directions.push_back(Direction(n_dot_l, azimuth));
      }
      for (const Vec3<float>& direction : directions) {
        const float value = lobe.Direct(at, From(at, direction)).x;
        EXPECT_TRUE(std::isfinite(value) && value >= 0.0f) << roughness << " " << n_dot_v << " " << value;
      }
      // The half vector is the normal where light is mirrored: fibres that stand upright reflect nothing there.
      const float mirrored = lobe.Direct(at, From(at, {-at.view.x, 0.0f, at.view.z})).x;
      EXPECT_LT(mirrored, 1e-6f * lobe.Direct(at, From(at, at.view)).x + 1e-30f);
    }
  }
}

// Smoother than the least roughness is the least roughness.
TEST(Sheen, RoughnessIsClamped) {
  const LightingData data = WithSheen();
  const LightingView<double> lighting(data);
  const SurfaceView<double> at = SeenFrom(0.05);
  const Incidence<double> from = From(at, Direction(0.04, 0.3));
  const Vec3<double> white = {1.0, 1.0, 1.0};
  const auto direct = [&](double roughness) {
    return SheenLobe<double>(at, {white, roughness}, lighting).Direct(at, from).x;
  };
  EXPECT_EQ(direct(0.0), direct(double(lanes::kMinSheenRoughness)));
  EXPECT_EQ(direct(-1.0), direct(0.05));
  EXPECT_EQ(direct(2.0), direct(1.0));
  EXPECT_NE(direct(0.1), direct(0.05));
}

TEST(Sheen, FloatAgreesWithDouble) {
  const LightingData data = WithSheen();
  const LightingView<float> in_float(data);
  const LightingView<double> in_double(data);
  std::mt19937 random(11);
  const auto uniform = [&] { return float(random() >> 8) / 16777216.0f; };
  double most = 0.0;
  for (int trial = 0; trial < 20000; ++trial) {
    const float roughness = trial % 4 == 0 ? 0.0f : uniform();
    const float n_dot_v = 1e-4f + (1.0f - 1e-4f) * uniform() * uniform();
    const SurfaceView<float> at = SeenFrom(n_dot_v);
    const Vec3<float> light = Direction(1e-3f + 0.999f * uniform() * uniform(), 6.28318531f * uniform());
    const auto widen = [](Vec3<float> v) { return Vec3<double>{double(v.x), double(v.y), double(v.z)}; };
    const SurfaceView<double> at_double = {widen(at.normal), widen(at.view), double(n_dot_v)};
    const SheenLobe<float> lobe(at, {{1.0f, 1.0f, 1.0f}, roughness}, in_float);
    const SheenLobe<double> exact(at_double, {{1.0, 1.0, 1.0}, double(roughness)}, in_double);
    const double expected = exact.Direct(at_double, From(at_double, widen(light))).x;
    const double error = std::fabs(double(lobe.Direct(at, From(at, light)).x) - expected);
    // Where D is 1e-12 of its peak it still has four digits.
    const double peak = exact.scale / exact.one_and_lambda_of_view;
    if (expected > 1e-12 * peak) most = std::max(most, error / expected);
    EXPECT_LE(error, 2e-4 * expected + 1e-12 * peak) << roughness << " " << n_dot_v;
    EXPECT_NEAR(double(lobe.albedo), exact.albedo, 1e-5);
    EXPECT_NEAR(double(lobe.EnergyLeft()), exact.EnergyLeft(), 1e-5);
  }
  RecordProperty("most", std::to_string(most));
}

}  // namespace
}  // namespace facet
