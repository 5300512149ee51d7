// Reading tables: lanes gather, float and double index.

#if defined(FACET_LIGHT_LOOKUP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_LIGHT_LOOKUP_INL_H_
#undef FACET_LIGHT_LOOKUP_INL_H_
#else
#define FACET_LIGHT_LOOKUP_INL_H_
#endif

#include "facet/shader/lane-inl.h"
#include "facet/shader/vec-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

template <class T>
struct IndexTraits {  // float and double
  using Type = std::int32_t;
};
template <>
struct IndexTraits<Float> {
  using Type = Int;
};
template <class T>
using IndexOf = typename IndexTraits<T>::Type;

// Towards zero; the caller keeps it in range (Clamp turns a NaN into the lower bound).
HWY_INLINE Int TruncateToIndex(Float x) { return TruncateToInt(x); }
template <class T, RequireScalar<T> = 0>
HWY_INLINE std::int32_t TruncateToIndex(T x) {
  return static_cast<std::int32_t>(x);
}

HWY_INLINE Float FetchAs(const float* p, Int index, Float) { return Gather(p, index); }
template <class T, RequireScalar<T> = 0>
HWY_INLINE T FetchAs(const float* p, std::int32_t index, T) {
  return static_cast<T>(p[index]);
}
// p[index] as T.
template <class T>
HWY_INLINE T Fetch(const float* p, IndexOf<T> index) {
  return FetchAs(p, index, T());
}
HWY_INLINE Int FetchIndex(const std::int32_t* p, Int index) { return Gather(p, index); }
HWY_INLINE std::int32_t FetchIndex(const std::int32_t* p, std::int32_t index) { return p[index]; }

HWY_INLINE Float IndexToReal(Int index, Float) { return ToFloat(index); }
template <class T, RequireScalar<T> = 0>
HWY_INLINE T IndexToReal(std::int32_t index, T) {
  return static_cast<T>(index);
}

// Where x in [0, last] lies between two samples: floor (at most last - 1) and fraction.
template <class T>
struct TablePosition {
  IndexOf<T> index;
  T fraction;
};
template <class T>
HWY_INLINE TablePosition<T> PositionInTable(T x, float last) {
  const T clamped = Clamp(x, T(0.0f), T(last));
  const T cell = Min(Floor(clamped), T(last - 1.0f));
  return {TruncateToIndex(cell), clamped - cell};
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
