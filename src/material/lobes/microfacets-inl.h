// The microfacets of a surface: how rough it is, apart from what it is made of. Two kinds have the same members:
// Microfacets (equally rough in all directions) and AnisotropicMicrofacets (lobes/anisotropy-inl.h).

#if defined(FACET_MATERIAL_LOBES_MICROFACETS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_LOBES_MICROFACETS_INL_H_
#undef FACET_MATERIAL_LOBES_MICROFACETS_INL_H_
#else
#define FACET_MATERIAL_LOBES_MICROFACETS_INL_H_
#endif

#include "material/lobes/lobe-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// The weight of the normal in the dominant direction of a reflection, because masking and the cosine remove more of a
// rough lobe's grazing side (Lagarde and de Rousiers, 2014, Moving Frostbite to Physically Based Rendering, section
// 4.9.3). It is close to the best under soft lamps (src/light/fit_dominant_direction.py measures it), and a little less
// on smoother surfaces, which suits the small suns of photographed skies better.
template <class T>
FACET_INLINE T ToNormal(T alpha) {
  return alpha * alpha * (T(1.5f) + alpha * (T(0.35f) - alpha * T(0.95f)));
}

// Where widening a lobe shows: not where the footprint is 0, nor where the lobe's own square of alpha is 64 times that,
// so that the roughness would grow by less than 0.4 %. Most packets of rough surfaces are spared the arithmetic.
template <class T>
FACET_INLINE MaskOf<T> IsWidened(T perceptual_roughness, T footprint_alpha2) {
  const T alpha = AlphaFromPerceptualRoughness(perceptual_roughness);
  return footprint_alpha2 > alpha * alpha * T(1.0f / 64.0f);
}

// The perceptual roughness of a lobe whose square of alpha grows by `footprint_alpha2`.
template <class T>
FACET_INLINE T WidenedRoughness(T perceptual_roughness, T footprint_alpha2) {
  const MaskOf<T> wider = IsWidened(perceptual_roughness, footprint_alpha2);
  if (!Any(wider)) return perceptual_roughness;
  const T alpha = AlphaFromPerceptualRoughness(perceptual_roughness);
  return Select(wider, Sqrt(Sqrt(alpha * alpha + footprint_alpha2)), perceptual_roughness);
}

// The same of a lobe that is at least as wide as those that are drawn (kMinPerceptualRoughness).
template <class T>
FACET_INLINE T DrawnRoughness(T perceptual_roughness, T footprint_alpha2) {
  return WidenedRoughness(Max(perceptual_roughness, T(kMinPerceptualRoughness)), footprint_alpha2);
}

template <class T>
struct Microfacets {
  T alpha{};                 // GGX's width
  T perceptual_roughness{};  // clamped

  FACET_INLINE Microfacets() {}  // for a lobe that a material does not have

  FACET_INLINE explicit Microfacets(T roughness) {
    perceptual_roughness = Clamp(roughness, T(kMinPerceptualRoughness), T(1.0f));
    alpha = AlphaFromPerceptualRoughness(perceptual_roughness);
  }

  // The single scattering without its Fresnel term: D V, in 1/steradian.
  FACET_INLINE T Single(const SurfaceView<T>& at, const Incidence<T>& from) const {
    return DistributionGgx(at.normal, from.half, alpha) * VisibilitySmith(from.n_dot_l, at.n_dot_v, alpha);
  }

  // The albedo for light from, or to, a direction. `cosine`: its cosine with the normal.
  template <class Lighting>
  FACET_INLINE SpecularAlbedo<T> Albedo(const Vec3<T>& /*direction*/, T cosine, const Lighting& lighting) const {
    return lighting.Dfg(cosine, perceptual_roughness);
  }
  template <class Lighting>
  FACET_INLINE SpecularAlbedo<T> AverageAlbedo(const Lighting& lighting) const {
    return lighting.DfgAverage(perceptual_roughness);
  }

  // The dominant direction of the reflection. It lies between the mirror direction and the normal. Not normalised.
  FACET_INLINE Vec3<T> DominantDirection(const SurfaceView<T>& at) const {
    const Vec3<T> mirror = at.normal * (T(2.0f) * Dot(at.normal, at.view)) - at.view;
    return Mix(mirror, at.normal, ToNormal(alpha));
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
