// Microfacets that are rougher along the tangent than across it (KHR_materials_anisotropy): alpha_t = mix(alpha, 1,
// strength^2) along the tangent, alpha_b = alpha across it. Their albedo depends on the azimuth, too, and has a table
// of its own (light/anisotropic_dfg.h). The albedo of surfaces that are equally rough in all directions, at whatever
// mean roughness, would be off by 0.3: at alpha_t 1 and alpha_b 0.01, 0.53 of the light is reflected to a view across
// the tangent at 5, 60 and 85 degrees from the normal, but 0.53, 0.65 and 0.87 to one along it.

#if defined(FACET_MATERIAL_LOBES_ANISOTROPY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_LOBES_ANISOTROPY_INL_H_
#undef FACET_MATERIAL_LOBES_ANISOTROPY_INL_H_
#else
#define FACET_MATERIAL_LOBES_ANISOTROPY_INL_H_
#endif

#include "material/lobes/microfacets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// The direction along which a surface is rougher, and by how much.
template <class T>
struct AnisotropyInputs {
  Vec3<T> tangent{}, bitangent{};  // unit, perpendicular to the shading normal and to one another
  T strength{};                // [0, 1]
};

template <class T>
struct AnisotropicMicrofacets {
  Vec3<T> tangent, bitangent;
  T alpha_t{}, alpha_b{};
  T perceptual_roughness{};  // across the tangent, clamped
  T strength{};

  FACET_INLINE AnisotropicMicrofacets() {}  // for a lobe that a material does not have

  FACET_INLINE AnisotropicMicrofacets(T roughness, const AnisotropyInputs<T>& in)
      : tangent(in.tangent), bitangent(in.bitangent), strength(in.strength) {
    perceptual_roughness = Clamp(roughness, T(kMinPerceptualRoughness), T(1.0f));
    alpha_b = AlphaFromPerceptualRoughness(perceptual_roughness);
    alpha_t = Mix(alpha_b, T(1.0f), strength * strength);
  }

  // The albedo for light from, or to, a direction. `cosine`: its cosine with the normal. Light from behind has the
  // albedo of the direction that is mirrored to the front, whose cosine with the tangent is the same.
  template <class Lighting>
  FACET_INLINE SpecularAlbedo<T> Albedo(const Vec3<T>& direction, T cosine, const Lighting& lighting) const {
    return lighting.AnisotropicDfg(cosine, Dot(tangent, direction), perceptual_roughness, strength);
  }
  template <class Lighting>
  FACET_INLINE SpecularAlbedo<T> AverageAlbedo(const Lighting& lighting) const {
    return lighting.AnisotropicDfgAverage(perceptual_roughness, strength);
  }

  FACET_INLINE T Single(const SurfaceView<T>& at, const Vec3<T>& light, const Incidence<T>& from) const {
    const T distribution = DistributionGgxAnisotropic(Dot(tangent, from.half), Dot(bitangent, from.half),
                                                      Max(Dot(at.normal, from.half), T(0.0f)), alpha_t, alpha_b);
    const T from_view = from.n_dot_l * Length(at.view, at.n_dot_v),
            from_light = at.n_dot_v * Length(light, from.n_dot_l);
    return distribution * T(0.5f) / (from_view + from_light);
  }

  // The environment as these microfacets blur it: a mean over reflections about normals that are tilted along the
  // tangent, each blurred as the surface is rough across it. The tilts have equal shares of GGX's slopes; their weights
  // are those of visible normals, and of the light that is not shadowed. `unclamped_roughness`: the material's.
  template <class Lighting>
  FACET_INLINE Vec3<T> Prefiltered(const SurfaceView<T>& at, T unclamped_roughness, const Lighting& lighting) const {
    constexpr int kTilts = 16;
    const T spread = Sqrt(Max(alpha_t * alpha_t - alpha_b * alpha_b, T(0.0f)));
    // The gaps between tilts are filled by blur, which is needed less where the surface itself is rough.
    const T gap = spread * T(kGapShare / kTilts);
    const T square = unclamped_roughness * unclamped_roughness;
    const T roughness = Sqrt(Sqrt(square * square + gap * gap));
    const T view_t = Dot(tangent, at.view);
    const T to_normal = ToNormal(alpha_b);
    Vec3<T> sum{};
    T weights(0.0f);
    for (int k = 0; k < kTilts; ++k) {
      const float share = static_cast<float>(2 * k + 1 - kTilts) / kTilts;
      const T slope = spread * T(share) / Sqrt(T(1.0f - share * share));
      const T seen = Max(at.n_dot_v + view_t * slope, T(0.0f));
      const Vec3<T> half = at.normal + tangent * slope;
      const Vec3<T> light = half * (T(2.0f) * seen / (slope * slope + T(1.0f))) - at.view;
      const T n_dot_l = Dot(at.normal, light);
      const T weight = Select(n_dot_l > T(0.0f), seen * n_dot_l / (n_dot_l + Length(light, n_dot_l)), T(0.0f));
      sum += lighting.Prefiltered(Mix(light, at.normal, to_normal), roughness) * weight;
      weights += weight;
    }
    return sum / Max(weights, T(1e-20f));
  }

 private:
  static constexpr float kGapShare = 1.0f;

  // Of the direction, stretched by the roughness: the term of Smith's masking.
  FACET_INLINE T Length(const Vec3<T>& direction, T n_dot) const {
    const T t = alpha_t * Dot(tangent, direction), b = alpha_b * Dot(bitangent, direction);
    return Sqrt(t * t + b * b + n_dot * n_dot);
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
