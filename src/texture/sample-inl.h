// Reading textures: wrapping, bilinear, trilinear and anisotropic filtering, in linear light. T is Float (lanes),
// float or double.

#if defined(FACET_TEXTURE_SAMPLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_TEXTURE_SAMPLE_INL_H_
#undef FACET_TEXTURE_SAMPLE_INL_H_
#else
#define FACET_TEXTURE_SAMPLE_INL_H_
#endif

#include "facet/shader/elementary-inl.h"
#include "facet/shader/lookup-inl.h"
#include "facet/shader/vec-inl.h"
#include "texture/texture.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// Which channels a caller wants: bits 1, 2, 4, 8 for R, G, B, A. The others stay zero and cost nothing.
enum ChannelMask : int { kR = 1, kG = 2, kB = 4, kA = 8, kRgb = 7, kRgba = 15 };

// The texels i and i + 1 on one axis, after wrapping, and how far the position lies towards the second: at a clamped or
// mirrored edge, which repeats its texel, not at all.
template <class T>
struct AxisTaps {
  IntOf<T> first, second;
  T fraction;
};

// `position` in [0, 1] units of the texture; `size` in texels; `linear`: lanes that interpolate.
template <class T>
HWY_INLINE AxisTaps<T> MakeTaps(Wrap wrap, T position, IntOf<T> size, MaskOf<T> linear) {
  position = Select(IsFinite(position), position, T(0.0f));
  switch (wrap) {
    case Wrap::Repeat: position = position - Floor(position); break;
    case Wrap::MirroredRepeat: {
      const T folded = position - T(2.0f) * Floor(position * T(0.5f));
      position = Select(folded > T(1.0f), T(2.0f) - folded, folded);
      break;
    }
    case Wrap::ClampToEdge: position = Clamp(position, T(0.0f), T(1.0f)); break;
  }
  const T texel = position * FromInt<T>(size) - Select(linear, T(0.5f), T(0.0f));
  const T whole = Floor(texel);
  AxisTaps<T> taps{};
  taps.fraction = Select(linear, texel - whole, T(0.0f));
  const IntOf<T> i = TruncateToInt(whole), last = size - IntOf<T>(1);
  if (wrap == Wrap::Repeat) {
    const auto wrapped = [&](IntOf<T> k) HWY_ATTR {
      k = Select(k < IntOf<T>(0), k + size, k);
      return Select(k > last, k - size, k);
    };
    taps.first = wrapped(i);
    taps.second = Select(taps.first < last, taps.first + IntOf<T>(1), IntOf<T>(0));
  } else {
    taps.first = Max(Min(i, last), IntOf<T>(0));
    taps.second = Min(taps.first + IntOf<T>(1), last);
    taps.fraction = Select((whole < T(0.0f)) | (whole >= FromInt<T>(last)), T(0.0f), taps.fraction);
  }
  return taps;
}

// Where the texels of one bilinear footprint stand, and how far the position lies towards the second of each axis.
template <class T>
struct BilinearTap {
  IndexList<T> top, bottom;  // numbers of the left texels in TextureData; the right ones follow them
  T along_u, along_v;
};

// The mip level of each lane.
template <class T>
struct LevelPlace {
  IntOf<T> width, height, offset, pitch;
};
template <class T>
HWY_INLINE LevelPlace<T> PlaceOfLevel(const TextureData& data, IntOf<T> level) {
  static_assert(kMaxTextureLevels == 16);
  return {FetchOf16(data.level_width, level), FetchOf16(data.level_height, level), FetchOf16(data.level_offset, level),
          FetchOf16(data.level_pitch, level)};
}

template <class T>
HWY_INLINE BilinearTap<T> MakeBilinearTap(const Sampler& sampler, Vec2<T> uv, const LevelPlace<T>& level,
                                          MaskOf<T> linear) {
  const AxisTaps<T> u = MakeTaps(sampler.wrap_u, uv.x, level.width, linear);
  const AxisTaps<T> v = MakeTaps(sampler.wrap_v, uv.y, level.height, linear);
  const IntOf<T> left = level.offset + u.first;
  BilinearTap<T> tap;
  tap.top = left + v.first * level.pitch;
  tap.bottom = left + v.second * level.pitch;
  tap.along_u = u.fraction;
  tap.along_v = v.fraction;
  return tap;
}

