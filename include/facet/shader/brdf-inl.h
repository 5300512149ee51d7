// The terms of reflection models: microfacet distribution, masking and shadowing, Fresnel, diffuse. Directions are unit
// vectors pointing away from the surface; n_dot_v and the like are their cosines with the normal. `alpha` is GGX's
// width, the square of glTF's perceptual roughness. T is Float (lanes), float or double.

#if defined(FACET_SHADER_BRDF_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_SHADER_BRDF_INL_H_
#undef FACET_SHADER_BRDF_INL_H_
#else
#define FACET_SHADER_BRDF_INL_H_
#endif

#include "facet/shader/lane-inl.h"
#include "facet/shader/vec-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

inline constexpr float kPi = 3.14159265358979324f;
inline constexpr float kInversePi = 0.318309886183790672f;

// The least roughness for punctual lights, which a perfect mirror would never reflect (glTF leaves alpha = 0 to the
// renderer). At 0.045 (Filament's bound for 32-bit floats; Guy and Agopian, 2018, Physically Based Rendering in
// Filament, section 4.8.3.3) alpha is 0.002 and a highlight is 0.2 degrees wide.
inline constexpr float kMinPerceptualRoughness = 0.045f;
// The least cosine with the view. Interpolated and mapped normals may face away from the eye.
inline constexpr float kMinNDotV = 1e-4f;
// Reflectance at normal incidence of glTF's dielectric, of index of refraction 1.5.
inline constexpr float kDielectricF0 = 0.04f;

template <class T>
FACET_INLINE T AlphaFromPerceptualRoughness(T perceptual_roughness) {
  return perceptual_roughness * perceptual_roughness;
}

// Microfacet distribution, in 1/steradian; the integral of D(h) n_dot_h over the hemisphere is 1. Walter et al., 2007,
// Microfacet Models for Refraction through Rough Surfaces, equation 33. `sin2_n_h` is 1 - n_dot_h^2. It is a parameter
// because computing it from n_dot_h in float loses all digits within the highlight.
template <class T>
FACET_INLINE T DistributionGgx(T n_dot_h, T sin2_n_h, T alpha) {
  const T a = n_dot_h * alpha;
  const T k = alpha / (sin2_n_h + a * a);
  return k * k * T(kInversePi);
}

// The same from the vectors. sin^2 = |n x h|^2 by Lagrange's identity, exact where n and h nearly coincide
// (Guy and Agopian, 2018, Physically Based Rendering in Filament, section 4.4.1).
template <class T>
FACET_INLINE T DistributionGgx(Vec3<T> normal, Vec3<T> half, T alpha) {
  const Vec3<T> c = Cross(normal, half);
  return DistributionGgx(Max(Dot(normal, half), T(0.0f)), Dot(c, c), alpha);
}

// The same where the surface is rougher along the tangent than across it. The arguments are the components of the half
// vector. Burley, 2012, Physically Based Shading at Disney, appendix B.2.
template <class T>
FACET_INLINE T DistributionGgxAnisotropic(T t_dot_h, T b_dot_h, T n_dot_h, T alpha_t, T alpha_b) {
  const T t = t_dot_h / alpha_t, b = b_dot_h / alpha_b;
  const T k = t * t + b * b + n_dot_h * n_dot_h;
  return T(kInversePi) / (alpha_t * alpha_b * k * k);
}

// Visibility: masking and shadowing divided by 4 n_dot_l n_dot_v; height-correlated Smith.
// Heitz, 2014, Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs, equation 99; in the form of
// glTF 2.0's specification, appendix B.3. Finite while n_dot_v > 0 and n_dot_l >= 0 and alpha > 0.
template <class T>
FACET_INLINE T VisibilitySmith(T n_dot_l, T n_dot_v, T alpha) {
  const T a2 = alpha * alpha;
  const T from_light = n_dot_v * Sqrt(n_dot_l * n_dot_l * (T(1.0f) - a2) + a2);
  const T from_view = n_dot_l * Sqrt(n_dot_v * n_dot_v * (T(1.0f) - a2) + a2);
  return T(0.5f) / (from_light + from_view);
}

// (1 - cosine)^5, the weight of Fresnel's rise towards grazing angles.
template <class T>
FACET_INLINE T SchlickWeight(T v_dot_h) {
  const T m = Clamp(T(1.0f) - v_dot_h, T(0.0f), T(1.0f));
  const T m2 = m * m;
  return m2 * m2 * m;
}

// Fresnel reflectance. Schlick, 1994, An Inexpensive BRDF Model for Physically-based Rendering, equation 15.
template <class T>
FACET_INLINE T FresnelSchlick(T f0, T v_dot_h) {
  return f0 + (T(1.0f) - f0) * SchlickWeight(v_dot_h);
}
template <class T>
FACET_INLINE Vec3<T> FresnelSchlick(Vec3<T> f0, T v_dot_h) {
  const T w = SchlickWeight(v_dot_h);
  const T rest = T(1.0f) - w;
  return {f0.x * rest + w, f0.y * rest + w, f0.z * rest + w};
}

// Mean of Schlick's Fresnel over the hemisphere, weighted by the cosine: f0 + (f90 - f0) / 21, because the integral of
// 2 mu (1 - mu)^5 over [0, 1] is 1/21.
template <class T>
FACET_INLINE T FresnelSchlickAverage(T f0, T f90 = T(1.0f)) {
  return f0 + (f90 - f0) * T(1.0f / 21.0f);
}

// Lambert, 1760, Photometria: equal radiance in all directions, in 1/steradian for albedo 1.
template <class T>
FACET_INLINE T DiffuseLambert() {
  return T(kInversePi);
}

// The share of the energy lost by single scattering that multiple scattering between microfacets returns: the factor
// Favg^2 Eavg / (1 - Favg (1 - Eavg)) of Kulla and Conty, 2017, Revisiting Physically Based Shading at Imageworks, with
// the square that Hill, 2018, A Multi-Faceted Exploration, part 3, adds (light bounces at least twice). 1 for a perfect
// reflector.
template <class T>
FACET_INLINE T MultipleScatteringFresnel(T f0, T e_avg, T f90 = T(1.0f)) {
  const T f = FresnelSchlickAverage(f0, f90);
  return f * f * e_avg / (T(1.0f) - f * (T(1.0f) - e_avg));
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
