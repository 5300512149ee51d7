// What the models that are not glTF's share: how they read their parameters, and how they are lit.
//
// A model states `Block`, its parameter block, and how it scatters light at a point:
//   template <class T, class Source, class Lighting>
//   static Scattering<T> Make(const Source&, const Vec4<T>& base, const Vec3<T>& view, const Lighting&);
// where `base` is the base colour (BaseColor() of shade/material_view-inl.h) and Source is that of material/read-inl.h.
// The result has
//   Vec3<T> normal;                                       // shading normal, unit
//   T coverage;                                           // alpha
//   Vec3<T> Emission() const;                             // radiance that needs no light
//   Vec3<T> Direct(Vec3<T> direction, lighting) const;    // BSDF times cosine, for a punctual light
//   Vec3<T> Environment(lighting) const;                  // radiance from the environment, occlusion included
//   Vec3<T> FromEnvironment(Vec3<T> direction, lighting) const;  // what Environment() approximates: its integrand
//   void ForEachShape(visit) const;                       // visit(normal, alpha) for each specular lobe
//   bool TransmitsDiffusely() const;                      // whether light from behind counts
//   Shaded<T> Finish(Vec3<T> radiance) const;             // may be left out: what becomes of all its light
// The reference integrates FromEnvironment() over all directions; the last two say where it is large.

#if defined(FACET_MATERIAL_MODELS_OWN_MODEL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_MODELS_OWN_MODEL_INL_H_
#undef FACET_MATERIAL_MODELS_OWN_MODEL_INL_H_
#else
#define FACET_MATERIAL_MODELS_OWN_MODEL_INL_H_
#endif

#include "facet/shader/surface-inl.h"
#include "material/model_parameters.h"
#include "material/read-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// A texel. A function of its own, because models have dozens of textures.
template <int kChannels, class T, class Source>
HWY_NOINLINE Vec4<T> ReadTexel(const Source& from, Slot slot) {
  return from.template Read<kChannels>(slot);
}

// A number: its value times the texture's channel.
template <class T, class Source>
FACET_INLINE T ReadParameter(const Source& from, const Textured<float>& parameter, Slot slot) {
  const T value(parameter.value);
  if (!from.Has(BitOf(slot))) return value;
  switch (parameter.channel) {
    case 0: return value * ReadTexel<kR, T>(from, slot).x;
    case 1: return value * ReadTexel<kG, T>(from, slot).y;
    case 2: return value * ReadTexel<kB, T>(from, slot).z;
    default: return value * ReadTexel<kA, T>(from, slot).w;
  }
}

// A colour: its value times the texture.
template <class T, class Source>
FACET_INLINE Vec3<T> ReadParameter(const Source& from, const Textured<glm::vec3>& parameter, Slot slot) {
  const Vec3<T> value{T(parameter.value.x), T(parameter.value.y), T(parameter.value.z)};
  return from.Has(BitOf(slot)) ? value * Xyz(ReadTexel<kRgb, T>(from, slot)) : value;
}
template <class T, class Source>
FACET_INLINE Vec4<T> ReadParameter(const Source& from, const Textured<glm::vec4>& parameter, Slot slot) {
  const Vec4<T> value{T(parameter.value.x), T(parameter.value.y), T(parameter.value.z), T(parameter.value.w)};
  return from.Has(BitOf(slot)) ? value * ReadTexel<kRgba, T>(from, slot) : value;
}

// A direction given in tangent space, in world axes: unit.
template <class T, class Source>
FACET_INLINE Vec3<T> ReadParameter(const Source& from, const TangentSpaceNormal& parameter, Slot slot) {
  if (from.Has(BitOf(slot))) return MappedNormal<T>(from, slot, parameter.scale);
  const glm::vec3& value = parameter.value;
  if (value == glm::vec3(0.0f, 0.0f, 1.0f) || !from.Has(kTangents)) return from.Normal();
  const Vec3<T> tangent = Xyz(from.Tangent());
  const Vec3<T> bitangent = Cross(from.InterpolatedNormal(), tangent) * from.Tangent().w;
  return NormalizeOr(tangent * T(value.x) + bitangent * T(value.y) + from.InterpolatedNormal() * T(value.z),
                     from.Normal());
}

// The surface with all its light.
template <class Scattering, class T>
FACET_INLINE Shaded<T> FinishOwn(const Scattering& scattering, const Vec3<T>& radiance) {
  if constexpr (requires { scattering.Finish(radiance); }) {
    return scattering.Finish(radiance);
  } else {
    return {radiance, scattering.coverage};
  }
}

template <class Model>
struct OwnModel {
  template <class T, class Material, class Lighting>
  FACET_INLINE Shaded<T> operator()(const Surface<T>& surface, const Material& material,
                                    const Lighting& lighting) const {
    return With<kCore>(surface, material, lighting);
  }

  static constexpr MaterialFeatures kCore = 0;
  template <MaterialFeatures, class T, class Material, class Lighting>
  static FACET_INLINE Shaded<T> With(const Surface<T>& surface, const Material& material, const Lighting& lighting) {
    return material.Read(surface, [&](const auto& source, const Vec4<T>& base) HWY_ATTR {
      const auto scattering = Model::template Make<T>(source, base, surface.view, lighting);
      return FinishOwn(scattering, AllLight(scattering, surface.position, lighting));
    });
  }

  // Of the emission, the environment and the punctual lights.
  template <class Scattering, class T, class Lighting>
  static FACET_INLINE Vec3<T> AllLight(const Scattering& scattering, const Vec3<T>& position,
                                       const Lighting& lighting) {
    Vec3<T> radiance = scattering.Emission();
    if (lighting.HasEnvironment()) radiance += scattering.Environment(lighting);
    const int light_count = lighting.LightCount();
    for (int i = 0; i < light_count; ++i) {
      const LightSample<T> light = lighting.Sample(i, position);
      radiance += scattering.Direct(light.direction, lighting) * light.irradiance;
    }
    return radiance;
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
