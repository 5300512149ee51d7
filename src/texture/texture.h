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

// Where in a picture there is nothing but black, also around: of most textures of emission it is nearly everywhere, and
// they need not be read there. Cells are the texels of the first level that is at most kMaxSide wide and high.
struct DarkCells {
  static constexpr int kMaxSide = 64;
  int width = 0, height = 0;      // cells; 0: nothing is known, as of small textures
  float reach = 0.0f;             // texels of level 0: what is nearer than this to a dark cell is black
  std::vector<std::int32_t> lit;  // row by row: whether a cell or one of its eight neighbours, as the picture repeats,
                                  // shows something; 0: dark

  double Share() const {
    return lit.empty() ? 0.0 : double(std::count(lit.begin(), lit.end(), 0)) / double(lit.size());
  }
};

// One image with its mip levels, no more of its channels than are read: texel (x, y) of level l is number
// level_offset[l] + y * level_pitch[l] + x, of TexelBytes() bytes. A row ends with its first texel once more, so that
// the two texels of a row that bilinear filtering needs always are neighbours, and one load gets both. (Squares of 4 x
// 4 texels, with four loads a footprint, are slower. The extra texel also keeps rows from lying powers of two apart.)
struct TextureData {
  bool wide = false;    // a number takes 16 bits, and is kept as signed: less 32768; else 8
  bool sparse = false;  // ... but as it is, so that black is 0 and needs no memory; only where `dark` is known
  int stored = 0;       // numbers of a texel
  // Which number of a texel each of R, G, B and A is; those of a grey picture share one. -1: it is not kept. Alpha
  // that is not kept is 1.
  int place_of[4] = {-1, -1, -1, -1};
  int levels = 0;
  std::int32_t level_offset[kMaxTextureLevels] = {};  // texels
  std::int32_t level_pitch[kMaxTextureLevels] = {};   // texels from row to row
  std::int32_t level_width[kMaxTextureLevels] = {};
  std::int32_t level_height[kMaxTextureLevels] = {};
  // Of the bytes from a texel on, those that make up 16-bit numbers R of it, R of the next, G of it, G of the next, and
  // so on; kNoByte: 0. As byte shuffles of x86 and Arm want it.
  std::uint8_t pair_bytes[16] = {};
  PageVector<std::uint8_t> bytes;  // little-endian numbers, and kTexelSlack more
  DarkCells dark;

  static constexpr std::uint8_t kNoByte = 0x80;
  static constexpr std::size_t kTexelSlack = 16;  // that one load may read beyond the last texel

  int TexelBytes() const { return stored * (wide ? 2 : 1); }
  // Where row y of a level begins in `bytes`.
  std::size_t ByteOf(int level, int y) const {
    return (std::size_t(level_offset[level]) + std::size_t(y) * std::size_t(level_pitch[level])) *
           std::size_t(TexelBytes());
  }
};

// How many texels a picture's levels take, as they are laid out.
std::size_t TexelCount(int width, int height, bool mips);

// Builds a texture from a decoded picture. Each level halves the one above, rounding down; a texel is the mean, in
// linear light, of the area it covers, also where a size is odd. `mips`: false keeps level 0 alone. `channels`: which
// will be read. `emission`: it is read for emission alone, hence likely to be black nearly everywhere.
// Throws Error: OutOfMemory for pictures beyond 32768 texels a side or 2^27 texels, InvalidInput for pictures without
// pixels, of other than 1 to 4 channels, or whose bytes do not fit their size.
TextureData BuildTexture(const Image& image, TextureRole role, bool mips, TexelBits bits = TexelBits::Mixed,
                         int channels = kRgba, bool emission = false);

// A texture as one material reads it.
struct BoundTexture {
  const TextureData* data = nullptr;  // null: the texture is absent, factors alone count
  Sampler sampler;
  int uv_slot = 0;  // which of the interpolated UV sets
  // u' = transform[0] * u + transform[1] * v + transform[2], v' = transform[3] * u + ...
  float transform[6] = {1, 0, 0, 0, 1, 0};
  float max_anisotropy = 8.0f;
};

// KHR_texture_transform as a 2 x 3 matrix: translation * rotation * scale, counter-clockwise with v down.
void SetTransform(const TextureRef& ref, BoundTexture& texture);

}  // namespace facet
