#include "color/srgb.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "base/check.h"
#include "math/elementary.h"
#include "math/round_to_float.h"

namespace facet {
namespace {

double Decode(double encoded) { return encoded <= 0.04045 ? encoded / 12.92 : Pow((encoded + 0.055) / 1.055, 2.4); }

double Encode(double linear) { return linear <= 0.0031308 ? linear * 12.92 : 1.055 * Pow(linear, 1.0 / 2.4) - 0.055; }

// The smallest float that is not below `value`.
float RoundUp(double value) {
  const float rounded = static_cast<float>(value);
  return static_cast<double>(rounded) < value ? std::nextafter(rounded, std::numeric_limits<float>::infinity())
                                              : rounded;
}

// Where the nearest of the codes 0..last becomes `code`.
float Threshold(int code, int last) { return RoundUp(Decode((code - 0.5) / last)); }

SrgbTables MakeTables() {
  SrgbTables tables{};
  tables.thresholds8[0] = 0.0f;
  for (int code = 1; code < 256; ++code) tables.thresholds8[static_cast<std::size_t>(code)] = Threshold(code, 255);
  tables.thresholds8[256] = std::numeric_limits<float>::infinity();
  std::size_t code = 0;
  std::size_t previous = 0;
  for (std::size_t bucket = 0; bucket < tables.ramps8.size(); ++bucket) {
    const std::int32_t bits = SrgbTables::kFirstBits + (static_cast<std::int32_t>(bucket) << SrgbTables::kBucketShift);
    while (std::bit_cast<float>(bits) >= tables.thresholds8[code + 1]) ++code;
    FACET_CHECK_OP(code, <=, previous + 1);
    const std::int32_t to_next = std::bit_cast<std::int32_t>(tables.thresholds8[code + 1]) - bits;
    constexpr std::int32_t kSize = SrgbTables::kInBucket + 1;
    tables.ramps8[bucket] = static_cast<std::int32_t>(code) * kSize + std::max(kSize - to_next, 0);
    previous = code;
  }
  return tables;
}

std::vector<float> MakeThresholds16() {
  std::vector<float> thresholds(65537);
  for (int code = 1; code < 65536; ++code) thresholds[static_cast<std::size_t>(code)] = Threshold(code, 65535);
  thresholds[65536] = std::numeric_limits<float>::infinity();
  return thresholds;
}

}  // namespace

float SrgbToLinear(float encoded) { return RoundToFloat(Decode(encoded)); }
float LinearToSrgb(float linear) { return static_cast<float>(Encode(linear)); }

const std::array<float, 256>& Srgb8ToLinearTable() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> result{};
    for (int code = 0; code < 256; ++code)
      result[static_cast<std::size_t>(code)] = static_cast<float>(Decode(code / 255.0));
    return result;
  }();
  return table;
}

const SrgbTables& GetSrgbTables() {
  static const SrgbTables tables = MakeTables();
  return tables;
}

std::span<const float> Srgb16Thresholds() {
  static const std::vector<float> thresholds = MakeThresholds16();
  return thresholds;
}

std::uint8_t LinearToSrgb8(float linear) {
  const SrgbTables& tables = GetSrgbTables();
  if (!(linear >= tables.thresholds8[1])) return 0;
  if (linear >= tables.thresholds8[255]) return 255;
  const std::int32_t bits = std::bit_cast<std::int32_t>(linear);
  const auto bucket = static_cast<std::size_t>((bits - SrgbTables::kFirstBits) >> SrgbTables::kBucketShift);
  const std::int32_t place = bits & SrgbTables::kInBucket;
  return static_cast<std::uint8_t>((tables.ramps8[bucket] + place) >> SrgbTables::kBucketShift);
}

std::uint16_t LinearToSrgb16(float linear) {
  if (!(linear > 0.0f)) return 0;
  if (linear >= 1.0f) return 65535;
  // Encode is good to 2^-51, far below the distance of any float from a threshold (tests/color).
  return static_cast<std::uint16_t>(std::floor(Encode(linear) * 65535.0 + 0.5));
}

}  // namespace facet
