// glTF 2.0's metallic-roughness material as a closure: the sum of its lobes, evaluated under any lighting.
//
// The model (Khronos, glTF 2.0 Specification, appendix B) is a specular lobe (lobes/specular-inl.h) over a diffuse one
// (lobes/diffuse-inl.h). Both are reciprocal. A white base colour reflects all light at every roughness, metalness
// (mixtures too: each part reflects all) and angle.
//
// A lobe that the material does not have is skipped by a uniform branch (all lanes take the same side).
//
// Occlusion multiplies all light from the environment, including specular reflection, because a cavity sees less of its
// surroundings in every direction. It does not affect punctual lights or emission (glTF 2.0, section 3.9.2).

#if defined(FACET_MATERIAL_CLOSURE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_CLOSURE_INL_H_
#undef FACET_MATERIAL_CLOSURE_INL_H_
#else
#define FACET_MATERIAL_CLOSURE_INL_H_
#endif

#include "material/features.h"
#include "material/lobes/diffuse-inl.h"
#include "material/lobes/specular-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// The inputs of the model at one point of a surface. Linear Rec. 709; world axes. Define one as `MaterialInputs<T>
// in{};`: without the braces GCC calls a constructor that it generates for the baseline instruction set.
template <class T>
struct MaterialInputs {
  Vec3<T> base_color;      // clamped to 1
  T alpha_coverage{};      // not read here
  T metallic{};            // [0, 1]
  T perceptual_roughness{};  // [0, 1]
  Vec3<T> normal;          // unit, shading, on the viewer's side
  T occlusion{};           // 1 + strength * (texel - 1); 1 where there is none
  Vec3<T> emissive;        // radiance
  MaterialFeatures lobes = kDiffuseLobe;  // those that the material has besides the specular lobe
};

// The material seen from one direction. A Lighting provides, to this and to the functions below:
//   int LightCount() const;
//   LightSample<T> Sample(int light, Vec3<T> position) const;         // position relative to the eye
//   bool HasEnvironment() const;
//   Vec3<T> IrradianceOverPi(Vec3<T> normal) const;                   // cosine-weighted mean radiance
//   Vec3<T> Prefiltered(Vec3<T> direction, T perceptual_roughness) const;
//   SpecularAlbedo<T> Dfg(T n_dot_v, T perceptual_roughness) const;
//   SpecularAlbedo<T> DfgAverage(T perceptual_roughness) const;       // the same, averaged: 2 * integral of mu d mu
template <class T>
struct Closure {
  SurfaceView<T> at;
  MaterialFeatures lobes;
  SpecularLobe<T> specular;
  DiffuseLobe<T> diffuse;

  template <class Lighting>
  HWY_INLINE Closure(const SurfaceView<T>& surface, const MaterialInputs<T>& in, const Vec3<T>& base_color, T metallic,
                     const Lighting& lighting)
      : at(surface),
        lobes(in.lobes),
        specular(surface, base_color, metallic, in.perceptual_roughness, lighting),
        diffuse(base_color, metallic, specular) {}

  HWY_INLINE bool Has(MaterialFeatures lobe) const { return (lobes & lobe) != 0; }
};

template <class T, class Lighting>
HWY_INLINE Closure<T> MakeClosure(const MaterialInputs<T>& in, Vec3<T> view, const Lighting& lighting) {
  const T zero(0.0f), one(1.0f);
  const SurfaceView<T> at{in.normal, view, Clamp(Dot(in.normal, view), T(kMinNDotV), one)};
  const Vec3<T> base = {Clamp(in.base_color.x, zero, one), Clamp(in.base_color.y, zero, one),
                        Clamp(in.base_color.z, zero, one)};
  return Closure<T>(at, in, base, Clamp(in.metallic, zero, one), lighting);
}

// The BRDF times n_dot_l, in 1/steradian, for light from `direction` (unit); zero below the horizon.
template <class T, class Lighting>
HWY_INLINE Vec3<T> EvaluateClosure(const Closure<T>& c, Vec3<T> direction, const Lighting& lighting) {
  const T n_dot_l_signed = Dot(c.at.normal, direction);
  const auto lit = n_dot_l_signed > T(0.0f);
  Incidence<T> from{};
  from.n_dot_l = Clamp(n_dot_l_signed, T(0.0f), T(1.0f));
  from.half = NormalizeOr(c.at.view + direction, c.at.normal);
  from.v_dot_h = Clamp(Dot(c.at.view, from.half), T(0.0f), T(1.0f));
  const SpecularAlbedo<T> light_albedo = lighting.Dfg(from.n_dot_l, c.specular.perceptual_roughness);

  Vec3<T> brdf = c.specular.Direct(c.at, from, light_albedo);
  if (c.Has(kDiffuseLobe)) brdf += c.diffuse.Direct(c.specular, light_albedo);
  return Select<T>(lit, brdf * from.n_dot_l, Vec3<T>{});
}

// The reflected radiance of the environment, without occlusion. `perceptual_roughness`: the material's, not clamped.
template <class T, class Lighting>
HWY_INLINE Vec3<T> EvaluateEnvironment(const Closure<T>& c, T perceptual_roughness, const Lighting& lighting) {
  EnvironmentTerms<T> sum = c.specular.Environment(c.at, perceptual_roughness, lighting);
  if (c.Has(kDiffuseLobe)) sum.of_irradiance_over_pi += c.diffuse.Environment().of_irradiance_over_pi;
  return sum.radiance + lighting.IrradianceOverPi(c.at.normal) * sum.of_irradiance_over_pi;
}

// Radiance towards the eye. `view`: unit, from the surface to the eye; `position`: relative to the eye, world axes.
template <class T, class Lighting>
HWY_INLINE Vec3<T> ShadeClosure(const MaterialInputs<T>& in, Vec3<T> view, Vec3<T> position, const Lighting& lighting) {
  const Closure<T> closure = MakeClosure(in, view, lighting);
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
