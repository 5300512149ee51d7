// glTF 2.0's material as a closure: the sum of its lobes, evaluated under any lighting. From the top:
//
//   clear coat               lobes/clearcoat-inl.h
//   sheen                    lobes/sheen-inl.h
//   specular reflection      lobes/specular-inl.h, of microfacets (lobes/microfacets-inl.h, lobes/anisotropy-inl.h)
//     with a thin film       lobes/iridescence-inl.h
//   diffuse reflection       lobes/diffuse-inl.h
//   diffuse transmission     lobes/diffuse_transmission-inl.h
//   transmission             lobes/transmission-inl.h
//   volume behind both       lobes/volume-inl.h
//
// Each layer passes down exactly the share of light that it does not reflect towards the view. The core (Khronos, glTF
// 2.0 Specification, appendix B) is reciprocal; a layer over it is not, as in the extensions' own texts. A white base
// colour reflects all light at every roughness, metalness (mixtures too: each part reflects all) and angle.
//
// A lobe that the material does not have is skipped by a uniform branch (all lanes take the same side). The core is
// compiled on its own, too (kCoreLobes), so that materials without layers do not even have the branches.
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
#include "material/lobes/anisotropy-inl.h"
#include "material/lobes/clearcoat-inl.h"
#include "material/lobes/diffuse-inl.h"
#include "material/lobes/diffuse_transmission-inl.h"
#include "material/lobes/iridescence-inl.h"
#include "material/lobes/sheen-inl.h"
#include "material/lobes/specular-inl.h"
#include "material/lobes/transmission-inl.h"
#include "material/lobes/volume-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

inline constexpr MaterialFeatures kCoreLobes = kDiffuseLobe, kAllLobes = kDiffuseLobe | kLayerFeatures;

// The inputs of the model at one point of a surface. Linear Rec. 709; world axes.
template <class T>
struct MaterialInputs {
  // Each member on its own: clearing the whole as one block would cost every packet more than a hundred instructions.
  FACET_INLINE MaterialInputs() {}

  Vec3<T> base_color{};    // clamped to 1
  T alpha_coverage{};      // not read here
  T metallic{};            // [0, 1]
  T perceptual_roughness{};  // [0, 1]
  Vec3<T> normal{};          // unit, shading, on the viewer's side
  T occlusion{};           // 1 + strength * (texel - 1); 1 where there is none
  Vec3<T> emissive{};      // radiance
  // Added to the square of alpha of the reflecting lobes, against aliasing: Surface::footprint_alpha2. What passes
  // through a surface is not blurred, because a thin wall does not deviate light, however it is curved.
  T footprint_alpha2{};
  MaterialFeatures lobes = kDiffuseLobe;  // those that the material has besides the specular lobe
  // Each of the following is read only if `lobes` has its bit.
  Interface<T> dielectric;  // kSpecular or kIor
  ClearcoatInputs<T> clearcoat;
  SheenInputs<T> sheen;
  FilmInputs<T> film;
  AnisotropyInputs<T> anisotropy;
  VolumeInputs<T> volume;
  TransmissionInputs<T> transmission;
  DiffuseTransmissionInputs<T> diffuse_transmission;
};

// The material seen from one direction. `kPossible`: the lobes that it may have; those of others cost nothing. A
// Lighting provides, to this and to the functions below:
//   int LightCount() const;
//   LightSample<T> Sample(int light, Vec3<T> position) const;         // position relative to the eye
//   bool HasEnvironment() const;
//   Vec3<T> IrradianceOverPi(Vec3<T> normal) const;                   // cosine-weighted mean radiance
//   Vec3<T> Prefiltered(Vec3<T> direction, T perceptual_roughness) const;
//   Vec3<T> Prefiltered(Vec3<T> direction, T perceptual_roughness, T footprint_alpha2) const;  // of a widened lobe
//   SpecularAlbedo<T> Dfg(T n_dot_v, T perceptual_roughness) const;
//   SpecularAlbedo<T> DfgAverage(T perceptual_roughness) const;       // the same, averaged: 2 * integral of mu d mu
//   SpecularAlbedo<T> AnisotropicDfg(T n_dot_v, T t_dot_v, T perceptual_roughness, T strength) const;
//   SpecularAlbedo<T> AnisotropicDfgAverage(T perceptual_roughness, T strength) const;
//   T SheenAlbedo(T n_dot_v, T perceptual_roughness) const;           // may exceed 1
template <class T, MaterialFeatures kPossible = kAllLobes>
struct Closure {
  SurfaceView<T> at;
  MaterialFeatures lobes;
  Microfacets<T> microfacets;
  AnisotropicMicrofacets<T> anisotropic;
  SpecularLobe<T> specular;
  DiffuseLobe<T> diffuse;
  DiffuseTransmissionLobe<T> diffuse_transmission;
  ClearcoatLobe<T> clearcoat;
  SheenLobe<T> sheen;
  TransmissionLobe<T> transmission;

