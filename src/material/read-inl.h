// Reading a material at one point: factors times textures. The rasterizer and the reference share it, and differ in how
// they sample. A Source provides:
//   bool Has(MaterialFeatures) const;
//   const MaterialFactors& Factors() const;
//   template <int kChannels> Vec4<T> Read(Slot) const;   // the texture, if Has(BitOf(slot))
//   Vec3<T> Normal() const;                              // of the surface, unit
//   Vec3<T> InterpolatedNormal() const;                  // not normalised
//   Vec4<T> Tangent() const;                             // not normalised; w is the handedness

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

// The surface's normal, perturbed by a texture in tangent space. As MikkTSpace demands, the bitangent is computed per
// fragment from the interpolated vectors, without normalising them.
template <class T, class Source>
HWY_INLINE Vec3<T> MappedNormal(const Source& from, Slot slot, float normal_scale) {
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
HWY_INLINE Vec3<T> ReadEmission(const Source& from) {
  const float* const factor = from.Factors().emissive;
  Vec3<T> e{T(factor[0]), T(factor[1]), T(factor[2])};
  if (from.Has(BitOf(Slot::Emissive))) e = e * Xyz(from.template Read<kRgb>(Slot::Emissive));
  return e;
}

// `base`: the base colour with its alpha. `features`: of the material.
template <class T, class Source>
HWY_INLINE MaterialInputs<T> ReadInputs(const Source& from, const Vec4<T>& base, MaterialFeatures features) {
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
  return {Xyz(base), base.w,   metallic, perceptual_roughness, MappedNormal<T>(from, Slot::Normal, f.normal_scale),
          occlusion, emissive, features};
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
