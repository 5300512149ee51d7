// The channels of an image that are read, and their meaning.
#pragma once

#include <cstdint>

namespace facet {

// A set of the channels R, G, B and A, one bit each.
enum ChannelMask : int { kR = 1, kG = 2, kB = 4, kA = 8, kRgb = 7, kRgba = 15 };

// The meaning of a texture's values, which decides how they are stored.
enum class TextureRole : std::uint8_t {
  Color,  // sRGB in the file; stored as 16-bit linear light, for which 8 bits would be too few
  Data,   // normals, roughness, metalness, occlusion: stored as in the file
};

}  // namespace facet
