#include "math/elementary.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "math/float_functions.h"
#include "math/ulp.h"

namespace facet::testing {
namespace {

constexpr float kInf = HUGE_VALF;
constexpr double kPi = 3.14159265358979323846;

class FloatFunctionTest : public ::testing::TestWithParam<FloatFunction> {};

TEST_P(FloatFunctionTest, StaysWithinItsDocumentedError) {
  const FloatFunction& f = GetParam();
  double worst = 0.0;
  float at = 0.0f;
  // A prime stride visits every exponent with varied significands; tests/math/ulp_table.cc visits all.
  for (std::uint64_t bits = 0; bits < (std::uint64_t{1} << 32); bits += 1021) {
    const float x = std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    if (std::fabs(x) > f.domain) continue;
    const double error = UlpError(f.function(x), f.exact(static_cast<double>(x)));
    if (error > worst) {
      worst = error;
      at = x;
    }
  }
  EXPECT_LE(worst, f.bound_ulp) << "at " << at;
}

INSTANTIATE_TEST_SUITE_P(Elementary, FloatFunctionTest, ::testing::ValuesIn(FloatFunctions()),
                         [](const auto& suite) { return std::string(suite.param.name); });

TEST(FloatSin, IsAccurateBesideMultiplesOfHalfPi) {
  for (const FloatFunction& f : FloatFunctions()) {
    if (f.domain == HUGE_VALF) continue;
    for (int n = 1; n < 83000; ++n) {
      const float nearest = static_cast<float>(n * (kPi / 2.0));
      for (const float x : {std::nextafter(nearest, 0.0f), nearest, std::nextafter(nearest, kInf)}) {
        ASSERT_LE(UlpError(f.function(x), f.exact(static_cast<double>(x))), f.bound_ulp) << f.name << " at " << x;
      }
    }
  }
}

TEST(FloatPow, StaysWithinItsDocumentedError) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 2000000; ++i) {
    const std::uint64_t bits = random();
    const float x = std::bit_cast<float>(static_cast<std::uint32_t>(bits) & 0x7FFFFFFFu);
    // Half of the exponents lead to a result within the range of float.
    float y = std::bit_cast<float>(static_cast<std::uint32_t>(bits >> 32));
    if (i % 2 == 0) y = static_cast<float>((static_cast<double>(bits >> 32) * 0x1p-31 - 1.0) * 150.0 / std::log2(x));
    const double exact = std::pow(static_cast<double>(x), static_cast<double>(y));
    ASSERT_LE(UlpError(FloatPow(x, y), exact), 6.0) << x << " to the " << y;  // 5.04 is the worst that was ever found
  }
}

TEST(FloatPow, SpecialValues) {
  const float nan = NAN;
  EXPECT_EQ(FloatPow(0.0f, 2.0f), 0.0f);
  EXPECT_EQ(FloatPow(0.0f, -2.0f), kInf);
  EXPECT_EQ(FloatPow(0.0f, 0.0f), 1.0f);
  EXPECT_EQ(FloatPow(nan, 0.0f), 1.0f);
  EXPECT_EQ(FloatPow(1.0f, nan), 1.0f);
  EXPECT_EQ(FloatPow(1.0f, kInf), 1.0f);
  EXPECT_EQ(FloatPow(kInf, 0.25f), kInf);
  EXPECT_EQ(FloatPow(kInf, -0.25f), 0.0f);
  EXPECT_EQ(FloatPow(0.5f, kInf), 0.0f);
  EXPECT_EQ(FloatPow(2.0f, kInf), kInf);
  EXPECT_EQ(FloatPow(2.0f, -kInf), 0.0f);
  EXPECT_EQ(FloatPow(2.0f, 10.0f), 1024.0f);
  EXPECT_EQ(FloatPow(2.0f, -149.0f), 0x1p-149f);
  EXPECT_EQ(FloatPow(0x1p-149f, 0.0f), 1.0f);
  EXPECT_EQ(FloatPow(0.9999999f, 3e38f), 0.0f);
  EXPECT_TRUE(std::isnan(FloatPow(-1.0f, 2.0f)));
  EXPECT_TRUE(std::isnan(FloatPow(nan, 2.0f)));
  EXPECT_TRUE(std::isnan(FloatPow(2.0f, nan)));
}

TEST(FloatAtan2, StaysWithinItsDocumentedError) {
  std::mt19937_64 random(8);
  for (int i = 0; i < 2000000; ++i) {
    const std::uint64_t bits = random();
    float y = std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    float x = std::bit_cast<float>(static_cast<std::uint32_t>(bits >> 32));
    if (i % 2 == 0) {
      y = static_cast<float>(static_cast<std::int32_t>(bits));
      x = static_cast<float>(static_cast<std::int32_t>(bits >> 32));
    }
    const double exact = std::atan2(static_cast<double>(y), static_cast<double>(x));
    ASSERT_LE(UlpError(FloatAtan2(y, x), exact), 2.0) << y << ", " << x;
  }
}

// Signs included, as in C.
TEST(Atan2, SpecialValues) {
  for (const double y : {0.0, -0.0, 1.0, -1.0, HUGE_VAL, -HUGE_VAL}) {
    for (const double x : {0.0, -0.0, 1.0, -1.0, HUGE_VAL, -HUGE_VAL}) {
      const double expected = std::atan2(y, x);
      const float result = FloatAtan2(static_cast<float>(y), static_cast<float>(x));
      EXPECT_EQ(result, static_cast<float>(expected)) << y << ", " << x;
      EXPECT_EQ(std::signbit(result), std::signbit(expected)) << y << ", " << x;
      EXPECT_EQ(Atan2(y, x), expected) << y << ", " << x;
      EXPECT_EQ(std::signbit(Atan2(y, x)), std::signbit(expected)) << y << ", " << x;
    }
  }
  EXPECT_TRUE(std::isnan(FloatAtan2(NAN, 1.0f)));
  EXPECT_TRUE(std::isnan(Atan2(1.0, NAN)));
}

