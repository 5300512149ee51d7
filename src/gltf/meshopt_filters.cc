#include "gltf/meshopt_filters.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numbers>

namespace facet::gltf {
namespace {

template <class Element, class Decode>
void ForEach(std::span<std::byte> elements, const Decode& decode) {
  for (std::size_t at = 0; at + sizeof(Element) <= elements.size(); at += sizeof(Element)) {
    Element element;
    std::memcpy(&element, elements.data() + at, sizeof element);
    decode(element);
    std::memcpy(elements.data() + at, &element, sizeof element);
  }
}

// The nearest integer, halves away from zero, whatever way the processor is set to round.
template <class Integer>
Integer Round(double x) {
  return static_cast<Integer>(x + std::copysign(0.5, x));
}

// Measured in the integer that stands for 1, everything before the root is whole, and so exact.
template <class Integer>
void DecodeOctahedral(std::span<std::byte> elements) {
  constexpr double kOne = std::numeric_limits<Integer>::max();
  ForEach<std::array<Integer, 4>>(elements, [](std::array<Integer, 4>& v) {
    double x = v[0], y = v[1];
    const double z = v[2] - std::fabs(x) - std::fabs(y);
    const double fold = std::min(z, 0.0);  // the lower half lies folded outwards
    x -= std::copysign(fold, x);
    y -= std::copysign(fold, y);
    const double length = std::sqrt(x * x + y * y + z * z);
    const double scale = length > 0.0 ? kOne / length : 0.0;
    v[0] = Round<Integer>(x * scale);
    v[1] = Round<Integer>(y * scale);
    v[2] = Round<Integer>(z * scale);
  });
}

// 2 to the power of an exponent in [-128, 127].
float PowerOfTwo(int exponent) {
  const bool normal = exponent >= -126;
  return std::bit_cast<float>(normal ? static_cast<std::uint32_t>(exponent + 127) << 23 : 1u << (exponent + 149));
}

}  // namespace

void DecodeOctahedral8(std::span<std::byte> elements) { DecodeOctahedral<std::int8_t>(elements); }

void DecodeOctahedral16(std::span<std::byte> elements) { DecodeOctahedral<std::int16_t>(elements); }

void DecodeQuaternions(std::span<std::byte> elements) {
  static constexpr double kOne = 32767.0;
  ForEach<std::array<std::int16_t, 4>>(elements, [](std::array<std::int16_t, 4>& v) {
    const double x = v[0], y = v[1], z = v[2];
    const double one = v[3] | 3;
    const auto largest = static_cast<std::size_t>(v[3] & 3);
    // The components are stored times the square root of 2. Twice their squares are whole.
    const double scale = kOne / (one * std::numbers::sqrt2);
    const double rest = 2.0 * one * one - x * x - y * y - z * z;
    const double w = std::sqrt(std::max(rest, 0.0) / (2.0 * one * one)) * kOne;
    const auto round = [](double value) { return Round<std::int16_t>(std::clamp(value, -kOne, kOne)); };
    v[(largest + 1) % 4] = round(x * scale);
    v[(largest + 2) % 4] = round(y * scale);
    v[(largest + 3) % 4] = round(z * scale);
    v[largest] = round(w);
  });
}

void DecodeExponential(std::span<std::byte> elements) {
  ForEach<std::int32_t>(elements, [](std::int32_t& value) {
    const std::int32_t exponent = value >> 24;
    const std::int32_t mantissa = static_cast<std::int32_t>(static_cast<std::uint32_t>(value) << 8) >> 8;
    value = std::bit_cast<std::int32_t>(static_cast<float>(mantissa) * PowerOfTwo(exponent));
  });
}

}  // namespace facet::gltf
