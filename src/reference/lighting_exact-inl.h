// What a closure asks of its lighting, in the reference.
#pragma once

#include <vector>

#include "light/lighting-inl.h"
#include "reference/albedo_exact.h"
#include "reference/exact_source-inl.h"

// Compiled for the baseline instruction set, as exact_source-inl.h.
HWY_BEFORE_NAMESPACE();
namespace facet {

// The Lighting for the closure, with exact albedos. Rows of the roughnesses that are asked for most are kept.
class ExactLighting {
 public:
  explicit ExactLighting(const AlbedoSurface& albedos) : albedos_(albedos) {}

  lanes::SpecularAlbedo<double> Dfg(double n_dot_v, double roughness) const {
    for (const Known& known : known_) {
      if (known.roughness == roughness) return Convert(known.row.At(n_dot_v));
    }
    return Convert(albedos_.At(n_dot_v, roughness));
  }
  // A closure asks once for each of its lobes, before it is evaluated under light.
  lanes::SpecularAlbedo<double> DfgAverage(double roughness) const {
    for (const Known& known : known_) {
      if (known.roughness == roughness) return Convert(known.row.Average());
    }
    known_.push_back({roughness, albedos_.Row(roughness)});
    return Convert(known_.back().row.Average());
  }

  // Of the rasterizer's table, read in double: a quadrature for each light would take longer than all else.
  lanes::SpecularAlbedo<double> AnisotropicDfg(double n_dot_v, double t_dot_v, double roughness,
                                               double strength) const {
    return lanes::LookupAnisotropicDfg(SharedAnisotropicDfgTable(), n_dot_v, t_dot_v, roughness, strength);
  }
  lanes::SpecularAlbedo<double> AnisotropicDfgAverage(double roughness, double strength) const {
    return lanes::LookupAnisotropicDfgAverage(SharedAnisotropicDfgTable(), roughness, strength);
  }

  // Of the rasterizer's table, whose error is below 0.0021: the quadrature would take longer than all else.
  double SheenAlbedo(double n_dot_v, double roughness) const {
    return lanes::LookupSheen(SharedSheenTable(), n_dot_v, roughness);
  }
  double ClothAlbedo(double n_dot_v, double roughness) const {
    return lanes::LookupSheen(SharedClothTable(), n_dot_v, roughness);
  }

 private:
  struct Known {
    double roughness;
    AlbedoRow row;
  };
  static lanes::SpecularAlbedo<double> Convert(const ExactAlbedo& albedo) { return {albedo.a, albedo.b}; }
  const AlbedoSurface& albedos_;
  mutable std::vector<Known> known_;
};

}  // namespace facet
HWY_AFTER_NAMESPACE();
