// Which channels of an image are read, and what they mean.
#pragma once

#include <cstdint>

namespace facet {

// Which of R, G, B and A: one bit each.
enum ChannelMask : int { kR = 1, kG = 2, kB = 4, kA = 8, kRgb = 7, kRgba = 15 };

// What the values of a texture mean; it decides how they are stored.
enum class TextureRole : std::uint8_t {
  Color,  // sRGB in the file; kept as 16-bit linear light, because eight bits are too few for it
  Data,   // normals, roughness, metalness, occlusion: as in the file
};

}  // namespace facet
