// glTF 2.0's metallic-roughness material as a closure: weighted lobes, evaluated under any lighting.
//
// The model (Khronos, glTF 2.0 Specification, appendix B): a linear mixture, by metalness, of a metal (GGX, coloured
// Fresnel) and a dielectric (GGX with F0 = 0.04 over a diffuse base). Added to it, so that no energy is lost or made:
//  - multiple scattering between the microfacets of either (Kulla and Conty, 2017), by the lobe
//    Fms (1 - E(v)) (1 - E(l)) / (pi (1 - Eavg)), with E the albedo of single scattering where Fresnel is 1;
//  - a diffuse base lit by, and seen through, what the dielectric's specular reflection leaves:
//    base / pi (1 - Ed(v)) (1 - Ed(l)) / (1 - Ed_avg), with Ed = F0 A + B + Fms (1 - E) the albedo of that reflection.
// Both are reciprocal. A white base colour reflects all light at every roughness, metalness (mixtures too: each part
// reflects all) and angle. The appendix couples diffuse by 1 - F(v.h) instead, which gains and loses at grazing angles.
//
// Under image-based light the directional terms become albedos (Karis, 2013, Real Shading in Unreal Engine 4: split
// sum; Fdez-Aguera, 2019, A Multiple-Scattering Microfacet Model for Real-Time Image-based Lighting):
//    prefiltered(d) (F0 A + B) + [ Fms (1 - E) + (1 - metallic) base (1 - Ed) ] irradiance / pi.
// d is where the lobe's light comes from, which is the mirror direction only for smooth surfaces.
// Occlusion multiplies all of that, the specular part too: a cavity sees less of its surroundings in every direction.
// It never touches punctual lights or emission (glTF 2.0, section 3.9.2).

#if defined(FACET_MATERIAL_CLOSURE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_CLOSURE_INL_H_
#undef FACET_MATERIAL_CLOSURE_INL_H_
#else
#define FACET_MATERIAL_CLOSURE_INL_H_
#endif

#include "facet/shader/brdf-inl.h"
#include "facet/shader/lane-inl.h"
#include "facet/shader/vec-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// What the model means at one point of a surface. Linear Rec. 709; world axes. Make one with `MaterialInputs<T> in{};`:
// without the braces GCC calls a constructor that it generated for no instruction set in particular.
template <class T>
struct MaterialInputs {
  Vec3<T> base_color;      // values above 1 count as 1
  T alpha_coverage{};      // not read here
  T metallic{};            // [0, 1]
  T perceptual_roughness{};  // [0, 1]
  Vec3<T> normal;          // unit, shading, on the viewer's side
  T occlusion{};           // 1 + strength * (texel - 1); 1 where there is none
  Vec3<T> emissive;        // radiance
};

// Albedos of GGX at one roughness: where Fresnel is Schlick's with F0, single scattering reflects F0 * a + b.
template <class T>
struct SpecularAlbedo {
  T a{}, b{};
};

// Light from one direction.
template <class T>
struct LightSample {
  Vec3<T> direction;   // unit, from the surface to the light
  Vec3<T> irradiance;  // on a surface that faces it: lux
};

// The material seen from one direction. What a Lighting provides to it and to the functions below:
//   int LightCount() const;
//   LightSample<T> Sample(int light, Vec3<T> position) const;         // position relative to the eye
//   bool HasEnvironment() const;
//   Vec3<T> IrradianceOverPi(Vec3<T> normal) const;                   // cosine-weighted mean radiance
//   Vec3<T> Prefiltered(Vec3<T> direction, T perceptual_roughness) const;
//   SpecularAlbedo<T> Dfg(T n_dot_v, T perceptual_roughness) const;
//   SpecularAlbedo<T> DfgAverage(T perceptual_roughness) const;       // the same, averaged: 2 * integral of mu d mu
template <class T>
struct MetallicRoughnessClosure {
  Vec3<T> normal, view;
  T n_dot_v{}, alpha{};
  T perceptual_roughness{};   // clamped
  Vec3<T> f0;                 // of the mixture: Schlick's Fresnel is linear in it
  Vec3<T> multiple_fresnel;   // Fms of the mixture
  T dielectric_multiple_fresnel{};
  Vec3<T> diffuse_color;      // (1 - metallic) * base colour
  SpecularAlbedo<T> albedo;   // at n_dot_v
  T multiple_scale{};         // 1 / (pi (1 - Eavg))
  T diffuse_scale{};          // 1 / (pi (1 - Ed_avg))
};

