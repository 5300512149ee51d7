// A material at a point of the reference, as material/read-inl.h reads it, in double.
#pragma once

#include <glm/glm.hpp>

#include "material/read-inl.h"
#include "reference/material_exact.h"
#include "reference/surface_exact.h"

// Compiled for the baseline instruction set, like the functions that it calls: on Arm their target attributes must
// agree.
HWY_BEFORE_NAMESPACE();
namespace facet {

namespace lanes = HWY_NAMESPACE;

inline lanes::Vec3<double> ToLanes(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
inline lanes::Vec4<double> ToLanes(const glm::dvec4& v) { return {v.x, v.y, v.z, v.w}; }
inline glm::dvec3 FromLanes(const lanes::Vec3<double>& v) { return {v.x, v.y, v.z}; }

struct ExactSource {
  const ExactMaterial& material;
  const SurfacePoint& point;

  bool Has(MaterialFeatures feature) const { return material.Frame().Has(feature); }
  const MaterialFactors& Factors() const { return material.Frame().factors; }
  template <class Block>
  const Block& Parameters() const {
    return material.Frame().Parameters<Block>();
  }
  template <int kChannels>
  lanes::Vec4<double> Read(Slot slot) const {
    return ToLanes(material.Read(slot, point));
  }
  lanes::Vec3<double> Normal() const { return ToLanes(point.normal); }
  lanes::Vec3<double> InterpolatedNormal() const { return ToLanes(point.interpolated_normal); }
  lanes::Vec4<double> Tangent() const { return ToLanes(point.tangent); }
  lanes::UvFootprint<double> FirstUv() const {
    const glm::dvec2 uv = point.Uv(0);
    return {{uv.x, uv.y}, {}, {}};
  }
  double MetresPerUnit() const { return point.metres_per_unit; }
  double FootprintAlpha2() const { return 0.0; }
};

}  // namespace facet
HWY_AFTER_NAMESPACE();
