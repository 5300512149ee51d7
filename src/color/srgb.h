// The sRGB transfer functions of IEC 61966-2-1:1999, with its own constants (0.0031308, 0.04045, 12.92, 1.055, 2.4).
// Deterministic; lanes have color/transfer-inl.h.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace facet {

// Light, proportional, Rec. 709 primaries.
struct LinearRgb {
  float r = 0.0f, g = 0.0f, b = 0.0f;
};

// The codes of an 8-bit sRGB picture.
struct Srgb8 {
  std::uint8_t r = 0, g = 0, b = 0;
  friend bool operator==(const Srgb8&, const Srgb8&) = default;
};

// Encoded to linear and back, computed in double and rounded. Below 0 the linear segment goes on, above 1 the power
// does; NaN stays NaN.
float SrgbToLinear(float encoded);
float LinearToSrgb(float linear);

// Linear light of the 256 codes of a byte.
const std::array<float, 256>& Srgb8ToLinearTable();

// The code whose value is nearest to the encoded `linear`: exactly, not to a few bits. Below 0 and NaN: 0; above 1: the
// largest code.
std::uint8_t LinearToSrgb8(float linear);
std::uint16_t LinearToSrgb16(float linear);

LinearRgb ToLinear(Srgb8 color);
Srgb8 ToSrgb8(LinearRgb color);

// What kernels need for exact codes. thresholds[k] is the smallest float whose nearest code is k or more;
// thresholds[0] = 0, and one infinity follows the last.
struct SrgbTables {
  static constexpr int kBucketShift = 16;                 // of a float's bits: 128 buckets an octave
  static constexpr std::int32_t kInBucket = (1 << kBucketShift) - 1;  // the bits that tell a bucket's floats apart
  static constexpr std::int32_t kFirstBits = 0x39000000;  // 2^-13; all below has code 0
  static constexpr int kBucketCount = (0x3F800000 - kFirstBits) >> kBucketShift;
  std::array<float, 257> thresholds8;
  // No bucket holds two thresholds. The code at the start of the bucket times 2^16, plus as much as makes adding a float's
  // place in the bucket carry into the code from the bucket's threshold on: (ramps8[bucket] + place) >> 16 is the code.
  std::array<std::int32_t, kBucketCount> ramps8;
};
const SrgbTables& GetSrgbTables();
// 65537 of them.
std::span<const float> Srgb16Thresholds();

}  // namespace facet
