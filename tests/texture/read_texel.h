// A texel of a texture by the layout that texture.h states, as double.
#pragma once

#include <array>

#include "texture/texture.h"

namespace facet {

inline std::array<double, 4> ReadTexel(const TextureData& t, int level, int x, int y) {
  const std::size_t texel =
      std::size_t(t.level_offset[level]) + std::size_t(y) * std::size_t(t.level_pitch[level]) + std::size_t(x);
  std::array<double, 4> c{};
  for (std::size_t k = 0; k < 4; ++k) {
    const auto word = static_cast<std::uint32_t>(t.words.at(t.wide ? 2 * texel + k / 2 : texel));
    c[k] = t.wide ? (word >> (k % 2 * 16) & 0xFFFFu) / 65535.0 : (word >> (k * 8) & 0xFFu) / 255.0;
  }
  return c;
}

}  // namespace facet
