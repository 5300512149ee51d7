// A point of a surface of the model "enterprise", in T, without textures.
#pragma once

#include <cmath>
#include <memory>

#include "light/lighting-inl.h"
#include "material/features.h"
#include "material/model_parameters.h"
#include "material/models/enterprise-inl.h"

namespace facet::testing {

namespace lanes = HWY_NAMESPACE;

// The tests' lighting has all tables.
inline LightingData EnterpriseLighting(const EnvironmentMap* environment = nullptr) {
  return MakeLightingData({}, environment, 0.0, 1.0, {.sheen = true, .anisotropic_dfg = true});
}

template <class T>
struct EnterprisePoint {
  EnterpriseParameters p;
  MaterialFeatures features = 0;
  MaterialFactors factors;
  lanes::UvFootprint<T> uv{};

  explicit EnterprisePoint(const EnterpriseParameters& parameters) : p(parameters) {
    Material material;
    material.model = ShadingModel::Enterprise;
    material.alpha_mode = AlphaMode::Blend;
    material.parameters = std::make_shared<const ModelParameters>(p);
    features = FeaturesOf(material);
    factors = FactorsOf(material);
  }

  bool Has(MaterialFeatures bits) const { return (features & bits) != 0; }
  const MaterialFactors& Factors() const { return factors; }
  template <class Block>
  const Block& Parameters() const {
    return p;
  }
  template <int kChannels>
  lanes::Vec4<T> Read(Slot) const {
    return {T(1.0f), T(1.0f), T(1.0f), T(1.0f)};
  }
  lanes::Vec3<T> Normal() const { return {T(0.0f), T(0.0f), T(1.0f)}; }
  lanes::Vec3<T> InterpolatedNormal() const { return Normal(); }
  lanes::Vec4<T> Tangent() const { return {T(1.0f), T(0.0f), T(0.0f), T(1.0f)}; }
  lanes::UvFootprint<T> FirstUv() const { return uv; }
  T MetresPerUnit() const { return T(1.0f); }
  T FootprintAlpha2() const { return T(0.0f); }

  lanes::EnterpriseScattering<T> From(const lanes::Vec3<T>& view, const lanes::LightingView<T>& lighting) const {
    const glm::vec3& a = p.albedo.value;
    const lanes::Vec4<T> base{T(a.x), T(a.y), T(a.z), T(p.cutout_opacity.value)};
    return lanes::Enterprise::Make<T>(*this, base, view, lighting);
  }
};

inline lanes::Vec3<double> ViewAt(double n_dot_v) { return {std::sqrt(1.0 - n_dot_v * n_dot_v), 0.0, n_dot_v}; }

}  // namespace facet::testing
