// The model "lecture": reflectance as lectures on physically based shading write it, each term a choice
// (docs/models/lecture.md):
//   kD albedo / pi + D F G / (4 n.v n.l),   kS = F, kD = (1 - kS) (1 - metalness).
// It gains and loses energy where those lectures do: nothing here repairs it.
//
// Image-based light is the split sum as such lectures compute it: with F of n.v and the roughness,
//   (kD albedo irradiance / pi + prefiltered (F A + B)) ao,   kS = F,
// where the prefiltered radiance and A, B are those of GGX (A, B with the geometry term that is chosen), whatever the
// distribution is, at the alpha whose GGX has the same peak. What it approximates, and the reference integrates, is the
// reflectance above with the k of image-based light.

#if defined(FACET_MATERIAL_MODELS_LECTURE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_MODELS_LECTURE_INL_H_
#undef FACET_MATERIAL_MODELS_LECTURE_INL_H_
#else
#define FACET_MATERIAL_MODELS_LECTURE_INL_H_
#endif

#include "material/models/lecture_abc.h"
#include "material/models/lecture_terms-inl.h"
#include "material/models/own_model-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// D, and the parameter of the geometry term.
template <class T>
struct LectureMicrofacets {
  T roughness{};             // [0, 1]
  T alpha{};                 // of the GGX with the same peak: 1 / (pi alpha^2) is D at the normal
  T exponent{};              // of Blinn and Phong's terms
  T perceptual_roughness{};  // the square root of alpha, for image-based light: 0 for a mirror

  FACET_INLINE LectureMicrofacets() {}

  FACET_INLINE LectureMicrofacets(const LectureParameters& p, T stated_roughness) {
    constexpr float kLeast = kMinPerceptualRoughness * kMinPerceptualRoughness;
    const auto bounded = [](T value) HWY_ATTR { return Clamp(value, T(kLeast), T(1.0f)); };
    roughness = Clamp(stated_roughness, T(0.0f), T(1.0f));
    const bool is_root = p.alpha == LectureAlpha::Roughness;
    alpha = bounded(is_root ? roughness : roughness * roughness);
    perceptual_roughness = is_root ? Sqrt(roughness) : roughness;
    const bool is_cosine_lobe =
        p.specular == LectureSpecular::BlinnPhong ||
        (p.specular == LectureSpecular::CookTorrance && p.distribution == LectureDistribution::BlinnPhong);
    if (is_cosine_lobe) {
      // A stated exponent has the bound that follows from alpha's.
      exponent = p.exponent == LectureExponent::AlphaP ? T(std::min(p.alpha_p, 2.0f / (kLeast * kLeast) - 2.0f))
                                                       : T(2.0f) / (alpha * alpha) - T(2.0f);
      if (p.exponent == LectureExponent::AlphaP) {
        alpha = bounded(Sqrt(T(2.0f) / (exponent + T(2.0f))));
        perceptual_roughness = Sqrt(alpha);
      }
    } else if (p.specular == LectureSpecular::CookTorrance && p.distribution == LectureDistribution::Abc) {
      const double integral = AbcIntegral(double{BoundedAlpha1(p.alpha1)}, double{p.alpha2});
      constexpr double kTwoPi = 6.28318530717958648;
      abc_peak_ = FromHost(1.0 / (kTwoPi * integral));
      alpha = bounded(Sqrt(FromHost(2.0 * integral)));
      perceptual_roughness = Sqrt(alpha);
    }
  }

  // D of the half vector.
  FACET_INLINE T Distribution(const LectureParameters& p, const Vec3<T>& normal, const Vec3<T>& half) const {
    const Vec3<T> cross = Cross(normal, half);
    const T n_dot_h = Clamp(Dot(normal, half), T(0.0f), T(1.0f)), sin2 = Dot(cross, cross);
    switch (p.distribution) {
      case LectureDistribution::Ggx: return DistributionGgx(n_dot_h, sin2, alpha);
      case LectureDistribution::Beckmann: return DistributionBeckmann(n_dot_h, sin2, alpha);
      case LectureDistribution::BlinnPhong: return DistributionBlinnPhong(n_dot_h, sin2, exponent);
      case LectureDistribution::Abc:
        return DistributionAbc(n_dot_h, sin2, T(BoundedAlpha1(p.alpha1)), T(p.alpha2), abc_peak_);
    }
    return T(0.0f);
  }

