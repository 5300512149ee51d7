// Reading a material at one point: factors times textures. The rasterizer and the reference share it, and differ in how
// they sample. A Source provides:
//   bool Has(MaterialFeatures) const;
//   const MaterialFactors& Factors() const;
//   template <class Block> const Block& Parameters() const;   // of models that are not glTF's
//   template <int kChannels> Vec4<T> Read(Slot) const;   // the texture, if Has(BitOf(slot))
//   Vec3<T> Normal() const;                              // of the surface, unit
//   Vec3<T> InterpolatedNormal() const;                  // not normalised
//   Vec4<T> Tangent() const;                             // not normalised; w is the handedness
//   UvFootprint<T> FirstUv() const;                      // TEXCOORD_0, of materials with kFlakes
//   T MetresPerUnit() const;                             // Surface::metres_per_unit, if Has(kVolume)
//   T FootprintAlpha2() const;                           // Surface::footprint_alpha2; may be left out where it is 0

#if defined(FACET_MATERIAL_READ_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_READ_INL_H_
#undef FACET_MATERIAL_READ_INL_H_
#else
#define FACET_MATERIAL_READ_INL_H_
#endif

#include "material/closure-inl.h"
#include "material/parameters.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// Texture coordinates and their derivatives over one pixel to the right and down; zero for a point of the reference.
template <class T>
struct UvFootprint {
  Vec2<T> uv, dx, dy;
};

// The surface's normal, perturbed by a texture in tangent space. As MikkTSpace demands, the bitangent is computed per
// fragment from the interpolated vectors, without normalising them.
template <class T, class Source>
FACET_INLINE Vec3<T> MappedNormal(const Source& from, Slot slot, float normal_scale) {
  if (!from.Has(BitOf(slot))) return from.Normal();
  const Vec4<T> texel = from.template Read<kRgb>(slot);
  const T scale(normal_scale);
  const Vec3<T> n{(texel.x * T(2.0f) - T(1.0f)) * scale, (texel.y * T(2.0f) - T(1.0f)) * scale,
                  texel.z * T(2.0f) - T(1.0f)};
  const Vec3<T> tangent = Xyz(from.Tangent());
  const Vec3<T> bitangent = Cross(from.InterpolatedNormal(), tangent) * from.Tangent().w;
  return NormalizeOr(tangent * n.x + bitangent * n.y + from.InterpolatedNormal() * n.z, from.Normal());
}

// For materials that emit.
template <class T, class Source>
FACET_INLINE Vec3<T> ReadEmission(const Source& from) {
  const float* const factor = from.Factors().emissive;
  Vec3<T> e{T(factor[0]), T(factor[1]), T(factor[2])};
  if (from.Has(BitOf(Slot::Emissive))) e = e * Xyz(from.template Read<kRgb>(Slot::Emissive));
  return e;
}

// A factor times one channel of a texture.
template <int kChannel, class T, class Source>
FACET_INLINE T ReadFactor(const Source& from, float factor, Slot slot) {
  if (!from.Has(BitOf(slot))) return T(factor);
  const Vec4<T> texel = from.template Read<kChannel>(slot);
  return T(factor) * (kChannel == kR ? texel.x : kChannel == kG ? texel.y : kChannel == kB ? texel.z : texel.w);
}
template <class T, class Source>
FACET_INLINE Vec3<T> ReadColor(const Source& from, const float (&factor)[3], Slot slot) {
  const Vec3<T> color{T(factor[0]), T(factor[1]), T(factor[2])};
  return from.Has(BitOf(slot)) ? color * Xyz(from.template Read<kRgb>(slot)) : color;
}

// The dielectric's reflectance (KHR_materials_specular, KHR_materials_ior).
template <class T, class Source>
FACET_INLINE Interface<T> ReadDielectric(const Source& from) {
  const MaterialFactors& f = from.Factors();
  const T specular = ReadFactor<kA, T>(from, f.specular, Slot::Specular), one(1.0f), f0(f.dielectric_f0);
  const Vec3<T> color = ReadColor<T>(from, f.specular_color, Slot::SpecularColor);
  return {{Min(f0 * color.x, one) * specular, Min(f0 * color.y, one) * specular, Min(f0 * color.z, one) * specular},
          specular};
}

template <class T, class Source>
FACET_INLINE ClearcoatInputs<T> ReadClearcoat(const Source& from) {
  const MaterialFactors& f = from.Factors();
  return {ReadFactor<kR, T>(from, f.clearcoat, Slot::Clearcoat),
          ReadFactor<kG, T>(from, f.clearcoat_perceptual_roughness, Slot::ClearcoatRoughness),
          MappedNormal<T>(from, Slot::ClearcoatNormal, f.clearcoat_normal_scale)};
}

template <class T, class Source>
FACET_INLINE FilmInputs<T> ReadFilm(const Source& from) {
  const MaterialFactors& f = from.Factors();
  T thickness(f.film_thickness_maximum_nm);
  if (from.Has(BitOf(Slot::IridescenceThickness))) {
    thickness = Mix(T(f.film_thickness_minimum_nm), thickness, from.template Read<kG>(Slot::IridescenceThickness).y);
  }
  return {ReadFactor<kR, T>(from, f.iridescence, Slot::Iridescence), T(f.iridescence_ior), thickness};
}

