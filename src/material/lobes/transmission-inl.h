// Light that passes straight through a surface (KHR_materials_transmission) and is refracted by the medium behind it
// (KHR_materials_volume, KHR_materials_dispersion). What is seen through the surface is multiplied by `color`; where it
// is seen, and how far it is blurred, follows from RefractedPath() and Spread().
//
// A thin wall (thickness 0) does not refract. A volume is a flat slab of the given thickness: the view is refracted
// once, by Snell's law at the shading normal, and leaves it after that distance, which its absorption counts, too.
//
// A rough surface scatters what it transmits as it would reflect it, mirrored to its other side, with a Fresnel term of
// 1 and with multiple scattering, so that the lobe's integral is 1. Its width is that of the reflection times
// clamp(2 ior - 2, 0, 1), as in the renderers of the extension's authors: a surface between equal media does not
// scatter, and glass of 1.5 scatters as wide as it reflects.

#if defined(FACET_MATERIAL_LOBES_TRANSMISSION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_LOBES_TRANSMISSION_INL_H_
#undef FACET_MATERIAL_LOBES_TRANSMISSION_INL_H_
#else
#define FACET_MATERIAL_LOBES_TRANSMISSION_INL_H_
#endif

#include "material/lobes/diffuse-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

template <class T>
struct TransmissionInputs {
  T factor{};     // [0, 1]
  Vec3<T> ior{};  // for red, green and blue; 1 or more
};

template <class T>
struct TransmissionLobe {
  Vec3<T> color;               // of the light that passes: without what the interface and layers above it reflect
  Microfacets<T> microfacets;  // of the mirrored reflection
  T unclamped_alpha{};         // GGX's width of the same: 0 for a smooth surface
  // What its single scattering loses, towards the view and on average.
  T lost_for_view{}, lost_average{};

  FACET_INLINE TransmissionLobe() {}  // for a lobe that a material does not have

  // `base`: clamped to 1. `roughness`: of the specular lobe.
  template <class Lighting>
  FACET_INLINE TransmissionLobe(const TransmissionInputs<T>& in, const SurfaceView<T>& at, const Vec3<T>& base,
                                T metallic, T roughness, const Lighting& lighting) {
    const T zero(0.0f), one(1.0f);
    color = base * (Clamp(in.factor, zero, one) * (one - metallic));
    const T bounded = Clamp(roughness, zero, one);
    unclamped_alpha = AlphaFromPerceptualRoughness(bounded) * Clamp(T(2.0f) * in.ior.y - T(2.0f), zero, one);
    microfacets = Microfacets<T>(Sqrt(unclamped_alpha));
    lost_average = Max(LostEnergy(lighting.DfgAverage(microfacets.perceptual_roughness)), T(1e-6f));
    lost_for_view = LostEnergy(lighting.Dfg(at.n_dot_v, microfacets.perceptual_roughness));
  }

  // The BTDF times the cosine, for light from behind, before `color`.
  template <class Lighting>
  FACET_INLINE T Direct(const SurfaceView<T>& at, const Vec3<T>& light, const Lighting& lighting) const {
    const T behind = -Dot(at.normal, light);
    const Vec3<T> mirrored = light + at.normal * (T(2.0f) * behind);
    const Incidence<T> from = IncidenceFrom(at, mirrored);
    const T lost_for_light = LostEnergy(lighting.Dfg(from.n_dot_l, microfacets.perceptual_roughness));
    const T multiple = lost_for_view * lost_for_light * T(kInversePi) / lost_average;
    return Select(behind > T(0.0f), (microfacets.Single(at, from) + multiple) * from.n_dot_l, T(0.0f));
  }

  // The standard deviation of the tangent of the angle by which the lobe spreads light. GGX has none, because of its
  // tails, so it is that of the Gauss lobe with the same median: half of the facets are tilted by less than
  // atan(alpha), and deviate light by twice that. Where they are very rough, half of the light deviates by less than 45
  // degrees.
  //
  // That is the mirrored reflection of a thin wall. The facets of a volume refract: they deviate light by ior - 1 times
  // their tilt instead of twice.
  FACET_INLINE T Spread(T thickness, T ior) const {
    const T mirrored = unclamped_alpha * T(1.7f) / (T(1.0f) + unclamped_alpha);
    const T refracted = mirrored * Min(T(0.25f) * Max(T(2.0f) * ior - T(2.0f), T(1.0f)), T(1.0f));
    return Select(thickness > T(0.0f), refracted, mirrored);
  }
};

// The vector from where the view enters a medium to where it leaves it. `ior`: 1 or more.
template <class T>
FACET_INLINE Vec3<T> RefractedPath(const SurfaceView<T>& at, T ior, T thickness) {
  const T eta = T(1.0f) / Max(ior, T(1.0f));
  const T cosine = Sqrt(Max(T(1.0f) - eta * eta * (T(1.0f) - at.n_dot_v * at.n_dot_v), T(0.0f)));
  const Vec3<T> inward = at.normal * (eta * at.n_dot_v - cosine) - at.view * eta;
  return NormalizeOr(inward, -at.view) * thickness;
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
