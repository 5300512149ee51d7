// How ambient occlusion dims the light of the environment in Filament's models. (Guy and Agopian, 2018, 5.6, and the
// shaders of Filament.)

#if defined(FACET_MATERIAL_MODELS_FILAMENT_OCCLUSION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_MODELS_FILAMENT_OCCLUSION_INL_H_
#undef FACET_MATERIAL_MODELS_FILAMENT_OCCLUSION_INL_H_
#else
#define FACET_MATERIAL_MODELS_FILAMENT_OCCLUSION_INL_H_
#endif

#include "facet/shader/elementary-inl.h"
#include "facet/shader/vec-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {
namespace filament {

// The share of a reflection that is not occluded, for microfacets that see the share `visibility` of their
// surroundings. Lagarde and de Rousiers, 2014, Moving Frostbite to Physically Based Rendering, section 4.10.2.
template <class T>
FACET_INLINE T SpecularOcclusion(T n_dot_v, T visibility, T alpha) {
  const T power = Pow(Max(n_dot_v + visibility, T(0.0f)), Exp2(T(-16.0f) * alpha - T(1.0f)));
  return Clamp(power - T(1.0f) + visibility, T(0.0f), T(1.0f));
}

// The solid angle that two spherical caps share, divided by 2 pi. Oat and Sander, 2007, Ambient Aperture Lighting:
// exact where one lies within the other or outside of it, and a smooth step between.
template <class T>
FACET_INLINE T SharedByCaps(T cosine_a, T cosine_b, T cosine_between) {
  const T zero(0.0f), one(1.0f);
  const T a = Acos(Clamp(cosine_a, zero, one)), b = Acos(Clamp(cosine_b, zero, one));
  const T between = Acos(Clamp(cosine_between, T(-1.0f), one));
  const T smaller = one - Max(cosine_a, cosine_b), difference = Abs(a - b);
  const T outside = Clamp((between - difference) / Max(a + b - difference, T(1e-4f)), zero, one);
  const T inside = one - outside;
  const T share = inside * inside * (T(3.0f) - T(2.0f) * inside);
  const T partial = Select(a + b <= between, zero, share * smaller);
  return Select(between <= difference, smaller, partial);
}

// The same from the cone about the bent normal that is not occluded and the cone of the reflection (Jimenez et al.,
// 2016, Practical Realtime Strategies for Accurate Indirect Occlusion, section 5.2). It fades out on smooth surfaces,
// whose cone is so narrow that it would remove whole reflections.
template <class T>
FACET_INLINE T SpecularOcclusionOfCones(const Vec3<T>& bent_normal, const Vec3<T>& reflected, T visibility, T alpha) {
  const T visible = Sqrt(Clamp(T(1.0f) - visibility, T(0.0f), T(1.0f)));
  const T lobe = Exp2(T(-3.321928f) * alpha * alpha);
  const T share = SharedByCaps(visible, lobe, Dot(bent_normal, reflected)) / Max(T(1.0f) - lobe, T(1e-6f));
  const T x = Clamp((alpha - T(0.01f)) * T(1.0f / 0.08f), T(0.0f), T(1.0f));
  return Mix(T(1.0f), share, x * x * (T(3.0f) - T(2.0f) * x));
}

// Occlusion with the light that occluded surfaces of this colour reflect to one another (the same, section 4). The fit
// is 1.0001 where nothing is occluded, and is bounded to 1.
template <class T>
FACET_INLINE T MultiBounceOcclusion(T visibility, T albedo) {
  const T a = T(2.0404f) * albedo - T(0.3324f), b = T(-4.7951f) * albedo + T(0.6417f),
          c = T(2.7552f) * albedo + T(0.6903f);
  return Min(Max(visibility, ((visibility * a + b) * visibility + c) * visibility), T(1.0f));
}
template <class T>
FACET_INLINE Vec3<T> MultiBounceOcclusion(T visibility, const Vec3<T>& albedo) {
  return {MultiBounceOcclusion(visibility, albedo.x), MultiBounceOcclusion(visibility, albedo.y),
          MultiBounceOcclusion(visibility, albedo.z)};
}

}  // namespace filament
}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
