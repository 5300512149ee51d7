#include "simd/lane_operations.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/lane_operations.cc"
#include "hwy/foreach_target.h"

#include <limits>

#include "facet/shader/vec-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

std::size_t TestLaneCount() { return LaneCount(); }

template <class T>
FACET_INLINE T ApplyFloatOp(FloatOp op, T a, T b, T c) {
  switch (op) {
    case FloatOp::Add: return a + b;
    case FloatOp::Sub: return a - b;
    case FloatOp::Mul: return a * b;
    case FloatOp::Div: return a / b;
    case FloatOp::Neg: return -a;
    case FloatOp::Select: return Select(a < b, b, c);
    case FloatOp::Min: return Min(a, b);
    case FloatOp::Max: return Max(a, b);
    case FloatOp::Clamp: return Clamp(a, b, c);
    case FloatOp::Abs: return Abs(a);
    case FloatOp::Sqrt: return Sqrt(a);
    case FloatOp::Floor: return Floor(a);
    case FloatOp::RoundEven: return RoundEven(a);
    case FloatOp::CopySign: return CopySign(a, b);
  }
  return a;
}

void TestOnLanes(FloatOp op, const FloatArrays& arrays) {
  for (std::size_t i = 0; i < arrays.count; i += LaneCount()) {
    Store(ApplyFloatOp(op, LoadFloat(arrays.a + i), LoadFloat(arrays.b + i), LoadFloat(arrays.c + i)), arrays.out + i);
  }
}
void TestOnFloats(FloatOp op, const FloatArrays& arrays) {
  for (std::size_t i = 0; i < arrays.count; ++i) {
    arrays.out[i] = ApplyFloatOp<float>(op, arrays.a[i], arrays.b[i], arrays.c[i]);
  }
}
void TestOnDoubles(FloatOp op, const FloatArrays& arrays) {
  for (std::size_t i = 0; i < arrays.count; ++i) {
    arrays.out[i] = float(ApplyFloatOp<double>(op, double(arrays.a[i]), double(arrays.b[i]), double(arrays.c[i])));
  }
}

FACET_INLINE Mask ApplyMaskOp(MaskOp op, Float a, Float b) {
  const Mask a_is_positive = a > Float(0.0f), b_is_positive = b > Float(0.0f);
  switch (op) {
    case MaskOp::Less: return a < b;
    case MaskOp::LessEqual: return a <= b;
    case MaskOp::Greater: return a > b;
    case MaskOp::GreaterEqual: return a >= b;
    case MaskOp::Equal: return a == b;
    case MaskOp::IsFinite: return IsFinite(a);
    case MaskOp::And: return a_is_positive & b_is_positive;
    case MaskOp::Or: return a_is_positive | b_is_positive;
    case MaskOp::Not: return !a_is_positive;
  }
  return Mask(false);
}

void TestMasks(MaskOp op, const float* a, const float* b, std::int32_t* out, std::size_t count) {
  for (std::size_t i = 0; i < count; i += LaneCount()) {
    Store(Select(ApplyMaskOp(op, LoadFloat(a + i), LoadFloat(b + i)), Int(1), Int(0)), out + i);
  }
}

FACET_INLINE Int ApplyIntOp(IntOp op, Int a, Int b) {
  switch (op) {
    case IntOp::Add: return a + b;
    case IntOp::Sub: return a - b;
    case IntOp::Mul: return a * b;
    case IntOp::And: return a & b;
    case IntOp::Or: return a | b;
    case IntOp::Xor: return a ^ b;
    case IntOp::Equal: return Select(a == b, Int(1), Int(0));
    case IntOp::Less: return Select(a < b, Int(1), Int(0));
    case IntOp::Greater: return Select(a > b, Int(1), Int(0));
    case IntOp::Select: return Select(a < b, b, a);
    case IntOp::Min: return Min(a, b);
    case IntOp::Max: return Max(a, b);
    case IntOp::ShiftLeft5: return ShiftLeft<5>(a);
    case IntOp::ShiftLeft31: return ShiftLeft<31>(a);
    case IntOp::ArithmeticRight1: return ShiftRightArithmetic<1>(a);
    case IntOp::ArithmeticRight31: return ShiftRightArithmetic<31>(a);
    case IntOp::LogicalRight1: return ShiftRightLogical<1>(a);
    case IntOp::LogicalRight23: return ShiftRightLogical<23>(a);
    case IntOp::LogicalRight31: return ShiftRightLogical<31>(a);
  }
  return a;
}

