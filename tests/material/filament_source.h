// A material of the model "filament" without textures, for tests: its source, and lights.
#pragma once

#include <deque>

#include "light/lighting-inl.h"
#include "material/models/filament-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet::filament_test {

namespace lanes = HWY_NAMESPACE;
using lanes::Vec3;
using lanes::Vec4;

// See material/read-inl.h. The normal is +Z, the tangent +X.
template <class T>
struct Source {
  FilamentParameters parameters;
  MaterialFeatures features = 0;

  explicit Source(const FilamentParameters& p, MaterialFeatures more = 0)
      : parameters(p), features(FeaturesOf(p) | kLit | kTangents | more) {}

  bool Has(MaterialFeatures feature) const { return (features & feature) != 0; }
  template <class Block>
  const Block& Parameters() const {
    return parameters;
  }
  template <int kChannels>
  Vec4<T> Read(Slot) const {
    return {T(1), T(1), T(1), T(1)};
  }
  Vec3<T> Normal() const { return {T(0), T(0), T(1)}; }
  Vec3<T> InterpolatedNormal() const { return Normal(); }
  Vec4<T> Tangent() const { return {T(1), T(0), T(0), T(1)}; }
};

inline LightingData Tables() { return MakeLightingData({}, nullptr, 0.0, 1.0, {.cloth = true}); }

// The tables of albedos, and radiance 1 from everywhere.
template <class T>
struct Uniform : lanes::LightingView<T> {
  using lanes::LightingView<T>::LightingView;
  Vec3<T> IrradianceOverPi(Vec3<T>) const { return {T(1), T(1), T(1)}; }
  Vec3<T> Prefiltered(Vec3<T>, T) const { return {T(1), T(1), T(1)}; }
};

template <class T>
lanes::FilamentScattering<T> Scattering(const FilamentParameters& p, const Vec3<T>& view, const LightingData& tables,
                                        MaterialFeatures more = 0) {
  static std::deque<Source<T>> kept;  // what is returned points to its parameters
  const glm::vec4& c = p.base_color.value;
  const Vec4<T> base{T(c.x), T(c.y), T(c.z), T(c.w)};
  return lanes::Filament::Make<T>(kept.emplace_back(p, more), base, view, Uniform<T>(tables));
}

}  // namespace facet::filament_test
HWY_AFTER_NAMESPACE();
