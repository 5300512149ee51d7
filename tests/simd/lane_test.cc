// What the lanes compute, on every instruction set of this machine, against plain C++ that says the same.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "simd/lane_operations.h"

namespace facet {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kLargest = std::numeric_limits<float>::max();
constexpr float kSmallestNormal = std::numeric_limits<float>::min();
constexpr float kSmallest = std::numeric_limits<float>::denorm_min();
const float kNan = std::bit_cast<float>(0x7FC12345);  // with a payload, to see which NaN comes out

std::vector<Target> AvailableTargets() {
  std::vector<Target> targets;
  for (const Target target : {Target::Scalar, Target::Sse4, Target::Avx2, Target::Avx3, Target::Neon}) {
    if (TargetIsAvailable(target)) targets.push_back(target);
  }
  return targets;
}

void PadTo16(auto& values) {
  while (values.size() % 16 != 0) values.push_back(values[values.size() / 2]);
}

// Numbers at which operations change their minds, with both signs, and random bit patterns.
std::vector<float> Numbers() {
  std::vector<float> numbers = {0.0f, kSmallest, 3 * kSmallest, kSmallestNormal, 1e-30f, 0.25f, 0.49999997f, 0.5f,
                                0.50000006f, 0.75f, 1.0f, 1.5f, 2.0f, 2.5f, 3.5f, 4194303.5f, 4194304.5f, 8388607.5f,
                                8388608.0f, 8388609.0f, 16777216.0f, 2147483520.0f, 2147483648.0f, 1e20f, 1e30f,
                                kLargest, kInf, kNan};
  const std::size_t count = numbers.size();
  for (std::size_t i = 0; i < count; ++i) numbers.push_back(-numbers[i]);
  std::mt19937 random(1);
  for (int i = 0; i < 24; ++i) numbers.push_back(std::bit_cast<float>(std::uint32_t(random())));
  return numbers;
}

// All pairs of Numbers(), and a third number for each.
struct Triples {
  std::vector<float> a, b, c;
  Triples() {
    const std::vector<float> numbers = Numbers();
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      for (std::size_t j = 0; j < numbers.size(); ++j) {
        a.push_back(numbers[i]);
        b.push_back(numbers[j]);
        c.push_back(numbers[(7 * i + 13 * j + 5) % numbers.size()]);
      }
    }
    PadTo16(a);
    PadTo16(b);
    PadTo16(c);
  }
  FloatArrays Into(std::vector<float>& out) const {
    out.assign(a.size(), 123.0f);
    return {a.data(), b.data(), c.data(), out.data(), a.size()};
  }
};

float RoundHalfToEven(float x) {
  if (!(std::fabs(x) < 8388608.0f)) return x;
  const double whole = std::floor(double(x)), rest = double(x) - whole;
  const bool up = rest > 0.5 || (rest == 0.5 && std::fmod(whole, 2.0) != 0.0);
  return std::copysign(float(up ? whole + 1.0 : whole), x);
}

float Expected(FloatOp op, float a, float b, float c) {
  const auto min = [](float x, float y) { return x < y ? x : y; };
  const auto max = [](float x, float y) { return x > y ? x : y; };
  switch (op) {
    case FloatOp::Add: return a + b;
    case FloatOp::Sub: return a - b;
    case FloatOp::Mul: return a * b;
    case FloatOp::Div: return a / b;
    case FloatOp::Neg: return std::bit_cast<float>(std::bit_cast<std::uint32_t>(a) ^ 0x80000000u);
    case FloatOp::Select: return a < b ? b : c;
    case FloatOp::Min: return min(a, b);
    case FloatOp::Max: return max(a, b);
    case FloatOp::Clamp: return min(max(a, b), c);
    case FloatOp::Abs: return std::bit_cast<float>(std::bit_cast<std::uint32_t>(a) & 0x7FFFFFFFu);
    case FloatOp::Sqrt: return std::sqrt(a);
    case FloatOp::Floor: return std::floor(a);
    case FloatOp::RoundEven: return RoundHalfToEven(a);
    case FloatOp::CopySign: return std::copysign(a, b);
  }
  return 0.0f;
}

