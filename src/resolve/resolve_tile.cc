#include "resolve/resolve_tile.h"

namespace facet {

void ResolveOpaque(const TileBuffers& tile, const ShadedFragments& opaque, const TilePixels* background,
                   TilePixels& pixels) {
  const std::size_t size = std::size_t(tile.tile_size) * std::size_t(tile.tile_size);
  const float share = 1.0f / static_cast<float>(tile.samples);
  pixels.assign(size, glm::vec4(0.0f));
  const FragmentList& list = opaque.list;
  for (std::size_t i = 0; i < list.Size(); ++i) {
    const float weight = static_cast<float>(__builtin_popcount(list.samples[i])) * share;
    pixels[list.pixel[i]] += glm::vec4(opaque.red[i], opaque.green[i], opaque.blue[i], 1.0f) * weight;
  }
  if (background == nullptr) return;
  for (std::size_t i = 0; i < size; ++i) {
    if (pixels[i].a < 1.0f) pixels[i] += (*background)[i] * (1.0f - pixels[i].a);
  }
}

}  // namespace facet
