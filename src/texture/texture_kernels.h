// The SIMD kernels that build a texture. A row of texels is one plane of floats per component; kernels may read and
// write up to kRowSlack floats beyond the row's width in each plane.
#pragma once

#include <cstddef>
#include <cstdint>

namespace facet {

inline constexpr std::size_t kRowSlack = 64;

// Converts a row of an image's 8-bit codes to linear light, and splits it into planes.
struct ExpandRowTask {
  const std::uint8_t* row;
  int channels;           // of the image
  int kept;               // how many of them are converted
  int channel[4];         // the channel that each plane is made from
  const float* light[4];  // for each plane the linear value of each of the 256 codes; null: code / 255
  float* planes[4];
  std::int32_t width;
};
void ExpandRow(const ExpandRowTask& task);

// Stores a row of texels in [0, 1], rounded to 8 or 16 bits, and repeats its first texel at its end (see TextureData).
struct StoreRowTask {
  const float* planes[4];  // one for each component of a texel
  int components;          // components of a texel
  std::int32_t width;
  bool is_16_bit, sparse;  // as in TextureData
  bool skip_black;         // vectors of black texels are not written: the memory is zero already
  std::uint8_t* bytes;  // where the row's first texel goes
};
void StoreRow(const StoreRowTask& task);

// Makes one plane of a row of the next mip level from two or three rows of the level above. n texels become m, with n =
// 2 m or 2 m + 1; texel i covers [i * n / m, (i + 1) * n / m] of the finer row, so the texels from 2 * i on are
// weighted by how much of each lies in that interval (a polyphase box filter: Guthe and Heckbert 2005,
// "Non-power-of-two mipmapping"). Where n is even, the two weights are one half each.
struct HalveRowTask {
  const float* rows[3];
  float weights[3];  // of the rows, with sum 1
  std::int32_t row_count;
  std::int32_t n, m;
  float* out;
};
void HalveRow(const HalveRowTask& task);

}  // namespace facet
