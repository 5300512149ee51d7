// The model "enterprise": DSPBR, the Dassault Systèmes Enterprise PBR Shading Model, versions 2025x and 2022x
// (https://github.com/DassaultSystemes-Technology/EnterprisePBRShadingModel, spec-2025x). From the top:
//
//   clear coat             facet's lobe
//   flakes                 enterprise/flakes-inl.h: opaque or absent, over all that is below
//   sheen, thin film,      facet's closure: the mixture of a metal, an opaque and a transparent dielectric has the same
//   core                   reflectances, (1 - m) F0 s tint + m albedo and (1 - m) s + m
//   medium                 what it scatters leaves the surface as diffuse light (AddSubsurface())
//
// docs/models/enterprise.md says where facet's lobes differ from the specification's.

#if defined(FACET_MATERIAL_MODELS_ENTERPRISE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_MODELS_ENTERPRISE_INL_H_
#undef FACET_MATERIAL_MODELS_ENTERPRISE_INL_H_
#else
#define FACET_MATERIAL_MODELS_ENTERPRISE_INL_H_
#endif

#include "material/models/enterprise/inputs-inl.h"
#include "material/models/seen_through-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

template <class T>
struct EnterpriseScattering {
  MaterialInputs<T> in;
  ClearcoatLobe<T> coat;
  bool has_coat, has_flakes;
  Closure<T> closure;  // of what lies under the coat and the flakes
  FlakeLayer<T> flakes;
  Vec3<T> normal, view;
  T coverage{};

  // `inputs`: of the same source, with the coat.
  template <class Source, class Lighting>
  FACET_INLINE EnterpriseScattering(const Source& from, const MaterialInputs<T>& inputs, const Vec3<T>& towards_eye,
                                    const Lighting& lighting)
      : in(inputs),
        has_coat(from.Has(kClearcoat)),
        has_flakes(from.Has(kFlakes)),
        closure(WithoutCoat(in), towards_eye, lighting),
        normal(in.normal),
        view(towards_eye),
        coverage(in.alpha_coverage) {
    const EnterpriseParameters& p = from.template Parameters<EnterpriseParameters>();
    if (has_coat) coat = ClearcoatLobe<T>(in.clearcoat, in.footprint_alpha2, view, lighting);
    if (has_flakes) flakes = FlakeLayer<T>(ReadFlakes<T>(from, p, normal), closure.at);
    if (closure.Has(kTransmission) && closure.Has(kAnisotropy)) SetMeanRoughnessOfTransmission(lighting);
    if (closure.Has(kTransmission) && closure.Has(kVolume) && p.subsurface_color != glm::vec3(0.0f)) {
      AddSubsurface(ToVec3<T>(p.subsurface_color));
    }
  }

  FACET_INLINE Vec3<T> Emission() const { return has_coat ? in.emissive * coat.EnergyLeft() : in.emissive; }

  template <class Lighting>
  FACET_INLINE Vec3<T> Direct(const Vec3<T>& direction, const Lighting& lighting) const {
    Vec3<T> value = EvaluateClosure(closure, direction, lighting);
    if (has_flakes) value = value * (T(1.0f) - flakes.Share()) + flakes.Direct(closure.at, direction);
    if (has_coat) {
      const T reflected = coat.Direct(direction, lighting);
      value = value * coat.EnergyLeft() + Vec3<T>{reflected, reflected, reflected};
    }
    return value;
  }

  template <class Lighting>
  FACET_INLINE Vec3<T> Environment(const Lighting& lighting) const {
    Vec3<T> radiance = EvaluateEnvironment(closure, in, lighting);
    if (has_flakes) radiance = radiance * (T(1.0f) - flakes.Share()) + flakes.Environment(closure.at, lighting);
    if (has_coat) {
      radiance = radiance * coat.EnergyLeft() +
                 coat.Environment(in.clearcoat.perceptual_roughness, in.footprint_alpha2, lighting);
    }
    return radiance;
  }

  template <class Lighting>
  FACET_INLINE Vec3<T> FromEnvironment(const Vec3<T>& direction, const Lighting& lighting) const {
    return Direct(direction, lighting);
  }

  // What is seen through the surface is multiplied by this.
  FACET_INLINE Vec3<T> Tint() const {
    if (!closure.Has(kTransmission)) return Vec3<T>{};
    Vec3<T> tint = closure.transmission.color;
    if (has_flakes) tint = tint * (T(1.0f) - flakes.Share());
    if (has_coat) tint = tint * coat.EnergyLeft();
    return tint;
  }