void TestInts(IntOp op, const IntArrays& arrays) {
  for (std::size_t i = 0; i < arrays.count; i += LaneCount()) {
    Store(ApplyIntOp(op, LoadInt(arrays.a + i), LoadInt(arrays.b + i)), arrays.out + i);
  }
}

void TestTruncate(const float* a, std::int32_t* out, std::size_t count) {
  for (std::size_t i = 0; i < count; i += LaneCount()) Store(TruncateToInt(LoadFloat(a + i)), out + i);
}
void TestToFloat(const std::int32_t* a, float* out, std::size_t count) {
  for (std::size_t i = 0; i < count; i += LaneCount()) Store(ToFloat(LoadInt(a + i)), out + i);
}
void TestBits(const float* a, std::int32_t* bits, float* back, std::size_t count) {
  for (std::size_t i = 0; i < count; i += LaneCount()) {
    const Int raw = BitsOf(LoadFloat(a + i));
    Store(raw, bits + i);
    Store(FloatFromBits(raw), back + i);
  }
}
void TestGatherFloats(const float* table, const std::int32_t* index, float* out, std::size_t count) {
  for (std::size_t i = 0; i < count; i += LaneCount()) Store(Gather(table, LoadInt(index + i)), out + i);
}
void TestGatherInts(const std::int32_t* table, const std::int32_t* index, std::int32_t* out, std::size_t count) {
  for (std::size_t i = 0; i < count; i += LaneCount()) Store(Gather(table, LoadInt(index + i)), out + i);
}
void TestMaskBits(const float* a, std::uint32_t* bits, std::int32_t* any, std::int32_t* all, std::size_t count) {
  for (std::size_t i = 0; i < count; i += LaneCount()) {
    const Mask negative = LoadFloat(a + i) < Float(0.0f);
    const std::size_t group = i / LaneCount();
    bits[group] = BitsOf(negative);
    any[group] = Any(negative);
    all[group] = All(negative);
  }
}
void TestConstants(std::int32_t* lane_index, std::uint32_t* all_true, std::uint32_t* all_false) {
  Store(LaneIndex(), lane_index);
  *all_true = BitsOf(Mask(true));
  *all_false = BitsOf(Mask(false));
}

void TestNormalize(const float* xyz, float* out, std::size_t count) {
  for (std::size_t i = 0; i < count; i += LaneCount()) {
    const Vec3<Float> v{LoadFloat(xyz + i), LoadFloat(xyz + count + i), LoadFloat(xyz + 2 * count + i)};
    const Vec3<Float> unit = NormalizeOr(v, Vec3<Float>{Float(7.0f), Float(8.0f), Float(9.0f)});
    Store(unit.x, out + i);
    Store(unit.y, out + count + i);
    Store(unit.z, out + 2 * count + i);
  }
}
void TestNormalizeFloats(const float* xyz, float* out, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3<float> unit =
        NormalizeOr(Vec3<float>{xyz[i], xyz[count + i], xyz[2 * count + i]}, Vec3<float>{7.0f, 8.0f, 9.0f});
    out[i] = unit.x;
    out[count + i] = unit.y;
    out[2 * count + i] = unit.z;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facet {

FACET_EXPORT(TestLaneCount);
FACET_EXPORT(TestOnLanes);
FACET_EXPORT(TestOnFloats);
FACET_EXPORT(TestOnDoubles);
FACET_EXPORT(TestMasks);
FACET_EXPORT(TestInts);
FACET_EXPORT(TestTruncate);
FACET_EXPORT(TestToFloat);
FACET_EXPORT(TestBits);
FACET_EXPORT(TestGatherFloats);
FACET_EXPORT(TestGatherInts);
FACET_EXPORT(TestMaskBits);
FACET_EXPORT(TestConstants);
FACET_EXPORT(TestNormalize);
FACET_EXPORT(TestNormalizeFloats);

LaneOperations LaneOperationsFor(Target target) {
  return {TestLaneCountForTarget(target),
          TestOnLanesForTarget(target),
          TestOnFloatsForTarget(target),
          TestOnDoublesForTarget(target),
          TestMasksForTarget(target),
          TestIntsForTarget(target),
          TestTruncateForTarget(target),
          TestToFloatForTarget(target),
          TestBitsForTarget(target),
          TestGatherFloatsForTarget(target),
          TestGatherIntsForTarget(target),
          TestMaskBitsForTarget(target),
          TestConstantsForTarget(target),
          TestNormalizeForTarget(target),
          TestNormalizeFloatsForTarget(target)};
}

}  // namespace facet
#endif
