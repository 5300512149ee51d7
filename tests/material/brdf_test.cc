// Closed forms of every BRDF term.
#include "facet/shader/brdf-inl.h"

#include <gtest/gtest.h>

#include <cmath>

namespace facet {
namespace {

namespace lanes = HWY_NAMESPACE;
using lanes::Vec3;

constexpr double kPi = 3.14159265358979324;
constexpr double kAlphas[] = {0.002, 0.01, 0.1, 0.3, 0.7, 1.0};

// Smith's Lambda of GGX: Heitz, 2014, Understanding the Masking-Shadowing Function, equation 72.
double Lambda(double cosine, double alpha) {
  const double tan2 = (1.0 - cosine * cosine) / (cosine * cosine);
  return 0.5 * (std::sqrt(1.0 + alpha * alpha * tan2) - 1.0);
}

// Calls f(theta, weight of dtheta) for angles crowded around alpha: uniform in log tan.
template <class F>
void ForPolarAngles(double alpha, int count, F f) {
  const double low = std::log(alpha * 1e-4), high = std::log(1e5);
  const double step = (high - low) / count;
  for (int i = 0; i < count; ++i) {
    const double theta = std::atan(std::exp(low + (i + 0.5) * step));
    f(theta, std::sin(theta) * std::cos(theta) * step);
  }
}

TEST(Ggx, IntegratesToOneOverProjectedHemisphere) {
  for (double alpha : kAlphas) {
    double sum = 0.0;
    ForPolarAngles(alpha, 2000, [&](double theta, double weight) {
      const double s = std::sin(theta), c = std::cos(theta);
      sum += 2.0 * kPi * lanes::DistributionGgx(c, s * s, alpha) * c * s * weight;
    });
    EXPECT_NEAR(sum, 1.0, 1e-6) << alpha;
  }
}

TEST(Ggx, IsUniformAtAlphaOneAndPeaksAtInverseAlphaSquared) {
  for (double c : {0.05, 0.5, 1.0}) EXPECT_NEAR(lanes::DistributionGgx(c, 1.0 - c * c, 1.0), 1.0 / kPi, 1e-7);
  for (double alpha : kAlphas) {
    EXPECT_NEAR(lanes::DistributionGgx(1.0, 0.0, alpha) * kPi * alpha * alpha, 1.0, 1e-7) << alpha;
  }
}

// Heitz, 2014, equation 14: the visible normals project onto exactly the area that is seen. Ties D to Smith's masking.
TEST(Ggx, VisibleNormalsCoverWhatIsSeen) {
  for (double alpha : {0.05, 0.3, 1.0}) {
    for (double n_dot_v : {0.1, 0.5, 0.9}) {
      const double sin_v = std::sqrt(1.0 - n_dot_v * n_dot_v);
      const double g1 = 1.0 / (1.0 + Lambda(n_dot_v, alpha));
      double sum = 0.0;
      constexpr int kAzimuths = 400;
      ForPolarAngles(alpha, 800, [&](double theta, double weight) {
        const double s = std::sin(theta), c = std::cos(theta);
        for (int j = 0; j < kAzimuths; ++j) {
          const double v_dot_h = sin_v * s * std::cos(2.0 * kPi * (j + 0.5) / kAzimuths) + n_dot_v * c;
          if (v_dot_h <= 0.0) continue;
          sum += g1 * v_dot_h * lanes::DistributionGgx(c, s * s, alpha) * s * weight * 2.0 * kPi / kAzimuths;
        }
      });
      EXPECT_NEAR(sum, n_dot_v, 2e-4 * n_dot_v) << alpha << " " << n_dot_v;
    }
  }
}

TEST(Ggx, FloatKeepsItsDigitsInTheHighlight) {
  // A unit half vector a tenth of a lobe off the normal, in a skewed frame so that no component is special.
  const double alpha = 0.045 * 0.045;
  for (double tilt : {0.01, 0.1, 1.0, 10.0}) {
    const double angle = tilt * alpha;
    const Vec3<double> n = {0.36, 0.48, 0.8}, t = {0.8, -0.6, 0.0};
    const Vec3<double> h = n * std::cos(angle) + t * std::sin(angle);
    const auto narrow = [](Vec3<double> v) { return Vec3<float>{float(v.x), float(v.y), float(v.z)}; };
    const double exact = lanes::DistributionGgx(std::cos(angle), std::sin(angle) * std::sin(angle), alpha);
    const double in_float = lanes::DistributionGgx(narrow(n), narrow(h), float(alpha));
    EXPECT_NEAR(in_float / exact, 1.0, 2e-3) << tilt;
  }
}

TEST(Smith, IsHeightCorrelatedSmith) {
  for (double alpha : kAlphas) {
    for (double l : {0.01, 0.3, 1.0}) {
      for (double v : {0.02, 0.6, 1.0}) {
        const double g2 = 1.0 / (1.0 + Lambda(l, alpha) + Lambda(v, alpha));
        EXPECT_NEAR(lanes::VisibilitySmith(l, v, alpha) * 4.0 * l * v / g2, 1.0, 1e-12);
        EXPECT_NEAR(lanes::VisibilitySmith(v, l, alpha) / lanes::VisibilitySmith(l, v, alpha), 1.0, 1e-14);
      }
    }
  }
}

TEST(Smith, Limits) {
  EXPECT_NEAR(lanes::VisibilitySmith(0.3, 0.5, 1e-9) * 4.0 * 0.3 * 0.5, 1.0, 1e-12);  // a mirror masks nothing
  EXPECT_NEAR(lanes::VisibilitySmith(0.3, 0.5, 1.0), 0.5 / 0.8, 1e-12);               // alpha 1: 1 / (2 (l + v))
  EXPECT_TRUE(std::isfinite(lanes::VisibilitySmith(0.0f, lanes::kMinNDotV, 0.002f)));
}

TEST(Schlick, Endpoints) {
  for (double f0 : {0.0, 0.04, 0.5, 1.0}) {
    EXPECT_DOUBLE_EQ(lanes::FresnelSchlick(f0, 1.0), f0);
    EXPECT_DOUBLE_EQ(lanes::FresnelSchlick(f0, 0.0), 1.0);
    EXPECT_NEAR(lanes::FresnelSchlick(f0, 0.5), f0 + (1.0 - f0) / 32.0, 1e-15);
    double average = 0.0;
    constexpr int kCount = 10000;
    for (int i = 0; i < kCount; ++i) {
      const double mu = (i + 0.5) / kCount;
      average += lanes::FresnelSchlick(f0, mu) * 2.0 * mu / kCount;
    }
    EXPECT_NEAR(lanes::FresnelSchlickAverage(f0), average, 1e-7);
  }
  EXPECT_EQ(lanes::SchlickWeight(1.0f + 1e-6f), 0.0f);  // rounding of a dot product must not turn it negative
}

TEST(Lambert, ReflectsAll) {
  EXPECT_NEAR(lanes::DiffuseLambert<double>() * kPi, 1.0, 1e-7);  // the projected hemisphere measures pi
}

TEST(MultipleScattering, IsTheSeriesOfBounces) {
  for (double f0 : {0.0, 0.04, 0.6, 1.0}) {
    for (double e_avg : {0.4, 0.8, 0.999}) {
      // After the first bounce Favg (1 - Eavg) is still inside; each further one lets Eavg of it out, over the lobe's
      // share 1 - Eavg.
      const double f = lanes::FresnelSchlickAverage(f0);
      double inside = 1.0 - e_avg, out = 0.0;
      for (int bounce = 2; bounce < 4000; ++bounce) {
        inside *= f;
        out += inside * f * e_avg;
        inside *= 1.0 - e_avg;
      }
      EXPECT_NEAR(lanes::MultipleScatteringFresnel(f0, e_avg), out / (1.0 - e_avg), 1e-9);
    }
  }
  EXPECT_EQ(lanes::MultipleScatteringFresnel(1.0f, 0.37f), 1.0f);
}

}  // namespace
}  // namespace facet