// --- double ---------------------------------------------------------------------------------------------------------

constexpr double kDoubleBound = 1.2;  // as documented

template <class Function, class Exact>
void ExpectAccurate(const char* name, Function function, Exact exact, double low, double high) {
  if (std::numeric_limits<long double>::digits <= std::numeric_limits<double>::digits) GTEST_SKIP();
  std::mt19937_64 random(9);
  for (int i = 0; i < 200000; ++i) {
    double x = low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
    if (i % 2 != 0) {
      x = std::bit_cast<double>(random());
      if (!(x >= low && x <= high)) continue;
    }
    ASSERT_LE(UlpError(function(x), exact(static_cast<long double>(x))), kDoubleBound) << name << " at " << x;
  }
}

using Extended = long double;
constexpr double kMax = std::numeric_limits<double>::max();

TEST(Double, Exponentials) {
  ExpectAccurate(
      "Exp2", Exp2, [](Extended x) { return std::exp2(x); }, -1080.0, 1030.0);
  ExpectAccurate(
      "Exp", Exp, [](Extended x) { return std::exp(x); }, -750.0, 720.0);
  ExpectAccurate(
      "Exp", Exp, [](Extended x) { return std::exp(x); }, -1.0, 1.0);
}

TEST(Double, Logarithms) {
  ExpectAccurate(
      "Log2", Log2, [](Extended x) { return std::log2(x); }, 0.0, 4.0);
  ExpectAccurate(
      "Log2", Log2, [](Extended x) { return std::log2(x); }, 0.0, kMax);
  ExpectAccurate(
      "Log", Log, [](Extended x) { return std::log(x); }, 0.0, 4.0);
  ExpectAccurate(
      "Log", Log, [](Extended x) { return std::log(x); }, 0.0, kMax);
  EXPECT_EQ(Log2(0.0), -HUGE_VAL);
  EXPECT_EQ(Log(HUGE_VAL), HUGE_VAL);
  EXPECT_TRUE(std::isnan(Log2(-1.0)));
  for (int n = -1074; n < 1024; ++n) {
    ASSERT_EQ(Log2(std::ldexp(1.0, n)), n);
    ASSERT_EQ(Exp2(n), std::ldexp(1.0, n));
  }
}

TEST(Double, Powers) {
  for (const double y : {0.3, 2.4, 1.0 / 2.4, 7.0, -11.3, 100.5, -0.001}) {
    ExpectAccurate(
        "Pow", [y](double x) { return Pow(x, y); }, [y](Extended x) { return std::pow(x, Extended(y)); }, 0.0, 1000.0);
  }
  ExpectAccurate(
      "Cbrt", Cbrt, [](Extended x) { return std::cbrt(x); }, -kMax / 2, kMax / 2);
  for (const double x : {0.0, -0.0, 1.0, -1.0, 0.5, -2.0, HUGE_VAL, -HUGE_VAL}) {
    for (const double y : {0.0, 1.0, -1.0, 2.0, -3.0, 0.5, 0x1p60, -0x1p60, HUGE_VAL, -HUGE_VAL}) {
      if (x == -1.0 && std::isinf(y)) continue;
      const double expected = std::pow(x, y);
      if (std::isnan(expected)) {
        EXPECT_TRUE(std::isnan(Pow(x, y))) << x << ", " << y;
      } else {
        EXPECT_LE(UlpError(Pow(x, y), expected), kDoubleBound) << x << ", " << y;
        EXPECT_EQ(std::signbit(Pow(x, y)), std::signbit(expected)) << x << ", " << y;
      }
    }
  }
}

TEST(Double, CircularFunctions) {
  for (const double range : {0.1, 10.0, 1e9, 1e18}) {
    ExpectAccurate(
        "Sin", Sin, [](Extended x) { return std::sin(x); }, -range, range);
    ExpectAccurate(
        "Cos", Cos, [](Extended x) { return std::cos(x); }, -range, range);
    ExpectAccurate(
        "Tan", Tan, [](Extended x) { return std::tan(x); }, -range, range);
  }
  // W. Kahan's worst case: 6381956970095103 2^797 is the double closest to a multiple of pi/2.
  const double worst = std::ldexp(6381956970095103.0, 797);
  EXPECT_LE(UlpError(Cos(worst), -4.68716592425462761112e-19L), kDoubleBound);
  EXPECT_EQ(std::fabs(Sin(worst)), 1.0);
  EXPECT_TRUE(std::isnan(Sin(HUGE_VAL)));
  EXPECT_TRUE(std::signbit(Sin(-0.0)));
}

TEST(Double, InverseCircularFunctions) {
  ExpectAccurate(
      "Asin", Asin, [](Extended x) { return std::asin(x); }, -1.0, 1.0);
  ExpectAccurate(
      "Acos", Acos, [](Extended x) { return std::acos(x); }, -1.0, 1.0);
  ExpectAccurate(
      "Atan2", [](double x) { return Atan2(x, 1.0); }, [](Extended x) { return std::atan(x); }, -3.0, 3.0);
  ExpectAccurate(
      "Atan2", [](double x) { return Atan2(0.7, x); }, [](Extended x) { return std::atan2(Extended(0.7), x); },
      -kMax / 2, kMax / 2);
  EXPECT_EQ(Acos(1.0), 0.0);
  EXPECT_EQ(Acos(-1.0), kPi);
  EXPECT_TRUE(std::isnan(Asin(1.0000000000000002)));
}

}  // namespace
}  // namespace facet::testing
