// Samples into pixels.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "frame/tile.h"

namespace facet {

// Pixels of a tile, tile_size a row: linear light multiplied by coverage, and coverage.
using TilePixels = std::vector<glm::vec4>;

// The mean over each pixel's samples of the opaque fragments' colours; samples that nothing covers count as nothing.
// Fragments are those of VisibleFragments.
void ResolveOpaque(const TileBuffers& tile, const ShadedFragments& opaque, TilePixels& pixels);

}  // namespace facet
