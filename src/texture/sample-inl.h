// Reading textures: wrapping, bilinear, trilinear and anisotropic filtering on lanes, in linear light.

#if defined(FACET_TEXTURE_SAMPLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_TEXTURE_SAMPLE_INL_H_
#undef FACET_TEXTURE_SAMPLE_INL_H_
#else
#define FACET_TEXTURE_SAMPLE_INL_H_
#endif

#include "facet/shader/elementary-inl.h"
#include "facet/shader/vec-inl.h"
#include "texture/texture.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// Which channels a caller wants: bits 1, 2, 4, 8 for R, G, B, A. The others stay zero and cost nothing.
enum ChannelMask : int { kR = 1, kG = 2, kB = 4, kA = 8, kRgb = 7, kRgba = 15 };

// The texels i and i + 1 on one axis, after wrapping, and how far the position lies towards the second.
struct AxisTaps {
  Int first, second;
  Float fraction;
};

// `position` in [0, 1] units of the texture; `size` in texels; `linear`: lanes that interpolate.
HWY_INLINE AxisTaps MakeTaps(Wrap wrap, Float position, Int size, Mask linear) {
  position = Select(IsFinite(position), position, Float(0.0f));
  switch (wrap) {
    case Wrap::Repeat: position = position - Floor(position); break;
    case Wrap::MirroredRepeat: {
      const Float folded = position - Float(2.0f) * Floor(position * Float(0.5f));
      position = Select(folded > Float(1.0f), Float(2.0f) - folded, folded);
      break;
    }
    case Wrap::ClampToEdge: position = Clamp(position, Float(0.0f), Float(1.0f)); break;
  }
  const Float texel = position * ToFloat(size) - Select(linear, Float(0.5f), Float(0.0f));
  const Float whole = Floor(texel);
  AxisTaps taps;
  taps.fraction = Select(linear, texel - whole, Float(0.0f));
  const Int i = TruncateToInt(whole), last = size - Int(1);
  if (wrap == Wrap::Repeat) {
    const auto wrapped = [&](Int k) HWY_ATTR {
      k = Select(k < Int(0), k + size, k);
      return Select(k > last, k - size, k);
    };
    taps.first = wrapped(i);
    taps.second = wrapped(i + Int(1));
  } else {  // a mirrored edge repeats its texel, as a clamped one does
    taps.first = Max(Min(i, last), Int(0));
    taps.second = Max(Min(i + Int(1), last), Int(0));
  }
  return taps;
}

template <int kChannels>
HWY_INLINE Vec4<Float> FetchTexel(const TextureData& data, Int texel) {
  Vec4<Float> c{};
  const std::int32_t* words = data.words.data();
  if (data.wide) {
    const Int index = texel + texel;
    const Float scale(1.0f / 65535.0f);
    if constexpr ((kChannels & (kR | kG)) != 0) {
      const Int rg = Gather(words, index);
      if constexpr ((kChannels & kR) != 0) c.x = ToFloat(rg & Int(0xFFFF)) * scale;
      if constexpr ((kChannels & kG) != 0) c.y = ToFloat(ShiftRightLogical<16>(rg)) * scale;
    }
    if constexpr ((kChannels & (kB | kA)) != 0) {
      const Int ba = Gather(words + 1, index);
      if constexpr ((kChannels & kB) != 0) c.z = ToFloat(ba & Int(0xFFFF)) * scale;
      if constexpr ((kChannels & kA) != 0) c.w = ToFloat(ShiftRightLogical<16>(ba)) * scale;
    }
  } else {
    const Int rgba = Gather(words, texel);
    const Float scale(1.0f / 255.0f);
    if constexpr ((kChannels & kR) != 0) c.x = ToFloat(rgba & Int(0xFF)) * scale;
    if constexpr ((kChannels & kG) != 0) c.y = ToFloat(ShiftRightLogical<8>(rgba) & Int(0xFF)) * scale;
    if constexpr ((kChannels & kB) != 0) c.z = ToFloat(ShiftRightLogical<16>(rgba) & Int(0xFF)) * scale;
    if constexpr ((kChannels & kA) != 0) c.w = ToFloat(ShiftRightLogical<24>(rgba)) * scale;
  }
  return c;
}

