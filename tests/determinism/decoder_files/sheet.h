// A bent sheet of triangles with attributes of every kind, in numbers that no step of quantisation divides.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "decoder_files.h"

namespace facet::decoder_files {

struct Sheet {
  static constexpr std::uint32_t kSide = 20, kCount = kSide * kSide;
  Values<float, 3> positions, normals;
  Values<float, 4> tangents, weights;
  Values<float, 2> uvs;
  Values<std::uint8_t, 4> colors, joints;
  std::vector<std::uint32_t> indices;

  Sheet() {
    for (std::uint32_t i = 0; i < kCount; ++i) {
      const float x = float(i % kSide) * 0.137f - 1.3f, y = float(i / kSide) * 0.119f - 1.1f;
      positions.push_back({x, y, std::sin(x * 2.0f) * std::cos(y * 1.7f) * 0.4f});
      normals.push_back(Unit(std::array{std::sin(x * 3.0f) * 0.7f, std::sin(x * y * 5.0f) * 0.6f, std::cos(y * 3.0f)}));
      const auto tangent = Unit(std::array{std::cos(x), std::sin(y * 2.0f), 0.3f});
      tangents.push_back({tangent[0], tangent[1], tangent[2], i % 3 ? 1.0f : -1.0f});
      uvs.push_back({x * 0.43f + 0.5f, y * 0.39f + 0.6f});
      colors.push_back({std::uint8_t(i * 7), std::uint8_t(i * 29 + 3), std::uint8_t(255 - i * 11), 255});
      joints.push_back({std::uint8_t(i % 2), std::uint8_t(1 - i % 2), 0, 0});
      const float weight = 0.5f + 0.5f * std::sin(x * 4.0f + y);
      weights.push_back({weight, 1.0f - weight, 0.0f, 0.0f});
    }
    for (std::uint32_t i = 0; i + kSide < kCount; ++i) {
      if (i % kSide == kSide - 1) continue;
      for (const std::uint32_t k : {i, i + 1, i + kSide, i + 1, i + 1 + kSide, i + kSide}) indices.push_back(k);
    }
  }

  template <std::size_t N>
  static std::array<float, N> Unit(std::array<float, N> v) {
    float square = 0.0f;
    for (const float c : v) square += c * c;
    for (float& c : v) c /= std::sqrt(square);
    return v;
  }
};

}  // namespace facet::decoder_files