// What single scattering loses.
template <class T>
HWY_INLINE T LostEnergy(SpecularAlbedo<T> albedo) {
  return Max(T(1.0f) - (albedo.a + albedo.b), T(0.0f));
}

// What the dielectric's specular reflection leaves to its base: 1 - Ed.
template <class T>
HWY_INLINE T EnergyLeftByDielectric(SpecularAlbedo<T> albedo, T multiple_fresnel) {
  const T reflected = T(kDielectricF0) * albedo.a + albedo.b + multiple_fresnel * LostEnergy(albedo);
  return Max(T(1.0f) - reflected, T(0.0f));
}

template <class T, class Lighting>
HWY_INLINE MetallicRoughnessClosure<T> MakeClosure(const MaterialInputs<T>& in, Vec3<T> view,
                                                   const Lighting& lighting) {
  const T one = T(1.0f);
  MetallicRoughnessClosure<T> c{};
  c.normal = in.normal;
  c.view = view;
  c.n_dot_v = Clamp(Dot(in.normal, view), T(kMinNDotV), one);
  c.perceptual_roughness = Clamp(in.perceptual_roughness, T(kMinPerceptualRoughness), one);
  c.alpha = AlphaFromPerceptualRoughness(c.perceptual_roughness);
  const T metallic = Clamp(in.metallic, T(0.0f), one);
  const T dielectric = one - metallic;
  const Vec3<T> base = {Clamp(in.base_color.x, T(0.0f), one), Clamp(in.base_color.y, T(0.0f), one),
                        Clamp(in.base_color.z, T(0.0f), one)};
  c.albedo = lighting.Dfg(c.n_dot_v, c.perceptual_roughness);
  const SpecularAlbedo<T> average = lighting.DfgAverage(c.perceptual_roughness);
  const T e_avg = average.a + average.b;
  const T f0_dielectric = T(kDielectricF0);
  c.f0 = {f0_dielectric * dielectric + base.x * metallic, f0_dielectric * dielectric + base.y * metallic,
          f0_dielectric * dielectric + base.z * metallic};
  c.dielectric_multiple_fresnel = MultipleScatteringFresnel(f0_dielectric, e_avg);
  const T fd = c.dielectric_multiple_fresnel * dielectric;
  c.multiple_fresnel = {fd + MultipleScatteringFresnel(base.x, e_avg) * metallic,
                        fd + MultipleScatteringFresnel(base.y, e_avg) * metallic,
                        fd + MultipleScatteringFresnel(base.z, e_avg) * metallic};
  c.diffuse_color = base * dielectric;
  // A nearly smooth surface loses nearly nothing: 1 - E is then as small as 1 - Eavg, whose rounding must not divide.
  c.multiple_scale = T(kInversePi) / Max(LostEnergy(average), T(1e-6f));
  c.diffuse_scale = T(kInversePi) / Max(EnergyLeftByDielectric(average, c.dielectric_multiple_fresnel), T(1e-6f));
  return c;
}

