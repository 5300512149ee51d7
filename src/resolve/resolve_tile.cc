#include "resolve/resolve_tile.h"

namespace facet {

void ResolveOpaque(const TileBuffers& tile, const ShadedFragments& opaque, TilePixels& pixels) {
  const std::size_t size = std::size_t(tile.tile_size) * std::size_t(tile.tile_size);
  float weights[256];  // by the samples covered
  weights[0] = 0.0f;
  for (int mask = 1; mask < 1 << tile.samples; ++mask) {
    weights[mask] = static_cast<float>(__builtin_popcount(static_cast<unsigned>(mask))) / static_cast<float>(tile.samples);
  }
  pixels.assign(size, glm::vec4(0.0f));
  const FragmentList& list = opaque.list;
  for (std::size_t i = 0; i < list.Size(); ++i) {
    pixels[list.pixel[i]] += glm::vec4(opaque.red[i], opaque.green[i], opaque.blue[i], 1.0f) * weights[list.samples[i]];
  }
}

}  // namespace facet