  // G / (4 n.l n.v). `of_image`: for image-based light.
  FACET_INLINE T Visibility(const LectureParameters& p, T n_dot_l, T n_dot_v, bool of_image) const {
    if (p.geometry == LectureGeometry::SchlickGgx) {
      const T one_more = roughness + T(1.0f);
      // With k = 0 the quotient would be infinite at the horizon.
      const T k = of_image ? Max(roughness * roughness * T(0.5f), T(1e-6f)) : one_more * one_more * T(0.125f);
      return VisibilitySchlick(n_dot_l, n_dot_v, k);
    }
    const bool is_gaussian =
        p.distribution == LectureDistribution::Beckmann || p.distribution == LectureDistribution::BlinnPhong;
    return is_gaussian ? VisibilitySmithBeckmann(n_dot_l, n_dot_v, alpha) : VisibilitySmith(n_dot_l, n_dot_v, alpha);
  }

 private:
  static FACET_INLINE T FromHost(double value) {
    if constexpr (std::is_same_v<T, double>) {
      return value;
    } else {
      return T(static_cast<float>(value));
    }
  }

  T abc_peak_{};
};

template <class T>
struct LectureScattering {
  const LectureParameters* choice = nullptr;
  Vec3<T> normal{}, view{}, diffuse_color{}, emission{};
  Vec3<T> f0{};              // of the mixture
  Vec3<T> dielectric_ior{};  // of the exact equations
  T coverage{}, n_dot_v{}, metalness{}, occlusion{};
  LectureMicrofacets<T> microfacets;

  FACET_INLINE LectureScattering() {}  // see MaterialInputs

  // F, where the light and the view have the cosine v.h with the microfacet.
  FACET_INLINE Vec3<T> Fresnel(T v_dot_h) const {
    const LectureParameters& p = *choice;
    if (p.specular == LectureSpecular::None) return {};
    if (p.fresnel == LectureFresnel::Schlick) return FresnelSchlick(f0, v_dot_h);
    const auto exact = [&](T ior, float eta, float k) HWY_ATTR {
      return Mix(FresnelDielectric(ior, v_dot_h), FresnelConductor(T(eta), T(k), v_dot_h), metalness);
    };
    return {exact(dielectric_ior.x, p.eta.x, p.k.x), exact(dielectric_ior.y, p.eta.y, p.k.y),
            exact(dielectric_ior.z, p.eta.z, p.k.z)};
  }

  // The specular term without F.
  FACET_INLINE T Specular(const Incidence<T>& from, bool of_image) const {
    const LectureParameters& p = *choice;
    if (p.specular == LectureSpecular::None) return T(0.0f);
    if (p.specular == LectureSpecular::CookTorrance) {
      return microfacets.Distribution(p, normal, from.half) *
             microfacets.Visibility(p, from.n_dot_l, n_dot_v, of_image);
    }
    const Vec3<T> cross = Cross(normal, from.half);
    const T n_dot_h = Clamp(Dot(normal, from.half), T(0.0f), T(1.0f));
    return (microfacets.exponent + T(8.0f)) * T(0.125f * kInversePi) *
           CosineLobe(n_dot_h, Dot(cross, cross), microfacets.exponent);
  }

  // kD times the diffuse colour.
  FACET_INLINE Vec3<T> Diffuse(const Vec3<T>& k_s) const {
    const T zero(0.0f), one(1.0f), dielectric = one - metalness;  // F may exceed 1 by its rounding
    return {diffuse_color.x * (Max(one - k_s.x, zero) * dielectric),
            diffuse_color.y * (Max(one - k_s.y, zero) * dielectric),
            diffuse_color.z * (Max(one - k_s.z, zero) * dielectric)};
  }

  FACET_INLINE Vec3<T> Reflected(const Vec3<T>& direction, bool of_image) const {
    const Incidence<T> from = IncidenceFrom(SurfaceView<T>{normal, view, n_dot_v}, direction);
    const Vec3<T> fresnel = Fresnel(from.v_dot_h);
    const Vec3<T> brdf = Diffuse(fresnel) * T(kInversePi) + fresnel * Specular(from, of_image);
    return Select<T>(from.n_dot_l > T(0.0f), brdf * from.n_dot_l, Vec3<T>{});
  }

  FACET_INLINE Vec3<T> Emission() const { return emission; }

  template <class Lighting>
  FACET_INLINE Vec3<T> Direct(const Vec3<T>& direction, const Lighting&) const {
    return Reflected(direction, /*of_image=*/false);
  }

  template <class Lighting>
  FACET_INLINE Vec3<T> Environment(const Lighting& lighting) const {
    const LectureParameters& p = *choice;
    if (p.ambient == LectureAmbient::Constant) return {};
    Vec3<T> k_s{}, radiance{};
    if (p.specular != LectureSpecular::None) {
      const auto with_roughness = [&](T f)
                                      HWY_ATTR { return FresnelSchlickRoughness(f, microfacets.roughness, n_dot_v); };
      k_s = {with_roughness(f0.x), with_roughness(f0.y), with_roughness(f0.z)};
      const Vec3<T> mirror = normal * (T(2.0f) * Dot(normal, view)) - view;
      const T roughness = microfacets.perceptual_roughness;
      const T bounded_roughness = Max(roughness, T(kMinPerceptualRoughness));
      const SpecularAlbedo<T> dfg = p.geometry == LectureGeometry::SchlickGgx
                                        ? lighting.SchlickDfg(p.alpha, n_dot_v, bounded_roughness)
                                        : lighting.Dfg(n_dot_v, bounded_roughness);
      const Vec3<T> albedo{k_s.x * dfg.a + dfg.b, k_s.y * dfg.a + dfg.b, k_s.z * dfg.a + dfg.b};
      radiance = lighting.Prefiltered(mirror, roughness) * albedo;
    }
    return (radiance + lighting.IrradianceOverPi(normal) * Diffuse(k_s)) * occlusion;
  }

