// The lane work of building a texture. A row of texels is a plane of floats per channel; kRowSlack more floats than its
// width may be read and written in each.
#pragma once

#include <cstddef>
#include <cstdint>

namespace facet {

inline constexpr std::size_t kRowSlack = 64;

// A picture's row of 8-bit codes, apart by channel and in linear light.
struct ExpandRowTask {
  const std::uint8_t* row;
  int channels;           // of the picture
  int kept;               // how many of them
  int channel[4];         // which
  const float* light[4];  // of each of the 256 codes; null: code / 255
  float* planes[4];
  std::int32_t width;
};
void ExpandRow(const ExpandRowTask& task);

// A row of texels in [0, 1], rounded to 8 or 16 bits, and its first texel once more at the end (see TextureData).
struct StoreRowTask {
  const float* planes[4];  // of each number of a texel
  int stored;              // how many
  std::int32_t width;
  bool wide, sparse;    // as TextureData has them
  bool leave_black;     // black is not written, where several texels are: it is there
  std::uint8_t* bytes;  // of the row's first texel
};
void StoreRow(const StoreRowTask& task);

// One channel of a row of the next level, from the rows above it. How much of the texels from 2 * i onwards lies under
// texel i: its area is [i * n / m, (i + 1) * n / m] with n = 2 m or 2 m + 1 texels becoming m (Guthe and Heckbert 2005,
// "Non-power-of-two mipmapping": a polyphase box). Where n is even that is two halves.
struct HalveRowTask {
  const float* rows[3];
  float weights[3];  // of the rows
  std::int32_t row_count;
  std::int32_t n, m;
  float* out;
};
void HalveRow(const HalveRowTask& task);

}  // namespace facet
