// The filters of EXT_meshopt_compression: the last step of unpacking attributes. meshoptimizer's own versions give
// other bits on other processors (they use estimates of the reciprocal root, and fused multiply-adds on Arm); these
// compute with what IEEE 754 rounds exactly, and give the extension's formulas rounded once. Source: Khronos Group,
// extension EXT_meshopt_compression, appendix B; ties as in KHR_meshopt_compression: away from 0.
#pragma once

#include <cstddef>
#include <span>

namespace facet::gltf {

// Each works in place on whole elements, whatever they hold: what the extension leaves undefined has a value too.

// Elements of four bytes: x and y on the octahedron, the integer that stands for 1, and one that stays as it is.
// They become signed normalised bytes; a vector without direction stays zero.
void DecodeOctahedral8(std::span<std::byte> elements);

// The same with elements of four 16-bit integers.
void DecodeOctahedral16(std::span<std::byte> elements);

// Elements of four 16-bit integers: the three smaller components, and the integer that stands for 1, with the place of
// the largest component in its lowest two bits. They become signed normalised quaternions x, y, z, w.
void DecodeQuaternions(std::span<std::byte> elements);

// Elements of 32 bits, exponents above mantissas, become floats; beyond their range they are infinite.
void DecodeExponential(std::span<std::byte> elements);

}  // namespace facet::gltf
