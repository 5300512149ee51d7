// Primitive assembly: makes snapped screen triangles of primitives by culling, clipping, and widening points and lines.
#pragma once

#include "frame/geometry.h"

namespace facet {

// Assembles the chunk's range of `drawable`'s primitives into chunk.records, in the order of primitives, and counts
// chunk.culled and chunk.clipped. `samples`: per pixel; triangles that cannot cover any are culled.
void AssembleChunk(const FrameView& view, const FrameDrawable& drawable, const VertexBuffer& vertices, int samples,
                   TriangleChunk& chunk);

}  // namespace facet