// These choose bits, and NaNs among them with their payload; arithmetic makes a NaN of the processor's liking.
bool KeepsNans(FloatOp op) {
  return op == FloatOp::Neg || op == FloatOp::Select || op == FloatOp::Min || op == FloatOp::Max ||
         op == FloatOp::Clamp || op == FloatOp::Abs || op == FloatOp::CopySign;
}

bool Same(float x, float y, bool any_nan) {
  if (any_nan && std::isnan(x) && std::isnan(y)) return true;
  return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y);
}

TEST(Lanes, AreAsManyAsTheTargetSays) {
  EXPECT_EQ(LaneOperationsFor(Target::Scalar).lane_count(), 1u);
  for (const Target target : AvailableTargets()) {
    const std::size_t expected = target == Target::Scalar ? 1
                                 : target == Target::Avx2 ? 8
                                 : target == Target::Avx3 ? 16
                                                          : 4;
    EXPECT_EQ(LaneOperationsFor(target).lane_count(), expected) << TargetName(target);
  }
}

TEST(Lanes, ComputeFloatsLikeScalarCode) {
  const Triples triples;
  for (const Target target : AvailableTargets()) {
    const LaneOperations operations = LaneOperationsFor(target);
    for (int i = 0; i < kFloatOpCount; ++i) {
      const FloatOp op = FloatOp(i);
      std::vector<float> lanes, floats, doubles;
      operations.on_lanes(op, triples.Into(lanes));
      operations.on_floats(op, triples.Into(floats));
      operations.on_doubles(op, triples.Into(doubles));
      // Of one operation in double nothing but its rounding differs, which float arithmetic makes a single one; that
      // rounding through double is harmless for + - * / sqrt of floats.
      // Source: Figueroa 1995, When is double rounding innocuous?
      for (std::size_t k = 0; k < lanes.size(); ++k) {
        const float a = triples.a[k], b = triples.b[k], c = triples.c[k];
        const float expected = Expected(op, a, b, c);
        const std::string what = std::string(TargetName(target)) + ", operation " + std::to_string(i) + " of " +
                                 std::to_string(a) + ", " + std::to_string(b) + ", " + std::to_string(c);
        ASSERT_TRUE(Same(lanes[k], expected, !KeepsNans(op)))
            << what << ": " << lanes[k] << " for " << expected;
        ASSERT_TRUE(Same(floats[k], expected, !KeepsNans(op))) << what << ": " << floats[k] << " for " << expected;
        const bool subnormal = std::fabs(expected) <= kSmallestNormal;  // there double rounding does harm
        if (!subnormal) {
          ASSERT_TRUE(Same(doubles[k], expected, true)) << what << ": " << doubles[k] << " for " << expected;
        }
      }
    }
  }
}

// The rules that the rest relies on, spelled out.
TEST(Lanes, MinMaxAndClampAreSelections) {
  for (const Target target : AvailableTargets()) {
    const LaneOperations operations = LaneOperationsFor(target);
    const auto apply = [&](FloatOp op, float a, float b, float c = 0.0f) {
      const std::vector<float> as(16, a), bs(16, b), cs(16, c);
      std::vector<float> out(16);
      operations.on_lanes(op, {as.data(), bs.data(), cs.data(), out.data(), 16});
      return out[5];
    };
    EXPECT_EQ(apply(FloatOp::Min, kNan, 2.0f), 2.0f) << "NaN in a gives b";
    EXPECT_EQ(apply(FloatOp::Max, kNan, 2.0f), 2.0f);
    EXPECT_TRUE(std::isnan(apply(FloatOp::Min, 2.0f, kNan))) << "NaN in b gives b";
    EXPECT_TRUE(std::isnan(apply(FloatOp::Max, 2.0f, kNan)));
    EXPECT_TRUE(std::signbit(apply(FloatOp::Min, 0.0f, -0.0f))) << "equal zeros give b";
    EXPECT_FALSE(std::signbit(apply(FloatOp::Min, -0.0f, 0.0f)));
    EXPECT_TRUE(std::signbit(apply(FloatOp::Max, 0.0f, -0.0f)));
    EXPECT_FALSE(std::signbit(apply(FloatOp::Max, -0.0f, 0.0f)));
    EXPECT_EQ(apply(FloatOp::Clamp, kNan, 0.0f, 1.0f), 0.0f) << "NaN becomes the lower bound";
    EXPECT_EQ(apply(FloatOp::Clamp, kInf, 0.0f, 1.0f), 1.0f);
    EXPECT_EQ(apply(FloatOp::Clamp, -kInf, 0.0f, 1.0f), 0.0f);
    EXPECT_EQ(apply(FloatOp::RoundEven, 0.5f, 0.0f), 0.0f);
    EXPECT_EQ(apply(FloatOp::RoundEven, 1.5f, 0.0f), 2.0f);
    EXPECT_EQ(apply(FloatOp::RoundEven, 2.5f, 0.0f), 2.0f);
    EXPECT_EQ(apply(FloatOp::RoundEven, -1.5f, 0.0f), -2.0f);
    EXPECT_EQ(apply(FloatOp::RoundEven, -0.25f, 0.0f), 0.0f);
    EXPECT_EQ(apply(FloatOp::Floor, -0.25f, 0.0f), -1.0f);
    EXPECT_EQ(apply(FloatOp::Floor, -0.0f, 0.0f), 0.0f);
  }
}

