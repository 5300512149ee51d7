// A surface of the model "filament" at one point, seen from one direction: its parameters in the form in which its
// shading models evaluate them.

#if defined(FACET_MATERIAL_MODELS_FILAMENT_SURFACE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_MODELS_FILAMENT_SURFACE_INL_H_
#undef FACET_MATERIAL_MODELS_FILAMENT_SURFACE_INL_H_
#else
#define FACET_MATERIAL_MODELS_FILAMENT_SURFACE_INL_H_
#endif

#include "material/lobes/iridescence-inl.h"
#include "material/models/filament/terms-inl.h"
#include "material/models/own_model-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {
namespace filament {

using Shading = FilamentParameters::Shading;
using Blending = FilamentParameters::Blending;

// The least roughness of fibres: kMinSheenRoughness, because of the rounding errors that their exponent multiplies.
template <class T>
struct FibreRoughness {
  T perceptual_roughness{}, alpha{}, inverse_alpha{};

  FACET_INLINE FibreRoughness() {}
  FACET_INLINE explicit FibreRoughness(T roughness)
      : perceptual_roughness(Clamp(roughness, T(kMinSheenRoughness), T(1.0f))) {
    alpha = AlphaFromPerceptualRoughness(perceptual_roughness);
    inverse_alpha = T(1.0f) / alpha;
  }
};

template <class T>
FACET_INLINE Vec3<T> Bounded(const Vec3<T>& v) {
  const T zero(0.0f), one(1.0f);
  return {Clamp(v.x, zero, one), Clamp(v.y, zero, one), Clamp(v.z, zero, one)};
}
template <class T>
FACET_INLINE T Bounded(T v) {
  return Clamp(v, T(0.0f), T(1.0f));
}
template <class T>
FACET_INLINE Vec3<T> Grey(T v) {
  return {v, v, v};
}

template <class T>
struct FilamentSurface {
  FACET_INLINE FilamentSurface() {}

  const FilamentParameters* block = nullptr;
  Shading shading = Shading::Lit;
  Blending blending = Blending::Opaque;  // never AlphaMode
  // Whether these layers are there; the same in all lanes.
  bool has_coat = false, has_sheen = false, is_anisotropic = false, refracts = false, has_subsurface = false,
       is_occluded = false;

  SurfaceView<T> at;
  Vec3<T> mirror{};          // unit, of the view
  Vec3<T> diffuse_normal{};  // along which diffuse light is looked up
  Vec3<T> base_color{};      // bounded to 1; multiplied by the coverage where blending says so
  T coverage{};
  Vec3<T> diffuse_color{}, f0{};
  T f90{};
  T unclamped_roughness{};  // perceptual, before the clear coat
  T perceptual_roughness{}, alpha{};
  SpecularAlbedo<T> albedo;  // of the microfacets
  Vec3<T> reflected{};       // E: of the microfacets, or of cloth's fibres
  Vec3<T> compensation{};    // of the energy that single scattering loses
  FilamentAnisotropy<T> anisotropy;
  Vec3<T> sheen_color{};
  FibreRoughness<T> sheen;
  T fibre_albedo{};  // of sheen or cloth, of colour 1: at most 1
  T fibre_scale{};   // 1 / max(1, E), so that fibres reflect no more than they receive
  SurfaceView<T> coat_at;
  T coat{}, coat_roughness{}, coat_alpha{}, coat_albedo{};  // of F = 1
  T occlusion{};                                            // the share that is visible
  Vec3<T> subsurface_color{};
  T subsurface_power{}, thickness{};
  T transmission{};
  Vec3<T> emission{};

  // The part of the light that sheen leaves to what is under it.
  FACET_INLINE T SheenLeft() const { return T(1.0f) - MaxComponent(sheen_color) * fibre_albedo; }
};

// Reads all but what only refraction needs. `base`: straight alpha.
template <class T, class Source>
class SurfaceReader {
 public:
  using Block = FilamentParameters;

  FACET_INLINE SurfaceReader(const Source& from, const Block& p) : from_(from), p_(p) {}

