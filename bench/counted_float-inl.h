// A float that counts what is done with it. Shaders are templates over their arithmetic type: run with this one, they
// say how many operations they are.

#if defined(FACET_BENCH_COUNTED_FLOAT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_BENCH_COUNTED_FLOAT_INL_H_
#undef FACET_BENCH_COUNTED_FLOAT_INL_H_
#else
#define FACET_BENCH_COUNTED_FLOAT_INL_H_
#endif

#include <bit>
#include <cmath>
#include <cstdint>

#include "facet/shader/vec-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// What a comparison gives. (A type of its own, because compilers suspect & between bools.)
struct Truth {
  bool value;
  Truth(bool v) : value(v) {}  // NOLINT: as Mask
  operator bool() const { return value; }
  friend Truth operator&(Truth a, Truth b) { return a.value && b.value; }
  friend Truth operator|(Truth a, Truth b) { return a.value || b.value; }
  friend Truth operator!(Truth a) { return !a.value; }
};

struct Counted {
  static inline std::uint64_t simple = 0, divisions = 0, roots = 0;
  float value = 0.0f;

  Counted() = default;
  Counted(float v) : value(v) {}                                                 // NOLINT: as Float
  explicit Counted(std::int32_t v) : value(static_cast<float>(v)) { ++simple; }  // a conversion
  static float One(float v) { return ++simple, v; }
  static Truth Compare(bool b) { return ++simple, b; }

  friend Counted operator+(Counted a, Counted b) { return One(a.value + b.value); }
  friend Counted operator-(Counted a, Counted b) { return One(a.value - b.value); }
  friend Counted operator*(Counted a, Counted b) { return One(a.value * b.value); }
  friend Counted operator/(Counted a, Counted b) { return ++divisions, Counted(a.value / b.value); }
  friend Counted operator-(Counted a) { return One(-a.value); }
  friend Counted& operator+=(Counted& a, Counted b) { return a = a + b; }
  friend Counted& operator-=(Counted& a, Counted b) { return a = a - b; }
  friend Counted& operator*=(Counted& a, Counted b) { return a = a * b; }
  friend Truth operator<(Counted a, Counted b) { return Compare(a.value < b.value); }
  friend Truth operator<=(Counted a, Counted b) { return Compare(a.value <= b.value); }
  friend Truth operator>(Counted a, Counted b) { return Compare(a.value > b.value); }
  friend Truth operator>=(Counted a, Counted b) { return Compare(a.value >= b.value); }
  friend Truth operator==(Counted a, Counted b) { return Compare(a.value == b.value); }
  friend Counted Select(bool m, Counted a, Counted b) { return One(m ? a.value : b.value); }
  friend Counted Min(Counted a, Counted b) { return One(a.value < b.value ? a.value : b.value); }
  friend Counted Max(Counted a, Counted b) { return One(a.value < b.value ? b.value : a.value); }
  friend Counted Clamp(Counted x, Counted low, Counted high) { return Min(Max(x, low), high); }
  friend Counted Abs(Counted a) { return One(std::fabs(a.value)); }
  friend Counted Sqrt(Counted a) { return ++roots, Counted(std::sqrt(a.value)); }
  friend Counted Floor(Counted a) { return One(std::floor(a.value)); }
  friend Counted RoundEven(Counted a) { return One(std::nearbyint(a.value)); }
  friend Counted CopySign(Counted a, Counted sign) { return One(std::copysign(a.value, sign.value)); }
  friend Truth IsFinite(Counted a) { return Compare(std::isfinite(a.value)); }
  friend std::int32_t TruncateToInt(Counted a) { return ++simple, static_cast<std::int32_t>(a.value); }
  friend std::int32_t BitsOf(Counted a) { return std::bit_cast<std::int32_t>(a.value); }
};

template <>
struct LaneTraits<Counted> {
  using MaskType = Truth;
};

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
