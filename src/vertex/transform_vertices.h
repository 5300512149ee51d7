// The vertex stage: transforms vertices from mesh space to the screen.
#pragma once

#include <cstddef>

#include "frame/geometry.h"

namespace facet {

// Transforms vertices [begin, end) of `drawable` into its part of `out` (sized by the caller). Thread-safe for disjoint
// ranges.
void TransformVertices(const FrameView& view, const FrameDrawable& drawable, std::size_t begin, std::size_t end,
                       VertexBuffer& out);

}  // namespace facet
