// The plane `triangle`: the index of the visible triangle, line or point in its primitive.
#pragma once

#include <cstdint>

#include "resolve/planes/plane_tile.h"

namespace facet {

// Pieces of a clipped triangle, or of a line that was widened to triangles, have the index of the whole.
inline void WriteTriangle(const PlaneTile& t) {
  constexpr std::uint32_t kNothing = 0xffffffff;
  WritePixels(t, kNothing, [&t](std::size_t sample) { return t.RecordAt(sample).primitive; });
}

}  // namespace facet
