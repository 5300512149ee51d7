// The sheen of KHR_materials_sheen: light scattered by fibres that stand on the surface, a layer above all that is
// under it. color * D * V, without Fresnel, where D and V are those of Estevez and Kulla, 2017, Production Friendly
// Microfacet Sheen BRDF, in the form of the extension's text:
//    D = (2 + 1/alpha) sin(theta_h)^(1/alpha) / (2 pi),   V = 1 / ((1 + Lambda(v) + Lambda(l)) 4 n_dot_v n_dot_l),
// alpha being the square of the perceptual roughness. The paper also softens the terminator by raising Lambda(l) to a
// power that depends on n_dot_l. The extension's text does not, and neither do we: other renderers follow the text, and
// D V is then reciprocal.
//
// What lies under the sheen receives what the sheen leaves, 1 - max(color) E(v), with E the albedo of D V
// (light/sheen_albedo.h). The text also offers the lesser of that and the same for the light's direction, which would
// darken a white furnace and cost one more lookup for each light.
//
// E exceeds 1 at grazing views of smooth sheen: below n_dot_v 0.055 at roughness 0.07 (2.94 at most), below 0.026 at
// 0.2, and nowhere from 0.26 on. The fit of Lambda masks too little there. D V is divided by max(1, E(v)), so that the
// layer reflects all light there, and no more.

#if defined(FACET_MATERIAL_LOBES_SHEEN_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_LOBES_SHEEN_INL_H_
#undef FACET_MATERIAL_LOBES_SHEEN_INL_H_
#else
#define FACET_MATERIAL_LOBES_SHEEN_INL_H_
#endif

#include "facet/shader/elementary-inl.h"
#include "material/lobes/lobe-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// The least perceptual roughness of sheen, which KHR_materials_sheen sets to 0 by default. At 0.07 D's exponent is 204.
// It multiplies the rounding error of sin(theta_h), so that in float the lobe is off by 3e-5 of itself (measured in
// tests/material), and it keeps E, whose rise towards grazing views is about as wide as the roughness, within a small
// table. Smoother sheen than this differs from it in a rim of 1 % of a sphere's radius.
inline constexpr float kMinSheenRoughness = 0.07f;

// Distribution of fibres, in 1/steradian; the integral of D(h) n_dot_h over the hemisphere is 1. `sin2_n_h` is 1 -
// n_dot_h^2, from the cross product, which is precise where n and h nearly coincide.
template <class T>
FACET_INLINE T DistributionCharlieOfLog2(T log2_sin2_n_h, T inverse_alpha) {
  return (T(2.0f) + inverse_alpha) * T(0.5f * kInversePi) * Exp2(log2_sin2_n_h * (T(0.5f) * inverse_alpha));
}
template <class T>
FACET_INLINE T DistributionCharlie(T sin2_n_h, T inverse_alpha) {
  return DistributionCharlieOfLog2(Log2(sin2_n_h), inverse_alpha);
}

// Lambda(cosine) of masking and shadowing, as Estevez and Kulla fitted it:
//    Lambda(x) = exp(L(x)) for x < 0.5, exp(2 L(0.5) - L(1 - x)) above, L(x) = a / (1 + b x^c) + d x + e,
// with each constant interpolated by (1 - alpha)^2 between its values at alpha 1 and at 0.
template <class T>
struct CharlieMasking {
  T a{}, b{}, c{}, d{}, e{}, twice_at_half{};

  FACET_INLINE CharlieMasking() {}  // for a lobe that a material does not have

  FACET_INLINE explicit CharlieMasking(T alpha) {
    const T rest = T(1.0f) - alpha, smooth = rest * rest;
    a = Mix(T(21.5473f), T(25.3245f), smooth);
    b = Mix(T(3.82987f), T(3.32435f), smooth);
    c = Mix(T(0.19823f), T(0.16801f), smooth);
    d = Mix(T(-1.97760f), T(-1.27393f), smooth);
    e = Mix(T(-4.32054f), T(-4.85967f), smooth);
    twice_at_half = T(2.0f) * Exponent(T(0.5f));
  }