// One bilinear footprint in level `level` (per lane).
template <int kChannels>
HWY_INLINE Vec4<Float> SampleLevel(const TextureSlot& slot, Vec2<Float> uv, Int level, Mask linear) {
  const TextureData& data = *slot.data;
  const AxisTaps u = MakeTaps(slot.sampler.wrap_u, uv.x, Gather(data.level_width, level), linear);
  const AxisTaps v = MakeTaps(slot.sampler.wrap_v, uv.y, Gather(data.level_height, level), linear);
  const Int offset = Gather(data.level_offset, level), pitch = Gather(data.level_pitch, level);
  const auto column = [](Int x) HWY_ATTR { return ShiftLeft<4>(ShiftRightArithmetic<2>(x)) + (x & Int(3)); };
  const auto row = [&](Int y) HWY_ATTR {
    return offset + ShiftLeft<4>(ShiftRightArithmetic<2>(y) * pitch) + ShiftLeft<2>(y & Int(3));
  };
  const Int x0 = column(u.first), x1 = column(u.second), y0 = row(v.first), y1 = row(v.second);
  const Vec4<Float> c00 = FetchTexel<kChannels>(data, y0 + x0), c10 = FetchTexel<kChannels>(data, y0 + x1);
  const Vec4<Float> c01 = FetchTexel<kChannels>(data, y1 + x0), c11 = FetchTexel<kChannels>(data, y1 + x1);
  const auto mix = [&](Float a, Float b, Float c, Float d) HWY_ATTR {
    const Float top = a + (b - a) * u.fraction, bottom = c + (d - c) * u.fraction;
    return top + (bottom - top) * v.fraction;
  };
  Vec4<Float> result{};
  if constexpr ((kChannels & kR) != 0) result.x = mix(c00.x, c10.x, c01.x, c11.x);
  if constexpr ((kChannels & kG) != 0) result.y = mix(c00.y, c10.y, c01.y, c11.y);
  if constexpr ((kChannels & kB) != 0) result.z = mix(c00.z, c10.z, c01.z, c11.z);
  if constexpr ((kChannels & kA) != 0) result.w = mix(c00.w, c10.w, c01.w, c11.w);
  return result;
}

// The ellipse that a pixel covers in a texture: the axes of the linear map from pixels to texels of level 0, by its
// singular values. (GPUs approximate them by the lengths of the two columns, which blurs skewed footprints.)
struct Footprint {
  Float lod;           // log2 of the width that one tap has to cover
  Float taps;          // how many taps go along the major axis, 1 to max_anisotropy
  Vec2<Float> major;   // the major axis in uv, whole length
};

HWY_INLINE Footprint MakeFootprint(const TextureSlot& slot, Vec2<Float> duv_dx, Vec2<Float> duv_dy) {
  const Float width(static_cast<float>(slot.data->level_width[0])), height(static_cast<float>(slot.data->level_height[0]));
  // Beyond every texture's last level, and below what overflows when it is squared twice; a NaN becomes the lower one.
  const Float limit(1e9f);
  const auto bounded = [&](Float texels) HWY_ATTR { return Clamp(texels, -limit, limit); };
  const Float ux = bounded(duv_dx.x * width), vx = bounded(duv_dx.y * height), uy = bounded(duv_dy.x * width),
              vy = bounded(duv_dy.y * height);
  const Float a = ux * ux + uy * uy, b = ux * vx + uy * vy, c = vx * vx + vy * vy;
  const Float determinant = Abs(ux * vy - uy * vx);
  const Float half_gap = Sqrt((a - c) * (a - c) * Float(0.25f) + b * b);
  const Float major_squared = (a + c) * Float(0.5f) + half_gap;
  const Float tiny(1e-30f);
  const Float major = Sqrt(Max(major_squared, tiny));
  const Float minor = determinant / major;

  // Several taps are for smooth filters: what asks for nearest texels, or has no smaller levels, gets one, and that one
  // covers the whole length.
  const bool several = slot.sampler.minification == Filter::Linear && slot.sampler.mip != MipFilter::None;
  Footprint f;
  // Fewer taps than the ratio of the axes would blur along the minor one; more would waste.
  const Float ratio = major / Max(minor, Float(1e-15f));
  const Float needed = Max(-Floor(-ratio), Float(1.0f));
  f.taps = Min(needed, Float(several ? slot.max_anisotropy : 1.0f));
  f.taps = Select(major > Float(1.0f), f.taps, Float(1.0f));  // magnified: one tap sees it all
  f.lod = Log2(Max(major / f.taps, Max(minor, Float(1e-15f))));
  // The eigenvector of the larger singular value: of the two ways to write it, the one that does not cancel.
  const Vec2<Float> p{major_squared - c, b}, q{b, major_squared - a};
  const auto use_p = a >= c;
  const Vec2<Float> axis{Select(use_p, p.x, q.x), Select(use_p, p.y, q.y)};
  const Float length = Sqrt(Max(Dot(axis, axis), tiny));
  const Float scale = major / length;
  const Mask stretched = f.taps > Float(1.0f);  // selected, not multiplied: axes that overflowed must not become NaN
  f.major = {Select(stretched, axis.x * scale / width, Float(0.0f)),
             Select(stretched, axis.y * scale / height, Float(0.0f))};
  return f;
}