  // The BTDF times the cosine, for a light behind the surface.
  template <class Lighting>
  FACET_INLINE Vec3<T> Transmitted(const Vec3<T>& direction, const Lighting& lighting) const {
    return Tint() * closure.transmission.Direct(closure.at, direction, lighting);
  }

  template <class Visit>
  FACET_INLINE void ForEachShape(const Visit& visit) const {
    if (closure.Has(kAnisotropy)) {
      visit(closure.anisotropic.tangent, closure.anisotropic.bitangent, normal, closure.anisotropic.alpha_t,
            closure.anisotropic.alpha_b);
    } else {
      visit(normal, closure.microfacets.alpha);
    }
    if (has_flakes) {
      visit(normal, flakes.widths.whole);
      visit(flakes.flake_normal, flakes.widths.cone);
    }
    if (has_coat) visit(coat.at.normal, coat.microfacets.alpha);
  }
  FACET_INLINE bool TransmitsDiffusely() const { return closure.Has(kDiffuseTransmission); }

 private:
  static FACET_INLINE MaterialInputs<T> WithoutCoat(MaterialInputs<T> in) {
    in.lobes = in.lobes & ~MaterialFeatures{kClearcoat};
    return in;
  }

  // The lobe of transmission is equally wide in all directions: its roughness is the mean of both, by the areas.
  template <class Lighting>
  FACET_INLINE void SetMeanRoughnessOfTransmission(const Lighting& lighting) {
    const Vec3<T> color = closure.transmission.color;
    const T mean = Sqrt(Sqrt(closure.anisotropic.alpha_t * closure.anisotropic.alpha_b));
    closure.transmission = TransmissionLobe<T>(in.transmission, closure.at, in.base_color, in.metallic, mean, lighting);
    closure.transmission.color = color;
  }

  // Light that the medium deflects, 1 - exp(-tau), comes back as diffuse light of the medium's colour. Of a thin medium
  // one half leaves it on the other side, of a thick one 1 / (3/4 tau), as two streams have it; between them,
  // 1 / (2 + 3/4 tau).
  FACET_INLINE void AddSubsurface(const Vec3<T>& color) {
    const T zero(0.0f), one(1.0f);
    const TransmissionInputs<T>& t = in.transmission;
    const T amount = Clamp(t.factor, zero, one) * (one - Clamp(in.metallic, zero, one));
    const Vec3<T> passing = in.volume.Passing();
    const auto behind = [&](T absorption) HWY_ATTR {
      return one / (T(2.0f) + T(0.75f) * Min(absorption * in.volume.thickness, T(1e6f)));
    };
    const Vec3<T> through{behind(in.volume.absorption.x), behind(in.volume.absorption.y),
                          behind(in.volume.absorption.z)};
    const Vec3<T> all{one, one, one};
    const Vec3<T> scattered = color * in.base_color * (all - passing) * amount;
    closure.diffuse.color += scattered * (all - through);
    closure.diffuse_transmission.color += scattered * through;
  }
};

struct Enterprise : OwnModel<Enterprise> {
  using Block = EnterpriseParameters;

  template <class T, class Source, class Lighting>
  static FACET_INLINE EnterpriseScattering<T> Make(const Source& from, const Vec4<T>& base, const Vec3<T>& view,
                                                   const Lighting& lighting) {
    return EnterpriseScattering<T>(from, ReadEnterpriseInputs<T>(from, base), view, lighting);
  }

  template <class T, class Material, class Lighting>
  static FACET_INLINE ShadedThrough<T> Through(const Surface<T>& surface, const Material& material,
                                               const Lighting& lighting) {
    return material.Read(surface, [&](const auto& source, const Vec4<T>& base) HWY_ATTR {
      const EnterpriseScattering<T> s = Make<T>(source, base, surface.view, lighting);
      Vec3<T> radiance = s.Emission();
      if (lighting.HasEnvironment()) radiance += s.Environment(lighting);
      const int light_count = lighting.LightCount();
      for (int i = 0; i < light_count; ++i) {
        const LightSample<T> light = lighting.Sample(i, surface.position);
        Vec3<T> scattered = s.Direct(light.direction, lighting);
        if (s.closure.Has(kTransmission)) scattered += s.Transmitted(light.direction, lighting);
        radiance += scattered * light.irradiance;
      }
      ShadedThrough<T> out{};
      out.own = {radiance, s.coverage};
      if (s.closure.Has(kTransmission)) {
        out.tint = s.Tint();
        SetPaths(s.closure, s.in, out);
      }
      return out;
    });
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