  template <class Lighting>
  FACET_INLINE FilamentSurface<T> Read(const Vec4<T>& base, const Vec3<T>& view, const Lighting& lighting) const {
    FilamentSurface<T> s;
    s.block = &p_;
    s.shading = from_.Has(kLit) ? p_.shading_model : Shading::Unlit;
    s.blending = BlendingOf();
    ReadColor(base, s);
    if (from_.Has(kEmission)) s.emission = ReadEmission(s);
    const Vec3<T> normal = ReadParameter<T>(from_, p_.normal, SlotOf(&Block::normal));
    s.at = {normal, view, Clamp(Dot(normal, view), T(kMinNDotV), T(1.0f))};
    if (s.shading == Shading::Unlit) return s;
    s.mirror = normal * (T(2.0f) * Dot(normal, view)) - view;
    const bool bends = p_.bent_normal != TangentSpaceNormal{};
    s.diffuse_normal = bends ? ReadParameter<T>(from_, p_.bent_normal, SlotOf(&Block::bent_normal)) : normal;
    s.is_occluded = p_.ambient_occlusion.value != 1.0f || from_.Has(BitOf(SlotOf(&Block::ambient_occlusion)));
    s.occlusion = Bounded(ReadParameter<T>(from_, p_.ambient_occlusion, SlotOf(&Block::ambient_occlusion)));
    if (s.shading == Shading::Cloth) {
      ReadCloth(s, lighting);
    } else {
      ReadMicrofacets(s, lighting);
    }
    return s;
  }

 private:
  FACET_INLINE Blending BlendingOf() const {
    const bool blends = from_.Has(kAlphaBlend);
    if (IsSeenThrough(p_) || (p_.blending == Blending::Transparent && blends)) return p_.blending;
    return blends ? Blending::Fade : Blending::Opaque;
  }

  FACET_INLINE void ReadColor(const Vec4<T>& base, FilamentSurface<T>& s) const {
    s.base_color = Bounded(Xyz(base));
    s.coverage = Bounded(base.w);
    if (s.blending != Blending::Opaque && s.blending != Blending::Fade) s.base_color = s.base_color * s.coverage;
  }

  FACET_INLINE Vec3<T> ReadEmission(const FilamentSurface<T>& s) const {
    const Vec4<T> e = ReadParameter<T>(from_, p_.emissive, SlotOf(&Block::emissive));
    const Vec3<T> radiance = Xyz(e) * Mix(T(1.0f / p_.exposure), T(1.0f), Bounded(e.w));
    return s.blending == Blending::Transparent ? radiance * s.coverage : radiance;
  }

  template <class Lighting>
  FACET_INLINE void ReadCloth(FilamentSurface<T>& s, const Lighting& lighting) const {
    s.diffuse_color = s.base_color;
    if (p_.sheen_color.value.x < 0.0f) {
      s.sheen_color = {Sqrt(s.base_color.x), Sqrt(s.base_color.y), Sqrt(s.base_color.z)};
    } else {
      s.sheen_color = Bounded(ReadParameter<T>(from_, p_.sheen_color, SlotOf(&Block::sheen_color)));
    }
    s.sheen = FibreRoughness<T>(ReadParameter<T>(from_, p_.roughness, SlotOf(&Block::roughness)));
    s.perceptual_roughness = s.sheen.perceptual_roughness;
    s.alpha = s.sheen.alpha;
    SetFibreAlbedo(s, lighting);
    s.reflected = s.sheen_color * s.fibre_albedo;
    s.f0 = s.sheen_color;
    s.compensation = Grey(T(1.0f));
    s.has_subsurface = p_.subsurface_color.value.x >= 0.0f;
    if (s.has_subsurface) {
      s.subsurface_color = Bounded(ReadParameter<T>(from_, p_.subsurface_color, SlotOf(&Block::subsurface_color)));
    }
  }

  template <class Lighting>
  static FACET_INLINE void SetFibreAlbedo(FilamentSurface<T>& s, const Lighting& lighting) {
    const T reflected = lighting.ClothAlbedo(s.at.n_dot_v, s.sheen.perceptual_roughness);
    s.fibre_albedo = Min(reflected, T(1.0f));
    s.fibre_scale = T(1.0f) / Max(reflected, T(1.0f));
  }