// Samples the texture of `slot` at interpolated coordinates `uv` with their derivatives over one pixel.
template <int kChannels>
HWY_INLINE Vec4<Float> SampleTexture(const TextureSlot& slot, Vec2<Float> uv_in, Vec2<Float> duv_dx_in,
                                     Vec2<Float> duv_dy_in) {
  const float* m = slot.transform;
  const auto rotate = [&](Vec2<Float> d) HWY_ATTR {
    return Vec2<Float>{Float(m[0]) * d.x + Float(m[1]) * d.y, Float(m[3]) * d.x + Float(m[4]) * d.y};
  };
  const Vec2<Float> turned = rotate(uv_in);
  const Vec2<Float> uv{turned.x + Float(m[2]), turned.y + Float(m[5])};
  const Sampler& sampler = slot.sampler;
  const Mask yes(true), no(false);
  const bool one_filter = sampler.magnification == sampler.minification;
  if (one_filter && slot.data->levels == 1) {
    return SampleLevel<kChannels>(slot, uv, Int(0), sampler.magnification == Filter::Linear ? yes : no);
  }

  Footprint footprint = MakeFootprint(slot, rotate(duv_dx_in), rotate(duv_dy_in));
  const Float max_level(static_cast<float>(slot.data->levels - 1));
  const Float lod = Clamp(footprint.lod, Float(0.0f), max_level);
  const Mask magnified = footprint.lod <= Float(0.0f);
  const Mask linear = (magnified & (sampler.magnification == Filter::Linear ? yes : no)) |
                      (!magnified & (sampler.minification == Filter::Linear ? yes : no));
  if (sampler.mip == MipFilter::None) return SampleLevel<kChannels>(slot, uv, Int(0), linear);
  const bool nearest_level = sampler.mip == MipFilter::Nearest;
  const Float base = Floor(nearest_level ? lod + Float(0.5f) : lod), blend = nearest_level ? Float(0.0f) : lod - base;
  const Int fine = TruncateToInt(base), coarse = TruncateToInt(Min(base + Float(1.0f), max_level));
  const bool one_level = !Any(blend > Float(0.0f));
  const auto trilinear = [&](Vec2<Float> at) HWY_ATTR {
    const Vec4<Float> near = SampleLevel<kChannels>(slot, at, fine, linear);
    if (one_level) return near;
    const Vec4<Float> far = SampleLevel<kChannels>(slot, at, coarse, linear);
    return near * (Float(1.0f) - blend) + far * blend;
  };
  if (!Any(footprint.taps > Float(1.0f))) return trilinear(uv);
  Vec4<Float> sum{};
  for (int i = 0; i < 16; ++i) {
    const Float tap(static_cast<float>(i));
    const Mask active = tap < footprint.taps;
    if (!Any(active)) break;
    const Float along = (tap + Float(0.5f)) / footprint.taps - Float(0.5f);
    const Vec4<Float> c = trilinear({uv.x + footprint.major.x * along, uv.y + footprint.major.y * along});
    sum = sum + c * Select(active, Float(1.0f), Float(0.0f));
  }
  return sum * (Float(1.0f) / footprint.taps);
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
