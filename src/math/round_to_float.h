// From double to float where a number may not fit: what a plain cast gives then, C++ leaves undefined.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <limits>

namespace facet {

// The nearest float, as IEEE 754 rounds: beyond the largest one, infinity; a NaN stays one.
inline float RoundToFloat(double x) {
  constexpr float kLargest = std::numeric_limits<float>::max();
  if (!(std::fabs(x) > double{kLargest})) return static_cast<float>(x);
  constexpr double kFirstInfinite = 0x1.ffffffp+127;  // half a step above the largest
  const float magnitude = std::fabs(x) < kFirstInfinite ? kLargest : std::numeric_limits<float>::infinity();
  return x < 0.0 ? -magnitude : magnitude;
}

template <glm::length_t kLength>
glm::vec<kLength, float> RoundToFloat(const glm::vec<kLength, double>& v) {
  glm::vec<kLength, float> rounded;
  for (glm::length_t i = 0; i < kLength; ++i) rounded[i] = RoundToFloat(v[i]);
  return rounded;
}

// The nearest float that is finite, for numbers of files; a NaN stays one.
inline float RoundToFiniteFloat(double x) {
  constexpr double kLargest{std::numeric_limits<float>::max()};
  return static_cast<float>(x > kLargest ? kLargest : x < -kLargest ? -kLargest : x);
}

}  // namespace facet
