// The sRGB transfer functions of IEC 61966-2-1:1999, with its own constants (0.0031308, 0.04045, 12.92, 1.055, 2.4).
// Deterministic; lanes have color/transfer-inl.h.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace facet {

// From encoded to linear and back, computed in double and rounded. The linear segment continues below 0, the power
// segment above 1; NaN stays NaN.
float SrgbToLinear(float encoded);
float LinearToSrgb(float linear);

// The linear light of all 256 codes.
const std::array<float, 256>& Srgb8ToLinearTable();

// The code that is nearest to the encoded value of `linear`, without any error. Below 0 and for NaN: 0; above 1: the
// largest code.
std::uint8_t LinearToSrgb8(float linear);
std::uint16_t LinearToSrgb16(float linear);

// Tables for exact encoding in kernels. thresholds[k] is the smallest float whose nearest code is at least k;
// thresholds[0] = 0, and an infinity follows the last.
struct SrgbTables {
  static constexpr int kBucketShift = 16;                 // of a float's bits: 128 buckets an octave
  static constexpr std::int32_t kInBucket = (1 << kBucketShift) - 1;  // the bits that tell a bucket's floats apart
  static constexpr std::int32_t kFirstBits = 0x39000000;  // 2^-13; all below has code 0
  static constexpr int kBucketCount = (0x3F800000 - kFirstBits) >> kBucketShift;
  std::array<float, 257> thresholds8;
  // No bucket contains two thresholds. ramps8[bucket] is the code at the start of the bucket times 2^16, plus an
  // offset: adding a float's position in the bucket carries into the code exactly from the threshold on, so that
  // (ramps8[bucket] + position) >> 16 is the code.
  std::array<std::int32_t, kBucketCount> ramps8;
};
const SrgbTables& GetSrgbTables();
// 65537 of them.
std::span<const float> Srgb16Thresholds();

}  // namespace facet
