// The specular reflection of a metal (GGX, coloured Fresnel) and a dielectric (GGX; F0 is 0.04 unless the material
// states an index of refraction or specular factors), mixed by metalness, with multiple scattering between microfacets,
// so that no energy is lost. Multiple scattering adds the lobe Fms (1 - E(v)) (1 - E(l)) / (pi (1 - Eavg)), where E is
// the albedo of single scattering with Fresnel 1 (Kulla and Conty, 2017, Revisiting Physically Based Shading at
// Imageworks).
//
// Under image-based light the directional terms become albedos (Karis, 2013, Real Shading in Unreal Engine 4: split
// sum; Fdez-Aguera, 2019, A Multiple-Scattering Microfacet Model for Real-Time Image-based Lighting):
//    prefiltered (F0 A + F90 B) + Fms (1 - E) irradiance / pi.

#if defined(FACET_MATERIAL_LOBES_SPECULAR_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_LOBES_SPECULAR_INL_H_
#undef FACET_MATERIAL_LOBES_SPECULAR_INL_H_
#else
#define FACET_MATERIAL_LOBES_SPECULAR_INL_H_
#endif

#include "material/lobes/microfacets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// The reflectance of an interface: Schlick's Fresnel from F0 at normal incidence to F90 at grazing angles.
template <class T>
struct Interface {
  Vec3<T> f0{};
  T f90{};
};

template <class T>
struct SpecularLobe {
  Vec3<T> f0;                       // of the mixture: Schlick's Fresnel is linear in it
  T f90{};                          // likewise
  Vec3<T> multiple_fresnel;         // Fms of the mixture
  T dielectric_f0{}, dielectric_f90{};  // of the dielectric alone, in its brightest channel
  T dielectric_multiple_fresnel{};      // likewise: its Fms
  SpecularAlbedo<T> albedo;         // at n_dot_v
  SpecularAlbedo<T> average_albedo;
  T multiple_scale{};  // 1 / (pi (1 - Eavg))

  FACET_INLINE SpecularLobe() {}  // for a lobe that a material does not have

  // `metal`: its F0. `metallic`: in [0, 1]. `is_default`: the base is the dielectric of core glTF, whose F0 is grey and
  // whose F90 is 1.
  FACET_INLINE SpecularLobe(const Interface<T>& base, const Vec3<T>& metal, T metallic, bool is_default,
                            SpecularAlbedo<T> view_albedo, SpecularAlbedo<T> average) {
    albedo = view_albedo;
    average_albedo = average;
    const T e_avg = average.a + average.b;
    const T dielectric = T(1.0f) - metallic;
    f0 = {base.f0.x * dielectric + metal.x * metallic, base.f0.y * dielectric + metal.y * metallic,
          base.f0.z * dielectric + metal.z * metallic};
    f90 = is_default ? T(1.0f) : base.f90 * dielectric + metallic;
    dielectric_f0 = is_default ? base.f0.x : MaxComponent(base.f0);
    dielectric_f90 = base.f90;
    dielectric_multiple_fresnel = MultipleScatteringFresnel(dielectric_f0, e_avg, base.f90);
    const auto of_mixture = [&](T of_dielectric, T of_metal) HWY_ATTR {
      return MultipleScatteringFresnel(of_dielectric, e_avg, base.f90) * dielectric +
             MultipleScatteringFresnel(of_metal, e_avg) * metallic;
    };
    multiple_fresnel = {of_mixture(base.f0.x, metal.x), of_mixture(base.f0.y, metal.y), of_mixture(base.f0.z, metal.z)};
    // Nearly smooth surfaces lose almost nothing: 1 - E and 1 - Eavg are then both so small that their quotient would
    // be nothing but rounding error.
    multiple_scale = T(kInversePi) / Max(LostEnergy(average), T(1e-6f));
  }

  // `single`: D V of the microfacets. `light_albedo`: at n_dot_l.
  FACET_INLINE Vec3<T> Direct(T single, T v_dot_h, SpecularAlbedo<T> light_albedo) const {
    const T w = SchlickWeight(v_dot_h);
    const T rest = T(1.0f) - w, grazing = f90 * w;
    const Vec3<T> fresnel{f0.x * rest + grazing, f0.y * rest + grazing, f0.z * rest + grazing};
    const T multiple = LostEnergy(albedo) * LostEnergy(light_albedo) * multiple_scale;
    return fresnel * single + multiple_fresnel * multiple;
  }

  // `prefiltered`: the environment, as the microfacets blur it.
  FACET_INLINE EnvironmentTerms<T> Environment(const Vec3<T>& prefiltered) const {
    const T grazing = f90 * albedo.b;
    const Vec3<T> single = {f0.x * albedo.a + grazing, f0.y * albedo.a + grazing, f0.z * albedo.a + grazing};
    return {prefiltered * single, multiple_fresnel * LostEnergy(albedo)};
  }

  // The share of light that the dielectric's interface does not reflect, so that it reaches the base: 1 - Ed, with Ed =
  // F0 A + F90 B + Fms (1 - E). `of`: the albedo at some angle.
  FACET_INLINE T EnergyLeftByDielectric(SpecularAlbedo<T> of) const {
    const T reflected = dielectric_f0 * of.a + dielectric_f90 * of.b + dielectric_multiple_fresnel * LostEnergy(of);
    return Max(T(1.0f) - reflected, T(0.0f));
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
