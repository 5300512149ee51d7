// Lanes: Float, Int and Mask hold one value for each of N fragments (N depends on the instruction set; no result does).
// The same free functions exist for plain float and double, so that a functor template over T runs on lanes in the
// rasterizer, in double in the reference and in float in tests.
//
// There are only operations that IEEE 754 rounds correctly: + - * / sqrt, comparison, selection, rounding; no fused
// multiply-add and no reciprocal estimates. Min and Max are selections, (a < b ? a : b), so that a NaN in `a` gives b
// on every target.

#if defined(FACET_SHADER_LANE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_SHADER_LANE_INL_H_
#undef FACET_SHADER_LANE_INL_H_
#else
#define FACET_SHADER_LANE_INL_H_
#endif

#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "facet/shader/inline.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::ScalableTag<float>;
using IntTag = hn::ScalableTag<std::int32_t>;
using UintTag = hn::ScalableTag<std::uint32_t>;

// The number of lanes.
FACET_INLINE HWY_MAYBE_UNUSED std::size_t LaneCount() { return hn::Lanes(FloatTag()); }
// A constant upper bound of the number of lanes.
inline constexpr std::size_t kMaxLanes = HWY_MAX_BYTES / sizeof(float) < 1 ? 1 : HWY_MAX_BYTES / sizeof(float);

// Default construction leaves lanes uninitialised, as for float; Float{} is zero. (A user-provided constructor would be
// called from the implicit constructors of structs of lanes, which GCC compiles for the baseline instruction set.)

// --- Types ----------------------------------------------------------------------------------------------------------

struct Mask {
  using Raw = hn::Mask<FloatTag>;
  Raw raw;
  Mask() = default;
  FACET_INLINE Mask(Raw r) : raw(r) {}  // NOLINT: implicit on purpose
  FACET_INLINE explicit Mask(bool b)
      : raw(hn::RebindMask(FloatTag(), hn::Eq(hn::Set(IntTag(), b ? 1 : 0), hn::Set(IntTag(), 1)))) {}
};

struct Float {
  using Raw = hn::Vec<FloatTag>;
  Raw raw;
  Float() = default;
  FACET_INLINE Float(Raw r) : raw(r) {}                         // NOLINT
  FACET_INLINE Float(float f) : raw(hn::Set(FloatTag(), f)) {}  // NOLINT: constants as in scalar code
};

struct Int {
  using Raw = hn::Vec<IntTag>;
  Raw raw;
  Int() = default;
  FACET_INLINE Int(Raw r) : raw(r) {}                              // NOLINT
  FACET_INLINE Int(std::int32_t i) : raw(hn::Set(IntTag(), i)) {}  // NOLINT
};

template <class T>
struct LaneTraits {  // float and double
  using MaskType = bool;
};
template <>
struct LaneTraits<Float> {
  using MaskType = Mask;
};
template <class T>
using MaskOf = typename LaneTraits<T>::MaskType;

template <class T>
using RequireScalar = std::enable_if_t<std::is_floating_point_v<T>, int>;

// --- Float ----------------------------------------------------------------------------------------------------------

FACET_INLINE Float operator+(Float a, Float b) { return hn::Add(a.raw, b.raw); }
FACET_INLINE Float operator-(Float a, Float b) { return hn::Sub(a.raw, b.raw); }
FACET_INLINE Float operator*(Float a, Float b) { return hn::Mul(a.raw, b.raw); }
FACET_INLINE Float operator/(Float a, Float b) { return hn::Div(a.raw, b.raw); }
FACET_INLINE Float operator-(Float a) { return hn::Neg(a.raw); }
FACET_INLINE Float& operator+=(Float& a, Float b) { return a = a + b; }
FACET_INLINE Float& operator-=(Float& a, Float b) { return a = a - b; }
FACET_INLINE Float& operator*=(Float& a, Float b) { return a = a * b; }
FACET_INLINE Mask operator<(Float a, Float b) { return hn::Lt(a.raw, b.raw); }
FACET_INLINE Mask operator<=(Float a, Float b) { return hn::Le(a.raw, b.raw); }
FACET_INLINE Mask operator>(Float a, Float b) { return hn::Gt(a.raw, b.raw); }
FACET_INLINE Mask operator>=(Float a, Float b) { return hn::Ge(a.raw, b.raw); }
FACET_INLINE Mask operator==(Float a, Float b) { return hn::Eq(a.raw, b.raw); }

