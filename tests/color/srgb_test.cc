#include "color/srgb.h"

#include <gtest/gtest.h>

#include <cmath>

namespace facet {
namespace {

using Extended = long double;

Extended ExactDecode(Extended encoded) {
  return encoded <= 0.04045L ? encoded / 12.92L : std::pow((encoded + 0.055L) / 1.055L, 2.4L);
}

TEST(Srgb, DecodesAllBytesToTheNearestFloat) {
  for (int code = 0; code < 256; ++code) {
    const float exact = static_cast<float>(ExactDecode(code / Extended(255)));
    EXPECT_EQ(Srgb8ToLinearTable()[static_cast<std::size_t>(code)], exact) << code;
  }
}

TEST(Srgb, TransferFunctionsAreThoseOfTheStandard) {
  EXPECT_EQ(SrgbToLinear(0.0f), 0.0f);
  EXPECT_EQ(SrgbToLinear(1.0f), 1.0f);
  EXPECT_EQ(LinearToSrgb(1.0f), 1.0f);
  EXPECT_FLOAT_EQ(SrgbToLinear(0.5f), 0.21404114f);
  EXPECT_FLOAT_EQ(LinearToSrgb(0.18f), 0.46135613f);
  EXPECT_FLOAT_EQ(SrgbToLinear(0.04f), 0.04f / 12.92f);
  EXPECT_FLOAT_EQ(LinearToSrgb(0.003f), 0.003f * 12.92f);
  EXPECT_TRUE(std::isnan(SrgbToLinear(NAN)));
}

// The nearest code changes between two neighbouring floats, one on each side of the exact border: with monotony between
// the borders, that proves every float's code.
template <class Encode>
void ExpectNearestCodes(Encode encode, int last) {
  for (int code = 1; code <= last; ++code) {
    const Extended border = ExactDecode((code - Extended(0.5)) / last);
    float above = static_cast<float>(border);
    if (above < border) above = std::nextafter(above, 2.0f);
    const float below = std::nextafter(above, 0.0f);
    ASSERT_EQ(encode(above), code) << above;
    ASSERT_EQ(encode(below), code - 1) << below;
    const float centre = static_cast<float>(ExactDecode(code / Extended(last)));
    ASSERT_EQ(encode(centre), code) << centre;
  }
  EXPECT_EQ(encode(0.0f), 0);
  EXPECT_EQ(encode(-1.0f), 0);
  EXPECT_EQ(encode(NAN), 0);
  EXPECT_EQ(encode(1.0f), last);
  EXPECT_EQ(encode(HUGE_VALF), last);
}

TEST(Srgb, EncodesToTheNearestByte) {
  ExpectNearestCodes([](float x) { return int(LinearToSrgb8(x)); }, 255);
}
TEST(Srgb, EncodesToTheNearest16BitCode) {
  ExpectNearestCodes([](float x) { return int(LinearToSrgb16(x)); }, 65535);
}

TEST(Srgb, CodesSurviveTheWayToLinearLightAndBack) {
  for (std::size_t code = 0; code < 256; ++code) EXPECT_EQ(LinearToSrgb8(Srgb8ToLinearTable()[code]), code);
}

TEST(Srgb, ThresholdTablesAreThoseOfTheEncoders) {
  const SrgbTables& tables = GetSrgbTables();
  for (std::size_t code = 1; code < 256; ++code) {
    EXPECT_EQ(LinearToSrgb8(tables.thresholds8[code]), code);
    EXPECT_EQ(LinearToSrgb8(std::nextafter(tables.thresholds8[code], 0.0f)), code - 1);
  }
  const auto thresholds = Srgb16Thresholds();
  ASSERT_EQ(thresholds.size(), 65537u);
  for (std::size_t code = 1; code < 65536; ++code) ASSERT_EQ(LinearToSrgb16(thresholds[code]), code);
}

}  // namespace
}  // namespace facet