  // L. At 0 the power is that of a logarithm of minus infinity, which is 0.
  FACET_INLINE T Exponent(T x) const { return a / (T(1.0f) + b * Exp2(c * Log2(x))) + d * x + e; }

  // `cosine`: in [0, 1].
  FACET_INLINE T Lambda(T cosine) const {
    const auto grazing = cosine < T(0.5f);
    const T exponent = Exponent(Select(grazing, cosine, T(1.0f) - cosine));
    return Exp(Select(grazing, exponent, twice_at_half - exponent));
  }
};

template <class T>
struct SheenInputs {
  Vec3<T> color{};           // [0, 1]
  T perceptual_roughness{};  // [0, 1]
};

template <class T>
struct SheenLobe {
  Vec3<T> color;
  T perceptual_roughness{};  // clamped
  T inverse_alpha{};
  CharlieMasking<T> masking;
  T one_and_lambda_of_view{};
  T albedo{};  // E at n_dot_v, at most 1
  T scale{};   // of D V n_dot_l (1 + Lambda(v) + Lambda(l)): 1 / (4 n_dot_v max(1, E))

  FACET_INLINE SheenLobe() {}  // for a lobe that a material does not have

  template <class Lighting>
  FACET_INLINE SheenLobe(const SurfaceView<T>& at, const SheenInputs<T>& in, const Lighting& lighting)
      : color(in.color),
        perceptual_roughness(Clamp(in.perceptual_roughness, T(kMinSheenRoughness), T(1.0f))),
        masking(AlphaFromPerceptualRoughness(perceptual_roughness)) {
    inverse_alpha = T(1.0f) / AlphaFromPerceptualRoughness(perceptual_roughness);
    one_and_lambda_of_view = T(1.0f) + masking.Lambda(at.n_dot_v);
    const T reflected = lighting.SheenAlbedo(at.n_dot_v, perceptual_roughness);
    albedo = Min(reflected, T(1.0f));
    scale = T(0.25f) / (at.n_dot_v * Max(reflected, T(1.0f)));
  }

  FACET_INLINE Vec3<T> Direct(const SurfaceView<T>& at, const Incidence<T>& from) const {
    const Vec3<T> cross = Cross(at.normal, from.half);
    const T distribution = DistributionCharlie(Dot(cross, cross), inverse_alpha);
    // V has a pole at 0, where n_dot_l, by which the closure multiplies it, would make 0 times infinity of it.
    const T n_dot_l = Max(from.n_dot_l, T(1e-6f));
    return color * (distribution * scale / ((one_and_lambda_of_view + masking.Lambda(n_dot_l)) * n_dot_l));
  }

  // The lobe is broad and lies low, towards the side of the viewer, not of the mirror direction. So the environment is
  // read as irradiance, along a direction that is turned from the normal to the viewer, by more on smoother sheen. The
  // root mean square error of the reflected radiance over seven roughnesses and seven angles, weighted by E and
  // relative to the mean, is 0.54 in a workshop, 1.34 and 0.95 under skies with small suns, and 0.21 in a garden
  // without one; with the irradiance on the surface itself it is 0.68, 1.57, 1.10 and 0.34, and with the environment
  // prefiltered for the roughness along the mirror direction 3.86, 2.19, 1.56 and 0.70. The best direction for each
  // roughness and angle gains less than 0.01 on this one (src/light/fit_sheen_direction.py measures all of them).
  template <class Lighting>
  FACET_INLINE EnvironmentTerms<T> Environment(const SurfaceView<T>& at, const Lighting& lighting) const {
    return {color * lighting.IrradianceOverPi(DominantDirection(at)) * albedo, {}};
  }

  // Not normalised. Along the normal its length is the roughness, along the surface 0.4 sin(theta_v).
  FACET_INLINE Vec3<T> DominantDirection(const SurfaceView<T>& at) const {
    const T to_view(0.4f);
    return at.normal * (perceptual_roughness - to_view * Dot(at.normal, at.view)) + at.view * to_view;
  }

  // The share of light that passes to what lies under the sheen and back.
  FACET_INLINE T EnergyLeft() const { return T(1.0f) - MaxComponent(color) * albedo; }
};

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
