// Primitives into snapped screen triangles: culling, clipping, widening of points and lines.
#pragma once

#include "frame/geometry.h"

namespace facet {

// Fills chunk.records, in primitive order, and chunk.culled and chunk.clipped, from the chunk's range of `drawable`'s
// primitives. `samples`: triangles that cannot cover one are culled.
void AssembleChunk(const FrameView& view, const FrameDrawable& drawable, const VertexBuffer& vertices, int samples,
                   TriangleChunk& chunk);

}  // namespace facet