FACET_INLINE Float Select(Mask m, Float a, Float b) { return hn::IfThenElse(m.raw, a.raw, b.raw); }
#if HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR  // x86's instructions are these selections
FACET_INLINE Float Min(Float a, Float b) { return hn::Min(a.raw, b.raw); }
FACET_INLINE Float Max(Float a, Float b) { return hn::Max(a.raw, b.raw); }
#else
FACET_INLINE Float Min(Float a, Float b) { return Select(a < b, a, b); }
FACET_INLINE Float Max(Float a, Float b) { return Select(a > b, a, b); }
#endif
FACET_INLINE Float Clamp(Float x, Float low, Float high) { return Min(Max(x, low), high); }
FACET_INLINE Float Abs(Float a) { return hn::Abs(a.raw); }
FACET_INLINE Float Sqrt(Float a) { return hn::Sqrt(a.raw); }
#if HWY_TARGET == HWY_SCALAR  // Highway's loses the sign of a zero result
FACET_INLINE Float Floor(Float a) { return hn::CopySign(hn::Floor(a.raw), a.raw); }
FACET_INLINE Float RoundEven(Float a) { return hn::CopySign(hn::Round(a.raw), a.raw); }  // ties to even
#else
FACET_INLINE Float Floor(Float a) { return hn::Floor(a.raw); }
FACET_INLINE Float RoundEven(Float a) { return hn::Round(a.raw); }  // ties to even
#endif
FACET_INLINE Float CopySign(Float magnitude, Float sign) { return hn::CopySign(magnitude.raw, sign.raw); }

// --- Int ------------------------------------------------------------------------------------------------------------

FACET_INLINE Int operator+(Int a, Int b) { return hn::Add(a.raw, b.raw); }
FACET_INLINE Int operator-(Int a, Int b) { return hn::Sub(a.raw, b.raw); }
FACET_INLINE Int operator*(Int a, Int b) { return hn::Mul(a.raw, b.raw); }
FACET_INLINE Int operator&(Int a, Int b) { return hn::And(a.raw, b.raw); }
FACET_INLINE Int operator|(Int a, Int b) { return hn::Or(a.raw, b.raw); }
FACET_INLINE Int operator^(Int a, Int b) { return hn::Xor(a.raw, b.raw); }
FACET_INLINE Mask operator==(Int a, Int b) { return hn::RebindMask(FloatTag(), hn::Eq(a.raw, b.raw)); }
FACET_INLINE Mask operator<(Int a, Int b) { return hn::RebindMask(FloatTag(), hn::Lt(a.raw, b.raw)); }
FACET_INLINE Mask operator>(Int a, Int b) { return hn::RebindMask(FloatTag(), hn::Gt(a.raw, b.raw)); }
template <int kBits>
FACET_INLINE Int ShiftLeft(Int a) {
  return hn::ShiftLeft<kBits>(a.raw);
}
template <int kBits>
FACET_INLINE Int ShiftRightArithmetic(Int a) {
  return hn::ShiftRight<kBits>(a.raw);
}
template <int kBits>
FACET_INLINE Int ShiftRightLogical(Int a) {
  return hn::BitCast(IntTag(), hn::ShiftRight<kBits>(hn::BitCast(UintTag(), a.raw)));
}
FACET_INLINE Int Select(Mask m, Int a, Int b) { return hn::IfThenElse(hn::RebindMask(IntTag(), m.raw), a.raw, b.raw); }
FACET_INLINE Int Min(Int a, Int b) { return hn::Min(a.raw, b.raw); }
FACET_INLINE Int Max(Int a, Int b) { return hn::Max(a.raw, b.raw); }