// The channels of a texel: `low` is its first word, `high` the second where there are two.
template <int kChannels, bool kWide, class T>
HWY_INLINE Vec4<T> Channels(IntOf<T> low, IntOf<T> high) {
  Vec4<T> c{};
  if constexpr (kWide) {
    const T scale(1.0f / 65535.0f);
    if constexpr ((kChannels & kR) != 0) c.x = FromInt<T>(low & IntOf<T>(0xFFFF)) * scale;
    if constexpr ((kChannels & kG) != 0) c.y = FromInt<T>(ShiftRightLogical<16>(low)) * scale;
    if constexpr ((kChannels & kB) != 0) c.z = FromInt<T>(high & IntOf<T>(0xFFFF)) * scale;
    if constexpr ((kChannels & kA) != 0) c.w = FromInt<T>(ShiftRightLogical<16>(high)) * scale;
  } else {
    const T scale(1.0f / 255.0f);
    if constexpr ((kChannels & kR) != 0) c.x = FromInt<T>(low & IntOf<T>(0xFF)) * scale;
    if constexpr ((kChannels & kG) != 0) c.y = FromInt<T>(ShiftRightLogical<8>(low) & IntOf<T>(0xFF)) * scale;
    if constexpr ((kChannels & kB) != 0) c.z = FromInt<T>(ShiftRightLogical<16>(low) & IntOf<T>(0xFF)) * scale;
    if constexpr ((kChannels & kA) != 0) c.w = FromInt<T>(ShiftRightLogical<24>(low)) * scale;
  }
  return c;
}

// Two texels of a row.
template <int kChannels, bool kWide, class T>
HWY_INLINE void FetchNeighbours(const std::int32_t* words, const IndexList<T>& texel, Vec4<T>& left, Vec4<T>& right) {
  if constexpr (kWide) {
    IntOf<T> w[4];
    FetchFour<2, T>(words, texel, w);
    left = Channels<kChannels, true, T>(w[0], w[1]);
    right = Channels<kChannels, true, T>(w[2], w[3]);
  } else {
    IntOf<T> w[2];
    FetchTwo<1, T>(words, texel, w);
    left = Channels<kChannels, false, T>(w[0], w[0]);
    right = Channels<kChannels, false, T>(w[1], w[1]);
  }
}

template <int kChannels, bool kWide, class T>
HWY_INLINE Vec4<T> ReadBilinear(const std::int32_t* words, const BilinearTap<T>& tap) {
  Vec4<T> c00, c10, c01, c11;
  FetchNeighbours<kChannels, kWide, T>(words, tap.top, c00, c10);
  FetchNeighbours<kChannels, kWide, T>(words, tap.bottom, c01, c11);
  const auto mix = [&](T a, T b, T c, T d) HWY_ATTR {
    const T top = a + (b - a) * tap.along_u, bottom = c + (d - c) * tap.along_u;
    return top + (bottom - top) * tap.along_v;
  };
  Vec4<T> result{};
  if constexpr ((kChannels & kR) != 0) result.x = mix(c00.x, c10.x, c01.x, c11.x);
  if constexpr ((kChannels & kG) != 0) result.y = mix(c00.y, c10.y, c01.y, c11.y);
  if constexpr ((kChannels & kB) != 0) result.z = mix(c00.z, c10.z, c01.z, c11.z);
  if constexpr ((kChannels & kA) != 0) result.w = mix(c00.w, c10.w, c01.w, c11.w);
  return result;
}

// The ellipse that a pixel covers in a texture: the axes of the linear map from pixels to texels of level 0, by its
// singular values. (GPUs approximate them by the lengths of the two columns, which blurs skewed footprints.)
template <class T>
struct Footprint {
  T lod;          // log2 of the width that one tap has to cover
  T taps;         // how many taps go along the major axis, 1 to max_anisotropy
  Vec2<T> major;  // the major axis in uv, whole length
};

