// The terms of Filament's shading models that other models do not have. Source of all: Guy and Agopian, 2018,
// Physically Based Rendering in Filament (4.4 to 4.12), and the shaders of Filament. Where a term is another author's,
// he is named.

#if defined(FACET_MATERIAL_MODELS_FILAMENT_TERMS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_MODELS_FILAMENT_TERMS_INL_H_
#undef FACET_MATERIAL_MODELS_FILAMENT_TERMS_INL_H_
#else
#define FACET_MATERIAL_MODELS_FILAMENT_TERMS_INL_H_
#endif

#include "material/lobes/sheen-inl.h"
#include "material/lobes/specular-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {
namespace filament {

// F0 of a dielectric, from the parameter that makes 0.5 of an index of 1.5.
template <class T>
FACET_INLINE T F0OfReflectance(T reflectance) {
  return T(0.16f) * reflectance * reflectance;
}

// Between air and a medium, and back. F0 of 1 has no index: it counts as that of 0.999.
template <class T>
FACET_INLINE T F0OfIndex(T ior) {
  const T root = (ior - T(1.0f)) / (ior + T(1.0f));
  return root * root;
}
template <class T>
FACET_INLINE T IndexOfF0(T f0) {
  const T root = Sqrt(Clamp(f0, T(0.0f), T(0.999f)));
  return (T(1.0f) + root) / (T(1.0f) - root);
}

// F0 of a surface that has the index of 1.5 above it instead of air: a cubic fit to the exact change of index. It is
// off by 0.029 at most, at F0 = 0, where it is bounded to 0.
template <class T>
FACET_INLINE Vec3<T> F0UnderCoat(const Vec3<T>& f0) {
  const auto of = [](T f) HWY_ATTR {
    return Clamp(f * (f * (T(0.941892f) - T(0.263008f) * f) + T(0.346479f)) - T(0.0285998f), T(0.0f), T(1.0f));
  };
  return {of(f0.x), of(f0.y), of(f0.z)};
}

// F90: below 1 only where F0 is below 2 %, which no real surface has: that is an occluded one.
template <class T>
FACET_INLINE T GrazingReflectance(const Vec3<T>& f0) {
  return Clamp((f0.x + f0.y + f0.z) * T(50.0f * 0.33f), T(0.0f), T(1.0f));
}

// Kelemen and Szirmay-Kalos, 2001, A Microfacet Based Coupled Specular-Matte BRDF Model with Importance Sampling.
template <class T>
FACET_INLINE T VisibilityKelemen(T l_dot_h) {
  return T(0.25f) / Max(l_dot_h * l_dot_h, T(1e-5f));
}

// Neubelt and Pettineo, 2013, Crafting a Next-gen Material Pipeline for The Order: 1886.
template <class T>
FACET_INLINE T VisibilityNeubelt(T n_dot_l, T n_dot_v) {
  return T(0.25f) / Max(n_dot_l + n_dot_v - n_dot_l * n_dot_v, T(1e-5f));
}

// Diffuse reflection that reaches around the terminator by `w`, without its 1 / pi; it replaces the cosine. Its
// integral over all directions is that of the cosine.
template <class T>
FACET_INLINE T WrappedCosine(T n_dot_l, float w) {
  return Clamp((n_dot_l + T(w)) * T(1.0f / ((1.0f + w) * (1.0f + w))), T(0.0f), T(1.0f));
}

// Fibres of cloth and of sheen, without their colour: the distribution of Charlie (Estevez and Kulla, 2017) and the
// visibility of Neubelt and Pettineo. 1/steradian.
template <class T>
FACET_INLINE T Fibres(const Vec3<T>& normal, const Vec3<T>& half, T n_dot_l, T n_dot_v, T inverse_alpha) {
  const Vec3<T> cross = Cross(normal, half);
  return DistributionCharlie(Dot(cross, cross), inverse_alpha) * VisibilityNeubelt(n_dot_l, n_dot_v);
}

// Microfacets that are rougher along the tangent than across it: alpha (1 + a) and alpha (1 - a).
template <class T>
struct FilamentAnisotropy {
  Vec3<T> tangent{}, bitangent{};  // unit, perpendicular to the normal and to one another
  T strength{};                    // a, in [-1, 1]
  T alpha_t{}, alpha_b{};

  FACET_INLINE FilamentAnisotropy() {}

  FACET_INLINE FilamentAnisotropy(const Vec3<T>& along, const Vec3<T>& across, T a, T alpha)
      : tangent(along), bitangent(across), strength(a) {
    constexpr float kLeast = kMinPerceptualRoughness * kMinPerceptualRoughness;
    alpha_t = Max(alpha * (T(1.0f) + a), T(kLeast));
    alpha_b = Max(alpha * (T(1.0f) - a), T(kLeast));
  }

  // D V. Burley, 2012, and Heitz, 2014, as in lobes/anisotropy-inl.h.
  FACET_INLINE T Single(const SurfaceView<T>& at, const Vec3<T>& light, const Incidence<T>& from) const {
    const T distribution = DistributionGgxAnisotropic(Dot(tangent, from.half), Dot(bitangent, from.half),
                                                      Max(Dot(at.normal, from.half), T(0.0f)), alpha_t, alpha_b);
    const T from_view = from.n_dot_l * Length(at.view, at.n_dot_v),
            from_light = at.n_dot_v * Length(light, from.n_dot_l);
    return distribution * T(0.5f) / (from_view + from_light);
  }

  // The normal that reflects an environment that is blurred alike in all directions: turned away from the direction
  // across which the surface is smoother. (Revie, 2012, as Filament's shaders have it.)
  FACET_INLINE Vec3<T> BentNormal(const SurfaceView<T>& at, T perceptual_roughness) const {
    const Vec3<T> axis = Select<T>(strength >= T(0.0f), bitangent, tangent);
    const Vec3<T> turned = Cross(Cross(axis, at.view), axis);
    const T bend = Abs(strength) * Clamp(T(5.0f) * perceptual_roughness, T(0.0f), T(1.0f));
    return NormalizeOr(Mix(at.normal, turned, bend), at.normal);
  }

 private:
  FACET_INLINE T Length(const Vec3<T>& direction, T n_dot) const {
    const T t = alpha_t * Dot(tangent, direction), b = alpha_b * Dot(bitangent, direction);
    return Sqrt(t * t + b * b + n_dot * n_dot);
  }
};

}  // namespace filament
}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
