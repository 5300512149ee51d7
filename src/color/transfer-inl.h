// The sRGB transfer functions on lanes, float and double. See color/srgb.h.

#if defined(FACET_COLOR_TRANSFER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_COLOR_TRANSFER_INL_H_
#undef FACET_COLOR_TRANSFER_INL_H_
#else
#define FACET_COLOR_TRANSFER_INL_H_
#endif

#include "color/srgb.h"
#include "facet/shader/elementary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// Encoded to linear, any sign, to a few ULP.
template <class T>
FACET_INLINE T SrgbToLinear(T encoded) {
  const T power = Pow(Max((encoded + T(0.055f)) / T(1.055f), T(0.0f)), T(2.4f));
  return Select(encoded <= T(0.04045f), encoded / T(12.92f), power);
}

// Linear to encoded, any sign, to a few ULP.
template <class T>
FACET_INLINE T LinearToSrgb(T linear) {
  const T power = T(1.055f) * Pow(Max(linear, T(0.0f)), T(1.0f / 2.4f)) - T(0.055f);
  return Select(linear <= T(0.0031308f), linear * T(12.92f), power);
}

// The nearest 8-bit code, exactly: LinearToSrgb8 on lanes. NaN gives 0.
FACET_INLINE Int NearestSrgb8(Float linear, const SrgbTables& tables) {
  // What lies outside the buckets has the code of their ends.
  const Float bounded = Clamp(linear, FloatFromBits(Int(SrgbTables::kFirstBits)), Float(0x1.fffffep-1f));
  constexpr int kShift = SrgbTables::kBucketShift;
  const Int bits = BitsOf(bounded);
  const Int ramp = Gather(tables.ramps8.data(), ShiftRightArithmetic<kShift>(bits - Int(SrgbTables::kFirstBits)));
  return ShiftRightArithmetic<kShift>(ramp + (bits & Int(SrgbTables::kInBucket)));
}

// The nearest 16-bit code, exactly, given Srgb16Thresholds(). NaN gives 0.
FACET_INLINE Int NearestSrgb16(Float linear, const float* thresholds) {
  const Float bounded = Clamp(linear, Float(0.0f), Float(1.0f));
  const Int code = TruncateToInt(LinearToSrgb(bounded) * Float(65535.0f) + Float(0.5f));  // off by one at most
  const Int lower = Select(bounded < Gather(thresholds, code), Int(1), Int(0));
  const Int higher = Select(bounded < Gather(thresholds, code + Int(1)), Int(0), Int(1));
  return code - lower + higher;
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