template <class T>
HWY_INLINE Footprint<T> MakeFootprint(const TextureSlot& slot, Vec2<T> duv_dx, Vec2<T> duv_dy) {
  const T width(static_cast<float>(slot.data->level_width[0])), height(static_cast<float>(slot.data->level_height[0]));
  // Beyond every texture's last level, and below what overflows when it is squared twice; a NaN becomes the lower one.
  const T limit(1e9f);
  const auto bounded = [&](T texels) HWY_ATTR { return Clamp(texels, -limit, limit); };
  const T ux = bounded(duv_dx.x * width), vx = bounded(duv_dx.y * height), uy = bounded(duv_dy.x * width),
          vy = bounded(duv_dy.y * height);
  const T a = ux * ux + uy * uy, b = ux * vx + uy * vy, c = vx * vx + vy * vy;
  const T determinant = Abs(ux * vy - uy * vx);
  const T half_gap = Sqrt((a - c) * (a - c) * T(0.25f) + b * b);
  const T major_squared = (a + c) * T(0.5f) + half_gap;
  const T tiny(1e-30f);
  const T major = Sqrt(Max(major_squared, tiny));
  const T minor = determinant / major;

  // Several taps are for smooth filters: what asks for nearest texels, or has no smaller levels, gets one, and that one
  // covers the whole length.
  const bool several = slot.sampler.minification == Filter::Linear && slot.sampler.mip != MipFilter::None;
  Footprint<T> f{};
  // Fewer taps than the ratio of the axes would blur along the minor one; more would waste.
  const T ratio = major / Max(minor, T(1e-15f));
  const T needed = Max(-Floor(-ratio), T(1.0f));
  f.taps = Min(needed, T(several ? slot.max_anisotropy : 1.0f));
  f.taps = Select(major > T(1.0f), f.taps, T(1.0f));  // magnified: one tap sees it all
  f.lod = Log2(Max(major / f.taps, Max(minor, T(1e-15f))));
  // The eigenvector of the larger singular value: of the two ways to write it, the one that does not cancel.
  const Vec2<T> p{major_squared - c, b}, q{b, major_squared - a};
  const auto use_p = a >= c;
  const Vec2<T> axis{Select(use_p, p.x, q.x), Select(use_p, p.y, q.y)};
  const T length = Sqrt(Max(Dot(axis, axis), tiny));
  const T scale = major / length;
  const MaskOf<T> stretched = f.taps > T(1.0f);  // selected, not multiplied: axes that overflowed must not become NaN
  f.major = {Select(stretched, axis.x * scale / width, T(0.0f)), Select(stretched, axis.y * scale / height, T(0.0f))};
  return f;
}

// All places that a sample reads: what textures of one size, sampled alike, have in common.
template <class T>
struct TextureTaps {
  static constexpr int kMax = 16;
  int count;        // taps along the major axis, of the lane that has most
  bool two_levels;
  T lane_count;     // taps of each lane
  T blend;          // from the finer level to the coarser
  BilinearTap<T> fine[kMax], coarse[kMax];
};

// Whether samples of both slots at the same texture coordinates read the same places.
HWY_INLINE bool HaveSameTaps(const TextureSlot& a, const TextureSlot& b) {
  const TextureData &p = *a.data, &q = *b.data;
  const Sampler &f = a.sampler, &g = b.sampler;
  bool same = a.uv_slot == b.uv_slot && a.max_anisotropy == b.max_anisotropy && p.levels == q.levels &&
              p.level_width[0] == q.level_width[0] && p.level_height[0] == q.level_height[0] &&
              f.wrap_u == g.wrap_u && f.wrap_v == g.wrap_v && f.magnification == g.magnification &&
              f.minification == g.minification && f.mip == g.mip;
  for (int i = 0; i < 6; ++i) same = same && a.transform[i] == b.transform[i];
  return same;
}

// The places that a sample of `slot` reads at interpolated coordinates with their derivatives over one pixel.
template <class T>
HWY_INLINE void MakeTextureTaps(const TextureSlot& slot, Vec2<T> uv_in, Vec2<T> duv_dx_in, Vec2<T> duv_dy_in,
                                TextureTaps<T>& out) {
  const float* m = slot.transform;
  const auto rotate = [&](Vec2<T> d) HWY_ATTR {
    return Vec2<T>{T(m[0]) * d.x + T(m[1]) * d.y, T(m[3]) * d.x + T(m[4]) * d.y};
  };
  const Vec2<T> turned = rotate(uv_in);
  const Vec2<T> uv{turned.x + T(m[2]), turned.y + T(m[5])};
  const Sampler& sampler = slot.sampler;
  const TextureData& data = *slot.data;
  const MaskOf<T> yes(true), no(false);
  const auto read_level_0 = [&](MaskOf<T> linear) HWY_ATTR {
    out.count = 1;
    out.two_levels = false;
    out.fine[0] = MakeBilinearTap(sampler, uv, PlaceOfLevel<T>(data, IntOf<T>(0)), linear);
  };
  if (sampler.magnification == sampler.minification && data.levels == 1) {
    return read_level_0(sampler.magnification == Filter::Linear ? yes : no);
  }

  const Footprint<T> footprint = MakeFootprint(slot, rotate(duv_dx_in), rotate(duv_dy_in));
  const T max_level(static_cast<float>(data.levels - 1));
  const T lod = Clamp(footprint.lod, T(0.0f), max_level);
  const MaskOf<T> magnified = footprint.lod <= T(0.0f), minified = !magnified;
  const MaskOf<T> linear = (magnified & (sampler.magnification == Filter::Linear ? yes : no)) |
                           (minified & (sampler.minification == Filter::Linear ? yes : no));
  if (sampler.mip == MipFilter::None) return read_level_0(linear);
  const bool nearest_level = sampler.mip == MipFilter::Nearest;
  const T base = Floor(nearest_level ? lod + T(0.5f) : lod);
  out.blend = nearest_level ? T(0.0f) : lod - base;
  out.two_levels = Any(out.blend > T(0.0f));
  out.lane_count = footprint.taps;
  const LevelPlace<T> fine = PlaceOfLevel<T>(data, TruncateToInt(base));
  const LevelPlace<T> coarse = PlaceOfLevel<T>(data, TruncateToInt(Min(base + T(1.0f), max_level)));
  for (out.count = 0; out.count < TextureTaps<T>::kMax; ++out.count) {
    const int i = out.count;
    const T tap(static_cast<float>(i));
    if (!Any(tap < footprint.taps)) break;
    const T along = (tap + T(0.5f)) / footprint.taps - T(0.5f);
    const Vec2<T> at{uv.x + footprint.major.x * along, uv.y + footprint.major.y * along};
    out.fine[i] = MakeBilinearTap(sampler, at, fine, linear);
    if (out.two_levels) out.coarse[i] = MakeBilinearTap(sampler, at, coarse, linear);
  }
}

