#include "math/all_floats.h"

#include <bit>
#include <cmath>
#include <vector>

#include "math/elementary_lanes.h"

namespace facet::testing {

std::uint64_t ChecksumOverFloats(int function, std::uint64_t stride) {
  constexpr std::uint64_t kFloats = std::uint64_t{1} << 32;
  constexpr std::size_t kBlock = 1 << 14;
  // Odd, so that no step of the sum loses a difference. From G. Steele and S. Vigna, 2021, Computationally Easy,
  // Spectrally Good Multipliers for Congruential Pseudorandom Number Generators.
  constexpr std::uint64_t kMultiplier = 0xD1342543DE82EF95u;
  std::vector<float> arguments(kBlock), results(kBlock);
  std::uint64_t sum = 0;
  for (std::uint64_t bits = 0; bits < kFloats;) {
    std::size_t count = 0;
    for (; count < kBlock && bits < kFloats; bits += stride) {
      arguments[count++] = std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    }
    ApplyOnLanes(function, arguments.data(), arguments.data(), results.data(), kBlock);
    for (std::size_t i = 0; i < count; ++i) {
      sum = sum * kMultiplier + (std::isnan(results[i]) ? 0x7FC00000u : std::bit_cast<std::uint32_t>(results[i]));
    }
  }
  return sum;
}

}  // namespace facet::testing
