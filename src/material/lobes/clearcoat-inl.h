// A clear coat (KHR_materials_clearcoat): GGX with F0 = 0.04 over everything else, with its own roughness and normal,
// and with multiple scattering, so that a coat over a mirror loses nothing. What it does not reflect reaches what lies
// below, the emission included.

#if defined(FACET_MATERIAL_LOBES_CLEARCOAT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_LOBES_CLEARCOAT_INL_H_
#undef FACET_MATERIAL_LOBES_CLEARCOAT_INL_H_
#else
#define FACET_MATERIAL_LOBES_CLEARCOAT_INL_H_
#endif

#include "material/lobes/microfacets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

template <class T>
struct ClearcoatInputs {
  T factor{};                // [0, 1]
  T perceptual_roughness{};  // [0, 1]
  Vec3<T> normal{};          // unit, shading
};

template <class T>
struct ClearcoatLobe {
  SurfaceView<T> at;  // with the coat's normal
  Microfacets<T> microfacets;
  T factor{};
  T multiple_fresnel{}, multiple_scale{};  // as in SpecularLobe
  SpecularAlbedo<T> albedo;

  FACET_INLINE ClearcoatLobe() {}  // for a lobe that a material does not have

  template <class Lighting>
  FACET_INLINE ClearcoatLobe(const ClearcoatInputs<T>& in, T footprint_alpha2, const Vec3<T>& view,
                             const Lighting& lighting)
      : at{in.normal, view, Clamp(Dot(in.normal, view), T(kMinNDotV), T(1.0f))},
        microfacets(DrawnRoughness(in.perceptual_roughness, footprint_alpha2)),
        factor(Clamp(in.factor, T(0.0f), T(1.0f))) {
    albedo = lighting.Dfg(at.n_dot_v, microfacets.perceptual_roughness);
    const SpecularAlbedo<T> average = lighting.DfgAverage(microfacets.perceptual_roughness);
    multiple_fresnel = MultipleScatteringFresnel(T(kDielectricF0), average.a + average.b);
    multiple_scale = T(kInversePi) / Max(LostEnergy(average), T(1e-6f));
  }

  // The BRDF times the cosine with the coat's normal; zero below its horizon.
  template <class Lighting>
  FACET_INLINE T Direct(const Vec3<T>& light, const Lighting& lighting) const {
    const Incidence<T> from = IncidenceFrom(at, light);
    const SpecularAlbedo<T> light_albedo = lighting.Dfg(from.n_dot_l, microfacets.perceptual_roughness);
    const T single = FresnelSchlick(T(kDielectricF0), from.v_dot_h) * microfacets.Single(at, from);
    const T multiple = LostEnergy(albedo) * LostEnergy(light_albedo) * multiple_scale * multiple_fresnel;
    return Select(Dot(at.normal, light) > T(0.0f), factor * (single + multiple) * from.n_dot_l, T(0.0f));
  }

  // `unclamped_roughness`: the material's.
  template <class Lighting>
  FACET_INLINE Vec3<T> Environment(T unclamped_roughness, T footprint_alpha2, const Lighting& lighting) const {
    const Vec3<T> prefiltered =
        lighting.Prefiltered(microfacets.DominantDirection(at), unclamped_roughness, footprint_alpha2);
    const T single = factor * (T(kDielectricF0) * albedo.a + albedo.b);
    const T multiple = factor * multiple_fresnel * LostEnergy(albedo);
    return prefiltered * single + lighting.IrradianceOverPi(at.normal) * multiple;
  }

  // The share of light that it lets pass towards the view.
  FACET_INLINE T EnergyLeft() const {
    const T reflected = T(kDielectricF0) * albedo.a + albedo.b + multiple_fresnel * LostEnergy(albedo);
    return Max(T(1.0f) - factor * reflected, T(0.0f));
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
