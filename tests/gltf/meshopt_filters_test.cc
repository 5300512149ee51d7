// The filters of EXT_meshopt_compression against its formulas, worked out in whole numbers: the roots in them are
// compared by their squares, so nothing is rounded before the result is. No valid input stands halfway between two
// integers (what the halves would need is odd on one side and even on the other), so that there is one right answer.
#include "gltf/meshopt_filters.h"

#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <array>
#include <bit>
#include <cfenv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>
#include <vector>

namespace facet::gltf {
namespace {

template <class Integer>
using Element = std::array<Integer, 4>;

template <class T>
std::span<std::byte> BytesOf(std::vector<T>& elements) {
  return std::as_writable_bytes(std::span(elements));
}

// Whether `got` is the integer nearest to unit * n / sqrt(square).
bool IsNearest(std::int64_t got, std::int64_t unit, std::int64_t n, std::int64_t square) {
  if (got != 0 && (got < 0) != (n < 0)) return false;
  const auto size = static_cast<std::uint64_t>(std::abs(got)), s = static_cast<std::uint64_t>(square);
  const auto twice = static_cast<std::uint64_t>(2 * std::abs(unit * n));
  const bool not_less = size == 0 || (2 * size - 1) * (2 * size - 1) * s < twice * twice;
  return not_less && twice * twice < (2 * size + 1) * (2 * size + 1) * s;
}

// In units of what stands for 1, which must be positive.
template <class Integer>
bool IsOctahedral(const Element<Integer>& got, const Element<Integer>& in) {
  const std::int64_t one = in[2], up = one - std::abs(in[0]) - std::abs(in[1]);
  std::int64_t x = in[0], y = in[1];
  if (up < 0) {
    x = x < 0 ? x - up : x + up;
    y = y < 0 ? y - up : y + up;
  }
  const std::int64_t square = x * x + y * y + up * up, unit = std::numeric_limits<Integer>::max();
  return IsNearest(got[0], unit, x, square) && IsNearest(got[1], unit, y, square) &&
         IsNearest(got[2], unit, up, square) && got[3] == in[3];
}

// The stored components are those of the quaternion times sqrt(2) times `one`.
bool IsQuaternion(const Element<std::int16_t>& got, const Element<std::int16_t>& in) {
  constexpr std::int64_t kUnit = 32767;
  const std::int64_t one = in[3] | 3, square = 2 * one * one;
  const auto at = [&](int i) { return std::int64_t(got[static_cast<std::size_t>(((in[3] & 3) + i) % 4)]); };
  std::int64_t rest = square;
  for (int i = 0; i < 3; ++i) {
    const std::int64_t n = in[static_cast<std::size_t>(i)];
    if (!IsNearest(at(i + 1), kUnit, n, square)) return false;
    rest -= n * n;
  }
  rest = std::max<std::int64_t>(rest, 0);
  // at(0) is nearest to kUnit * sqrt(rest / square).
  const auto odd = [&](std::int64_t k) {
    return static_cast<std::uint64_t>(k * k) * static_cast<std::uint64_t>(square);
  };
  const std::uint64_t exact = 4ull * kUnit * kUnit * static_cast<std::uint64_t>(rest);
  return at(0) >= 0 && (at(0) == 0 || odd(2 * at(0) - 1) < exact) && exact < odd(2 * at(0) + 1);
}

template <class Integer>
Integer OneOf(int bits) {
  return static_cast<Integer>((1 << (bits - 1)) - 1);
}

// An octahedral vector with `bits` in its valid range.
template <class Integer>
Element<Integer> RandomOctahedral(std::mt19937& random, int bits) {
  const Integer one = OneOf<Integer>(bits);
  const auto any = [&] { return static_cast<Integer>(int(random() % (2u * unsigned(one) + 1)) - one); };
  return {any(), any(), one, static_cast<Integer>(random())};
}

TEST(MeshoptFilters, EveryOctahedralVectorOfBytes) {
  // All 2^24: beyond the valid ones too, whatever stands for 1.
  for (int one = -128; one < 128; ++one) {
    std::vector<Element<std::int8_t>> in;
    for (int x = -128; x < 128; ++x) {
      for (int y = -128; y < 128; ++y) {
        in.push_back({std::int8_t(x), std::int8_t(y), std::int8_t(one), std::int8_t(x ^ y)});
      }
    }
    auto got = in;
    DecodeOctahedral8(BytesOf(got));
    for (std::size_t i = 0; i < in.size(); ++i) {
      if (one > 0) {
        ASSERT_TRUE(IsOctahedral(got[i], in[i])) << int(in[i][0]) << " " << int(in[i][1]) << " of " << one;
      } else {  // undefined: a unit vector, or none
        const double length = std::hypot(got[i][0], got[i][1], got[i][2]);
        ASSERT_TRUE(length == 0.0 || std::fabs(length - 127.0) < 1.0) << length;
        ASSERT_EQ(got[i][3], in[i][3]);
      }
    }
  }
}

TEST(MeshoptFilters, OctahedralVectorsOfSixteenBits) {
  std::mt19937 random(14);
  for (int bits = 2; bits <= 16; ++bits) {
    std::vector<Element<std::int16_t>> in;
    for (int i = 0; i < 100000; ++i) in.push_back(RandomOctahedral<std::int16_t>(random, bits));
    auto got = in;
    DecodeOctahedral16(BytesOf(got));
    for (std::size_t i = 0; i < in.size(); ++i) {
      ASSERT_TRUE(IsOctahedral(got[i], in[i])) << in[i][0] << " " << in[i][1] << " of " << bits << " bits";
    }
  }
}

TEST(MeshoptFilters, OctahedralCornersAndEdges) {
  const auto decode = [](std::int16_t x, std::int16_t y, std::int16_t one) {
    std::vector<Element<std::int16_t>> elements{{x, y, one, -5}};
    DecodeOctahedral16(BytesOf(elements));
    return elements[0];
  };
  constexpr std::int16_t kOne = 32767;
  for (int bits = 2; bits <= 16; ++bits) {
    const auto one = OneOf<std::int16_t>(bits), minus = static_cast<std::int16_t>(-one);
    EXPECT_EQ(decode(0, 0, one), (Element<std::int16_t>{0, 0, kOne, -5}));
    EXPECT_EQ(decode(one, 0, one), (Element<std::int16_t>{kOne, 0, 0, -5}));
    EXPECT_EQ(decode(0, minus, one), (Element<std::int16_t>{0, -kOne, 0, -5}));
    for (const auto x : {one, minus}) {
      for (const auto y : {one, minus}) EXPECT_EQ(decode(x, y, one), (Element<std::int16_t>{0, 0, -kOne, -5}));
    }
  }
  EXPECT_EQ(decode(0, 0, 0), (Element<std::int16_t>{0, 0, 0, -5})) << "without direction";
}

TEST(MeshoptFilters, Quaternions) {
  std::mt19937 random(14);
  for (int bits = 4; bits <= 16; ++bits) {
    const int one = OneOf<std::int16_t>(bits);
    std::vector<Element<std::int16_t>> in;
    for (int i = 0; i < 100000; ++i) {
      const auto any = [&] { return static_cast<std::int16_t>(int(random() % (2u * unsigned(one) + 1)) - one); };
      // Also of squares that sum to more than 1: the largest is 0 then.
      in.push_back({any(), any(), any(), static_cast<std::int16_t>((one & ~3) | int(random() % 4))});
    }
    auto got = in;
    DecodeQuaternions(BytesOf(got));
    for (std::size_t i = 0; i < in.size(); ++i) {
      ASSERT_TRUE(IsQuaternion(got[i], in[i]))
          << in[i][0] << " " << in[i][1] << " " << in[i][2] << ", " << in[i][3] << ", " << bits << " bits";
    }
  }
}

TEST(MeshoptFilters, QuaternionsOfEachLargestComponent) {
  for (std::size_t largest = 0; largest < 4; ++largest) {
    std::vector<Element<std::int16_t>> elements{{0, 0, 0, static_cast<std::int16_t>(0x7FFC | largest)}};
    DecodeQuaternions(BytesOf(elements));
    Element<std::int16_t> expected{};
    expected[largest] = 32767;
    EXPECT_EQ(elements[0], expected) << largest;
  }
  // Undefined: no number leaves the range.
  std::vector<Element<std::int16_t>> elements{{32767, -32768, 1, 0}, {32767, -32768, 1, -4}};
  DecodeQuaternions(BytesOf(elements));
  const auto stored = [](double x) { return static_cast<std::int16_t>(std::lround(32767.0 * x / std::sqrt(2.0))); };
  EXPECT_EQ(elements[0], (Element<std::int16_t>{0, 32767, -32767, stored(1.0 / 3.0)}));
  EXPECT_EQ(elements[1], (Element<std::int16_t>{0, -32767, 32767, stored(-1.0)}));
}

TEST(MeshoptFilters, Exponential) {
  // Every exponent, with mantissas that are small, large, and any: exact, or infinite beyond the largest float.
  std::mt19937 random(14);
  std::vector<std::uint32_t> in;
  for (std::uint32_t exponent = 0; exponent < 256; ++exponent) {
    for (const std::uint32_t mantissa : {0u, 1u, 2u, 0x7FFFFFu, 0x800000u, 0xFFFFFFu}) {
      in.push_back(exponent << 24 | mantissa);
    }
    for (int i = 0; i < 2000; ++i) in.push_back(exponent << 24 | (random() & 0xFFFFFF));
  }
  auto got = in;
  DecodeExponential(BytesOf(got));
  for (std::size_t i = 0; i < in.size(); ++i) {
    const int exponent = static_cast<std::int8_t>(in[i] >> 24);
    const int mantissa = static_cast<int>(in[i] & 0xFFFFFF) - ((in[i] & 0x800000) ? 1 << 24 : 0);
    const long double exact = std::ldexp(static_cast<long double>(mantissa), exponent);
    const float value = std::bit_cast<float>(got[i]);
    if (std::fabs(exact) > std::numeric_limits<float>::max()) {
      ASSERT_EQ(value, mantissa < 0 ? -INFINITY : INFINITY);
    } else {
      ASSERT_EQ(static_cast<long double>(value), exact) << mantissa << " * 2^" << exponent;
      ASSERT_EQ(std::signbit(value), mantissa < 0);
    }
  }
}

TEST(MeshoptFilters, WhateverWayTheHostRounds) {
  std::mt19937 random(14);
  std::vector<Element<std::int8_t>> bytes;
  std::vector<Element<std::int16_t>> octahedral, quaternions;
  std::vector<std::uint32_t> exponential;
  for (int i = 0; i < 20000; ++i) {
    bytes.push_back(RandomOctahedral<std::int8_t>(random, 8));
    octahedral.push_back(RandomOctahedral<std::int16_t>(random, 4 + i % 13));
    const auto one = OneOf<std::int16_t>(4 + i % 13);
    quaternions.push_back(octahedral.back());
    quaternions.back()[2] = static_cast<std::int16_t>(int(random() % (2u * unsigned(one) + 1)) - one);
    quaternions.back()[3] = one;
    exponential.push_back(static_cast<std::uint32_t>(i % 201 - 100) << 24 | (random() & 0xFFFFFF));
  }
  const auto decode = [&] {
    auto a = bytes;
    auto b = octahedral, c = quaternions;
    auto d = exponential;
    DecodeOctahedral8(BytesOf(a));
    DecodeOctahedral16(BytesOf(b));
    DecodeQuaternions(BytesOf(c));
    DecodeExponential(BytesOf(d));
    return std::tuple(a, b, c, d);
  };
  const auto expected = decode();
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(mode);
    const auto got = decode();
    std::fesetround(FE_TONEAREST);
    EXPECT_EQ(got, expected) << mode;
  }
}

// What meshoptimizer's encoders make comes back within half a step of quantisation.
TEST(MeshoptFilters, WhatTheEncodersMakeComesBack) {
  constexpr std::size_t kCount = 4096;
  std::mt19937 random(14);
  std::normal_distribution<float> any;
  const auto unit_vectors = [&](std::size_t components) {
    std::vector<Element<float>> vectors(kCount);
    for (auto& v : vectors) {
      float length = 0.0f;
      for (std::size_t c = 0; c < components; ++c) {
        v[c] = any(random);
        length += v[c] * v[c];
      }
      for (std::size_t c = 0; c < components; ++c) v[c] /= std::sqrt(length);
    }
    return vectors;
  };
  const auto normals = unit_vectors(3), rotations = unit_vectors(4);
  const auto dot = [](const auto& a, const Element<float>& b, std::size_t components, float unit) {
    float sum = 0.0f;
    for (std::size_t c = 0; c < components; ++c) sum += float(a[c]) / unit * b[c];
    return sum;
  };
  // Half a step in x and y moves a point of the octahedron by at most sqrt(1.5) / one, where its face comes closest to
  // the centre, at 1 / sqrt(3), by an angle of sqrt(4.5) / one. Rounding to the output adds a little.
  for (int bits = 4; bits <= 16; ++bits) {
    const float error = std::sqrt(4.5f) / float(OneOf<std::int16_t>(bits));
    std::vector<Element<std::int16_t>> packed(kCount);
    meshopt_encodeFilterOct(packed.data(), kCount, 8, bits, normals[0].data());
    DecodeOctahedral16(BytesOf(packed));
    for (std::size_t i = 0; i < kCount; ++i) {
      ASSERT_GT(dot(packed[i], normals[i], 3, 32767.0f), 1.0f - error * error / 2 - 1e-4f) << bits;
    }
    meshopt_encodeFilterQuat(packed.data(), kCount, 8, bits, rotations[0].data());
    DecodeQuaternions(BytesOf(packed));
    for (std::size_t i = 0; i < kCount; ++i) {
      ASSERT_GT(std::fabs(dot(packed[i], rotations[i], 4, 32767.0f)), 1.0f - error * error / 2 - 1e-4f) << bits;
    }
    if (bits > 8) continue;
    std::vector<Element<std::int8_t>> bytes(kCount);
    meshopt_encodeFilterOct(bytes.data(), kCount, 4, bits, normals[0].data());
    DecodeOctahedral8(BytesOf(bytes));
    for (std::size_t i = 0; i < kCount; ++i) {
      ASSERT_GT(dot(bytes[i], normals[i], 3, 127.0f), 1.0f - error * error / 2 - 1e-2f) << bits;
    }
  }
  std::vector<Element<std::uint32_t>> packed(kCount);
  meshopt_encodeFilterExp(packed.data(), kCount, 16, 24, rotations[0].data());
  DecodeExponential(BytesOf(packed));
  for (std::size_t i = 0; i < kCount; ++i) {
    for (std::size_t c = 0; c < 4; ++c) {
      ASSERT_NEAR(std::bit_cast<float>(packed[i][c]), rotations[i][c], 0x1p-23f);
    }
  }
}

}  // namespace
}  // namespace facet::gltf