  template <class Lighting>
  FACET_INLINE Closure(const MaterialInputs<T>& in, const Vec3<T>& view, const Lighting& lighting)
      : at{in.normal, view, Clamp(Dot(in.normal, view), T(kMinNDotV), T(1.0f))},
        lobes(in.lobes),
        microfacets(DrawnRoughness(in.perceptual_roughness, in.footprint_alpha2)) {
    const T zero(0.0f), one(1.0f);
    const Vec3<T> base{Clamp(in.base_color.x, zero, one), Clamp(in.base_color.y, zero, one),
                       Clamp(in.base_color.z, zero, one)};
    const T metallic = Clamp(in.metallic, zero, one);
    if (Has(kAnisotropy)) {
      anisotropic =
          AnisotropicMicrofacets<T>(DrawnRoughness(in.perceptual_roughness, in.footprint_alpha2), in.anisotropy);
    }
    specular = MakeSpecular(in, base, metallic, lighting);
    diffuse = DiffuseLobe<T>(base, metallic, specular);
    if (Has(kTransmission)) diffuse.color = diffuse.color * (one - in.transmission.factor);
    if (Has(kDiffuseTransmission)) {
      diffuse_transmission = DiffuseTransmissionLobe<T>(in.diffuse_transmission, metallic, diffuse);
      if (Has(kTransmission)) diffuse_transmission.color = diffuse_transmission.color * (one - in.transmission.factor);
      if (Has(kVolume)) diffuse_transmission.color = diffuse_transmission.color * in.volume.Passing();
    }
    if constexpr ((kPossible & kSheen) != 0) {
      if (Has(kSheen)) sheen = SheenLobe<T>(at, in.sheen, lighting);
    }
    if (Has(kClearcoat)) clearcoat = ClearcoatLobe<T>(in.clearcoat, in.footprint_alpha2, view, lighting);
    if (Has(kTransmission)) {
      transmission = TransmissionLobe<T>(in.transmission, at, base, metallic, in.perceptual_roughness, lighting);
      if (Has(kVolume)) transmission.color = transmission.color * in.volume.Passing();
      transmission.color = transmission.color * diffuse.left_for_view;
      if (Has(kSheen)) transmission.color = transmission.color * sheen.EnergyLeft();
      if (Has(kClearcoat)) transmission.color = transmission.color * clearcoat.EnergyLeft();
    }
  }

  FACET_INLINE bool Has(MaterialFeatures lobe) const { return (kPossible & lobe) != 0 && (lobes & lobe) != 0; }

  // The specular lobe's albedo for light from (or to) a direction. `cosine`: its cosine with the normal.
  template <class Lighting>
  FACET_INLINE SpecularAlbedo<T> Albedo(const Vec3<T>& direction, T cosine, const Lighting& lighting) const {
    return Has(kAnisotropy) ? anisotropic.Albedo(direction, cosine, lighting)
                            : microfacets.Albedo(direction, cosine, lighting);
  }

 private:
  template <class Lighting>
  FACET_INLINE SpecularLobe<T> MakeSpecular(const MaterialInputs<T>& in, const Vec3<T>& base, T metallic,
                                            const Lighting& lighting) const {
    constexpr float kF0 = kDielectricF0;
    Interface<T> dielectric{{T(kF0), T(kF0), T(kF0)}, T(1.0f)};
    if (Has(kSpecular | kIor)) dielectric = in.dielectric;
    Vec3<T> metal = base;
    if constexpr ((kPossible & kIridescence) != 0) {
      if (Has(kIridescence)) {
        const ThinFilm<T> film(in.film, at.n_dot_v);
        if (Has(kDiffuseLobe)) dielectric.f0 = film.F0Over(dielectric.f0);
        metal = film.F0Over(metal);
      }
    }
    const SpecularAlbedo<T> average =
        Has(kAnisotropy) ? anisotropic.AverageAlbedo(lighting) : microfacets.AverageAlbedo(lighting);
    return SpecularLobe<T>(dielectric, metal, metallic, /*is_default=*/!Has(kSpecular | kIor | kIridescence),
                           Albedo(at.view, at.n_dot_v, lighting), average);
  }
};

template <class T, MaterialFeatures kPossible = kAllLobes, class Lighting>
FACET_INLINE Closure<T, kPossible> MakeClosure(const MaterialInputs<T>& in, Vec3<T> view, const Lighting& lighting) {
  return Closure<T, kPossible>(in, view, lighting);
}

