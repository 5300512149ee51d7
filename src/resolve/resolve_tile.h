// The resolve stage: samples to pixels.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "frame/tile.h"

namespace facet {

// The pixels of a tile, tile_size a row: linear light multiplied by coverage, and coverage.
using TilePixels = std::vector<glm::vec4>;

// The mean colour of each pixel's samples; uncovered samples count as zero. `opaque`: the fragments of
// VisibleFragments, shaded.
void ResolveOpaque(const TileBuffers& tile, const ShadedFragments& opaque, TilePixels& pixels);

}  // namespace facet
