// The model "lecture" at one point of a flat surface, in double: what its tests and the table of its energy share.
#pragma once

#include <cmath>

#include "light/lighting-inl.h"
#include "material/models/lecture-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {

namespace lanes = HWY_NAMESPACE;

// A surface without textures, facing +Z.
template <class T>
struct LectureSource {
  const LectureParameters& parameters;

  bool Has(MaterialFeatures feature) const { return (feature & FeaturesOf(parameters)) != 0; }
  template <class Block>
  const Block& Parameters() const {
    return parameters;
  }
  template <int kChannels>
  lanes::Vec4<T> Read(Slot) const {
    return {T(1.0f), T(1.0f), T(1.0f), T(1.0f)};
  }
  lanes::Vec3<T> Normal() const { return {T(0.0f), T(0.0f), T(1.0f)}; }
  lanes::Vec3<T> InterpolatedNormal() const { return Normal(); }
  lanes::Vec4<T> Tangent() const { return {T(1.0f), T(0.0f), T(0.0f), T(1.0f)}; }
};

struct NoLighting {};

template <class T, class Lighting = NoLighting>
lanes::LectureScattering<T> LectureSeenFrom(const LectureParameters& p, const lanes::Vec3<T>& view,
                                            const Lighting& lighting = {}) {
  const glm::vec4& base = p.albedo.value;
  return lanes::Lecture::Make<T>(LectureSource<T>{p}, lanes::Vec4<T>{T(base.x), T(base.y), T(base.z), T(base.w)}, view,
                                 lighting);
}

inline lanes::Vec3<double> DirectionOf(double cosine, double azimuth = 0.0) {
  const double sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
  return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}

// The share of a white furnace's light that the surface reflects towards a view, of the red channel: the integral over
// half vectors, uniform in the logarithm of their tangent, so that every lobe is resolved.
inline double LectureAlbedo(const LectureParameters& p, double n_dot_v, bool of_image = false) {
  const lanes::Vec3<double> view = DirectionOf(n_dot_v);
  const auto surface = LectureSeenFrom<double>(p, view);
  constexpr int kPolar = 300, kAzimuth = 64;
  constexpr double kPi = 3.14159265358979324;
  const double low = std::log(surface.microfacets.alpha * 0.01), high = std::log(1e5);
  const double step = (high - low) / kPolar;
  double sum = 0.0;
  for (int i = 0; i < kPolar; ++i) {
    const double theta = std::atan(std::exp(low + (i + 0.5) * step));
    const double s = std::sin(theta), c = std::cos(theta);
    double ring = 0.0;
    for (int j = 0; j < kAzimuth; ++j) {
      const double phi = kPi * (j + 0.5) / kAzimuth;
      const lanes::Vec3<double> half = {s * std::cos(phi), s * std::sin(phi), c};
      const double v_dot_h = Dot(view, half);
      if (v_dot_h <= 0.0) continue;
      const lanes::Vec3<double> light = half * (2.0 * v_dot_h) - view;
      if (light.z > 0.0) ring += surface.Reflected(light, of_image).x * 4.0 * v_dot_h;
    }
    sum += ring * s * (s * c * step) * (2.0 * kPi / kAzimuth);
  }
  return sum;
}

// What image-based light reflects of a white environment.
class WhiteLighting {
 public:
  lanes::SpecularAlbedo<double> Dfg(double n_dot_v, double roughness) const {
    return lanes::LookupDfg(SharedDfgTable(), n_dot_v, roughness);
  }
  lanes::SpecularAlbedo<double> SchlickDfg(LectureAlpha alpha, double n_dot_v, double roughness) const {
    return lanes::LookupDfg(SharedSchlickDfgTable(alpha), n_dot_v, roughness);
  }
  lanes::Vec3<double> Prefiltered(const lanes::Vec3<double>&, double) const { return {1.0, 1.0, 1.0}; }
  lanes::Vec3<double> IrradianceOverPi(const lanes::Vec3<double>&) const { return {1.0, 1.0, 1.0}; }
};

inline double LectureImageAlbedo(const LectureParameters& p, double n_dot_v) {
  const WhiteLighting lighting;
  return LectureSeenFrom<double>(p, DirectionOf(n_dot_v), lighting).Environment(lighting).x;
}

}  // namespace facet
HWY_AFTER_NAMESPACE();
