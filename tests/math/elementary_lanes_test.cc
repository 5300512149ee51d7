#include "math/elementary_lanes.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "facet/shader/dispatch.h"

namespace facet::testing {
namespace {

std::vector<float> Arguments(std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  const float special[] = {0.0f, -0.0f,     1.0f,      -1.0f,    0.5f,   -0.5f,   HUGE_VALF, -HUGE_VALF,
                           NAN,  0x1p-149f, 0x1p-126f, 0x1p127f, 128.0f, -149.5f, 0x1p17f,   1e30f};
  std::vector<float> arguments(std::begin(special), std::end(special));
  while (arguments.size() < count) {
    const std::uint32_t bits = static_cast<std::uint32_t>(random());
    switch (arguments.size() % 4) {
      case 0: arguments.push_back(std::bit_cast<float>(bits)); break;
      case 1: arguments.push_back(static_cast<float>(bits) * 0x1p-31f - 1.0f); break;
      case 2: arguments.push_back(static_cast<float>(bits) * 0x1p-24f - 128.0f); break;
      default: arguments.push_back(static_cast<float>(bits) * 0x1p-15f); break;
    }
  }
  return arguments;
}

// Every NaN counts as the same.
std::uint32_t Bits(float x) { return std::isnan(x) ? 0x7FC00000u : std::bit_cast<std::uint32_t>(x); }

TEST(ElementaryLanes, SameBitsOnEveryTargetAndOneByOne) {
  constexpr std::size_t kCount = 1 << 16;
  const std::vector<float> a = Arguments(kCount, 1);
  std::vector<float> b = Arguments(kCount, 2);
  // All pairs of the special values.
  std::vector<float> a_pairs = a;
  for (std::size_t i = 0; i < 256; ++i) {
    a_pairs[i] = a[i / 16];
    b[i] = b[i % 16];
  }
  std::vector<float> expected(kCount), result(kCount);
  for (int function = 0; function < kLaneFunctionCount; ++function) {
    SCOPED_TRACE(kLaneFunctionNames[static_cast<std::size_t>(function)]);
    {
      const ScopedTarget scoped(Target::Scalar);
      ApplyOnFloats(function, a_pairs.data(), b.data(), expected.data(), kCount);
    }
    for (const Target target : {Target::Scalar, Target::Sse4, Target::Avx2, Target::Avx3, Target::Neon}) {
      if (!TargetIsAvailable(target)) continue;
      SCOPED_TRACE(TargetName(target));
      const ScopedTarget scoped(target);
      for (const auto apply : {&ApplyOnLanes, &ApplyOnFloats}) {
        apply(function, a_pairs.data(), b.data(), result.data(), kCount);
        for (std::size_t i = 0; i < kCount; ++i) {
          ASSERT_EQ(Bits(result[i]), Bits(expected[i])) << "at " << a_pairs[i] << ", " << b[i];
        }
      }
    }
  }
}

}  // namespace
}  // namespace facet::testing
