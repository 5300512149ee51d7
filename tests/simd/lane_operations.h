// The lanes' operations on whole arrays, compiled for every instruction set.
#pragma once

#include <cstddef>
#include <cstdint>

#include "facet/shader/dispatch.h"

namespace facet {

// Counts are multiples of 16, a multiple of every target's number of lanes.
enum class FloatOp { Add, Sub, Mul, Div, Neg, Select, Min, Max, Clamp, Abs, Sqrt, Floor, RoundEven, CopySign };
constexpr int kFloatOpCount = 14;
enum class MaskOp { Less, LessEqual, Greater, GreaterEqual, Equal, IsFinite, And, Or, Not };
constexpr int kMaskOpCount = 9;
enum class IntOp {
  Add, Sub, Mul, And, Or, Xor, Equal, Less, Greater, Select, Min, Max, ShiftLeft5, ShiftLeft31, ArithmeticRight1,
  ArithmeticRight31, LogicalRight1, LogicalRight23, LogicalRight31
};
constexpr int kIntOpCount = 19;

struct FloatArrays {
  const float *a, *b, *c;  // what an operation has no use for, it ignores
  float* out;
  std::size_t count;
};
struct IntArrays {
  const std::int32_t *a, *b;
  std::int32_t* out;
  std::size_t count;
};

// The versions for one target.
struct LaneOperations {
  std::size_t (*lane_count)();
  void (*on_lanes)(FloatOp op, const FloatArrays& arrays);   // Select is a < b ? b : c
  void (*on_floats)(FloatOp op, const FloatArrays& arrays);  // the functions for plain float
  void (*on_doubles)(FloatOp op, const FloatArrays& arrays);
  void (*masks)(MaskOp op, const float* a, const float* b, std::int32_t* out, std::size_t count);  // 1: true
  void (*ints)(IntOp op, const IntArrays& arrays);           // Select is a < b ? b : a; comparisons give 0 or 1
  void (*truncate)(const float* a, std::int32_t* out, std::size_t count);
  void (*to_float)(const std::int32_t* a, float* out, std::size_t count);
  void (*bits_round_trip)(const float* a, std::int32_t* bits, float* back, std::size_t count);
  void (*gather_floats)(const float* table, const std::int32_t* index, float* out, std::size_t count);
  void (*gather_ints)(const std::int32_t* table, const std::int32_t* index, std::int32_t* out, std::size_t count);
  // For each group of lanes BitsOf(a < 0), Any(a < 0) and All(a < 0).
  void (*mask_bits)(const float* a, std::uint32_t* bits, std::int32_t* any, std::int32_t* all, std::size_t count);
  void (*constants)(std::int32_t* lane_index, std::uint32_t* all_true, std::uint32_t* all_false);
  // xyz: three arrays of `count` after one another; the fallback is (7, 8, 9).
  void (*normalize)(const float* xyz, float* out, std::size_t count);
  void (*normalize_floats)(const float* xyz, float* out, std::size_t count);
};

LaneOperations LaneOperationsFor(Target target);

}  // namespace facet
