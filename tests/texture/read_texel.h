// A texel of a texture by the layout that texture.h states, as double.
#pragma once

#include <array>

#include "texture/texture.h"

namespace facet {

inline std::array<double, 4> ReadTexel(const TextureData& t, int level, int x, int y) {
  const std::size_t size = t.is_16_bit ? 2 : 1;
  const std::size_t first = t.ByteOf(level, y) + std::size_t(x * t.TexelBytes());
  std::array<double, 4> c{0.0, 0.0, 0.0, 1.0};
  for (std::size_t k = 0; k < 4; ++k) {
    if (t.component_of[k] < 0) continue;
    const std::uint8_t* p = &t.bytes.at(first + std::size_t(t.component_of[k]) * size);
    c[k] = t.is_16_bit ? (((p[0] | p[1] << 8) + (t.sparse ? 0 : 32768)) & 0xFFFF) / 65535.0 : p[0] / 255.0;
  }
  return c;
}

}  // namespace facet
