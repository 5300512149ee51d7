// The integer types that go with T = Float, float or double, and table lookups with them: lanes load and gather,
// scalars index. Tables are of float for every T.

#if defined(FACET_SHADER_LOOKUP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_SHADER_LOOKUP_INL_H_
#undef FACET_SHADER_LOOKUP_INL_H_
#else
#define FACET_SHADER_LOOKUP_INL_H_
#endif

#include <cstddef>
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

// --- The scalar integers, corresponding to Int ----- ----------------------------------------------------------------

FACET_INLINE std::int32_t Select(bool m, std::int32_t a, std::int32_t b) { return m ? a : b; }
FACET_INLINE std::int32_t Min(std::int32_t a, std::int32_t b) { return a < b ? a : b; }
FACET_INLINE std::int32_t Max(std::int32_t a, std::int32_t b) { return a > b ? a : b; }
template <int kBits>
FACET_INLINE std::int32_t ShiftLeft(std::int32_t a) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) << kBits);
}
template <int kBits>
FACET_INLINE std::int32_t ShiftRightArithmetic(std::int32_t a) {
  return a >> kBits;
}
template <int kBits>
FACET_INLINE std::int32_t ShiftRightLogical(std::int32_t a) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) >> kBits);
}

// Rounds towards zero. The caller ensures the range (Clamp turns a NaN into the lower bound).
template <class T, RequireScalar<T> = 0>
FACET_INLINE std::int32_t TruncateToInt(T a) {
  return static_cast<std::int32_t>(a);
}
template <class T>
FACET_INLINE T FromInt(IntOf<T> a) {
  if constexpr (std::is_same_v<T, Float>) {
    return ToFloat(a);
  } else {
    return static_cast<T>(a);
  }
}

// --- Memory ---------------------------------------------------------------------------------------------------------

// Loads the value at p, or one for each lane from p on.
template <class T>
FACET_INLINE T Load(const float* p) {
  if constexpr (std::is_same_v<T, Float>) {
    return LoadFloat(p);
  } else {
    return static_cast<T>(*p);
  }
}
template <class T>
FACET_INLINE IntOf<T> LoadIntOf(const std::int32_t* p) {
  if constexpr (std::is_same_v<T, Float>) {
    return LoadInt(p);
  } else {
    return *p;
  }
}

// p[index] as T.
template <class T>
FACET_INLINE T Fetch(const float* p, IntOf<T> index) {
  if constexpr (std::is_same_v<T, Float>) {
    return Gather(p, index);
  } else {
    return static_cast<T>(p[index]);
  }
}
FACET_INLINE Int FetchInt(const std::int32_t* p, Int index) { return Gather(p, index); }
FACET_INLINE std::int32_t FetchInt(const std::int32_t* p, std::int32_t index) { return p[index]; }

// p[index] for a table of 16 entries, which fits registers.
FACET_INLINE Int FetchOf16(const std::int32_t* p, Int index) {
#if HWY_TARGET == HWY_AVX3
  return hn::TableLookupLanes(hn::LoadU(IntTag(), p), hn::IndicesFromVec(IntTag(), index.raw));
#else
  return Gather(p, index);
#endif
}
FACET_INLINE std::int32_t FetchOf16(const std::int32_t* p, std::int32_t index) { return p[index]; }

// Loads of several adjacent values, p[index], p[index + 1] and so on, for each lane: one vector load per lane, and a
// transposition. Processors gather element by element, so one gather for each value would take several times as long.
#if HWY_TARGET != HWY_SCALAR
// The 16 bytes at p + at[0], those at p + at[4], and so on, for every fourth lane, in one vector.
template <class D, class Number>
FACET_INLINE hn::Vec<D> EveryFourthRow(D d, const Number* p, const std::int32_t* at) {
  constexpr std::size_t kRows = hn::MaxLanes(D()) * sizeof(hn::TFromD<D>) / 16;
  if constexpr (kRows == 1) {
    return hn::LoadU(d, p + at[0]);
  } else {
    const hn::Half<D> half;
    return hn::Combine(d, EveryFourthRow(half, p, at + 2 * kRows), EveryFourthRow(half, p, at));
  }
}
// Transposes: rows[j] has four values each of lanes j, j + 4 and so on; the results have one value of every lane.
template <class D>
FACET_INLINE void Transpose(D d, const hn::Vec<D> (&rows)[4], hn::Vec<D>* out) {
  const auto xy02 = hn::InterleaveLower(d, rows[0], rows[2]), zw02 = hn::InterleaveUpper(d, rows[0], rows[2]);
  const auto xy13 = hn::InterleaveLower(d, rows[1], rows[3]), zw13 = hn::InterleaveUpper(d, rows[1], rows[3]);
  out[0] = hn::InterleaveLower(d, xy02, xy13);
  out[1] = hn::InterleaveUpper(d, xy02, xy13);
  out[2] = hn::InterleaveLower(d, zw02, zw13);
  out[3] = hn::InterleaveUpper(d, zw02, zw13);
}
template <class D, class Number>
FACET_INLINE void TransposedRows(D d, const Number* p, const std::int32_t* at, hn::Vec<D>* out) {
  const hn::Vec<D> rows[4] = {EveryFourthRow(d, p, at), EveryFourthRow(d, p, at + 1),
                              EveryFourthRow(d, p, at + 2), EveryFourthRow(d, p, at + 3)};
  Transpose(d, rows, out);
}
#endif

