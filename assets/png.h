// A PNG encoder of the generator's own: its bytes depend on the image alone, not on a library's version.
#pragma once

#include <cstdint>
#include <vector>

namespace facet::assets {

// `pixels`: height rows of width pixels of 1 to 4 interleaved bytes, top row first.
std::vector<std::uint8_t> EncodePng(int width, int height, int channels, const std::vector<std::uint8_t>& pixels);

}  // namespace facet::assets
