// The integers that go with T = Float, float or double, and reading numbers from memory with them: lanes load and
// gather, float and double index. Tables hold floats, whatever T is.

#if defined(FACET_SHADER_LOOKUP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_SHADER_LOOKUP_INL_H_
#undef FACET_SHADER_LOOKUP_INL_H_
#else
#define FACET_SHADER_LOOKUP_INL_H_
#endif

#include <cstdint>
#include <type_traits>

#include "facet/shader/vec-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

template <class T>
struct IntTraits {  // float and double
  using Type = std::int32_t;
};
template <>
struct IntTraits<Float> {
  using Type = Int;
};
template <class T>
using IntOf = typename IntTraits<T>::Type;

// --- Integers of scalars, as Int stands beside Float -----------------------------------------------------------------

HWY_INLINE std::int32_t Select(bool m, std::int32_t a, std::int32_t b) { return m ? a : b; }
HWY_INLINE std::int32_t Min(std::int32_t a, std::int32_t b) { return a < b ? a : b; }
HWY_INLINE std::int32_t Max(std::int32_t a, std::int32_t b) { return a > b ? a : b; }
template <int kBits>
HWY_INLINE std::int32_t ShiftLeft(std::int32_t a) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) << kBits);
}
template <int kBits>
HWY_INLINE std::int32_t ShiftRightArithmetic(std::int32_t a) {
  return a >> kBits;
}
template <int kBits>
HWY_INLINE std::int32_t ShiftRightLogical(std::int32_t a) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) >> kBits);
}

// Towards zero; the caller keeps it in range (Clamp turns a NaN into the lower bound).
template <class T, RequireScalar<T> = 0>
HWY_INLINE std::int32_t TruncateToInt(T a) {
  return static_cast<std::int32_t>(a);
}
template <class T>
HWY_INLINE T FromInt(IntOf<T> a) {
  if constexpr (std::is_same_v<T, Float>) {
    return ToFloat(a);
  } else {
    return static_cast<T>(a);
  }
}

// --- Memory ----------------------------------------------------------------------------------------------------------

// The number at p, or those of all lanes from p on.
template <class T>
HWY_INLINE T Load(const float* p) {
  if constexpr (std::is_same_v<T, Float>) {
    return LoadFloat(p);
  } else {
    return static_cast<T>(*p);
  }
}
template <class T>
HWY_INLINE IntOf<T> LoadIntOf(const std::int32_t* p) {
  if constexpr (std::is_same_v<T, Float>) {
    return LoadInt(p);
  } else {
    return *p;
  }
}

// p[index] as T.
template <class T>
HWY_INLINE T Fetch(const float* p, IntOf<T> index) {
  if constexpr (std::is_same_v<T, Float>) {
    return Gather(p, index);
  } else {
    return static_cast<T>(p[index]);
  }
}
HWY_INLINE Int FetchInt(const std::int32_t* p, Int index) { return Gather(p, index); }
HWY_INLINE std::int32_t FetchInt(const std::int32_t* p, std::int32_t index) { return p[index]; }

// p[index] where p has 16 entries: such a table fits registers.
HWY_INLINE Int FetchOf16(const std::int32_t* p, Int index) {
#if HWY_TARGET == HWY_AVX3
  return hn::TableLookupLanes(hn::LoadU(IntTag(), p), hn::IndicesFromVec(IntTag(), index.raw));
#else
  return Gather(p, index);
#endif
}
HWY_INLINE std::int32_t FetchOf16(const std::int32_t* p, std::int32_t index) { return p[index]; }

// p[2 index] and p[2 index + 1].
HWY_INLINE void FetchIntPair(const std::int32_t* p, Int index, Int& first, Int& second) {
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX2  // half as many elements to gather
  const IntTag d;
  const hn::Repartition<std::int64_t, IntTag> wide;
  const auto* pairs = reinterpret_cast<const std::int64_t*>(p);
  const auto gather = [&](auto half) HWY_ATTR {
    return hn::BitCast(d, hn::GatherIndex(wide, pairs, hn::PromoteTo(wide, half)));
  };
  const auto low = gather(hn::LowerHalf(index.raw)), high = gather(hn::UpperHalf(hn::Half<IntTag>(), index.raw));
  first = hn::ConcatEven(d, high, low);
  second = hn::ConcatOdd(d, high, low);
#else
  const Int twice = index + index;
  first = Gather(p, twice);
  second = Gather(p + 1, twice);
#endif
}
HWY_INLINE void FetchIntPair(const std::int32_t* p, std::int32_t index, std::int32_t& first, std::int32_t& second) {
  first = p[2 * index];
  second = p[2 * index + 1];
}

#if HWY_TARGET != HWY_SCALAR
// The four numbers at p + at[0], those at p + at[4], and so on, side by side.
template <class D>
HWY_INLINE hn::Vec<D> EveryFourthRow(D d, const float* p, const std::int32_t* at) {
  if constexpr (hn::MaxLanes(D()) == 4) {
    return hn::LoadU(d, p + at[0]);
  } else {
    const hn::Half<D> half;
    return hn::Combine(d, EveryFourthRow(half, p, at + hn::MaxLanes(half)), EveryFourthRow(half, p, at));
  }
}
#endif

// The four numbers p[index], p[index + 1], ... as T. One wide load a lane and a transposition: processors gather
// element by element, so four gathers take about four times as long.
template <class T>
HWY_INLINE Vec4<T> FetchVec4(const float* p, IntOf<T> index) {
  if constexpr (!std::is_same_v<T, Float>) {
    return {Fetch<T>(p, index), Fetch<T>(p + 1, index), Fetch<T>(p + 2, index), Fetch<T>(p + 3, index)};
  } else {
#if HWY_TARGET == HWY_SCALAR
    return {Gather(p, index), Gather(p + 1, index), Gather(p + 2, index), Gather(p + 3, index)};
#else
    const FloatTag d;
    alignas(64) std::int32_t at[kMaxLanes];
    Store(index, at);
    const auto r0 = EveryFourthRow(d, p, at), r1 = EveryFourthRow(d, p, at + 1), r2 = EveryFourthRow(d, p, at + 2),
               r3 = EveryFourthRow(d, p, at + 3);
    const auto xy02 = hn::InterleaveLower(d, r0, r2), zw02 = hn::InterleaveUpper(d, r0, r2);
    const auto xy13 = hn::InterleaveLower(d, r1, r3), zw13 = hn::InterleaveUpper(d, r1, r3);
    return {hn::InterleaveLower(d, xy02, xy13), hn::InterleaveUpper(d, xy02, xy13),
            hn::InterleaveLower(d, zw02, zw13), hn::InterleaveUpper(d, zw02, zw13)};
#endif
  }
}

// Where x in [0, last] lies between two samples: floor (at most last - 1) and fraction.
template <class T>
struct TablePosition {
  IntOf<T> index;
  T fraction;
};
template <class T>
HWY_INLINE TablePosition<T> PositionInTable(T x, float last) {
  const T clamped = Clamp(x, T(0.0f), T(last));
  const T cell = Min(Floor(clamped), T(last - 1.0f));
  return {TruncateToInt(cell), clamped - cell};
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