TEST(Lanes, CompareLikeScalarCode) {
  const Triples triples;
  const auto expected = [](MaskOp op, float a, float b) {
    switch (op) {
      case MaskOp::Less: return a < b;
      case MaskOp::LessEqual: return a <= b;
      case MaskOp::Greater: return a > b;
      case MaskOp::GreaterEqual: return a >= b;
      case MaskOp::Equal: return a == b;
      case MaskOp::IsFinite: return std::isfinite(a);
      case MaskOp::And: return a > 0 && b > 0;
      case MaskOp::Or: return a > 0 || b > 0;
      case MaskOp::Not: return !(a > 0);
    }
    return false;
  };
  for (const Target target : AvailableTargets()) {
    for (int i = 0; i < kMaskOpCount; ++i) {
      std::vector<std::int32_t> out(triples.a.size(), 7);
      LaneOperationsFor(target).masks(MaskOp(i), triples.a.data(), triples.b.data(), out.data(), out.size());
      for (std::size_t k = 0; k < out.size(); ++k) {
        ASSERT_EQ(out[k], int(expected(MaskOp(i), triples.a[k], triples.b[k])))
            << TargetName(target) << ", operation " << i << " of " << triples.a[k] << ", " << triples.b[k];
      }
    }
  }
}

TEST(Lanes, ComputeIntegersModulo32Bits) {
  std::vector<std::int32_t> a, b;
  std::vector<std::int32_t> numbers = {0, 1, -1, 2, -2, 31, 65535, 65536, -65537, 0x7FFFFFFF, std::int32_t(0x80000000u),
                                       std::int32_t(0x80000001u), 0x12345678, std::int32_t(0xDEADBEEFu)};
  for (const std::int32_t x : numbers) {
    for (const std::int32_t y : numbers) {
      a.push_back(x);
      b.push_back(y);
    }
  }
  PadTo16(a);
  PadTo16(b);
  const auto expected = [](IntOp op, std::int32_t x, std::int32_t y) {
    const std::uint32_t u = std::uint32_t(x), v = std::uint32_t(y);
    switch (op) {
      case IntOp::Add: return std::int32_t(u + v);
      case IntOp::Sub: return std::int32_t(u - v);
      case IntOp::Mul: return std::int32_t(u * v);
      case IntOp::And: return x & y;
      case IntOp::Or: return x | y;
      case IntOp::Xor: return x ^ y;
      case IntOp::Equal: return std::int32_t(x == y);
      case IntOp::Less: return std::int32_t(x < y);
      case IntOp::Greater: return std::int32_t(x > y);
      case IntOp::Select: return x < y ? y : x;
      case IntOp::Min: return x < y ? x : y;
      case IntOp::Max: return x > y ? x : y;
      case IntOp::ShiftLeft5: return std::int32_t(u << 5);
      case IntOp::ShiftLeft31: return std::int32_t(u << 31);
      case IntOp::ArithmeticRight1: return x >> 1;
      case IntOp::ArithmeticRight31: return x < 0 ? -1 : 0;
      case IntOp::LogicalRight1: return std::int32_t(u >> 1);
      case IntOp::LogicalRight23: return std::int32_t(u >> 23);
      case IntOp::LogicalRight31: return std::int32_t(u >> 31);
    }
    return 0;
  };
  for (const Target target : AvailableTargets()) {
    for (int i = 0; i < kIntOpCount; ++i) {
      std::vector<std::int32_t> out(a.size());
      LaneOperationsFor(target).ints(IntOp(i), {a.data(), b.data(), out.data(), out.size()});
      for (std::size_t k = 0; k < out.size(); ++k) {
        ASSERT_EQ(out[k], expected(IntOp(i), a[k], b[k]))
            << TargetName(target) << ", operation " << i << " of " << a[k] << ", " << b[k];
      }
    }
  }
}

