// Samples textures in linear light: wrap modes, bilinear to anisotropic filters. T: Float (lanes), float, double.

#if defined(FACET_TEXTURE_SAMPLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_TEXTURE_SAMPLE_INL_H_
#undef FACET_TEXTURE_SAMPLE_INL_H_
#else
#define FACET_TEXTURE_SAMPLE_INL_H_
#endif

#include <algorithm>
#include <type_traits>

#include "facet/shader/elementary-inl.h"
#include "facet/shader/lookup-inl.h"
#include "facet/shader/vec-inl.h"
#include "texture/texture.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// The two neighbouring texels that linear filtering reads on one axis, after wrapping, and the weight of the second. At
// a clamped or mirrored edge, where the texel beyond the edge repeats the one at it, that weight is 0.
template <class T>
struct AxisTaps {
  IntOf<T> first, second;
  T fraction;
};

// A texture coordinate after wrapping, in [0, 1].
template <class T>
FACET_INLINE T Wrapped(Wrap wrap, T position) {
  position = Select(IsFinite(position), position, T(0.0f));
  switch (wrap) {
    case Wrap::Repeat: return position - Floor(position);
    case Wrap::MirroredRepeat: {
      const T folded = position - T(2.0f) * Floor(position * T(0.5f));
      return Select(folded > T(1.0f), T(2.0f) - folded, folded);
    }
    default: return Clamp(position, T(0.0f), T(1.0f));
  }
}

