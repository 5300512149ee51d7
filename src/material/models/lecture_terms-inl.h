// The terms of the model "lecture" that facet's other models do not have: distributions, masking and shadowing, the
// exact Fresnel equations. n, v, l, h as in facet/shader/brdf-inl.h; T is Float (lanes), float or double.
// sin2_n_h is |n x h|^2, which keeps the digits that 1 - n.h loses within a highlight.

#if defined(FACET_MATERIAL_MODELS_LECTURE_TERMS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_MODELS_LECTURE_TERMS_INL_H_
#undef FACET_MATERIAL_MODELS_LECTURE_TERMS_INL_H_
#else
#define FACET_MATERIAL_MODELS_LECTURE_TERMS_INL_H_
#endif

#include "facet/shader/brdf-inl.h"
#include "facet/shader/elementary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// --- Distributions: the integral of D(h) n.h over the hemisphere is 1 ------------------------------------------------

// ln(n.h) to the relative precision of sin2_n_h: half of ln(1 - sin^2) by its series where n and h are close.
template <class T>
FACET_INLINE T LogOfCosine(T n_dot_h, T sin2_n_h) {
  constexpr float kSeries[] = {1.0f, 1.0f / 2, 1.0f / 3, 1.0f / 4, 1.0f / 5, 1.0f / 6, 1.0f / 7, 1.0f / 8};
  const T close = sin2_n_h * Polynomial(sin2_n_h, kSeries) * T(-0.5f);
  return Select(sin2_n_h < T(1.0f / 16.0f), close, Log(Max(n_dot_h, T(1e-30f))));
}

// (n.h)^exponent.
template <class T>
FACET_INLINE T CosineLobe(T n_dot_h, T sin2_n_h, T exponent) {
  return Exp(exponent * LogOfCosine(n_dot_h, sin2_n_h));
}

// Blinn, 1977, Models of Light Reflection for Computer Synthesized Pictures, normalised: (p + 2) / (2 pi) (n.h)^p.
template <class T>
FACET_INLINE T DistributionBlinnPhong(T n_dot_h, T sin2_n_h, T exponent) {
  return (exponent + T(2.0f)) * T(0.5f * kInversePi) * CosineLobe(n_dot_h, sin2_n_h, exponent);
}

// Beckmann and Spizzichino, 1963, The Scattering of Electromagnetic Waves from Rough Surfaces; in the form of Walter et
// al., 2007, equation 25: exp(-tan^2 / alpha^2) / (pi alpha^2 cos^4). Below a cosine of 1e-4 it is 0 for every alpha.
template <class T>
FACET_INLINE T DistributionBeckmann(T n_dot_h, T sin2_n_h, T alpha) {
  const T cosine = Max(n_dot_h, T(1e-4f)), cos2 = cosine * cosine, a2 = alpha * alpha;
  return Exp(-sin2_n_h / (cos2 * a2)) * T(kInversePi) / (a2 * cos2 * cos2);
}

// ABC: peak / (1 + alpha1 (1 - n.h))^alpha2, where peak is 1 / (2 pi AbcIntegral(alpha1, alpha2)) of
// material/models/lecture_abc.h.
template <class T>
FACET_INLINE T DistributionAbc(T n_dot_h, T sin2_n_h, T alpha1, T alpha2, T peak) {
  const T below = sin2_n_h / (T(1.0f) + n_dot_h);  // 1 - n.h
  return peak * Exp2(-alpha2 * Log2(T(1.0f) + alpha1 * below));
}

// --- Visibility: masking and shadowing, G, divided by 4 n.l n.v ------------------------------------------------------

// G1(n.l) G1(n.v) with G1(x) = x / (x (1 - k) + k). Schlick, 1994, An Inexpensive BRDF Model for Physically-based
// Rendering; k by Karis, 2013, Real Shading in Unreal Engine 4. Finite while k > 0.
template <class T>
FACET_INLINE T VisibilitySchlick(T n_dot_l, T n_dot_v, T k) {
  const T rest = T(1.0f) - k;
  return T(0.25f) / ((n_dot_l * rest + k) * (n_dot_v * rest + k));
}

