// The filters of EXT_meshopt_compression, which are the last step of decompressing attributes. meshoptimizer's own
// versions give different bits on different processors (they use reciprocal square root estimates, and fused
// multiply-adds on Arm). These use only operations that IEEE 754 rounds correctly, and round the extension's formulas
// once. Source: Khronos Group, extension EXT_meshopt_compression, appendix B; ties as in KHR_meshopt_compression: away
// from 0.
#pragma once

#include <cstddef>
#include <span>

namespace facet::gltf {

// All filters work in place on whole elements. They accept any values, also those that the extension leaves undefined.

// Elements of four bytes: octahedral x and y, the integer that represents 1, and one that is not changed. They become
// signed normalised bytes; a vector without direction stays zero.
void DecodeOctahedral8(std::span<std::byte> elements);

// The same with elements of four 16-bit integers.
void DecodeOctahedral16(std::span<std::byte> elements);

// Elements of four 16-bit integers: the three smaller components of a quaternion, and the integer that represents 1,
// with the index of the largest component in its lowest two bits. They become signed normalised quaternions x, y, z, w.
void DecodeQuaternions(std::span<std::byte> elements);

// Elements of 32 bits, with the exponent above the mantissa, become floats; beyond the range of float, infinities.
void DecodeExponential(std::span<std::byte> elements);

}  // namespace facet::gltf