  template <class Lighting>
  FACET_INLINE void ReadMicrofacets(FilamentSurface<T>& s, const Lighting& lighting) const {
    const T one(1.0f);
    ReadReflectance(s);
    if (s.shading == Shading::Subsurface) {
      s.has_subsurface = true;
      s.subsurface_color = Grey(one);
      if (p_.subsurface_color.value.x >= 0.0f) {
        s.subsurface_color = Bounded(ReadParameter<T>(from_, p_.subsurface_color, SlotOf(&Block::subsurface_color)));
      }
      s.subsurface_power = ReadParameter<T>(from_, p_.subsurface_power, SlotOf(&Block::subsurface_power));
      s.thickness = Bounded(ReadParameter<T>(from_, p_.thickness, SlotOf(&Block::thickness)));
    } else {
      ReadLayers(s, lighting);
    }
    s.perceptual_roughness = Clamp(s.perceptual_roughness, T(kMinPerceptualRoughness), one);
    s.alpha = AlphaFromPerceptualRoughness(s.perceptual_roughness);
    s.albedo = lighting.Dfg(s.at.n_dot_v, s.perceptual_roughness);
    const T grazing = s.f90 * s.albedo.b;
    s.reflected = s.f0 * s.albedo.a + Grey(grazing);
    const T lost = one / Max(s.albedo.a + s.albedo.b, T(1e-4f)) - one;
    s.compensation = Grey(one) + s.f0 * lost;
    s.is_anisotropic = s.shading != Shading::Subsurface && p_.anisotropy.value != 0.0f;
    if (s.is_anisotropic) s.anisotropy = ReadAnisotropy(s);
  }

  // Its colours, and the roughness of the base.
  FACET_INLINE void ReadReflectance(FilamentSurface<T>& s) const {
    const T one(1.0f);
    if (s.shading == Shading::SpecularGlossiness) {
      s.f0 = Bounded(ReadParameter<T>(from_, p_.specular_color, SlotOf(&Block::specular_color)));
      s.diffuse_color = s.base_color * (one - MaxComponent(s.f0));
      s.f90 = GrazingReflectance(s.f0);
      s.perceptual_roughness = one - Bounded(ReadParameter<T>(from_, p_.glossiness, SlotOf(&Block::glossiness)));
    } else {
      const T metallic = Bounded(ReadParameter<T>(from_, p_.metallic, SlotOf(&Block::metallic)));
      const T dielectric = one - metallic;
      Vec3<T> f0 = Grey(DielectricF0());
      const bool scaled = ScalesReflectance();
      T f90 = one;
      if (scaled) {
        f90 = Bounded(ReadParameter<T>(from_, p_.specular_factor, SlotOf(&Block::specular_factor)));
        f0 = Bounded(f0 * ReadParameter<T>(from_, p_.specular_color_factor, SlotOf(&Block::specular_color_factor))) *
             f90;
      }
      s.diffuse_color = s.base_color * dielectric;
      s.f0 = s.base_color * metallic + f0 * dielectric;
      s.f90 = scaled ? metallic + f90 * dielectric : GrazingReflectance(s.f0);
      s.perceptual_roughness = Bounded(ReadParameter<T>(from_, p_.roughness, SlotOf(&Block::roughness)));
    }
    s.unclamped_roughness = s.perceptual_roughness;
    s.perceptual_roughness = OverPixel(s.perceptual_roughness);
    if (p_.iridescence.value != 0.0f) {
      const T thickness = ReadParameter<T>(from_, p_.iridescence_thickness, SlotOf(&Block::iridescence_thickness));
      const T factor = ReadParameter<T>(from_, p_.iridescence, SlotOf(&Block::iridescence));
      s.f0 = ThinFilm<T>({factor, T(p_.iridescence_ior), thickness}, s.at.n_dot_v).F0Over(s.f0);
    }
  }

  // Whether it has specular factors, which state its F90, too.
  FACET_INLINE bool ScalesReflectance() const {
    return p_.specular_factor.value != 1.0f || p_.specular_color_factor.value != glm::vec3(1.0f) ||
           from_.Has(BitOf(SlotOf(&Block::specular_factor)) | BitOf(SlotOf(&Block::specular_color_factor)));
  }

  // Widened by what the normal turns within the pixel.
  FACET_INLINE T OverPixel(T perceptual_roughness) const {
    if constexpr (requires { from_.FootprintAlpha2(); }) {
      return WidenedRoughness(perceptual_roughness, from_.FootprintAlpha2());
    } else {
      return perceptual_roughness;
    }
  }