// Asks for the memory of texels that will be read soon, for one lane in `kStep`. (Inlined always: GCC drops calls of
// functions that do nothing else.)
template <int kStep, class T>
HWY_INLINE void PrefetchRow(const std::int32_t* words, std::ptrdiff_t words_each, const IndexList<T>& texel) {
  for (int lane = 0; lane < IndexList<T>::kLanes; lane += kStep) {
    __builtin_prefetch(words + texel.of_lane[lane] * words_each);
  }
}

// Of most that will be read at `taps`. Neighbouring lanes read neighbouring texels: every second lane, of the coarser
// level every fourth, names nearly as many cache lines as all, and what is a lane's lower row is often another's upper.
template <class T>
HWY_INLINE void PrefetchTexels(const TextureData& data, const TextureTaps<T>& taps) {
  const std::int32_t* words = data.words.data();
  const std::ptrdiff_t words_each = data.wide ? 2 : 1;
  for (int i = 0; i < taps.count; ++i) {
    PrefetchRow<2, T>(words, words_each, taps.fine[i].top);
    if (taps.two_levels) PrefetchRow<4, T>(words, words_each, taps.coarse[i].top);
  }
}

template <int kChannels, bool kWide, class T>
HWY_INLINE Vec4<T> ReadTaps(const std::int32_t* words, const TextureTaps<T>& taps) {
  const auto trilinear = [&](int i) HWY_ATTR {
    const Vec4<T> near = ReadBilinear<kChannels, kWide>(words, taps.fine[i]);
    if (!taps.two_levels) return near;
    const Vec4<T> far = ReadBilinear<kChannels, kWide>(words, taps.coarse[i]);
    return near * (T(1.0f) - taps.blend) + far * taps.blend;
  };
  if (taps.count == 1) return trilinear(0);
  Vec4<T> sum{};
  for (int i = 0; i < taps.count; ++i) {
    const MaskOf<T> active = T(static_cast<float>(i)) < taps.lane_count;
    sum = sum + trilinear(i) * Select(active, T(1.0f), T(0.0f));
  }
  return sum * (T(1.0f) / taps.lane_count);
}

// What `slot` shows at places that were made for it, or for one that has the same.
template <int kChannels, class T>
HWY_INLINE Vec4<T> ReadTexture(const TextureSlot& slot, const TextureTaps<T>& taps) {
  const std::int32_t* words = slot.data->words.data();
  return slot.data->wide ? ReadTaps<kChannels, true>(words, taps) : ReadTaps<kChannels, false>(words, taps);
}

// Samples the texture of `slot` at interpolated coordinates `uv` with their derivatives over one pixel.
template <int kChannels, class T>
HWY_INLINE Vec4<T> SampleTexture(const TextureSlot& slot, Vec2<T> uv, Vec2<T> duv_dx, Vec2<T> duv_dy) {
  TextureTaps<T> taps;
  MakeTextureTaps(slot, uv, duv_dx, duv_dy, taps);
  return ReadTexture<kChannels>(slot, taps);
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