  template <class Lighting>
  FACET_INLINE Vec3<T> FromEnvironment(const Vec3<T>& direction, const Lighting&) const {
    if (choice->ambient == LectureAmbient::Constant) return {};
    return Reflected(direction, /*of_image=*/true) * occlusion;
  }

  template <class Visit>
  FACET_INLINE void ForEachShape(const Visit& visit) const {
    visit(normal, microfacets.alpha);
  }
  FACET_INLINE bool TransmitsDiffusely() const { return false; }
};

struct Lecture : OwnModel<Lecture> {
  using Block = LectureParameters;

  template <class T, class Source, class Lighting>
  static FACET_INLINE LectureScattering<T> Make(const Source& from, const Vec4<T>& base, const Vec3<T>& view,
                                                const Lighting&) {
    const Block& p = from.template Parameters<Block>();
    const auto share = [](T value) HWY_ATTR { return Clamp(value, T(0.0f), T(1.0f)); };
    const auto color = [&](const Vec3<T>& c) HWY_ATTR { return Vec3<T>{share(c.x), share(c.y), share(c.z)}; };
    LectureScattering<T> s;
    s.choice = &p;
    s.view = view;
    s.normal = ReadParameter<T>(from, p.normal, SlotOf(&Block::normal));
    s.n_dot_v = Clamp(Dot(s.normal, view), T(kMinNDotV), T(1.0f));
    s.coverage = base.w;
    s.occlusion = ReadParameter<T>(from, p.ambient_occlusion, SlotOf(&Block::ambient_occlusion));
    if (from.Has(kEmission)) s.emission = ReadParameter<T>(from, p.emission, SlotOf(&Block::emission));

    const Vec3<T> albedo = color(Xyz(base));
    if (p.diffuse == LectureDiffuse::Lambert) s.diffuse_color = albedo;
    if (p.ambient == LectureAmbient::Constant) s.emission += albedo * (T(p.ambient_light) * s.occlusion);

    const LecturePresetRow& preset = PresetOf(p.f0_preset);
    const Vec3<T> of_preset{T(preset.linear[0]), T(preset.linear[1]), T(preset.linear[2])};
    T roughness{};
    if (p.workflow == LectureWorkflow::SpecularGlossiness) {
      roughness = T(1.0f) - ReadParameter<T>(from, p.glossiness, SlotOf(&Block::glossiness));
      Textured<glm::vec3> specular = p.specular_color;
      if (p.f0_preset != LecturePreset::None) {
        specular.value = {preset.linear[0], preset.linear[1], preset.linear[2]};
      }
      s.f0 = color(ReadParameter<T>(from, specular, SlotOf(&Block::specular_color)));
      if (p.fresnel == LectureFresnel::Exact) s.dielectric_ior = {IorOf(s.f0.x), IorOf(s.f0.y), IorOf(s.f0.z)};
    } else {
      roughness = ReadParameter<T>(from, p.roughness, SlotOf(&Block::roughness));
      s.metalness = share(ReadParameter<T>(from, p.metalness, SlotOf(&Block::metalness)));
      const bool is_stated = p.f0_preset != LecturePreset::None;
      const bool is_metal = preset.kind == LecturePresetRow::Kind::Metal;
      const Vec3<T> dielectric = is_stated && !is_metal ? of_preset : Vec3<T>{T(p.f0), T(p.f0), T(p.f0)};
      s.f0 = Mix(dielectric, is_metal ? of_preset : albedo, s.metalness);
      s.dielectric_ior = {T(p.ior), T(p.ior), T(p.ior)};
    }
    s.microfacets = LectureMicrofacets<T>(p, roughness);
    // Image-based light takes F0 from the exact equations at normal incidence.
    if (p.fresnel == LectureFresnel::Exact) s.f0 = s.Fresnel(T(1.0f));
    return s;
  }

 private:
  // The index of refraction of a dielectric in air with this F0. An F0 of 1 has an infinite one.
  template <class T>
  static FACET_INLINE T IorOf(T f0) {
    const T root = Sqrt(Min(f0, T(0.999f)));
    return (T(1.0f) + root) / (T(1.0f) - root);
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
