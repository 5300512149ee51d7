// The whole material: float against long double, double against long double, and energy, over the parameters' ends.
#include <cmath>
#include <functional>

#include "light/lighting-inl.h"
#include "light/punctual.h"
#include "material/closure-inl.h"
#include "stability/stability_case.h"

namespace facet::stability {
namespace {

namespace lanes = HWY_NAMESPACE;
using lanes::LightingView;
using lanes::MaterialInputs;
using lanes::Vec3;

constexpr double kPi = 3.14159265358979324;
constexpr float kBelowOne = 0x1.fffffep-1f;

const float kRoughnesses[] = {0.0f, 1e-6f, 1e-3f, 0.045f, 0.1f, 0.3f, 0.5f, 0.7f, 0.9f, 1.0f};
const float kMetallic[] = {0.0f, 1e-6f, 0.25f, 0.5f, kBelowOne, 1.0f};
const float kBaseColors[] = {0.0f, 1e-8f, 0.5f, kBelowOne, 1.0f};
const float kCosines[] = {1.0f, kBelowOne, 0.99f, 0.5f, 0.1f, 1e-2f, 1e-3f, 1e-4f, 1e-6f, 1e-8f};

const LightingData& NoLighting() {
  static const LightingData data = MakeLightingData({}, nullptr);
  return data;
}

template <class T>
MaterialInputs<T> Inputs(float base, float metallic, float roughness) {
  MaterialInputs<T> in{};
  in.base_color = {T(base), T(base), T(base)};
  in.metallic = T(metallic);
  in.perceptual_roughness = T(roughness);
  in.normal = {T(0), T(0), T(1)};
  in.occlusion = T(1);
  return in;
}

// Unit to rounding, with the z that is asked for.
Vec3<float> Direction(float z, double azimuth) {
  const double s = std::sqrt(std::fmax(1.0 - double(z) * double(z), 0.0));
  return {float(s * std::cos(azimuth)), float(s * std::sin(azimuth)), z};
}

template <class T>
Vec3<T> As(const Vec3<float>& v) {
  return {T(v.x), T(v.y), T(v.z)};
}

template <class T>
T Evaluate(const MaterialInputs<T>& in, const Vec3<float>& view, const Vec3<float>& light) {
  const LightingView<T> lighting(NoLighting());
  return lanes::EvaluateClosure(lanes::MakeClosure<T, lanes::kCoreLobes>(in, As<T>(view), lighting), As<T>(light),
                                lighting)
      .y;
}

// Calls visit(base, metallic, roughness, view, light) for all ends of all parameters.
void ForEachGeometry(const std::function<void(float, float, float, const Vec3<float>&, const Vec3<float>&)>& visit) {
  for (const float roughness : kRoughnesses) {
    for (const float metallic : kMetallic) {
      for (const float base : kBaseColors) {
        for (const float n_dot_v : kCosines) {
          const Vec3<float> view = Direction(n_dot_v, 0.0);
          for (const float n_dot_l : kCosines) {
            for (const double azimuth : {0.0, 1e-3, 1.0, 3.0, kPi - 1e-3, kPi - 1e-6, kPi}) {
              visit(base, metallic, roughness, view, Direction(n_dot_l, azimuth));
            }
          }
        }
      }
    }
  }
}

// Errors are measured against the value itself plus what a white diffuse surface would show in that light: below that,
// a wrong digit is not seen. Bound in float, at roughness 0.045: the half vector is off by 3e-7 (its own rounding and
// that of the cross product), which costs 2 * 3e-7 / alpha = 3e-4 of a highlight; 1 - Eavg is 7.6e-5 there and off by
// three roundings of sums near 1, 1.5e-7, which costs 2e-3 of multiple scattering. Double has 2^-29 of that.
template <class T>
Measured MeasureClosure() {
  Measured m;
  ForEachGeometry([&m](float base, float metallic, float roughness, const Vec3<float>& view, const Vec3<float>& light) {
    const T got = Evaluate(Inputs<T>(base, metallic, roughness), view, light);
    const long double exact = Evaluate(Inputs<long double>(base, metallic, roughness), view, light);
    m.Expect(got >= T(0) && std::isfinite(got), "a BRDF is negative or not finite");
    m.Error(double(std::fabs(static_cast<long double>(got) - exact) / (exact + light.z / kPi)));
  });
  return m;
}

Measured MeasureBelowHorizon() {
  Measured m;
  for (const float roughness : kRoughnesses) {
    for (const float metallic : kMetallic) {
      for (const float n_dot_v : {1.0f, 0.3f, 1e-8f, 0.0f, -1e-8f, -0.3f, -1.0f}) {
        for (const float n_dot_l : {0.0f, -0.0f, -1e-30f, -1e-8f, -0.5f, -1.0f}) {
          for (const double azimuth : {0.0, 2.0, kPi}) {
            const auto in = Inputs<float>(1.0f, metallic, roughness);
            m.Error(std::fabs(Evaluate(in, Direction(n_dot_v, 0.0), Direction(n_dot_l, azimuth))));
            const float lit = Evaluate(in, Direction(n_dot_v, 0.0), Direction(0.7f, azimuth));
            m.Expect(std::isfinite(lit) && lit >= 0.0f, "a view below the horizon gives what is not a radiance");
          }
        }
      }
    }
  }
  return m;
}

// Albedo towards `view`: the integral of BRDF n.l over half vectors, uniform in log tan so that every lobe is resolved.
// The closure in T, the sum in double.
template <class T>
double Albedo(const MaterialInputs<T>& in, float n_dot_v) {
  const LightingView<T> lighting(NoLighting());
  const double sin_v = std::sqrt(1.0 - double(n_dot_v) * double(n_dot_v));
  const auto closure = lanes::MakeClosure(in, Vec3<T>{T(sin_v), T(0), T(n_dot_v)}, lighting);
  constexpr int kPolar = 220, kAzimuth = 48;
  const double low = std::log(double(closure.microfacets.alpha) * 0.02), high = std::log(3e4),
               step = (high - low) / kPolar;
  double sum = 0.0;
  for (int i = 0; i < kPolar; ++i) {
    const double theta = std::atan(std::exp(low + (i + 0.5) * step)), s = std::sin(theta), c = std::cos(theta);
    double ring = 0.0;
    for (int j = 0; j < kAzimuth; ++j) {
      const double phi = kPi * (j + 0.5) / kAzimuth;
      const Vec3<double> half{s * std::cos(phi), s * std::sin(phi), c};
      const double v_dot_h = sin_v * half.x + double(n_dot_v) * half.z;
      if (v_dot_h <= 0.0) continue;
      const Vec3<double> light = half * (2.0 * v_dot_h) - Vec3<double>{sin_v, 0.0, double(n_dot_v)};
      if (light.z <= 0.0) continue;
      ring += double(lanes::EvaluateClosure(closure, Vec3<T>{T(light.x), T(light.y), T(light.z)}, lighting).y) * 4.0 *
              v_dot_h;
    }
    sum += ring * s * (s * c * step) * (2.0 * kPi / kAzimuth);
  }
  return sum;
}

// Bound: tables of 64 columns and linear reading between them, tests/material/furnace_test.cc; the integral's own
// error.
Measured MeasureFurnace() {
  Measured m;
  for (const float roughness : {0.0f, 1e-6f, 0.045f, 0.1f, 0.4f, 1.0f}) {
    for (const float metallic : {0.0f, 0.5f, 1.0f}) {
      for (const float n_dot_v : {1.0f, 0.5f, 0.1f, 1e-2f, 1e-4f}) {
        m.Error(std::fabs(Albedo(Inputs<float>(1.0f, metallic, roughness), n_dot_v) - 1.0));
      }
    }
  }
  return m;
}

// What rounding does to energy: the same sum with directions and closure in float and in double. Bound: at n.v = 1e-3
// the sum of view and light is 2e-3 long, and its direction off by the directions' own rounding, sqrt(2) 2^-24 / 2e-3 =
// 4e-5. That blurs a lobe of width alpha = 2e-3: D loses, to second order, some 10 (4e-5 / 2e-3)^2 = 4e-3.
Measured MeasureEnergyOfRounding() {
  Measured m;
  for (const float roughness : {0.0f, 0.045f, 0.1f, 0.5f, 1.0f}) {
    for (const float metallic : {0.0f, 0.25f, 1.0f}) {
      for (const float base : {0.0f, 0.5f, 1.0f}) {
        for (const float n_dot_v : {1.0f, 0.3f, 1e-3f}) {
          m.Error(std::fabs(Albedo(Inputs<float>(base, metallic, roughness), n_dot_v) -
                            Albedo(Inputs<double>(base, metallic, roughness), n_dot_v)));
        }
      }
    }
  }
  return m;
}

}  // namespace

std::vector<Case> ClosureCases() {
  return {
      {"materials", "closure in float at the ends of all parameters",
       "NaN or infinities at 0 roughness or grazing angles",
       "roughness from 0.045 and n·v from 1e-4 on; sums of positive terms", "relative", 2.5e-3, MeasureClosure<float>},
      {"materials", "closure in double at the ends of all parameters", "the reference has the error that it measures",
       "one source for all precisions", "relative", 1e-11, MeasureClosure<double>},
      {"materials", "light and view below the horizon", "light through the surface; negative radiance",
       "exactly 0 for light; a view below counts as grazing", "1/sr", 0.0, MeasureBelowHorizon},
      {"materials", "white furnace at roughness 0 to 1, metalness mixed", "rough metals lose more than half of it",
       "a lobe for multiple scattering", "of what comes in", 0.02, MeasureFurnace},
      {"materials", "albedo in float against double", "speckles that are brighter than their light",
       "half vectors from a sum that cancels exactly", "of what comes in", 5e-3, MeasureEnergyOfRounding},
  };
}

}  // namespace facet::stability
