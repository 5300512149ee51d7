// The diffuse base of a dielectric. Light enters and leaves it through the interface, reduced by specular reflection:
//    base / pi (1 - Ed(v)) (1 - Ed(l)) / (1 - Ed_avg), with Ed the albedo of that reflection,
// which is reciprocal and conserves energy. (glTF's appendix B couples diffuse by 1 - F(v.h) instead, which
// gains and loses at grazing angles.) Under image-based light: base (1 - Ed(v)) irradiance / pi.

#if defined(FACET_MATERIAL_LOBES_DIFFUSE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_LOBES_DIFFUSE_INL_H_
#undef FACET_MATERIAL_LOBES_DIFFUSE_INL_H_
#else
#define FACET_MATERIAL_LOBES_DIFFUSE_INL_H_
#endif

#include "material/lobes/specular-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

template <class T>
struct DiffuseLobe {
  Vec3<T> color;      // (1 - metallic) * base colour
  T left_for_view{};  // 1 - Ed(v)
  T scale{};          // 1 / (pi (1 - Ed_avg))

  FACET_INLINE DiffuseLobe() {}  // for a lobe that a material does not have

  FACET_INLINE DiffuseLobe(const Vec3<T>& base_color, T metallic, const SpecularLobe<T>& above) {
    color = base_color * (T(1.0f) - metallic);
    left_for_view = above.EnergyLeftByDielectric(above.albedo);
    scale = T(kInversePi) / Max(above.EnergyLeftByDielectric(above.average_albedo), T(1e-6f));
  }

  // `light_albedo`: of the specular lobe, at n_dot_l.
  FACET_INLINE Vec3<T> Direct(const SpecularLobe<T>& above, SpecularAlbedo<T> light_albedo) const {
    return color * (left_for_view * above.EnergyLeftByDielectric(light_albedo) * scale);
  }

  FACET_INLINE EnvironmentTerms<T> Environment() const { return {{}, color * left_for_view}; }
};

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
