// The terms that BRDFs are made of: float and double against long double, each in units of its own last place. Where
// the model's constants are floats (1 / pi) the exact value uses the same ones, so that errors are those of rounding.
#include <cmath>
#include <limits>
#include <random>

#include "facet/shader/brdf-inl.h"
#include "math/ulp.h"
#include "stability/stability_case.h"

namespace facet::stability {
namespace {

namespace lanes = HWY_NAMESPACE;
using Exact = long double;
using lanes::Vec3;
using testing::UlpError;

const float kPerceptualRoughnesses[] = {1e-6f, 1e-4f, 1e-3f, 0.01f, 0.045f, 0.1f, 0.3f, 0.5f, 0.7f, 0.9f, 1.0f};

// From 1 down to 1e-8, and the floats next to 1.
std::vector<float> Cosines() {
  std::vector<float> cosines = {1.0f, std::nextafter(1.0f, 0.0f), 0.999999f, 0.9999f, 0.99f, 0.9f};
  for (float c = 0.7f; c > 1e-8f; c *= 0.37f) cosines.push_back(c);
  cosines.push_back(1e-8f);
  return cosines;
}

template <class T>
Vec3<Exact> Widen(const Vec3<T>& v) {
  return {Exact(v.x), Exact(v.y), Exact(v.z)};
}

// Walter et al., 2007, equation 33, of the angle between two vectors of any length.
Exact DistributionOfAngle(const Vec3<Exact>& n, const Vec3<Exact>& h, Exact alpha) {
  const Vec3<Exact> c = lanes::Cross(n, h);
  const Exact lengths2 = lanes::Dot(n, n) * lanes::Dot(h, h), cosine = lanes::Dot(n, h);
  const Exact cos2 = cosine * cosine / lengths2, sin2 = lanes::Dot(c, c) / lengths2;
  const Exact k = alpha / (sin2 + cos2 * alpha * alpha);
  return k * k * Exact(lanes::kInversePi);
}

// Half vectors at angles from 0 through an ULP of n.h below 1 (3.5e-4) to grazing, around normals of any direction.
// Bound: a component of the cross product is the difference of two products below 1, each rounded by 2^-25 at most: its
// length is off by sqrt(3) * 2^-24 = 1e-7 = d. The relative error of D by it is 4 s d / (s^2 + alpha^2) <= 2 d / alpha,
// for alpha = 0.002 (the least that is drawn) 1e-4, or 850 ULP; 20 more for the remaining operations.
Measured MeasureDistributionNearItsPeak() {
  Measured m;
  std::mt19937 random(5);
  const auto uniform = [&] { return double(random()) / 4294967296.0 * 2.0 - 1.0; };
  for (const double alpha_exact : {0.002025, 0.01, 0.1, 1.0}) {
    const float alpha = static_cast<float>(alpha_exact);
    for (double angle = 1e-9; angle < 1.5; angle *= 1.15) {
      for (int trial = 0; trial < 20; ++trial) {
        Vec3<double> n{uniform(), uniform(), uniform()}, t{uniform(), uniform(), uniform()};
        n = lanes::NormalizeOr(n, Vec3<double>{0, 0, 1});
        t = lanes::NormalizeOr(lanes::Cross(n, t), Vec3<double>{1, 0, 0});
        const Vec3<double> h = n * std::cos(angle) + t * std::sin(angle);
        const Vec3<float> nf{float(n.x), float(n.y), float(n.z)}, hf{float(h.x), float(h.y), float(h.z)};
        const Exact exact = DistributionOfAngle(Widen(nf), Widen(hf), Exact(alpha));
        // Vectors that are unit to float's rounding only are no fair input to double; its own are.
        const Exact of_doubles = DistributionOfAngle(Widen(n), Widen(h), Exact(alpha));
        m.Error(UlpError(lanes::DistributionGgx(n, h, double(alpha)), of_doubles));
        m.Error(UlpError(lanes::DistributionGgx(nf, hf, alpha), exact));
        const float n_dot_h = lanes::Min(lanes::Dot(nf, hf), 1.0f);
        m.NaiveError(UlpError(lanes::DistributionGgx(n_dot_h, 1.0f - n_dot_h * n_dot_h, alpha), exact));
      }
    }
  }
  return m;
}

// Bound: a, a^2, the sum, the quotient, its square and the factor round once each; k enters squared:
// 2 * (1/2 * (2 + 1 + 1 + 1)) + 1 = 6 half units, an ULP being up to two half units of the result below: 12.
Measured MeasureDistributionOverRoughness() {
  Measured m;
  for (const float roughness : kPerceptualRoughnesses) {
    const float alpha = lanes::AlphaFromPerceptualRoughness(roughness);
    for (const float cosine : Cosines()) {
      const float sin2 = static_cast<float>(1.0 - double(cosine) * double(cosine));
      const Exact a = Exact(cosine) * Exact(alpha), k = Exact(alpha) / (Exact(sin2) + a * a);
      const float got = lanes::DistributionGgx(cosine, sin2, alpha);
      m.Expect(std::isfinite(got), "D is not finite at roughness " + std::to_string(roughness));
      const Exact exact = k * k * Exact(lanes::kInversePi);
      m.Error(UlpError(got, exact));
      m.Error(UlpError(lanes::DistributionGgx(double(cosine), double(sin2), double(alpha)), exact));
      const float d = cosine * cosine * (alpha * alpha - 1.0f) + 1.0f;
      m.NaiveError(UlpError(alpha * alpha / (d * d) * lanes::kInversePi, exact));
    }
  }
  return m;
}

// Walter's form of masking: with tangents, and 0 / 0 where a cosine vanishes.
float NaiveVisibility(float n_dot_l, float n_dot_v, float alpha) {
  const auto lambda = [alpha](float c) {
    const float tan2 = (1.0f - c * c) / (c * c);
    return (std::sqrt(1.0f + alpha * alpha * tan2) - 1.0f) * 0.5f;
  };
  return 1.0f / ((1.0f + lambda(n_dot_l) + lambda(n_dot_v)) * 4.0f * n_dot_l * n_dot_v);
}

// Every operation is on positive numbers but 1 - alpha^2, whose error alpha^2 + (1 - alpha^2) c^2 swallows unless c is
// near 1, where the sum is near 1 and the error absolute: no operation can lose more than a unit. Bound: eight
// roundings in the longer term, one for the sum, one for the quotient, at up to two halves of an ULP each: 10.
Measured MeasureVisibility() {
  Measured m;
  for (const float roughness : kPerceptualRoughnesses) {
    if (roughness < lanes::kMinPerceptualRoughness) continue;
    const float alpha = lanes::AlphaFromPerceptualRoughness(roughness);
    std::vector<float> light_cosines = Cosines();
    light_cosines.push_back(0.0f);
    for (const float n_dot_l : light_cosines) {
      for (const float n_dot_v : Cosines()) {
        const Exact exact = lanes::VisibilitySmith(Exact(n_dot_l), Exact(n_dot_v), Exact(alpha));
        m.Error(UlpError(lanes::VisibilitySmith(n_dot_l, n_dot_v, alpha), exact));
        m.Error(UlpError(lanes::VisibilitySmith(double(n_dot_l), double(n_dot_v), double(alpha)), exact));
        m.NaiveError(UlpError(NaiveVisibility(n_dot_l, n_dot_v, alpha), exact));
      }
    }
  }
  return m;
}

const float kReflectances[] = {0.0f, 1e-30f, 1e-8f, 0.02f, 0.04f, 0.5f, 0.999999f, 1.0f};

// Reflectance is compared with 1, what comes in: near v.h = 1 (1 - v.h)^5 has no correct digit to speak of, nor any
// weight. Bound: the weight's five roundings and the mixture's three, each 2^-24 of at most 1: 8 * 2^-24.
Measured MeasureFresnel() {
  Measured m;
  for (const float f0 : kReflectances) {
    for (const float cosine : Cosines()) {
      const Exact w = lanes::SchlickWeight(Exact(cosine));
      const Exact exact = Exact(f0) + (1.0L - Exact(f0)) * w;
      const Vec3<float> colored = lanes::FresnelSchlick(Vec3<float>{f0, f0, f0}, cosine);
      m.Error(std::fabs(double(Exact(colored.x) - exact)));
      m.Error(std::fabs(double(Exact(lanes::FresnelSchlick(f0, cosine)) - exact)));
      m.Expect(colored.x >= 0.0f && colored.x <= 1.0f, "Fresnel reflectance leaves [0, 1]");
    }
  }
  return m;
}

// Bound: f has 3 roundings, 1 - f (1 - e) cancels at f = e' = 1 only, where it is e itself, of at least 0.3 for every
// roughness (Eavg of GGX at alpha 1 is 0.45): an absolute error of 3 * 2^-24 over 0.3 is 10 half units; 6 more.
Measured MeasureMultipleScattering() {
  Measured m;
  for (const float f0 : kReflectances) {
    for (const float e_avg : {0.45f, 0.6f, 0.9f, 0.999f, 0.999999f, std::nextafter(1.0f, 0.0f), 1.0f}) {
      // With the float constant 1 / 21, as the model has it.
      const Exact f = Exact(f0) + (1.0L - Exact(f0)) * Exact(1.0f / 21.0f), e = Exact(e_avg);
      const float got = lanes::MultipleScatteringFresnel(f0, e_avg);
      const Exact exact = f * f * e / (1.0L - f * (1.0L - e));
      m.Error(UlpError(got, exact));
      m.Error(UlpError(lanes::MultipleScatteringFresnel(double(f0), double(e_avg)), exact));
      m.Expect(got >= 0.0f && got <= 1.0f, "multiple scattering makes energy");
    }
  }
  return m;
}

}  // namespace

std::vector<Case> BrdfCases() {
  return {
      {"BRDF terms", "GGX distribution at n·h within an ULP of 1", "1 - (n·h)² loses every digit of the highlight",
       "sin² = (n × h)², by Lagrange's identity", "ULP", 870.0, MeasureDistributionNearItsPeak},
      {"BRDF terms", "GGX distribution at roughness 1e-6 to 1", "(n·h)² (α² - 1) + 1 becomes 0, and D infinite",
       "α / (sin² + (n·h)² α²), squared last", "ULP", 12.0, MeasureDistributionOverRoughness},
      {"BRDF terms", "Smith masking at n·v from 1 to 1e-8 and n·l from 1 to 0", "0 / 0 at n·l = 0",
       "the form with both cosines divided out", "ULP", 10.0, MeasureVisibility},
      {"BRDF terms", "Fresnel at F0 from 0 to 1", "a power function's own error; mixtures above 1",
       "five products, and a mixture whose weights sum to 1", "of what comes in", 8 * 0x1p-24, MeasureFresnel},
      {"BRDF terms", "multiple scattering at F0 from 0 to 1", "0 / 0 for a perfect mirror",
       "the geometric series in closed form", "ULP", 16.0, MeasureMultipleScattering},
  };
}

}  // namespace facet::stability
