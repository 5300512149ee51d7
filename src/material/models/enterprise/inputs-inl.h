// The parameters of the model "enterprise" at a point, as inputs of facet's closure (material/closure-inl.h), which
// evaluates all of its layers but the flakes.

#if defined(FACET_MATERIAL_MODELS_ENTERPRISE_INPUTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_MODELS_ENTERPRISE_INPUTS_INL_H_
#undef FACET_MATERIAL_MODELS_ENTERPRISE_INPUTS_INL_H_
#else
#define FACET_MATERIAL_MODELS_ENTERPRISE_INPUTS_INL_H_
#endif

#include "material/models/enterprise/flakes-inl.h"
#include "material/models/own_model-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

template <class T>
FACET_INLINE Vec3<T> ToVec3(const glm::vec3& v) {
  return {T(v.x), T(v.y), T(v.z)};
}

// Radiance: the colour, divided by its luminance if that is asked for, times value / pi. The plan has turned lumens
// into lumens per square metre.
template <class T, class Source>
FACET_INLINE Vec3<T> ReadEnterpriseEmission(const Source& from, const EnterpriseParameters& p) {
  using P = EnterpriseParameters;
  const Vec3<T> color = ReadParameter<T>(from, p.emission_color, SlotOf(&P::emission_color));
  const T value = T(p.emission_value) * T(kInversePi);
  if (!p.emission_energy_normalization) return color * value;
  // Divided by its largest component first, which keeps dark colours from underflowing.
  const T largest = MaxComponent(color);
  const Vec3<T> bright = color / Max(largest, T(1e-37f));
  const T luminance = Dot(bright, Vec3<T>{T(0.2126729f), T(0.7151522f), T(0.0721750f)});
  return bright * Select(largest > T(0.0f), value / Max(luminance, T(0.01f)), T(0.0f));
}

// The widths along and across the tangent are roughness^2 and (roughness (1 - anisotropy))^2. The lobe takes the
// roughness across the tangent, and the strength s for which (1 - s^2) across^2 + s^2 is the width along it. The turn
// is counter-clockwise about the normal, as the specification's text and its chart have it; its formula has the other
// sign.
template <class T, class Source>
FACET_INLINE void ReadEnterpriseAnisotropy(const Source& from, const EnterpriseParameters& p, MaterialInputs<T>& in) {
  using P = EnterpriseParameters;
  const T zero(0.0f), one(1.0f);
  const T amount = Clamp(ReadParameter<T>(from, p.anisotropy, SlotOf(&P::anisotropy)), zero, one);
  const T along = in.perceptual_roughness * in.perceptual_roughness;
  in.perceptual_roughness = in.perceptual_roughness * (one - amount);
  const T across = Max(in.perceptual_roughness, T(kMinPerceptualRoughness));
  const T narrow = across * across;
  const T square = (Max(along, narrow) - narrow) / Max(one - narrow, T(1e-6f));
  const T turn = ReadParameter<T>(from, p.anisotropy_rotation, SlotOf(&P::anisotropy_rotation)) * T(2.0f * kPi);
  in.anisotropy.tangent = TurnedTangent<T>(from, in.normal, Cos(turn), Sin(turn) * from.Tangent().w);
  in.anisotropy.bitangent = Cross(in.normal, in.anisotropy.tangent);
  in.anisotropy.strength = Sqrt(Clamp(square, zero, one));
}

template <class T, class Source>
FACET_INLINE FlakeInputs<T> ReadFlakes(const Source& from, const EnterpriseParameters& p, const Vec3<T>& normal) {
  using P = EnterpriseParameters;
  FlakeInputs<T> in{};
  in.at = from.FirstUv();
  in.metres_per_uv = T(p.texture_scale);
  in.coverage = ReadParameter<T>(from, p.flake_coverage, SlotOf(&P::flake_coverage));
  in.size_mm = ReadParameter<T>(from, p.flake_size, SlotOf(&P::flake_size));
  in.roughness = ReadParameter<T>(from, p.flake_roughness, SlotOf(&P::flake_roughness));
  in.flip_flop = ReadParameter<T>(from, p.flip_flop, SlotOf(&P::flip_flop));
  in.color = ReadParameter<T>(from, p.flake_color, SlotOf(&P::flake_color));
  in.flip_flop_color = ReadParameter<T>(from, p.flip_flop_color, SlotOf(&P::flip_flop_color));
  in.tangent = TurnedTangent<T>(from, normal, T(1.0f), T(0.0f));
  in.bitangent = Cross(normal, in.tangent);
  return in;
}