TEST(Lanes, ConvertTowardsZeroAndBack) {
  std::vector<float> floats;
  for (const float x : Numbers()) {
    if (std::fabs(x) < 2147483648.0f) floats.push_back(x);  // beyond, processors differ; NaN is left out too
  }
  for (const float x : {-0.99999994f, 0.99999994f, -1.9999999f, 8388607.5f, -8388607.5f}) floats.push_back(x);
  PadTo16(floats);
  std::vector<std::int32_t> ints = {0, 1, -1, 16777216, 16777217, 16777219, -16777217, 0x7FFFFFFF, 0x7FFFFFBF,
                                    0x7FFFFFC0, std::int32_t(0x80000000u), 1234567891};
  PadTo16(ints);
  for (const Target target : AvailableTargets()) {
    const LaneOperations operations = LaneOperationsFor(target);
    std::vector<std::int32_t> truncated(floats.size());
    operations.truncate(floats.data(), truncated.data(), floats.size());
    for (std::size_t k = 0; k < floats.size(); ++k) {
      ASSERT_EQ(truncated[k], std::int32_t(std::trunc(double(floats[k])))) << TargetName(target) << ": " << floats[k];
    }
    std::vector<float> converted(ints.size());
    operations.to_float(ints.data(), converted.data(), ints.size());
    for (std::size_t k = 0; k < ints.size(); ++k) {
      ASSERT_EQ(converted[k], float(double(ints[k]))) << TargetName(target) << ": " << ints[k];
    }
  }
}

TEST(Lanes, PassBitsThrough) {
  std::vector<float> floats = Numbers();
  PadTo16(floats);
  for (const Target target : AvailableTargets()) {
    std::vector<std::int32_t> bits(floats.size());
    std::vector<float> back(floats.size());
    LaneOperationsFor(target).bits_round_trip(floats.data(), bits.data(), back.data(), floats.size());
    EXPECT_EQ(std::memcmp(bits.data(), floats.data(), floats.size() * 4), 0) << TargetName(target);
    EXPECT_EQ(std::memcmp(back.data(), floats.data(), floats.size() * 4), 0) << TargetName(target);
  }
}

TEST(Lanes, GatherByIndex) {
  std::vector<float> floats(1000);
  std::vector<std::int32_t> ints(1000);
  for (std::size_t i = 0; i < floats.size(); ++i) {
    floats[i] = float(i) * 1.5f;
    ints[i] = std::int32_t(i) * 7919 - 5;
  }
  std::mt19937 random(2);
  std::vector<std::int32_t> index(512);  // from the middle of the tables, backwards and forwards
  for (std::int32_t& i : index) i = std::int32_t(random() % 1000) - 500;
  index[0] = -500;
  index[1] = 499;
  for (const Target target : AvailableTargets()) {
    std::vector<float> gathered(index.size());
    std::vector<std::int32_t> gathered_ints(index.size());
    LaneOperationsFor(target).gather_floats(floats.data() + 500, index.data(), gathered.data(), index.size());
    LaneOperationsFor(target).gather_ints(ints.data() + 500, index.data(), gathered_ints.data(), index.size());
    for (std::size_t k = 0; k < index.size(); ++k) {
      ASSERT_EQ(gathered[k], floats[std::size_t(index[k] + 500)]) << TargetName(target);
      ASSERT_EQ(gathered_ints[k], ints[std::size_t(index[k] + 500)]) << TargetName(target);
    }
  }
}