// `position`: texture coordinate, 1 being the whole texture; `size`: in texels; `linear`: lanes with linear filtering.
template <class T>
FACET_INLINE AxisTaps<T> MakeTaps(Wrap wrap, T position, IntOf<T> size, MaskOf<T> linear) {
  const T texel = Wrapped(wrap, position) * FromInt<T>(size) - Select(linear, T(0.5f), T(0.0f));
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

// Float (lanes) and float filter in integers: components of 8 or 16 bits times weights of 14 bits, summed exactly. This
// is four times as fast as in floats; GPUs' weights have 8 bits. Other T, such as double, have unrounded weights.
template <class T>
inline constexpr bool kWholeWeights = std::is_same_v<T, Float> || std::is_same_v<T, float>;
// The sum of all weights of a sample.
template <class T>
inline constexpr float kWeightSum = kWholeWeights<T> ? 16384.0f : 1.0f;
template <class T>
FACET_INLINE T RoundWeight(T weight) {
  if constexpr (kWholeWeights<T>) {
    return Floor(weight + T(0.5f));
  } else {
    return weight;
  }
}

// The weights of two neighbouring texels: integers are packed into one 32-bit word per lane, the left one low.
template <class T, bool kWhole = kWholeWeights<T>>
struct WeightPair {
  IndexList<T> of_lane;
  FACET_INLINE void Set(T left, T right) { of_lane = TruncateToInt(left) | ShiftLeft<16>(TruncateToInt(right)); }
  // For T with a single lane.
  FACET_INLINE std::int32_t Left() const { return of_lane.of_lane[0] & 0xFFFF; }
  FACET_INLINE std::int32_t Right() const { return of_lane.of_lane[0] >> 16; }
};
template <class T>
struct WeightPair<T, false> {
  T left, right;
  FACET_INLINE void Set(T l, T r) { left = l, right = r; }
  FACET_INLINE T Left() const { return left; }
  FACET_INLINE T Right() const { return right; }
};

// Texel addresses and weights of one bilinear tap.
template <class T>
struct BilinearTap {
  IndexList<T> top, bottom;  // indices in TextureData of the two left texels; each right one follows its left one
  WeightPair<T> top_weights, bottom_weights;
};

// Where the mip level of each lane lies in TextureData: in texels.
template <class T>
struct LevelLayout {
  IntOf<T> width, height, offset, pitch;
};
template <class T>
FACET_INLINE LevelLayout<T> LayoutOfLevel(const TextureData& data, IntOf<T> level) {
  static_assert(kMaxTextureLevels == 16);
  return {FetchOf16(data.level_width, level), FetchOf16(data.level_height, level), FetchOf16(data.level_offset, level),
          FetchOf16(data.level_pitch, level)};
}

// `share`: the tap's part of kWeightSum, a result of RoundWeight(). The weights of its four texels sum to it exactly.
template <class T>
FACET_INLINE void MakeBilinearTap(const Sampler& sampler, Vec2<T> uv, const LevelLayout<T>& level, MaskOf<T> linear,
                                  T share, BilinearTap<T>& tap) {
  const AxisTaps<T> u = MakeTaps(sampler.wrap_u, uv.x, level.width, linear);
  const AxisTaps<T> v = MakeTaps(sampler.wrap_v, uv.y, level.height, linear);
  const IntOf<T> left = level.offset + u.first;
  tap.top = left + v.first * level.pitch;
  tap.bottom = left + v.second * level.pitch;
  const T right_share = RoundWeight(share * u.fraction), left_share = share - right_share;
  const T bottom_right = RoundWeight(right_share * v.fraction), bottom_left = RoundWeight(left_share * v.fraction);
  tap.top_weights.Set(left_share - bottom_left, right_share - bottom_right);
  tap.bottom_weights.Set(bottom_left, bottom_right);
}

// The ellipse that a pixel covers in a texture: the axes of the linear map from pixels to texels of level 0, by its
// singular values. (GPUs approximate them by the lengths of the two columns, which blurs skewed footprints.)
template <class T>
struct Footprint {
  T width;        // the diameter that one tap has to cover, in texels of level 0
  T lod;          // log2(width)
  T taps;         // the number of taps along the major axis, 1 to max_anisotropy
  Vec2<T> major;  // the major axis in uv, at its whole length
  T length;       // the length of the major axis in texels of level 0
};

template <class T>
FACET_INLINE Footprint<T> MakeFootprint(const BoundTexture& texture, Vec2<T> duv_dx, Vec2<T> duv_dy) {
  const T width(static_cast<float>(texture.data->level_width[0])),
      height(static_cast<float>(texture.data->level_height[0]));
  // A bound beyond every texture's last level that does not overflow when squared twice; NaN becomes the lower bound.
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

  // Only filters that interpolate get several taps. A sampler that asks for the nearest texel, or for no mip levels,
  // gets one, which covers the whole length.
  const bool several = texture.sampler.minification == Filter::Linear && texture.sampler.mip != MipFilter::None;
  Footprint<T> f{};
  // As many taps as the major axis is longer than the minor one: with fewer, each would blur along the minor axis.
  const T ratio = major / Max(minor, T(1e-15f));
  const T needed = Max(-Floor(-ratio), T(1.0f));
  f.taps = Min(needed, T(several ? texture.max_anisotropy : 1.0f));
  f.taps = Select(major > T(1.0f), f.taps, T(1.0f));  // magnified: one tap is enough
  f.width = Max(major / f.taps, Max(minor, T(1e-15f)));
  f.lod = Log2(f.width);
  f.length = major;
  // The singular vector of the larger singular value; of the two ways to write it, the one without cancellation.
  const Vec2<T> p{major_squared - c, b}, q{b, major_squared - a};
  const auto use_p = a >= c;
  const Vec2<T> axis{Select(use_p, p.x, q.x), Select(use_p, p.y, q.y)};
  const T length = Sqrt(Max(Dot(axis, axis), tiny));
  const T scale = major / length;
  const MaskOf<T> stretched = f.taps > T(1.0f);  // a select, since infinity * 0 would be NaN
  f.major = {Select(stretched, axis.x * scale / width, T(0.0f)), Select(stretched, axis.y * scale / height, T(0.0f))};
  return f;
}

// The taps (texel addresses and weights) of a sample. Textures of one size that are sampled alike share them.
template <class T>
struct TextureTaps {
  static constexpr int kMax = 16;  // taps along the major axis, in one level
  int count;                       // entries of `taps` that are used by the lane that has most of them
  IndexList<T> of_lane;            // how many each lane uses
  // The taps in the finer level; with two levels, each is followed by the tap at its position in the coarser level.
  bool two_levels;
  BilinearTap<T> taps[2 * kMax];
  Vec2<T> uv;  // the centre of the taps
  T reach;     // no texel that is read lies farther than this from the centre, in texels of level 0
};

// Whether two textures are sampled alike, so that the same taps serve both.
FACET_INLINE bool HaveSameTaps(const BoundTexture& a, const BoundTexture& b) {
  const TextureData &p = *a.data, &q = *b.data;
  const Sampler &f = a.sampler, &g = b.sampler;
  bool same = a.uv_slot == b.uv_slot && a.max_anisotropy == b.max_anisotropy && p.levels == q.levels &&
              p.level_width[0] == q.level_width[0] && p.level_height[0] == q.level_height[0] && f.wrap_u == g.wrap_u &&
              f.wrap_v == g.wrap_v && f.magnification == g.magnification && f.minification == g.minification &&
              f.mip == g.mip;
  for (int i = 0; i < 6; ++i) same = same && a.transform[i] == b.transform[i];
  return same;
}

// Computes the taps of a sample of `texture` from its coordinates and their derivatives over one pixel.
template <class T>
HWY_NOINLINE void MakeTextureTaps(const BoundTexture& texture, const Vec2<T>& uv_in, const Vec2<T>& duv_dx_in,
                                  const Vec2<T>& duv_dy_in, TextureTaps<T>& out) {
  const float* m = texture.transform;
  const auto rotate = [&](Vec2<T> d) HWY_ATTR {
    return Vec2<T>{T(m[0]) * d.x + T(m[1]) * d.y, T(m[3]) * d.x + T(m[4]) * d.y};
  };
  const Vec2<T> turned = rotate(uv_in);
  const Vec2<T> uv{turned.x + T(m[2]), turned.y + T(m[5])};
  const Sampler& sampler = texture.sampler;
  const TextureData& data = *texture.data;
  const MaskOf<T> yes(true), no(false);
  const T all(kWeightSum<T>);
  out.uv = uv;
  const T rounding = Max(Abs(uv.x), Abs(uv.y)) * T(2e-7f * float(data.level_width[0] + data.level_height[0]));
  const auto read_level_0 = [&](MaskOf<T> linear) HWY_ATTR {
    out.reach = T(1.5f) + rounding;  // a bilinear tap reads within 1.5 texels
    out.count = 1;
    out.of_lane = IntOf<T>(1);
    out.two_levels = false;
    MakeBilinearTap(sampler, uv, LayoutOfLevel<T>(data, IntOf<T>(0)), linear, all, out.taps[0]);
  };
  if (sampler.magnification == sampler.minification && data.levels == 1) {
    return read_level_0(sampler.magnification == Filter::Linear ? yes : no);
  }

  const Footprint<T> footprint = MakeFootprint(texture, rotate(duv_dx_in), rotate(duv_dy_in));
  const T max_level(static_cast<float>(data.levels - 1));
  const T lod = Clamp(footprint.lod, T(0.0f), max_level);
  const MaskOf<T> magnified = footprint.lod <= T(0.0f), minified = !magnified;
  const MaskOf<T> linear = (magnified & (sampler.magnification == Filter::Linear ? yes : no)) |
                           (minified & (sampler.minification == Filter::Linear ? yes : no));
  if (sampler.mip == MipFilter::None) return read_level_0(linear);
  // Half the major axis and what the last tap reads: texels of the coarser level are up to twice as wide as a tap.
  out.reach = footprint.length * T(0.5f) + Max(footprint.width, T(1.0f)) * T(3.0f) + rounding;
  const bool nearest_level = sampler.mip == MipFilter::Nearest;
  const T base = Floor(nearest_level ? lod + T(0.5f) : lod);
  const T blend = nearest_level ? T(0.0f) : lod - base;  // from the finer level to the coarser
  out.two_levels = Any(blend > T(0.0f));
  const LevelLayout<T> fine = LayoutOfLevel<T>(data, TruncateToInt(base));
  const LevelLayout<T> coarse = LayoutOfLevel<T>(data, TruncateToInt(Min(base + T(1.0f), max_level)));
  const T of_coarse = RoundWeight(all * blend), of_fine = all - of_coarse;
  const T inverse_count = T(1.0f) / footprint.taps;
  // The share of the first i taps. A tap's share is the difference of two of these: the rounded shares sum exactly.
  const auto share_before = [&](T whole, T i) HWY_ATTR { return RoundWeight(whole * Min(i * inverse_count, T(1.0f))); };
  const int levels = out.two_levels ? 2 : 1;
  T fine_before(0.0f), coarse_before(0.0f);
  int taps = 0;
  for (; taps < TextureTaps<T>::kMax; ++taps) {
    const T tap(static_cast<float>(taps));
    if (!Any(tap < footprint.taps)) break;
    const T along = (tap + T(0.5f)) * inverse_count - T(0.5f);
    const Vec2<T> at{uv.x + footprint.major.x * along, uv.y + footprint.major.y * along};
    const T fine_after = share_before(of_fine, tap + T(1.0f));
    MakeBilinearTap(sampler, at, fine, linear, fine_after - fine_before, out.taps[levels * taps]);
    fine_before = fine_after;
    if (!out.two_levels) continue;
    const T coarse_after = share_before(of_coarse, tap + T(1.0f));
    MakeBilinearTap(sampler, at, coarse, linear, coarse_after - coarse_before, out.taps[levels * taps + 1]);
    coarse_before = coarse_after;
  }
  out.count = levels * taps;
  out.of_lane = TruncateToInt(footprint.taps) * IntOf<T>(levels);
}

// Whether all texels that would be read at `taps` are black, in all lanes.
template <class T>
FACET_INLINE bool IsEmpty(const BoundTexture& texture, const TextureTaps<T>& taps) {
  const EmptyCells& empty_cells = texture.data->empty_cells;
  if (empty_cells.width == 0) return false;
  const auto cell = [](Wrap wrap, T position, int cells) HWY_ATTR {
    return Min(TruncateToInt(Wrapped(wrap, position) * T(static_cast<float>(cells))), IntOf<T>(cells - 1));
  };
  const IntOf<T> x = cell(texture.sampler.wrap_u, taps.uv.x, empty_cells.width),
                 y = cell(texture.sampler.wrap_v, taps.uv.y, empty_cells.height);
  const MaskOf<T> in_empty = FetchInt(empty_cells.occupied.data(), y * IntOf<T>(empty_cells.width) + x) == IntOf<T>(0);
  return All(in_empty & MaskOf<T>(taps.reach <= T(empty_cells.reach)));
}

// Prefetches texels that will be read soon, for one lane in `kStep`. (Inlined, as GCC drops the call otherwise.)
template <int kStep, class T>
FACET_INLINE void PrefetchRow(const TextureData& data, const IndexList<T>& texel) {
  const std::ptrdiff_t texel_bytes = data.TexelBytes();
  for (int lane = 0; lane < IndexList<T>::kLanes; lane += kStep) {
    __builtin_prefetch(data.bytes.data() + texel.of_lane[lane] * texel_bytes);
  }
}

// Prefetches most texels that will be read at `taps`. Neighbouring lanes read neighbouring texels: every second lane
// (fourth, in the coarser level) touches nearly all cache lines, and one lane's lower row is often another's upper row.
template <class T>
FACET_INLINE void PrefetchTexels(const TextureData& data, const TextureTaps<T>& taps) {
  for (int i = 0; i < taps.count;) {
    PrefetchRow<2, T>(data, taps.taps[i++].top);
    if (taps.two_levels) PrefetchRow<4, T>(data, taps.taps[i++].top);
  }
}

// The components R, G, B and A of two neighbouring texels at `p`, gathered by TextureData::pair_bytes one at a time.
struct ScalarPairs {
  const std::uint8_t* p;
  const TextureData& data;
  FACET_INLINE std::int32_t Byte(int i) const {
    const std::uint8_t from = data.pair_bytes[i];
    return from == TextureData::kNoByte ? 0 : p[from];
  }
  FACET_INLINE std::int32_t Component(int i) const {
    const auto kept = static_cast<std::uint16_t>(Byte(2 * i) | Byte(2 * i + 1) << 8);
    return static_cast<std::int16_t>(data.sparse ? kept ^ 0x8000 : kept);
  }
  FACET_INLINE std::int32_t Left(int channel) const { return Component(2 * channel); }
  FACET_INLINE std::int32_t Right(int channel) const { return Component(2 * channel + 1); }
};

#if HWY_TARGET == HWY_SCALAR
template <class T>
inline constexpr bool kInLanes = false;
#else
template <class T>
inline constexpr bool kInLanes = std::is_same_v<T, Float>;
#endif

// For each channel of one texture the sum of its components times their weights.
template <class T, bool kLanes = kInLanes<T>>
struct TexelSums {
  std::conditional_t<kWholeWeights<T>, std::int32_t, T> of_channel[4];
};
template <class T>
struct TexelSums<T, true> {
  IndexList<T> rows[4];  // R, G, B and A of a lane are adjacent; row j holds lanes j, j + 4 and so on
};

#if HWY_TARGET != HWY_SCALAR
// Byte shuffles: the j-th broadcasts 32-bit word j of each 16-byte block to the whole block.
struct WordOfBlocks {
  alignas(16) std::uint8_t bytes[4][16];
  constexpr WordOfBlocks() : bytes{} {
    for (int i = 0; i < 64; ++i) bytes[i / 16][i % 16] = static_cast<std::uint8_t>(i / 16 * 4 + i % 4);
  }
};
inline constexpr WordOfBlocks kWordOfBlocks;

// The two texels of a row are one 16-byte block of 16-bit integers (R, R, G, G, B, B, A, A): one multiply-add of pairs
// weighs both. A vector holds two such blocks, of every fourth lane; four are no faster where 512 bits run in halves.
template <int kCount, bool kSparse, class T>
FACET_INLINE void SumTexelsInLanes(const TextureData* const* textures, const TextureTaps<T>& taps, TexelSums<T>* sums) {
  using Tag = hn::CappedTag<std::int32_t, 8>;
  const Tag d32;
  const hn::Repartition<std::uint8_t, Tag> d8;
  const hn::Repartition<std::int16_t, Tag> d16;
  constexpr int kLanes = IndexList<T>::kLanes, kVector = hn::MaxLanes(Tag());
  // Byte offsets of the texel pairs in the upper and lower row; a texture of 2^27 texels of 8 bytes stays below 2^31.
  IndexList<T> at[2 * TextureTaps<T>::kMax][kCount][2];
  for (int i = 0; i < taps.count; ++i) {
    const Int top = LoadInt(taps.taps[i].top.of_lane), bottom = LoadInt(taps.taps[i].bottom.of_lane);
    for (int k = 0; k < kCount; ++k) {
      const Int size(textures[k]->TexelBytes());
      at[i][k][0] = top * size;
      at[i][k][1] = bottom * size;
    }
  }
  for (int first = 0; first < kLanes; first += kVector) {
    for (int j = 0; j < 4; ++j) {
      hn::Vec<Tag> sum[kCount], more[kCount];  // `more`: on Arm, the sums of every second product
      for (int k = 0; k < kCount; ++k) sum[k] = more[k] = hn::Zero(d32);
      const auto component = hn::LoadDup128(d8, kWordOfBlocks.bytes[j]);
      const auto weights = [&](const WeightPair<T>& of) HWY_ATTR {
        const auto all = hn::BitCast(d8, hn::Load(d32, of.of_lane.of_lane + first));
        return hn::BitCast(d16, hn::TableLookupBytes(all, component));
      };
      int count = 0;  // of the lane that has most taps; the surplus taps of the others have weight 0
      for (int lane = j; lane < kVector; lane += 4) count = std::max(count, taps.of_lane.of_lane[first + lane]);
      for (int i = 0; i < count; ++i) {
        const auto top = weights(taps.taps[i].top_weights), bottom = weights(taps.taps[i].bottom_weights);
        for (int k = 0; k < kCount; ++k) {
          const auto pair_bytes = hn::LoadDup128(d8, textures[k]->pair_bytes);
          const auto pairs = [&](const IndexList<T>& byte) HWY_ATTR {
            const auto texels = EveryFourthRow(d8, textures[k]->bytes.data(), byte.of_lane + first + j);
            const auto components = hn::BitCast(d16, hn::TableLookupBytesOr0(texels, pair_bytes));
            return kSparse ? hn::Xor(components, hn::Set(d16, std::int16_t{-32768})) : components;
          };
          sum[k] = hn::ReorderWidenMulAccumulate(d32, pairs(at[i][k][0]), top, sum[k], more[k]);
          sum[k] = hn::ReorderWidenMulAccumulate(d32, pairs(at[i][k][1]), bottom, sum[k], more[k]);
        }
      }
      for (int k = 0; k < kCount; ++k) {
        hn::Store(hn::RearrangeToOddPlusEven(sum[k], more[k]), d32, sums[k].rows[j].of_lane + first);
      }
    }
  }
}
#endif

// Sums the texels of kCount textures that share `taps`. A sparse texture must come alone. (Large, hence not inlined.)
template <int kCount, class T>
HWY_NOINLINE void SumTexels(const TextureData* const* textures, const TextureTaps<T>& taps, TexelSums<T>* sums) {
  if constexpr (kInLanes<T>) {
    if (kCount == 1 && textures[0]->sparse) {
      SumTexelsInLanes<1, true>(textures, taps, sums);
    } else {
      SumTexelsInLanes<kCount, false>(textures, taps, sums);
    }
  } else {
    for (int k = 0; k < kCount; ++k) {
      auto& of_channel = sums[k].of_channel;
      for (auto& sum : of_channel) sum = 0;
      for (int i = 0; i < taps.of_lane.of_lane[0]; ++i) {
        const auto add = [&](const IndexList<T>& texel, const WeightPair<T>& weights) {
          const ScalarPairs pairs{
              textures[k]->bytes.data() + std::ptrdiff_t(texel.of_lane[0]) * textures[k]->TexelBytes(), *textures[k]};
          for (int c = 0; c < 4; ++c) {
            of_channel[c] = of_channel[c] + (weights.Left() * pairs.Left(c) + weights.Right() * pairs.Right(c));
          }
        };
        add(taps.taps[i].top, taps.taps[i].top_weights);
        add(taps.taps[i].bottom, taps.taps[i].bottom_weights);
      }
    }
  }
}
template <class T>
FACET_INLINE void SumTexels(int count, const TextureData* const* of, const TextureTaps<T>& taps, TexelSums<T>* sums) {
  for (; count > 5; count -= 5, of += 5, sums += 5) SumTexels<5, T>(of, taps, sums);
  switch (count) {
    case 1: return SumTexels<1, T>(of, taps, sums);
    case 2: return SumTexels<2, T>(of, taps, sums);
    case 3: return SumTexels<3, T>(of, taps, sums);
    case 4: return SumTexels<4, T>(of, taps, sums);
    default: return SumTexels<5, T>(of, taps, sums);
  }
}

// The filtered values in [0, 1] of the channels in kChannels (a ChannelMask), from `sums`; other channels are 0.
template <int kChannels, class T>
FACET_INLINE Vec4<T> ChannelsOf(const TextureData& data, const TexelSums<T>& sums) {
  // From sums of weighted components to [0, 1]. 16-bit components were summed as code - 32768, which is added back.
  const T scale((data.is_16_bit ? 1.0f / 65535.0f : 1.0f / 255.0f) / kWeightSum<T>);
  Vec4<T> c{};
  if constexpr (kWholeWeights<T>) {
    IntOf<T> of_channel[4];
#if HWY_TARGET != HWY_SCALAR
    if constexpr (kInLanes<T>) {
      Int::Raw rows[4], raw[4];
      for (int j = 0; j < 4; ++j) rows[j] = hn::Load(IntTag(), sums.rows[j].of_lane);
      Transpose(IntTag(), rows, raw);
      for (int i = 0; i < 4; ++i) of_channel[i] = raw[i];
    } else
#endif
    {
      for (int i = 0; i < 4; ++i) of_channel[i] = sums.of_channel[i];
    }
    const IntOf<T> middle(data.is_16_bit ? 32768 * static_cast<std::int32_t>(kWeightSum<T>) : 0);
    const auto component = [&](int i) HWY_ATTR { return FromInt<T>(of_channel[i] + middle) * scale; };
    if constexpr ((kChannels & kR) != 0) c.x = component(0);
    if constexpr ((kChannels & kG) != 0) c.y = component(1);
    if constexpr ((kChannels & kB) != 0) c.z = component(2);
    if constexpr ((kChannels & kA) != 0) c.w = component(3);
  } else {
    const T middle(data.is_16_bit ? 32768.0f : 0.0f);
    const auto component = [&](int channel) { return (sums.of_channel[channel] + middle) * scale; };
    c = {component(0), component(1), component(2), component(3)};
  }
  if constexpr ((kChannels & kA) != 0) {
    if (data.component_of[3] < 0) c.w = T(1.0f);
  }
  return c;
}

// Filters `texture` with taps that were made for it, or for another texture that is sampled alike.
template <int kChannels, class T>
FACET_INLINE Vec4<T> ReadTexture(const BoundTexture& texture, const TextureTaps<T>& taps) {
  TexelSums<T> sums;
  SumTexels<1, T>(&texture.data, taps, &sums);
  return ChannelsOf<kChannels>(*texture.data, sums);
}

// Samples `texture` at interpolated coordinates `uv` with their derivatives over one pixel.
template <int kChannels, class T>
FACET_INLINE Vec4<T> SampleTexture(const BoundTexture& texture, Vec2<T> uv, Vec2<T> duv_dx, Vec2<T> duv_dy) {
  TextureTaps<T> taps;
  MakeTextureTaps(texture, uv, duv_dx, duv_dy, taps);
  return ReadTexture<kChannels>(texture, taps);
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
