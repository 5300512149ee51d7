#include "math/round_to_float.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <random>

namespace facet {
namespace {

constexpr double kLargest{std::numeric_limits<float>::max()}, kInfinity = std::numeric_limits<double>::infinity();
constexpr double kHalfStep = 0x1p+103;  // of the largest float

std::uint32_t Bits(float x) { return std::bit_cast<std::uint32_t>(x); }

TEST(RoundToFloat, IsACastWhereACastIsDefined) {
  std::mt19937_64 random(3);
  int tested = 0;
  for (int i = 0; i < 1000000; ++i) {
    const double x = std::bit_cast<double>(random());
    if (!(std::fabs(x) <= kLargest)) continue;
    ++tested;
    ASSERT_EQ(Bits(RoundToFloat(x)), Bits(static_cast<float>(x))) << x;
    ASSERT_EQ(Bits(RoundToFiniteFloat(x)), Bits(static_cast<float>(x))) << x;
  }
  EXPECT_GT(tested, 500000);
  for (const double x : {0.0, -0.0, 1.0, -1e-300, 4.9e-324, kLargest, -kLargest}) {
    EXPECT_EQ(Bits(RoundToFloat(x)), Bits(static_cast<float>(x))) << x;
    EXPECT_EQ(Bits(RoundToFiniteFloat(x)), Bits(static_cast<float>(x))) << x;
  }
}

// IEEE 754-2019, 4.3.1: what is half a step above the largest number, or more, becomes infinity.
TEST(RoundToFloat, BeyondTheLargestFloat) {
  const float largest = std::numeric_limits<float>::max(), infinity = std::numeric_limits<float>::infinity();
  for (const float sign : {1.0f, -1.0f}) {
    const double s{sign};
    for (const double x : {kLargest + 1e20, kLargest + std::nextafter(kHalfStep, 0.0) * 0.999}) {
      EXPECT_EQ(RoundToFloat(s * x), sign * largest) << x;
    }
    for (const double x : {kLargest + kHalfStep, 0x1p+128, 1e39, 1e300, kInfinity}) {
      EXPECT_EQ(RoundToFloat(s * x), sign * infinity) << x;
      EXPECT_EQ(RoundToFiniteFloat(s * x), sign * largest) << x;
    }
  }
  EXPECT_TRUE(std::isnan(RoundToFloat(NAN)));
  const glm::vec3 v = RoundToFloat(glm::dvec3(1e300, -1e300, 0.1));
  EXPECT_EQ(v, glm::vec3(infinity, -infinity, 0.1f));
}

}  // namespace
}  // namespace facet
