// One number for the results of a function over many floats, to compare instruction sets and machines by.
#pragma once

#include <cstdint>

namespace facet::testing {

// The functions of elementary_lanes.h with one argument come first.
constexpr int kOneArgumentFunctionCount = 9;

// A 64-bit checksum of function `function` on the lanes of the active target, over the floats whose bits are 0, stride,
// 2 stride ... Any one result that differs changes it. Every NaN counts as the same.
std::uint64_t ChecksumOverFloats(int function, std::uint64_t stride);

}  // namespace facet::testing