  // By the index where one is stated and the reflectance is not.
  FACET_INLINE T DielectricF0() const {
    const bool stated = p_.reflectance.value != 0.5f || from_.Has(BitOf(SlotOf(&Block::reflectance)));
    if (p_.ior != 0.0f && !stated) return F0OfIndex(T(p_.ior));
    return F0OfReflectance(Bounded(ReadParameter<T>(from_, p_.reflectance, SlotOf(&Block::reflectance))));
  }

  // Sheen and clear coat, which change what is under them.
  template <class Lighting>
  FACET_INLINE void ReadLayers(FilamentSurface<T>& s, const Lighting& lighting) const {
    const T one(1.0f);
    s.has_sheen = HasFibres(p_);
    if (s.has_sheen) {
      s.sheen_color = Bounded(ReadParameter<T>(from_, p_.sheen_color, SlotOf(&Block::sheen_color)));
      s.sheen = FibreRoughness<T>(ReadParameter<T>(from_, p_.sheen_roughness, SlotOf(&Block::sheen_roughness)));
      SetFibreAlbedo(s, lighting);
    }
    s.refracts = from_.Has(kTransmission) && Refracts(p_);
    if (s.refracts) {
      s.transmission = Bounded(ReadParameter<T>(from_, p_.transmission, SlotOf(&Block::transmission)));
    }
    s.has_coat = p_.clear_coat.value != 0.0f;
    if (!s.has_coat) return;
    const Vec3<T> normal = ReadParameter<T>(from_, p_.clear_coat_normal, SlotOf(&Block::clear_coat_normal));
    s.coat_at = {normal, s.at.view, Clamp(Dot(normal, s.at.view), T(kMinNDotV), one)};
    s.coat = Bounded(ReadParameter<T>(from_, p_.clear_coat, SlotOf(&Block::clear_coat)));
    const T roughness = ReadParameter<T>(from_, p_.clear_coat_roughness, SlotOf(&Block::clear_coat_roughness));
    s.coat_roughness = Clamp(OverPixel(Bounded(roughness)), T(kMinPerceptualRoughness), one);
    s.coat_alpha = AlphaFromPerceptualRoughness(s.coat_roughness);
    const SpecularAlbedo<T> albedo = lighting.Dfg(s.coat_at.n_dot_v, s.coat_roughness);
    s.coat_albedo = albedo.a + albedo.b;
    if (p_.clear_coat_ior_change) s.f0 = Mix(s.f0, F0UnderCoat(s.f0), s.coat);
    s.perceptual_roughness = Mix(s.perceptual_roughness, Max(s.perceptual_roughness, s.coat_roughness), s.coat);
  }

  FACET_INLINE FilamentAnisotropy<T> ReadAnisotropy(const FilamentSurface<T>& s) const {
    const Slot slot = SlotOf(&Block::anisotropy_direction);
    const glm::vec3& stated = p_.anisotropy_direction.value;
    Vec3<T> direction{T(stated.x), T(stated.y), T(stated.z)};
    if (from_.Has(BitOf(slot))) {
      const Vec3<T> texel = Xyz(ReadTexel<kRgb, T>(from_, slot));
      direction = texel * T(2.0f) - Grey(T(1.0f));
    }
    const Vec3<T>& normal = s.at.normal;
    const Vec3<T> along = Xyz(from_.Tangent());
    const Vec3<T> across = Cross(from_.InterpolatedNormal(), along) * from_.Tangent().w;
    const Vec3<T> world = along * direction.x + across * direction.y + from_.InterpolatedNormal() * direction.z;
    const T zero(0.0f), one(1.0f);
    const auto is_steep = Abs(normal.y) < T(0.9f);
    const Vec3<T> other =
        NormalizeOr(Cross(Select<T>(is_steep, Vec3<T>{zero, one, zero}, Vec3<T>{one, zero, zero}), normal),
                    Vec3<T>{one, zero, zero});
    const Vec3<T> tangent = NormalizeOr(world - normal * Dot(normal, world), other);
    const T strength = Clamp(ReadParameter<T>(from_, p_.anisotropy, SlotOf(&Block::anisotropy)), T(-1.0f), one);
    return FilamentAnisotropy<T>(tangent, Cross(normal, tangent), strength, s.alpha);
  }

  const Source& from_;
  const Block& p_;
};

}  // namespace filament
}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