// How light passes into the surface and through it.
template <class T, class Source>
FACET_INLINE void ReadEnterprisePassing(const Source& from, const EnterpriseParameters& p, MaterialInputs<T>& in) {
  using P = EnterpriseParameters;
  const MaterialFactors& f = from.Factors();
  if (from.Has(kVolume)) {
    in.volume = {Min(T(f.thickness) * from.MetresPerUnit(), T(1e30f)),
                 {T(f.absorption[0]), T(f.absorption[1]), T(f.absorption[2])}};
  }
  if (from.Has(kTransmission)) {
    in.transmission = {ReadParameter<T>(from, p.transparency, SlotOf(&P::transparency)),
                       {T(f.ior[0]), T(f.ior[1]), T(f.ior[2])}};
  }
  if (from.Has(kDiffuseTransmission)) {
    const Vec3<T> color = p.profile == EnterpriseProfile::V2022x
                              ? in.base_color
                              : ReadParameter<T>(from, p.translucency_color, SlotOf(&P::translucency_color));
    in.diffuse_transmission = {ReadParameter<T>(from, p.translucency, SlotOf(&P::translucency)), color};
  }
}

// `base`: as BaseColor() of shade/material_view-inl.h has it.
template <class T, class Source>
FACET_INLINE MaterialInputs<T> ReadEnterpriseInputs(const Source& from, const Vec4<T>& base) {
  using P = EnterpriseParameters;
  const P& p = from.template Parameters<P>();
  MaterialInputs<T> in;
  in.base_color = Xyz(base);
  in.alpha_coverage = base.w;
  in.metallic = ReadParameter<T>(from, p.metallic, SlotOf(&P::metallic));
  in.perceptual_roughness = ReadParameter<T>(from, p.roughness, SlotOf(&P::roughness));
  in.normal = ReadParameter<T>(from, p.normal, SlotOf(&P::normal));
  in.occlusion = T(1.0f);
  in.footprint_alpha2 = from.FootprintAlpha2();
  in.lobes = 0;
  for (const MaterialFeatures bit : {kDiffuseLobe, kClearcoat, kSheen, kSpecular, kIor, kTransmission, kVolume,
                                     kDispersion, kDiffuseTransmission, kIridescence, kAnisotropy}) {
    if (from.Has(bit)) in.lobes |= bit;
  }
  if (from.Has(kEmission)) in.emissive = ReadEnterpriseEmission<T>(from, p);
  if (from.Has(kSpecular | kIor)) {
    const T strength = ReadParameter<T>(from, p.specular, SlotOf(&P::specular));
    const Vec3<T> tint = ReadParameter<T>(from, p.specular_tint, SlotOf(&P::specular_tint));
    in.dielectric = {tint * (T(from.Factors().dielectric_f0) * strength), strength};
  }
  if (from.Has(kClearcoat)) {
    in.clearcoat = {ReadParameter<T>(from, p.clearcoat, SlotOf(&P::clearcoat)),
                    ReadParameter<T>(from, p.clearcoat_roughness, SlotOf(&P::clearcoat_roughness)),
                    ReadParameter<T>(from, p.clearcoat_normal, SlotOf(&P::clearcoat_normal))};
  }
  if (from.Has(kSheen)) {
    in.sheen = {ReadParameter<T>(from, p.sheen_color, SlotOf(&P::sheen_color)),
                ReadParameter<T>(from, p.sheen_roughness, SlotOf(&P::sheen_roughness))};
  }
  if (from.Has(kIridescence)) {
    constexpr float kNanometres = 1000.0f;
    in.film = {ReadParameter<T>(from, p.thin_film, SlotOf(&P::thin_film)), T(p.thin_film_ior),
               ReadParameter<T>(from, p.thin_film_thickness, SlotOf(&P::thin_film_thickness)) * T(kNanometres)};
  }
  if (from.Has(kAnisotropy)) ReadEnterpriseAnisotropy(from, p, in);
  ReadEnterprisePassing(from, p, in);
  return in;
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