// The direction (x, y) of tangent space, perpendicular to the shading normal: unit. Where the surface has no tangent,
// any direction takes its place.
template <class T, class Source>
FACET_INLINE Vec3<T> TurnedTangent(const Source& from, const Vec3<T>& normal, T x, T y) {
  const Vec3<T> along = Xyz(from.Tangent());
  const Vec3<T> across = Cross(from.InterpolatedNormal(), along) * from.Tangent().w;
  const Vec3<T> direction = along * x + across * y;
  const T zero(0.0f), one(1.0f);
  const auto is_steep = Abs(normal.y) < T(0.9f);
  const Vec3<T> other = NormalizeOr(
      Cross(Select<T>(is_steep, Vec3<T>{zero, one, zero}, Vec3<T>{one, zero, zero}), normal), Vec3<T>{one, zero, zero});
  return NormalizeOr(direction - normal * Dot(normal, direction), other);
}

// `normal`: the shading normal, unit.
template <class T, class Source>
FACET_INLINE AnisotropyInputs<T> ReadAnisotropy(const Source& from, const Vec3<T>& normal) {
  const MaterialFactors& f = from.Factors();
  T x(f.anisotropy_direction[0]), y(f.anisotropy_direction[1]), strength(f.anisotropy);
  if (from.Has(BitOf(Slot::Anisotropy))) {
    const Vec4<T> texel = from.template Read<kRgb>(Slot::Anisotropy);
    const T u = texel.x * T(2.0f) - T(1.0f), v = texel.y * T(2.0f) - T(1.0f), cosine = x, sine = y;
    x = cosine * u - sine * v;
    y = sine * u + cosine * v;
    strength = strength * texel.z;
  }
  const T zero(0.0f), one(1.0f);
  const Vec3<T> tangent = TurnedTangent<T>(from, normal, x, y);
  return {tangent, Cross(normal, tangent), Clamp(strength, zero, one)};
}

template <class T, class Source>
FACET_INLINE VolumeInputs<T> ReadVolume(const Source& from) {
  const MaterialFactors& f = from.Factors();
  const T thickness = ReadFactor<kG, T>(from, f.thickness, Slot::Thickness) * from.MetresPerUnit();
  return {Min(thickness, T(1e30f)), {T(f.absorption[0]), T(f.absorption[1]), T(f.absorption[2])}};
}

// `base`: the base colour with its alpha. `features`: of the material. `kPossible`: those of its lobes that are read.
template <class T, MaterialFeatures kPossible = kAllLobes, class Source>
FACET_INLINE MaterialInputs<T> ReadInputs(const Source& from, const Vec4<T>& base, MaterialFeatures features) {
  const MaterialFactors& f = from.Factors();
  T metallic(f.metallic), perceptual_roughness(f.perceptual_roughness), occlusion(1.0f);
  if (from.Has(BitOf(Slot::MetallicRoughness))) {
    const Vec4<T> texel = from.template Read<kG | kB>(Slot::MetallicRoughness);
    perceptual_roughness = perceptual_roughness * texel.y;
    metallic = metallic * texel.z;
  }
  if (from.Has(BitOf(Slot::Occlusion))) {
    occlusion = occlusion + T(f.occlusion_strength) * (from.template Read<kR>(Slot::Occlusion).x - T(1.0f));
  }
  const Vec3<T> emissive = from.Has(kEmission) ? ReadEmission<T>(from) : Vec3<T>{T(0.0f), T(0.0f), T(0.0f)};
  MaterialInputs<T> in{};
  in.base_color = Xyz(base);
  in.alpha_coverage = base.w;
  in.metallic = metallic;
  in.perceptual_roughness = perceptual_roughness;
  in.normal = MappedNormal<T>(from, Slot::Normal, f.normal_scale);
  in.occlusion = occlusion;
  in.emissive = emissive;
  in.lobes = features;
  const auto has = [&](MaterialFeatures lobe) HWY_ATTR { return (kPossible & lobe) != 0 && (features & lobe) != 0; };
  if (has(kSpecular | kIor)) in.dielectric = ReadDielectric<T>(from);
  if (has(kClearcoat)) in.clearcoat = ReadClearcoat<T>(from);
  if (has(kSheen)) {
    in.sheen = {ReadColor<T>(from, f.sheen_color, Slot::SheenColor),
                ReadFactor<kA, T>(from, f.sheen_perceptual_roughness, Slot::SheenRoughness)};
  }
  if (has(kIridescence)) in.film = ReadFilm<T>(from);
  if (has(kAnisotropy)) in.anisotropy = ReadAnisotropy<T>(from, in.normal);
  if (has(kVolume)) in.volume = ReadVolume<T>(from);
  if (has(kTransmission)) {
    in.transmission = {ReadFactor<kR, T>(from, f.transmission, Slot::Transmission),
                       {T(f.ior[0]), T(f.ior[1]), T(f.ior[2])}};
  }
  if (has(kDiffuseTransmission)) {
    in.diffuse_transmission = {ReadFactor<kA, T>(from, f.diffuse_transmission, Slot::DiffuseTransmission),
                               ReadColor<T>(from, f.diffuse_transmission_color, Slot::DiffuseTransmissionColor)};
  }
  return in;
}

// Replaces what the specular-glossiness model reads otherwise: a dielectric whose F0 is a colour.
template <class T, class Source>
FACET_INLINE void SetSpecularGlossiness(const Source& from, MaterialInputs<T>& in) {
  const MaterialFactors& f = from.Factors();
  const float* const specular = f.specular_glossiness_specular;
  Vec3<T> f0{T(specular[0]), T(specular[1]), T(specular[2])};
  T glossiness(f.glossiness);
  if (from.Has(BitOf(Slot::SpecularGlossiness))) {
    const Vec4<T> texel = from.template Read<kRgba>(Slot::SpecularGlossiness);
    f0 = f0 * Xyz(texel);
    glossiness = glossiness * texel.w;
  }
  in.metallic = T(0.0f);
  in.perceptual_roughness = T(1.0f) - glossiness;
  in.dielectric = {f0, T(1.0f)};
  in.lobes = in.lobes | kIor | kDiffuseLobe;
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