// The BRDF times n_dot_l, in 1/steradian, for light from `direction` (unit); zero from below the horizon.
template <class T, class Lighting>
HWY_INLINE Vec3<T> EvaluateClosure(const MetallicRoughnessClosure<T>& c, Vec3<T> direction, const Lighting& lighting) {
  const T n_dot_l_signed = Dot(c.normal, direction);
  const auto lit = n_dot_l_signed > T(0.0f);
  const T n_dot_l = Clamp(n_dot_l_signed, T(0.0f), T(1.0f));
  const Vec3<T> half = NormalizeOr(c.view + direction, c.normal);
  const T v_dot_h = Clamp(Dot(c.view, half), T(0.0f), T(1.0f));
  const T single = DistributionGgx(c.normal, half, c.alpha) * VisibilitySmith(n_dot_l, c.n_dot_v, c.alpha);
  const Vec3<T> fresnel = FresnelSchlick(c.f0, v_dot_h);

  const SpecularAlbedo<T> light_albedo = lighting.Dfg(n_dot_l, c.perceptual_roughness);
  const T multiple = LostEnergy(c.albedo) * LostEnergy(light_albedo) * c.multiple_scale;
  const T diffuse = EnergyLeftByDielectric(c.albedo, c.dielectric_multiple_fresnel) *
                    EnergyLeftByDielectric(light_albedo, c.dielectric_multiple_fresnel) * c.diffuse_scale;

  const Vec3<T> brdf = fresnel * single + c.multiple_fresnel * multiple + c.diffuse_color * diffuse;
  return Select<T>(lit, brdf * n_dot_l, Vec3<T>{});
}

// Where a rough lobe gathers most of its light: between the mirror direction and the normal, because masking and the
// cosine take more of its grazing side (Lagarde and de Rousiers, 2014, Moving Frostbite to Physically Based Rendering,
// section 4.9.3). The weight of the normal is close to the best under soft lamps (src/light/fit_dominant_direction.py
// measures it) and a little less on smoother surfaces, where the small suns of photographed skies ask for that. Not
// unit.
template <class T>
HWY_INLINE Vec3<T> DominantDirection(const MetallicRoughnessClosure<T>& c) {
  const Vec3<T> mirror = c.normal * (T(2.0f) * Dot(c.normal, c.view)) - c.view;
  const T to_normal = c.alpha * c.alpha * (T(1.5f) + c.alpha * (T(0.35f) - c.alpha * T(0.95f)));
  return Mix(mirror, c.normal, to_normal);
}

// What the surface reflects of the environment, unoccluded. `perceptual_roughness` is the material's, unclamped.
template <class T, class Lighting>
HWY_INLINE Vec3<T> EvaluateEnvironment(const MetallicRoughnessClosure<T>& c, T perceptual_roughness,
                                       const Lighting& lighting) {
  const Vec3<T> specular = lighting.Prefiltered(DominantDirection(c), perceptual_roughness);
  const Vec3<T> around = lighting.IrradianceOverPi(c.normal);
  const Vec3<T> single = {c.f0.x * c.albedo.a + c.albedo.b, c.f0.y * c.albedo.a + c.albedo.b,
                          c.f0.z * c.albedo.a + c.albedo.b};
  const Vec3<T> multiple = c.multiple_fresnel * LostEnergy(c.albedo);
  const Vec3<T> diffuse = c.diffuse_color * EnergyLeftByDielectric(c.albedo, c.dielectric_multiple_fresnel);
  return specular * single + around * (multiple + diffuse);
}

// Radiance towards the eye. `view`: unit, from the surface to the eye; `position`: relative to the eye, world axes.
template <class T, class Lighting>
HWY_INLINE Vec3<T> ShadeMetallicRoughness(const MaterialInputs<T>& in, Vec3<T> view, Vec3<T> position,
                                          const Lighting& lighting) {
  const MetallicRoughnessClosure<T> closure = MakeClosure(in, view, lighting);
  Vec3<T> radiance = in.emissive;
  if (lighting.HasEnvironment()) {
    radiance += EvaluateEnvironment(closure, in.perceptual_roughness, lighting) * in.occlusion;
  }
  const int light_count = lighting.LightCount();
  for (int i = 0; i < light_count; ++i) {
    const LightSample<T> light = lighting.Sample(i, position);
    radiance += EvaluateClosure(closure, light.direction, lighting) * light.irradiance;
  }
  return radiance;
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