TEST(Lanes, MasksHaveOneBitForEachLane) {
  std::mt19937 random(3);
  for (const Target target : AvailableTargets()) {
    const LaneOperations operations = LaneOperationsFor(target);
    const std::size_t lanes = operations.lane_count();
    const std::uint32_t full = std::uint32_t((std::uint64_t{1} << lanes) - 1);
    std::vector<float> signs(16 * 300);
    for (std::size_t i = 0; i < signs.size(); ++i) {
      signs[i] = i < 1600 ? (random() % 2 ? -1.0f : 1.0f) : i < 3200 ? -1.0f : 0.0f;  // mixed, all, none
    }
    std::vector<std::uint32_t> bits(signs.size());
    std::vector<std::int32_t> any(signs.size()), all(signs.size());
    operations.mask_bits(signs.data(), bits.data(), any.data(), all.data(), signs.size());
    for (std::size_t group = 0; group < signs.size() / lanes; ++group) {
      std::uint32_t expected = 0;
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        if (signs[group * lanes + lane] < 0) expected |= std::uint32_t{1} << lane;
      }
      ASSERT_EQ(bits[group], expected) << TargetName(target);
      ASSERT_EQ(any[group], int(expected != 0));
      ASSERT_EQ(all[group], int(expected == full));
    }
    std::vector<std::int32_t> lane_index(lanes);
    std::uint32_t all_true = 0, all_false = 7;
    operations.constants(lane_index.data(), &all_true, &all_false);
    EXPECT_EQ(all_true, full);
    EXPECT_EQ(all_false, 0u);
    for (std::size_t lane = 0; lane < lanes; ++lane) EXPECT_EQ(lane_index[lane], std::int32_t(lane));
  }
}

TEST(Lanes, NormalizeWhateverHasADirection) {
  struct Case {
    float x, y, z;
  };
  std::vector<Case> cases;
  const float odd[] = {0.0f, -0.0f, kSmallest, kSmallestNormal, 1e-30f, -1e-20f, 1.0f, -3.0f, 1e20f, 1e30f, -kLargest,
                       kInf, -kInf, kNan};
  for (const float x : odd) {
    for (const float y : odd) {
      for (const float z : odd) cases.push_back({x, y, z});
    }
  }
  PadTo16(cases);
  const std::size_t count = cases.size();
  std::vector<float> xyz(3 * count);
  for (std::size_t i = 0; i < count; ++i) {
    xyz[i] = cases[i].x;
    xyz[count + i] = cases[i].y;
    xyz[2 * count + i] = cases[i].z;
  }
  for (const Target target : AvailableTargets()) {
    std::vector<float> lanes(3 * count), floats(3 * count);
    LaneOperationsFor(target).normalize(xyz.data(), lanes.data(), count);
    LaneOperationsFor(target).normalize_floats(xyz.data(), floats.data(), count);
    EXPECT_EQ(std::memcmp(lanes.data(), floats.data(), lanes.size() * 4), 0) << TargetName(target);
    for (std::size_t i = 0; i < count; ++i) {
      const double x = cases[i].x, y = cases[i].y, z = cases[i].z;
      const double length = std::sqrt(x * x + y * y + z * z);  // of floats, in double: neither too long nor too short
      const bool has_direction = length > 0.0 && std::isfinite(length);
      const double expected[3] = {has_direction ? x / length : 7, has_direction ? y / length : 8,
                                  has_direction ? z / length : 9};
      for (std::size_t k = 0; k < 3; ++k) {
        ASSERT_NEAR(double(lanes[k * count + i]), expected[k], has_direction ? 3e-7 : 0.0)
            << TargetName(target) << ": (" << x << ", " << y << ", " << z << ")";
      }
    }
  }
}

}  // namespace
}  // namespace facet
