// What Filament's shading models reflect of the environment: prefiltered lookups by split sum, and the integrands that
// they stand for, each of which integrates to the factor of its lookup. (Guy and Agopian, 2018, 5.3 to 5.6, and the
// shaders of Filament. Their dfg.x is the B of facet's tables, and dfg.y is A + B.)

#if defined(FACET_MATERIAL_MODELS_FILAMENT_ENVIRONMENT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_MODELS_FILAMENT_ENVIRONMENT_INL_H_
#undef FACET_MATERIAL_MODELS_FILAMENT_ENVIRONMENT_INL_H_
#else
#define FACET_MATERIAL_MODELS_FILAMENT_ENVIRONMENT_INL_H_
#endif

#include "material/models/filament/direct-inl.h"
#include "material/models/filament/occlusion-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {
namespace filament {

// The factors of what is looked up, all layers above and occlusion included.
template <class T>
struct EnvironmentFactors {
  Vec3<T> specular{};    // of microfacets or of cloth's fibres: without their albedo
  Vec3<T> diffuse{};     // of irradiance / pi
  Vec3<T> subsurface{};  // of the same, and of the light from behind
  Vec3<T> sheen{};       // of the layer's fibres: without their albedo
  T coat{};              // without its Fresnel term
  T coat_fresnel{};
};

template <class T>
FACET_INLINE EnvironmentFactors<T> FactorsOf(const FilamentSurface<T>& s) {
  using Occlusion = FilamentParameters::SpecularOcclusion;
  const FilamentParameters& p = *s.block;
  const T one(1.0f);
  // Filament does not apply it to surfaces that are blended.
  const Occlusion kind =
      s.is_occluded && s.blending == Blending::Opaque ? p.specular_ambient_occlusion : Occlusion::None;
  const auto specular_occlusion = [&](T n_dot_v, T alpha) HWY_ATTR {
    switch (kind) {
      case Occlusion::None: break;
      case Occlusion::Simple: return SpecularOcclusion(n_dot_v, s.occlusion, alpha);
      case Occlusion::BentNormals: return SpecularOcclusionOfCones(s.diffuse_normal, s.mirror, s.occlusion, alpha);
    }
    return one;
  };
  EnvironmentFactors<T> f;
  const T specular = specular_occlusion(s.at.n_dot_v, s.alpha);
  const bool bounces = s.is_occluded && p.multi_bounce_ambient_occlusion;
  f.specular =
      s.compensation * (bounces && kind != Occlusion::None ? MultiBounceOcclusion(specular, s.f0) : Grey(specular));
  const Vec3<T> dims = bounces ? MultiBounceOcclusion(s.occlusion, s.diffuse_color) : Grey(s.occlusion);
  f.diffuse = s.diffuse_color * (Grey(one) - s.reflected);
  if (s.has_subsurface && s.shading == Shading::Cloth) {
    f.diffuse = f.diffuse * WrappedCosine(s.at.n_dot_v, 0.5f) * Bounded(s.subsurface_color + Grey(s.at.n_dot_v));
  }
  f.diffuse = f.diffuse * dims;
  if (s.shading == Shading::Subsurface) {
    const Vec3<T> occluded = bounces ? dims : Grey(one);
    f.subsurface = s.subsurface_color * occluded * ((one - s.thickness) * T(0.5f * kInversePi));
  }
  if (s.has_sheen) {
    const T left = s.SheenLeft();
    f.specular = f.specular * left, f.diffuse = f.diffuse * left;
    f.sheen = s.sheen_color * specular_occlusion(s.at.n_dot_v, s.sheen.alpha);
  }
  if (s.has_coat) {
    f.coat_fresnel = FresnelSchlick(T(kDielectricF0), s.coat_at.n_dot_v) * s.coat;
    const T left = one - f.coat_fresnel;
    f.specular = f.specular * left, f.diffuse = f.diffuse * left, f.sheen = f.sheen * left;
    f.coat = specular_occlusion(s.coat_at.n_dot_v, s.coat_alpha);
  }
  f.diffuse = f.diffuse * (one - s.transmission);
  return f;
}

// The blur with which light from behind is read: Filament's level of detail, 4 alpha + 1 + thickness in a map of five
// levels, by its inverse of level = 4 p (2 - p).
template <class T>
FACET_INLINE T RoughnessFromBehind(const FilamentSurface<T>& s) {
  const T level = s.alpha + T(0.25f) * (T(1.0f) + s.thickness);
  return T(1.0f) - Sqrt(Max(T(1.0f) - level, T(0.0f)));
}

// A function of its own, as those of direct light: its kernels share it.
template <class T, class Lighting>
HWY_NOINLINE Vec3<T> FromPrefiltered(const FilamentSurface<T>& s, const Lighting& lighting) {
  const EnvironmentFactors<T> f = FactorsOf(s);
  Vec3<T> mirror = s.mirror;
  if (s.is_anisotropic) {
    const Vec3<T> normal = s.anisotropy.BentNormal(s.at, s.perceptual_roughness);
    mirror = normal * (T(2.0f) * Dot(normal, s.at.view)) - s.at.view;
  }
  const Vec3<T> dominant = Mix(mirror, s.at.normal, s.alpha * s.alpha);
  Vec3<T> sum = lighting.Prefiltered(dominant, s.perceptual_roughness) * s.reflected * f.specular;
  const Vec3<T> irradiance = lighting.IrradianceOverPi(s.diffuse_normal);
  sum += irradiance * f.diffuse;
  if (s.shading == Shading::Subsurface) {
    sum += (irradiance + lighting.Prefiltered(-s.at.view, RoughnessFromBehind(s))) * f.subsurface;
  }
  if (s.has_sheen) {
    sum += lighting.Prefiltered(s.mirror, s.sheen.perceptual_roughness) * f.sheen * s.fibre_albedo;
  }
  if (s.has_coat) {
    const Vec3<T>& normal = s.coat_at.normal;
    const Vec3<T> reflected = normal * (T(2.0f) * Dot(normal, s.at.view)) - s.at.view;
    sum += lighting.Prefiltered(reflected, s.coat_roughness) * (f.coat * f.coat_fresnel);
  }
  return sum;
}

// The same for light from one direction.
template <class T>
FACET_INLINE Vec3<T> FromOneDirection(const FilamentSurface<T>& s, const Vec3<T>& light) {
  const EnvironmentFactors<T> f = FactorsOf(s);
  const T zero(0.0f), one(1.0f);
  const Incidence<T> from = IncidenceFrom(s.at, light);
  const bool is_cloth = s.shading == Shading::Cloth;
  const T fibres = is_cloth || s.has_sheen ? DirectFibres(s, from) * from.n_dot_l : zero;
  const Vec3<T> single = is_cloth ? s.sheen_color * fibres : DirectSpecular(s, light, from) * from.n_dot_l;
  Vec3<T> sum = single * f.specular;
  if (s.has_sheen) sum += f.sheen * fibres;
  sum = Select<T>(from.n_dot_l > zero, sum, Vec3<T>{});
  const T cosine = Clamp(Dot(s.diffuse_normal, light), zero, one) * T(kInversePi);
  sum += f.diffuse * cosine;
  if (s.shading == Shading::Subsurface) {
    // A lobe about the direction straight ahead, as wide as the reflection of microfacets seen from their front.
    const T half_cosine = T(0.5f) * Clamp(Dot(s.at.view, light), T(-1.0f), one);
    const T alpha = AlphaFromPerceptualRoughness(Max(RoughnessFromBehind(s), T(kMinPerceptualRoughness)));
    const T lobe = DistributionGgx(Sqrt(T(0.5f) - half_cosine), T(0.5f) + half_cosine, alpha) * T(0.25f);
    sum += f.subsurface * (cosine + lobe);
  }
  if (s.has_coat) {
    const Incidence<T> on_coat = IncidenceFrom(s.coat_at, light);
    const T lobe = DistributionGgx(s.coat_at.normal, on_coat.half, s.coat_alpha) *
                   VisibilitySmith(on_coat.n_dot_l, s.coat_at.n_dot_v, s.coat_alpha) * on_coat.n_dot_l;
    const T coat = lobe * f.coat * f.coat_fresnel / Max(s.coat_albedo, T(1e-4f));
    sum += Grey(Select(on_coat.n_dot_l > zero, coat, zero));
  }
  return sum;
}

}  // namespace filament
}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