FACET_INLINE Float ToFloat(Int a) { return hn::ConvertTo(FloatTag(), a.raw); }
// Rounds towards zero. The caller ensures |a| < 2^31, since results beyond differ between processors.
FACET_INLINE Int TruncateToInt(Float a) { return hn::ConvertTo(IntTag(), a.raw); }
FACET_INLINE Int BitsOf(Float a) { return hn::BitCast(IntTag(), a.raw); }
FACET_INLINE Float FloatFromBits(Int a) { return hn::BitCast(FloatTag(), a.raw); }

// --- Mask -----------------------------------------------------------------------------------------------------------

FACET_INLINE Mask operator&(Mask a, Mask b) { return hn::And(a.raw, b.raw); }
FACET_INLINE Mask operator|(Mask a, Mask b) { return hn::Or(a.raw, b.raw); }
FACET_INLINE Mask operator!(Mask a) { return hn::Not(a.raw); }
FACET_INLINE bool Any(Mask a) { return !hn::AllFalse(FloatTag(), a.raw); }
FACET_INLINE bool All(Mask a) { return hn::AllTrue(FloatTag(), a.raw); }
FACET_INLINE Mask IsFinite(Float a) { return hn::Lt(hn::Abs(a.raw), hn::Set(FloatTag(), HUGE_VALF)); }
// Bit i is lane i.
FACET_INLINE std::uint32_t BitsOf(Mask a) {
  alignas(8) std::uint8_t bits[8] = {};
  hn::StoreMaskBits(FloatTag(), a.raw, bits);
  std::uint32_t result;
  std::memcpy(&result, bits, sizeof result);
  return result;
}

// --- Memory ---------------------------------------------------------------------------------------------------------

FACET_INLINE Float LoadFloat(const float* p) { return hn::LoadU(FloatTag(), p); }
FACET_INLINE Int LoadInt(const std::int32_t* p) { return hn::LoadU(IntTag(), p); }
FACET_INLINE void Store(Float a, float* p) { hn::StoreU(a.raw, FloatTag(), p); }
FACET_INLINE void Store(Int a, std::int32_t* p) { hn::StoreU(a.raw, IntTag(), p); }
// Lane i reads p[index[i]].
FACET_INLINE Float Gather(const float* p, Int index) { return hn::GatherIndex(FloatTag(), p, index.raw); }
FACET_INLINE Int Gather(const std::int32_t* p, Int index) { return hn::GatherIndex(IntTag(), p, index.raw); }
// 0, 1, 2 ...
FACET_INLINE Int LaneIndex() { return hn::Iota(IntTag(), 0); }

// --- The same for float and double, selection for integers too ------------------------------------------------------

template <class T, std::enable_if_t<std::is_arithmetic_v<T>, int> = 0>
FACET_INLINE T Select(bool m, T a, T b) {
  return m ? a : b;
}
template <class T, RequireScalar<T> = 0>
FACET_INLINE T Min(T a, T b) {
  return a < b ? a : b;
}
template <class T, RequireScalar<T> = 0>
FACET_INLINE T Max(T a, T b) {
  return a > b ? a : b;
}
template <class T, RequireScalar<T> = 0>
FACET_INLINE T Clamp(T x, T low, T high) {
  return Min(Max(x, low), high);
}
template <class T, RequireScalar<T> = 0>
FACET_INLINE T Abs(T a) {
  return std::fabs(a);
}
template <class T, RequireScalar<T> = 0>
FACET_INLINE T Sqrt(T a) {
  return std::sqrt(a);
}
template <class T, RequireScalar<T> = 0>
FACET_INLINE T Floor(T a) {
  return std::floor(a);
}
template <class T, RequireScalar<T> = 0>
FACET_INLINE T RoundEven(T a) {
  return std::nearbyint(a);
}
template <class T, RequireScalar<T> = 0>
FACET_INLINE T CopySign(T magnitude, T sign) {
  return std::copysign(magnitude, sign);
}
template <class T, RequireScalar<T> = 0>
FACET_INLINE bool IsFinite(T a) {
  return std::fabs(a) < std::numeric_limits<T>::infinity();
}
FACET_INLINE bool Any(bool a) { return a; }
FACET_INLINE bool All(bool a) { return a; }

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
