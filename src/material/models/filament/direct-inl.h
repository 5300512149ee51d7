// What Filament's shading models reflect of the light from one direction: the BSDF times the cosine. (Guy and Agopian,
// 2018, 4.6 to 4.12, and the shaders of Filament.)

#if defined(FACET_MATERIAL_MODELS_FILAMENT_DIRECT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_MODELS_FILAMENT_DIRECT_INL_H_
#undef FACET_MATERIAL_MODELS_FILAMENT_DIRECT_INL_H_
#else
#define FACET_MATERIAL_MODELS_FILAMENT_DIRECT_INL_H_
#endif

#include "material/models/filament/surface-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {
namespace filament {

// Single scattering of the microfacets with their Fresnel term.
template <class T>
FACET_INLINE Vec3<T> DirectSpecular(const FilamentSurface<T>& s, const Vec3<T>& light, const Incidence<T>& from) {
  const T single = s.is_anisotropic ? s.anisotropy.Single(s.at, light, from)
                                    : DistributionGgx(s.at.normal, from.half, s.alpha) *
                                          VisibilitySmith(from.n_dot_l, s.at.n_dot_v, s.alpha);
  const T w = SchlickWeight(from.v_dot_h);
  const T rest = T(1.0f) - w, grazing = s.f90 * w;
  return (s.f0 * rest + Grey(grazing)) * single;
}

// Of sheen or cloth, of colour 1.
template <class T>
FACET_INLINE T DirectFibres(const FilamentSurface<T>& s, const Incidence<T>& from) {
  return Fibres(s.at.normal, from.half, from.n_dot_l, s.at.n_dot_v, s.sheen.inverse_alpha) * s.fibre_scale;
}

// The clear coat times its cosine, and Fc: the share of light that it keeps from what is under it.
template <class T>
struct CoatReflection {
  T reflected{}, fresnel{};
};
template <class T>
FACET_INLINE CoatReflection<T> DirectCoat(const FilamentSurface<T>& s, const Vec3<T>& light, const Incidence<T>& from) {
  const T fresnel = FresnelSchlick(T(kDielectricF0), from.v_dot_h) * s.coat;
  const T n_dot_l = Clamp(Dot(s.coat_at.normal, light), T(0.0f), T(1.0f));
  const T single = DistributionGgx(s.coat_at.normal, from.half, s.coat_alpha) * VisibilityKelemen(from.v_dot_h);
  return {single * fresnel * n_dot_l, fresnel};
}

// Lit and specularGlossiness. Light passes down from the coat, through the sheen, to the base.
template <class T>
HWY_NOINLINE Vec3<T> DirectLit(const FilamentSurface<T>& s, const Vec3<T>& light) {
  const T n_dot_l = Dot(s.at.normal, light);
  const Incidence<T> from = IncidenceFrom(s.at, light);
  Vec3<T> brdf =
      s.diffuse_color * (T(kInversePi) * (T(1.0f) - s.transmission)) + DirectSpecular(s, light, from) * s.compensation;
  if (s.has_sheen) {
    brdf = brdf * s.SheenLeft() + s.sheen_color * DirectFibres(s, from);
  }
  Vec3<T> sum = brdf * from.n_dot_l;
  if (s.has_coat) {
    const CoatReflection<T> coat = DirectCoat(s, light, from);
    sum = sum * (T(1.0f) - coat.fresnel) + Grey(coat.reflected);
  }
  return Select<T>(n_dot_l > T(0.0f), sum, Vec3<T>{});
}

template <class T>
HWY_NOINLINE Vec3<T> DirectCloth(const FilamentSurface<T>& s, const Vec3<T>& light) {
  const Incidence<T> from = IncidenceFrom(s.at, light);
  const T fibres = DirectFibres(s, from);
  Vec3<T> diffuse = s.diffuse_color * T(kInversePi);
  if (s.has_subsurface) {
    diffuse = diffuse * WrappedCosine(Dot(s.at.normal, light), 0.5f) * Bounded(s.subsurface_color + Grey(from.n_dot_l));
  } else {
    diffuse = diffuse * from.n_dot_l;
  }
  return diffuse + s.sheen_color * (fibres * from.n_dot_l);
}

template <class T>
HWY_NOINLINE Vec3<T> DirectSubsurface(const FilamentSurface<T>& s, const Vec3<T>& light) {
  const T one(1.0f);
  const Incidence<T> from = IncidenceFrom(s.at, light);
  const Vec3<T> specular =
      Select<T>(from.n_dot_l > T(0.0f), DirectSpecular(s, light, from) * s.compensation, Vec3<T>{});
  const Vec3<T> reflected = (s.diffuse_color * T(kInversePi) + specular) * from.n_dot_l;
  const T ahead = Clamp(-Dot(s.at.view, light), T(0.0f), one);
  const T forward = Exp2(ahead * s.subsurface_power - s.subsurface_power);
  const T back = Bounded(from.n_dot_l * s.thickness + (one - s.thickness)) * T(0.5f);
  const T passed = Mix(back, one, forward) * (one - s.thickness);
  return reflected + s.subsurface_color * (passed * T(kInversePi));
}

}  // namespace filament
}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