// The index of each lane, stored in memory for lane-by-lane loads.
template <class T>
struct IndexList {
  static constexpr int kLanes = sizeof(IntOf<T>) / sizeof(std::int32_t);
  alignas(IntOf<T>) std::int32_t of_lane[kLanes];
  FACET_INLINE void operator=(IntOf<T> index) {
    if constexpr (std::is_same_v<T, Float>) {
      Store(index, of_lane);
    } else {
      of_lane[0] = index;
    }
  }
};

template <class T>
FACET_INLINE Vec4<T> FetchVec4(const float* p, IntOf<T> index) {
  if constexpr (!std::is_same_v<T, Float>) {
    return {Fetch<T>(p, index), Fetch<T>(p + 1, index), Fetch<T>(p + 2, index), Fetch<T>(p + 3, index)};
  } else {
#if HWY_TARGET == HWY_SCALAR
    return {Gather(p, index), Gather(p + 1, index), Gather(p + 2, index), Gather(p + 3, index)};
#else
    alignas(64) std::int32_t at[kMaxLanes];
    Store(index, at);
    Float::Raw rows[4];
    TransposedRows(FloatTag(), p, at, rows);
    return {rows[0], rows[1], rows[2], rows[3]};
#endif
  }
}

// Bilinear interpolation: (w[0] p[i[0]] + w[1] p[i[1]]) + (w[2] p[i[2]] + w[3] p[i[3]]) for three adjacent components,
// of which a fourth must be readable. Components are weighted in memory order and only the sums are transposed, which
// takes a quarter of the shuffles.
template <class T>
FACET_INLINE Vec3<T> WeighFour(const float* p, const IntOf<T> (&i)[4], const T (&w)[4]) {
#if HWY_TARGET != HWY_SCALAR
  if constexpr (std::is_same_v<T, Float>) {
    const FloatTag d;
    alignas(64) std::int32_t at[4][kMaxLanes];
    for (int k = 0; k < 4; ++k) Store(i[k], at[k]);
    // For lanes kRow, kRow + 4 and so on. The weights of each are one of the four words of a 16-byte block.
    const auto sum = [&]<int kRow>(std::integral_constant<int, kRow>) HWY_ATTR {
      const auto term = [&](int k) HWY_ATTR {
        return hn::Mul(EveryFourthRow(d, p, at[k] + kRow), hn::Broadcast<kRow>(w[k].raw));
      };
      return hn::Add(hn::Add(term(0), term(1)), hn::Add(term(2), term(3)));
    };
    const Float::Raw rows[4] = {sum(std::integral_constant<int, 0>()), sum(std::integral_constant<int, 1>()),
                                sum(std::integral_constant<int, 2>()), sum(std::integral_constant<int, 3>())};
    Float::Raw out[4];
    Transpose(d, rows, out);
    return {out[0], out[1], out[2]};
  }
#endif
  const auto term = [&](int k) HWY_ATTR { return Xyz(FetchVec4<T>(p, i[k])) * w[k]; };
  return (term(0) + term(1)) + (term(2) + term(3));
}

// The position of x in [0, last] between two samples: floor (at most last - 1) and fraction.
template <class T>
struct TablePosition {
  IntOf<T> index;
  T fraction;
};
template <class T>
FACET_INLINE TablePosition<T> PositionInTable(T x, float last) {
  const T clamped = Clamp(x, T(0.0f), T(last));
  const T cell = Min(Floor(clamped), T(last - 1.0f));
  return {TruncateToInt(cell), clamped - cell};
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