// The BSDF times the cosine with the normal, in 1/steradian, for light from `direction` (unit).
template <class T, MaterialFeatures kPossible, class Lighting>
FACET_INLINE Vec3<T> EvaluateClosure(const Closure<T, kPossible>& c, Vec3<T> direction, const Lighting& lighting) {
  const T n_dot_l = Dot(c.at.normal, direction);
  const Incidence<T> from = IncidenceFrom(c.at, direction);
  const SpecularAlbedo<T> light_albedo = c.Albedo(direction, from.n_dot_l, lighting);
  const T single = c.Has(kAnisotropy) ? c.anisotropic.Single(c.at, direction, from) : c.microfacets.Single(c.at, from);

  Vec3<T> brdf = c.specular.Direct(single, from.v_dot_h, light_albedo);
  if (c.Has(kDiffuseLobe)) brdf += c.diffuse.Direct(c.specular, light_albedo);
  if constexpr ((kPossible & kSheen) != 0) {
    if (c.Has(kSheen)) brdf = brdf * c.sheen.EnergyLeft() + c.sheen.Direct(c.at, from);
  }
  Vec3<T> reflected = Select<T>(n_dot_l > T(0.0f), brdf * from.n_dot_l, Vec3<T>{});
  if (c.Has(kDiffuseTransmission)) {
    const auto albedo_at = [&](T cosine) HWY_ATTR { return c.Albedo(direction, cosine, lighting); };
    Vec3<T> passed = c.diffuse_transmission.Direct(c.diffuse, c.specular, -n_dot_l, albedo_at);
    if (c.Has(kSheen)) passed = passed * c.sheen.EnergyLeft();
    reflected += passed;
  }
  if (c.Has(kClearcoat)) {
    const T coat = c.clearcoat.Direct(direction, lighting);
    reflected = reflected * c.clearcoat.EnergyLeft() + Vec3<T>{coat, coat, coat};
  }
  return reflected;
}

// The radiance of the environment that the material scatters towards the view, without occlusion. `in`: of the closure,
// whose roughness is not clamped.
template <class T, MaterialFeatures kPossible, class Lighting>
FACET_INLINE Vec3<T> EvaluateEnvironment(const Closure<T, kPossible>& c, const MaterialInputs<T>& in,
                                         const Lighting& lighting) {
  const Vec3<T> prefiltered =
      c.Has(kAnisotropy)
          ? c.anisotropic.Prefiltered(c.at, WidenedRoughness(in.perceptual_roughness, in.footprint_alpha2), lighting)
          : lighting.Prefiltered(c.microfacets.DominantDirection(c.at), in.perceptual_roughness, in.footprint_alpha2);
  EnvironmentTerms<T> sum = c.specular.Environment(prefiltered);
  if (c.Has(kDiffuseLobe)) sum.of_irradiance_over_pi += c.diffuse.Environment().of_irradiance_over_pi;
  Vec3<T> radiance = sum.radiance + lighting.IrradianceOverPi(c.at.normal) * sum.of_irradiance_over_pi;
  if (c.Has(kDiffuseTransmission)) radiance += c.diffuse_transmission.Environment(c.at, c.diffuse, lighting);
  if (c.Has(kSheen)) radiance = radiance * c.sheen.EnergyLeft() + c.sheen.Environment(c.at, lighting).radiance;
  if (c.Has(kClearcoat)) {
    radiance = radiance * c.clearcoat.EnergyLeft() +
               c.clearcoat.Environment(in.clearcoat.perceptual_roughness, in.footprint_alpha2, lighting);
  }
  return radiance;
}

// The emission of the base that the clear coat lets pass. (Sheen scatters light that comes from outside; by the texts
// of the extensions it does not dim emission.)
template <class T, MaterialFeatures kPossible>
FACET_INLINE Vec3<T> EmissionThroughLayers(const Closure<T, kPossible>& c, const MaterialInputs<T>& in) {
  return c.Has(kClearcoat) ? in.emissive * c.clearcoat.EnergyLeft() : in.emissive;
}

// The transmission's part of the BSDF times the cosine, for light from behind the surface.
template <class T, MaterialFeatures kPossible, class Lighting>
FACET_INLINE Vec3<T> EvaluateTransmission(const Closure<T, kPossible>& c, Vec3<T> direction, const Lighting& lighting) {
  return c.transmission.color * c.transmission.Direct(c.at, direction, lighting);
}

// Radiance towards the eye, except for what is seen through the surface. `closure`: of `in`; `position`: relative to
// the eye, world axes.
template <class T, MaterialFeatures kPossible, class Lighting>
FACET_INLINE Vec3<T> ShadeClosure(const Closure<T, kPossible>& closure, const MaterialInputs<T>& in, Vec3<T> position,
                                  const Lighting& lighting) {
  Vec3<T> radiance = EmissionThroughLayers(closure, in);
  if (lighting.HasEnvironment()) radiance += EvaluateEnvironment(closure, in, lighting) * in.occlusion;
  const int light_count = lighting.LightCount();
  for (int i = 0; i < light_count; ++i) {
    const LightSample<T> light = lighting.Sample(i, position);
    radiance += EvaluateClosure(closure, light.direction, lighting) * light.irradiance;
    if (closure.Has(kTransmission)) {
      radiance += EvaluateTransmission(closure, light.direction, lighting) * light.irradiance;
    }
  }
  return radiance;
}

// `view`: unit, from the surface to the eye.
template <class T, MaterialFeatures kPossible = kAllLobes, class Lighting>
FACET_INLINE Vec3<T> ShadeClosure(const MaterialInputs<T>& in, Vec3<T> view, Vec3<T> position,
                                  const Lighting& lighting) {
  return ShadeClosure(Closure<T, kPossible>(in, view, lighting), in, position, lighting);
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
