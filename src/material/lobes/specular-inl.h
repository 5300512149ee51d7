// The specular reflection of a metal (GGX, coloured Fresnel) and a dielectric (GGX with F0 = 0.04), mixed by metalness,
// with multiple scattering between microfacets, so that no energy is lost. Multiple scattering adds the lobe Fms (1 -
// E(v)) (1 - E(l)) / (pi (1 - Eavg)), where E is the albedo of single scattering with Fresnel 1 (Kulla and Conty, 2017,
// Revisiting Physically Based Shading at Imageworks).
//
// Under image-based light the directional terms become albedos (Karis, 2013, Real Shading in Unreal Engine 4: split
// sum; Fdez-Aguera, 2019, A Multiple-Scattering Microfacet Model for Real-Time Image-based Lighting):
//    prefiltered(d) (F0 A + B) + Fms (1 - E) irradiance / pi.
// d is the dominant direction of the lobe, which is the mirror direction only for smooth surfaces.

#if defined(FACET_MATERIAL_LOBES_SPECULAR_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_LOBES_SPECULAR_INL_H_
#undef FACET_MATERIAL_LOBES_SPECULAR_INL_H_
#else
#define FACET_MATERIAL_LOBES_SPECULAR_INL_H_
#endif

#include "material/lobes/lobe-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

template <class T>
struct SpecularLobe {
  T alpha{};                        // GGX's width
  T perceptual_roughness{};         // clamped
  Vec3<T> f0;                       // of the mixture: Schlick's Fresnel is linear in it
  Vec3<T> multiple_fresnel;         // Fms of the mixture
  T dielectric_multiple_fresnel{};  // Fms of the dielectric alone
  SpecularAlbedo<T> albedo;         // at n_dot_v
  SpecularAlbedo<T> average_albedo;
  T multiple_scale{};  // 1 / (pi (1 - Eavg))

  // `base_color`, `metallic`: in [0, 1]. `lighting`: see material/closure-inl.h.
  template <class Lighting>
  HWY_INLINE SpecularLobe(const SurfaceView<T>& at, const Vec3<T>& base_color, T metallic, T roughness,
                          const Lighting& lighting) {
    perceptual_roughness = Clamp(roughness, T(kMinPerceptualRoughness), T(1.0f));
    alpha = AlphaFromPerceptualRoughness(perceptual_roughness);
    albedo = lighting.Dfg(at.n_dot_v, perceptual_roughness);
    average_albedo = lighting.DfgAverage(perceptual_roughness);
    const T e_avg = average_albedo.a + average_albedo.b;
    const T f0_dielectric = T(kDielectricF0), dielectric = T(1.0f) - metallic;
    f0 = {f0_dielectric * dielectric + base_color.x * metallic, f0_dielectric * dielectric + base_color.y * metallic,
          f0_dielectric * dielectric + base_color.z * metallic};
    dielectric_multiple_fresnel = MultipleScatteringFresnel(f0_dielectric, e_avg);
    const T fd = dielectric_multiple_fresnel * dielectric;
    multiple_fresnel = {fd + MultipleScatteringFresnel(base_color.x, e_avg) * metallic,
                        fd + MultipleScatteringFresnel(base_color.y, e_avg) * metallic,
                        fd + MultipleScatteringFresnel(base_color.z, e_avg) * metallic};
    // Nearly smooth surfaces lose almost nothing: 1 - E and 1 - Eavg are then both so small that their quotient would
    // be nothing but rounding error.
    multiple_scale = T(kInversePi) / Max(LostEnergy(average_albedo), T(1e-6f));
  }

  // `light_albedo`: at n_dot_l.
  HWY_INLINE Vec3<T> Direct(const SurfaceView<T>& at, const Incidence<T>& from, SpecularAlbedo<T> light_albedo) const {
    const T single = DistributionGgx(at.normal, from.half, alpha) * VisibilitySmith(from.n_dot_l, at.n_dot_v, alpha);
    const Vec3<T> fresnel = FresnelSchlick(f0, from.v_dot_h);
    const T multiple = LostEnergy(albedo) * LostEnergy(light_albedo) * multiple_scale;
    return fresnel * single + multiple_fresnel * multiple;
  }

  // `unclamped_roughness`: the material's, which may be smoother than the lobe for punctual lights.
  template <class Lighting>
  HWY_INLINE EnvironmentTerms<T> Environment(const SurfaceView<T>& at, T unclamped_roughness,
                                             const Lighting& lighting) const {
    const Vec3<T> prefiltered = lighting.Prefiltered(DominantDirection(at), unclamped_roughness);
    const Vec3<T> single = {f0.x * albedo.a + albedo.b, f0.y * albedo.a + albedo.b, f0.z * albedo.a + albedo.b};
    return {prefiltered * single, multiple_fresnel * LostEnergy(albedo)};
  }

  // The dominant direction of a rough lobe. It lies between the mirror direction and the normal, because masking and
  // the cosine remove more of its grazing side (Lagarde and de Rousiers, 2014, Moving Frostbite to Physically Based
  // Rendering, section 4.9.3). The weight of the normal is close to the best under soft lamps
  // (src/light/fit_dominant_direction.py measures it), and a little less on smoother surfaces, which suits the small
  // suns of photographed skies better. Not normalised.
  HWY_INLINE Vec3<T> DominantDirection(const SurfaceView<T>& at) const {
    const Vec3<T> mirror = at.normal * (T(2.0f) * Dot(at.normal, at.view)) - at.view;
    const T to_normal = alpha * alpha * (T(1.5f) + alpha * (T(0.35f) - alpha * T(0.95f)));
    return Mix(mirror, at.normal, to_normal);
  }

  // The share of light that the dielectric's interface does not reflect, so that it reaches the base: 1 - Ed, with Ed =
  // F0 A + B + Fms (1 - E). `of`: the albedo at some angle.
  HWY_INLINE T EnergyLeftByDielectric(SpecularAlbedo<T> of) const {
    const T reflected = T(kDielectricF0) * of.a + of.b + dielectric_multiple_fresnel * LostEnergy(of);
    return Max(T(1.0f) - reflected, T(0.0f));
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
