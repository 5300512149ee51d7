// Textures as the samplers read them: linear light, with all mip levels.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/pages.h"
#include "facet/image.h"
#include "facet/render.h"
#include "facet/scene.h"

namespace facet {

inline constexpr int kMaxTextureLevels = 16;  // 32768 texels a side

// What the numbers of a texture mean; it decides how they are stored.
enum class TextureRole : std::uint8_t {
  Color,  // sRGB in the file; kept as 16-bit linear light, because eight bits are too few for it
  Data,   // normals, roughness, metalness, occlusion: as in the file
};

// One image with its mip levels: texel (x, y) of level l is number level_offset[l] + y * level_pitch[l] + x. A row ends
// with its first texel once more, so that the two texels of a row that bilinear filtering needs always are neighbours,
// and one load gets both. (Loads, not cache lines, are what reading textures waits for: squares of 4 x 4 texels, with
// four loads a footprint, are slower. The extra texel also keeps rows from lying powers of two apart.)
struct TextureData {
  bool wide = false;                // two words a texel (16 bits a channel, RG then BA) instead of one (8 bits, RGBA)
  int levels = 0;
  std::int32_t level_offset[kMaxTextureLevels] = {};  // texels
  std::int32_t level_pitch[kMaxTextureLevels] = {};   // texels from row to row
  std::int32_t level_width[kMaxTextureLevels] = {};
  std::int32_t level_height[kMaxTextureLevels] = {};
  PageVector<std::int32_t> words;  // little-endian channels: R in the low bits

  std::size_t Bytes() const { return words.size() * sizeof(words[0]); }
  // Where row y of a level begins in `words`.
  std::size_t WordOf(int level, int y) const {
    return (std::size_t(level_offset[level]) + std::size_t(y) * std::size_t(level_pitch[level])) * (wide ? 2 : 1);
  }
};

// How many texels a picture's levels take, as they are laid out.
std::size_t TexelCount(int width, int height, bool mips);

// Builds a texture from a decoded picture. Each level halves the one above, rounding down; a texel is the mean, in
// linear light, of the area it covers, also where a size is odd. `mips`: false keeps level 0 alone.
// Throws Error: OutOfMemory for pictures beyond 32768 texels a side or 2^27 texels, InvalidInput for pictures without
// pixels, of other than 1 to 4 channels, or whose bytes do not fit their size.
TextureData BuildTexture(const Image& image, TextureRole role, bool mips, TexelBits bits = TexelBits::Mixed);

// A use of a texture by a material.
struct TextureSlot {
  const TextureData* data = nullptr;  // null: the texture is absent, factors alone count
  Sampler sampler;
  int uv_slot = 0;                    // which of the interpolated UV sets
  // u' = transform[0] * u + transform[1] * v + transform[2], v' = transform[3] * u + ...
  float transform[6] = {1, 0, 0, 0, 1, 0};
  float max_anisotropy = 8.0f;
};

// KHR_texture_transform as a 2 x 3 matrix: translation * rotation * scale, counter-clockwise with v down.
void SetTransform(const TextureRef& ref, TextureSlot& slot);

}  // namespace facet
