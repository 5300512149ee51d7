// The float functions on whole arrays, compiled for every instruction set.
#pragma once

#include <array>
#include <cstddef>

namespace facet::testing {

constexpr int kLaneFunctionCount = 11;
extern const std::array<const char*, kLaneFunctionCount> kLaneFunctionNames;

// out[i] = f(a[i], b[i]) on the lanes of the active target; functions of one argument ignore b.
// count is a multiple of 16.
void ApplyOnLanes(int function, const float* a, const float* b, float* out, std::size_t count);

// The same, one float after the other.
void ApplyOnFloats(int function, const float* a, const float* b, float* out, std::size_t count);

}  // namespace facet::testing
