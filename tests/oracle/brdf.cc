#include "oracle/brdf.h"

#include <algorithm>
#include <map>
#include <utility>

namespace oracle {
namespace {

constexpr double kDielectric = 0.04;  // appendix B.2.2: index of refraction 1.5

// Appendix B.3.2: Trowbridge-Reitz, and height-correlated Smith over 4 n.l n.v.
double Distribution(double n_h, double alpha) {
  const double f = n_h * n_h * (alpha * alpha - 1.0) + 1.0;
  return alpha * alpha / (kPi * f * f);
}
double Visibility(double n_l, double n_v, double alpha) {
  const double a2 = alpha * alpha;
  return 0.5 / (n_l * std::sqrt(n_v * n_v * (1.0 - a2) + a2) + n_v * std::sqrt(n_l * n_l * (1.0 - a2) + a2));
}

// How much of the light from all around GGX reflects once where Fresnel is f0 + (1 - f0)(1 - v.h)^5: f0 a + b.
struct Albedo {
  double a = 0.0, b = 0.0;
  double White() const { return a + b; }
};

// The mean over half vectors distributed as D n.h, at the middles of even steps: dl = 4 v.h dh.
Albedo AlbedoAt(double n_v, double alpha) {
  static std::map<std::pair<double, double>, Albedo> known;  // the same views and lights come again
  const auto [place, is_new] = known.try_emplace({n_v, alpha});
  if (!is_new) return place->second;
  constexpr int kPolar = 200, kAzimuth = 100;
  const double sin_v = std::sqrt(1.0 - n_v * n_v);
  Albedo sum;
  for (int i = 0; i < kPolar; ++i) {
    const double u = (i + 0.5) / kPolar, cos2 = (1.0 - u) / (1.0 + (alpha * alpha - 1.0) * u);
    const double n_h = std::sqrt(cos2), sin_h = std::sqrt(1.0 - cos2);
    for (int j = 0; j < kAzimuth; ++j) {
      const double v_h = sin_v * sin_h * std::cos(kPi * (j + 0.5) / kAzimuth) + n_v * n_h;
      const double n_l = 2.0 * v_h * n_h - n_v;
      if (n_l <= 0.0 || v_h <= 0.0) continue;
      const double weight = Visibility(n_l, n_v, alpha) * n_l * 4.0 * v_h / n_h;
      const double rise = std::pow(1.0 - v_h, 5.0);
      sum.a += weight * (1.0 - rise);
      sum.b += weight * rise;
    }
  }
  return place->second = {sum.a / (kPolar * kAzimuth), sum.b / (kPolar * kAzimuth)};
}

// 2 * integral of mu d mu.
Albedo AverageAlbedo(double alpha) {
  static std::map<double, Albedo> known;
  if (const auto found = known.find(alpha); found != known.end()) return found->second;
  constexpr int kSteps = 100;
  Albedo sum;
  for (int i = 0; i < kSteps; ++i) {
    const double mu = (i + 0.5) / kSteps;
    const Albedo at = AlbedoAt(mu, alpha);
    sum.a += 2.0 * mu * at.a / kSteps;
    sum.b += 2.0 * mu * at.b / kSteps;
  }
  return known[alpha] = sum;
}

// docs/materials.md, "Multiple scattering".
double MultipleFresnel(double f0, double average) {
  const double f = f0 + (1.0 - f0) / 21.0;
  return f * f * average / (1.0 - f * (1.0 - average));
}
// What a dielectric's reflection leaves to its base.
double Left(const Albedo& albedo, double multiple) {
  return 1.0 - (kDielectric * albedo.a + albedo.b + multiple * (1.0 - albedo.White()));
}

double Channel(const Vec& v, int c) { return c == 0 ? v.x : c == 1 ? v.y : v.z; }
template <class Of>
Vec EachChannel(const Vec& base, const Of& of) {
  return {of(Channel(base, 0)), of(Channel(base, 1)), of(Channel(base, 2))};
}

}  // namespace

Vec Reflect(const Surface& s, Vec normal, Vec view, Vec light) {
  const double n_l = Dot(normal, light), n_v = Dot(normal, view);
  if (n_l <= 0.0) return {};
  const double alpha = s.roughness * s.roughness;
  const Vec half = Unit(view + light);
  const double rise = std::pow(1.0 - Dot(view, half), 5.0);
  const double single = Distribution(Dot(normal, half), alpha) * Visibility(n_l, n_v, alpha);
  const Albedo at_view = AlbedoAt(n_v, alpha), at_light = AlbedoAt(n_l, alpha), average = AverageAlbedo(alpha);
  const double lost = (1.0 - at_view.White()) * (1.0 - at_light.White()) / (kPi * (1.0 - average.White()));
  const double multiple = MultipleFresnel(kDielectric, average.White());
  const double diffuse = Left(at_view, multiple) * Left(at_light, multiple) / (kPi * Left(average, multiple));
  return n_l * EachChannel(s.base, [&](double base) {
           const double metal = (base + (1.0 - base) * rise) * single + MultipleFresnel(base, average.White()) * lost;
           const double dielectric =
               (kDielectric + (1.0 - kDielectric) * rise) * single + multiple * lost + base * diffuse;
           return s.metallic * metal + (1.0 - s.metallic) * dielectric;
         });
}

Vec ReflectAll(const Surface& s, Vec normal, Vec view) {
  const double alpha = s.roughness * s.roughness;
  const Albedo at_view = AlbedoAt(Dot(normal, view), alpha), average = AverageAlbedo(alpha);
  const double multiple = MultipleFresnel(kDielectric, average.White()), lost = 1.0 - at_view.White();
  return EachChannel(s.base, [&](double base) {
    const double metal = base * at_view.a + at_view.b + MultipleFresnel(base, average.White()) * lost;
    const double left = Left(at_view, multiple);
    return s.metallic * metal + (1.0 - s.metallic) * (1.0 - left + base * left);
  });
}

}  // namespace oracle
