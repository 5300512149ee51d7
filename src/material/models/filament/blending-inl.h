// What Filament does with a surface after it is lit: the post-lighting colour, and blending. (Filament Materials Guide,
// "blending" and "postLightingBlending".) Filament blends premultiplied colours; facet's compositor takes straight
// ones.

#if defined(FACET_MATERIAL_MODELS_FILAMENT_BLENDING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_MODELS_FILAMENT_BLENDING_INL_H_
#undef FACET_MATERIAL_MODELS_FILAMENT_BLENDING_INL_H_
#else
#define FACET_MATERIAL_MODELS_FILAMENT_BLENDING_INL_H_
#endif

#include "material/models/filament/surface-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {
namespace filament {

// The least coverage of a surface whose reflections are not dimmed by it: they have to be divided by it.
inline constexpr float kLeastCoverage = 0x1p-16f;

// The colour that is blended with a lit surface.
template <class T>
struct PostLighting {
  bool is_stated = false;  // the same in all lanes
  Vec4<T> color{};         // premultiplied
  T mix_factor{};
};

template <class T, class Source>
FACET_INLINE PostLighting<T> ReadPostLighting(const Source& from, const FilamentParameters& p) {
  using Block = FilamentParameters;
  PostLighting<T> after;
  // Of the other ways to blend, black and transparent changes nothing.
  using Way = Block::PostLightingBlending;
  const bool replaces = p.post_lighting_blending == Way::Opaque || p.post_lighting_blending == Way::Multiply;
  after.is_stated = p.post_lighting_color.value != glm::vec4(0.0f) || replaces;
  if (!after.is_stated) return after;
  after.color = ReadParameter<T>(from, p.post_lighting_color, SlotOf(&Block::post_lighting_color));
  after.mix_factor =
      Bounded(ReadParameter<T>(from, p.post_lighting_mix_factor, SlotOf(&Block::post_lighting_mix_factor)));
  return after;
}

template <class T>
FACET_INLINE Vec4<T> BlendPostLighting(FilamentParameters::PostLightingBlending how, const Vec4<T>& lit,
                                       const PostLighting<T>& after) {
  using Way = FilamentParameters::PostLightingBlending;
  const T one(1.0f);
  const Vec4<T>& c = after.color;
  Vec4<T> blended = lit;
  switch (how) {
    case Way::Opaque: blended = c; break;
    case Way::Transparent: blended = c + lit * (one - c.w); break;
    case Way::Add: blended = lit + c; break;
    case Way::Multiply: blended = lit * c; break;
    case Way::Screen: blended = lit + c * Vec4<T>{one - lit.x, one - lit.y, one - lit.z, one - lit.w}; break;
  }
  return lit * (one - after.mix_factor) + blended * after.mix_factor;
}

// The surface in straight alpha. `radiance`: premultiplied where blending says that reflections are not dimmed.
template <class T>
FACET_INLINE Shaded<T> Finish(const FilamentSurface<T>& s, const PostLighting<T>& after, const Vec3<T>& radiance) {
  const T one(1.0f);
  const bool covers = s.blending == Blending::Fade || s.blending == Blending::Transparent;
  if (!after.is_stated && s.blending != Blending::Transparent) return {radiance, s.coverage};
  const Vec3<T> light = s.blending == Blending::Fade ? radiance * s.coverage : radiance;
  Vec4<T> pixel{light.x, light.y, light.z, covers ? s.coverage : one};
  if (after.is_stated) pixel = BlendPostLighting(s.block->post_lighting_blending, pixel, after);
  if (!covers) return {Xyz(pixel), s.coverage};
  const T coverage = Max(Bounded(pixel.w), T(kLeastCoverage));
  return {Xyz(pixel) / coverage, coverage};
}

// For add, multiply and screen: the surface's own light, and the factor of what is behind it.
template <class T>
FACET_INLINE void BlendWithBehind(const FilamentSurface<T>& s, Shaded<T>& own, Vec3<T>& tint) {
  const T one(1.0f);
  tint = Grey(one);
  own.alpha = one;
  if (s.blending == Blending::Multiply) {
    tint = Bounded(own.color);
    own.color = Vec3<T>{};
  } else if (s.blending == Blending::Screen) {
    tint = Bounded(Grey(one) - own.color);
  }
}

}  // namespace filament
}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
