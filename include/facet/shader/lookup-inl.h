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

#include "facet/shader/lane-inl.h"

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
