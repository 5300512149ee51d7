// Well spread random points: two dimensions of Sobol's sequence, Owen-scrambled, as many such pairs as are asked for.
//
// Each pair of dimensions has its own scrambling and its own order, which are random to each other and to those of
// other seeds (Burley, 2020, Practical Hash-based Owen Scrambling, section 4). An aligned run of 2^k points of a pair
// is a net: of any division of the square into 2^k equal boxes with sides of powers of two, each holds one of them.
// Scrambled points are uniform, so means over them are not biased; and different seeds make independent sets.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <initializer_list>

namespace facet {

// A random number for a number (Steele, Lea and Flood, 2014, Fast Splittable Pseudorandom Number Generators: the
// mixer).
inline std::uint64_t MixBits(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15u;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

inline std::uint32_t ReverseBits(std::uint32_t x) {
  x = (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
  x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
  x = (x & 0x0F0F0F0Fu) << 4 | (x >> 4 & 0x0F0F0F0Fu);
  return __builtin_bswap32(x);
}

// Owen's nested scrambling of the digits of x, highest first, of a number whose bits are given in reverse: each step
// lets a bit change only those above it. Multipliers of Laine and Karras, 2011, Stratified Sampling for Stochastic
// Transparency.
inline std::uint32_t ScrambleReversed(std::uint32_t x, std::uint32_t seed) {
  x += seed;
  for (const std::uint32_t factor : {0x6C50B47Cu, 0xB82F1E52u, 0xC7AFE638u, 0x8D22F6E6u}) x ^= x * factor;
  return x;
}

class SampleSequence {
 public:
  explicit SampleSequence(std::uint64_t seed) : seed_(seed) {}

  // Point `index` of pair `pair`, in (0, 1)^2.
  glm::dvec2 Point(std::uint32_t pair, std::uint32_t index) const {
    const std::uint64_t a = MixBits(seed_ ^ MixBits(pair)), b = MixBits(a);
    const std::uint32_t i = ReverseBits(ScrambleReversed(ReverseBits(index), static_cast<std::uint32_t>(a)));
    // The first dimension is the radical inverse, whose bits in reverse are the index itself.
    const std::uint32_t x = ReverseBits(ScrambleReversed(i, static_cast<std::uint32_t>(a >> 32)));
    const std::uint32_t y =
        ReverseBits(ScrambleReversed(ReverseBits(SecondDimension(i)), static_cast<std::uint32_t>(b >> 32)));
    constexpr double kUnit = 1.0 / 4294967296.0;
    return {(x + 0.5) * kUnit, (y + 0.5) * kUnit};
  }

 private:
  // Sobol's second dimension, of the primitive polynomial x + 1: its direction numbers are Pascal's triangle modulo 2.
  static std::uint32_t SecondDimension(std::uint32_t index) {
    std::uint32_t result = 0;
    for (std::uint32_t direction = 1u << 31; index != 0; index >>= 1, direction ^= direction >> 1) {
      if (index & 1) result ^= direction;
    }
    return result;
  }

  std::uint64_t seed_;
};

}  // namespace facet