// Height-correlated Smith of Beckmann's distribution: 1 / (1 + Lambda(l) + Lambda(v)), with Lambda by the rational fit
// of Heitz, 2014, Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs (after Walter et
// al., 2007): (1 - 1.259 a + 0.396 a^2) / (3.535 a + 2.181 a^2) for a = n.x / (alpha sin) below 1.6, else 0. Both
// cosines are multiplied into it, so that it is finite while n.v > 0 and n.l >= 0.
template <class T>
FACET_INLINE T CosineTimesLambdaBeckmann(T cosine, T alpha) {
  const T spread = alpha * Sqrt(Max(T(1.0f) - cosine * cosine, T(0.0f)));  // cosine / a
  const T a = cosine / Max(spread, T(1e-20f));
  const T near = Min(a, T(1.6f));
  const T fit = spread * (T(1.0f) + near * (T(0.396f) * near - T(1.259f))) / (T(3.535f) + T(2.181f) * near);
  return Select(a < T(1.6f), fit, T(0.0f));
}
template <class T>
FACET_INLINE T VisibilitySmithBeckmann(T n_dot_l, T n_dot_v, T alpha) {
  return T(0.25f) / (n_dot_l * n_dot_v + n_dot_v * CosineTimesLambdaBeckmann(n_dot_l, alpha) +
                     n_dot_l * CosineTimesLambdaBeckmann(n_dot_v, alpha));
}

// --- Fresnel's equations, unpolarised light --------------------------------------------------------------------------

// A dielectric in air, of index of refraction 1 or more. Cook and Torrance, 1982, A Reflectance Model for Computer
// Graphics, with c = v.h and g^2 = ior^2 - 1 + c^2. 1 at c = 0 for every index above 1.
template <class T>
FACET_INLINE T FresnelDielectric(T ior, T v_dot_h) {
  const T c = v_dot_h;
  const T excess = (ior - T(1.0f)) * (ior + T(1.0f));
  const T g = Sqrt(excess + c * c);
  // (g - c) / (g + c) = (g^2 - c^2) / (g + c)^2, without the difference of two close numbers.
  const T sum = Max(g + c, T(1e-15f));
  const T perpendicular = excess / (sum * sum);
  // c (g + c) - 1 over c (g - c) + 1.
  const T parallel = (c * sum - T(1.0f)) / (c * excess / sum + T(1.0f));
  return T(0.5f) * perpendicular * perpendicular * (T(1.0f) + parallel * parallel);
}

// A conductor in air, of index of refraction eta + i k, both 0 or more, not both 0. Born and Wolf, 1999, Principles of
// Optics, section 14.2, solved for real numbers.
template <class T>
FACET_INLINE T FresnelConductor(T eta, T k, T v_dot_h) {
  const T c2 = v_dot_h * v_dot_h, s2 = Max(T(1.0f) - c2, T(0.0f));
  const T eta2 = eta * eta, k2 = k * k;
  // p^2 - q^2 and 2 p q are the parts of (eta + i k)^2 - sin^2.
  const T real = eta2 - k2 - s2;
  const T norm = Sqrt(real * real + T(4.0f) * eta2 * k2);  // p^2 + q^2
  const T p = Sqrt(Max((norm + real) * T(0.5f), T(0.0f)));
  const T sum = norm + c2, cross = T(2.0f) * p * v_dot_h;
  // The differences are squares of absolute values: not negative, but for rounding. The sums are 0 only where nothing
  // is reflected: at grazing incidence on a medium that is like air.
  const T least(1e-30f);
  const T perpendicular = Max(sum - cross, T(0.0f)) / Max(sum + cross, least);
  const T sum_p = c2 * norm + s2 * s2, cross_p = cross * s2;
  const T parallel = perpendicular * (Max(sum_p - cross_p, T(0.0f)) / Max(sum_p + cross_p, least));
  return T(0.5f) * (perpendicular + parallel);
}

// F with roughness, as lectures have it for image-based light: F0 + (max(1 - roughness, F0) - F0) (1 - n.v)^5
// (S. Lagarde, 2011, Adopting a Physically Based Shading Model).
template <class T>
FACET_INLINE T FresnelSchlickRoughness(T f0, T roughness, T n_dot_v) {
  return f0 + (Max(T(1.0f) - roughness, f0) - f0) * SchlickWeight(n_dot_v);
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
