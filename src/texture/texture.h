// Textures as the samplers read them: linear light, with all mip levels.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/pages.h"
#include "facet/image.h"
#include "facet/scene.h"
#include "facet/settings.h"
#include "image/channels.h"

namespace facet {

inline constexpr int kMaxTextureLevels = 16;  // 32768 texels a side

// Where an emission texture is black. Most of them are black nearly everywhere, and a sample that touches only black
// texels need not be read. A cell is one texel of the first mip level that is at most kMaxSide wide and high.
struct EmptyCells {
  static constexpr int kMaxSide = 64;
  int width = 0, height = 0;      // in cells; 0: nothing is known about the texture, for example because it is small
  float reach = 0.0f;             // in texels of level 0: all texels within this distance of an empty cell are black
  std::vector<std::int32_t>
      occupied;  // row by row; 0: the cell and its eight neighbours are black (with repeat wrapping)

  // The share of cells that are empty, 0 to 1.
  double Share() const {
    return occupied.empty() ? 0.0 : double(std::count(occupied.begin(), occupied.end(), 0)) / double(occupied.size());
  }
};

// One image with its mip levels. Only the channels that some material reads are stored, as the components of a texel.
// Texel (x, y) of level l has index level_offset[l] + y * level_pitch[l] + x and takes TexelBytes() bytes. Each row
// repeats its first texel at its end, so that the two neighbours that bilinear filtering reads are adjacent in memory
// and one load fetches both. (A layout in squares of 4 x 4 texels needs four loads a footprint and was slower. The
// extra texel also keeps the distance between rows from being a power of two, which would crowd few cache sets.)
struct TextureData {
  bool is_16_bit = false;  // true: components have 16 bits, stored as signed integers (code - 32768); false: 8 bits
  bool sparse = false;  // 16-bit components are stored unsigned: black is 0, and pages of it take no memory. Only where
                        // the empty cells are known
  int components = 0;   // components of a texel
  // The component that holds each of R, G, B and A; those of a grey image share one. -1: the channel is not stored. An
  // alpha that is not stored reads as 1.
  int component_of[4] = {-1, -1, -1, -1};
  int levels = 0;
  std::int32_t level_offset[kMaxTextureLevels] = {};  // texels
  std::int32_t level_pitch[kMaxTextureLevels] = {};   // texels from row to row
  std::int32_t level_width[kMaxTextureLevels] = {};
  std::int32_t level_height[kMaxTextureLevels] = {};
  // The byte shuffle (x86's pshufb, Arm's tbl) that gathers two adjacent texels into 16-bit integers: R of the first, R
  // of the second, G of the first, and so on. Each entry is a byte offset from the first texel; kNoByte gives 0.
  std::uint8_t pair_bytes[16] = {};
  PageVector<std::uint8_t> bytes;  // little-endian components of all levels, then kTexelSlack bytes of padding
  EmptyCells empty_cells;

  static constexpr std::uint8_t kNoByte = 0x80;
  static constexpr std::size_t kTexelSlack = 16;  // bytes that one load may read beyond the last texel

  int TexelBytes() const { return components * (is_16_bit ? 2 : 1); }
  // The offset in `bytes` of row y of a level.
  std::size_t ByteOf(int level, int y) const {
    return (std::size_t(level_offset[level]) + std::size_t(y) * std::size_t(level_pitch[level])) *
           std::size_t(TexelBytes());
  }
};

// The number of texels that TextureData stores for an image of this size, with the repeated one of each row.
std::size_t TexelCount(int width, int height, bool mips);

// Builds a texture from a decoded image. Each level has half the size of the one above, rounded down; a texel is the
// mean, in linear light, of the area that it covers, also where a size is odd. `mips`: false makes level 0 only.
// `channels`: those that will be read, bits of ChannelMask. `emission`: the texture is read for emission only, so it is
// likely to be black nearly everywhere, and its empty cells are found. Throws Error: OutOfMemory for images of more
// than 32768 texels a side or 2^27 texels, InvalidInput for images without pixels, with other than 1 to 4 channels, or
// whose number of bytes does not fit their size.
TextureData BuildTexture(const Image& image, TextureRole role, bool mips, TexelBits bits = TexelBits::Mixed,
                         int channels = kRgba, bool emission = false);

// A texture as one material reads it.
struct BoundTexture {
  const TextureData* data = nullptr;  // null: there is no texture, and the material's factors are used alone
  Sampler sampler;
  int uv_slot = 0;  // index into the material's interpolated UV sets
  // u' = transform[0] * u + transform[1] * v + transform[2], v' = transform[3] * u + ...
  float transform[6] = {1, 0, 0, 0, 1, 0};
  float max_anisotropy = 8.0f;
};

// Sets `texture.transform` to the KHR_texture_transform of `ref`: translation * rotation * scale, where the rotation is
// counter-clockwise as seen with v pointing down.
void SetTransform(const TextureRef& ref, BoundTexture& texture);

}  // namespace facet
