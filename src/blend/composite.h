// The blend stage. Transparency is exact: at each sample, every blended fragment in front of the opaque surface is
// composited, from back to front.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "blend/layers_by_pixel.h"
#include "frame/tile.h"

namespace facet {

// Keeps its working memory from tile to tile. Not thread-safe: one per worker.
class Compositor {
 public:
  // Replaces those of `pixels` (tile_size a row) that blended fragments cover. Each sample starts with the opaque
  // fragment that covers it, or with `background`. The blended fragments are composited over it in the order of their
  // depth at that very sample, so that intersecting surfaces are right. At equal depth the later triangle is in front.
  // `opaque`: in the order of VisibleFragments. `records`: by id in the tile.
  void Run(const TileBuffers& tile, const ShadedFragments& opaque, const ShadedFragments& blended,
           std::span<const ScreenTriangle* const> records, const std::vector<glm::vec4>& background,
           std::vector<glm::vec4>& pixels);

 private:
  template <int kSamples>
  void Composite(const TileBuffers& tile, const ShadedFragments& opaque, const ShadedFragments& blended,
                 std::span<const ScreenTriangle* const> records, const std::vector<glm::vec4>& background,
                 std::vector<glm::vec4>& pixels);

  FragmentsByPixel layers_of_, opaque_of_;
  std::vector<BlockDepth> planes_;
  std::vector<Layer> layers_;
};

}  // namespace facet
