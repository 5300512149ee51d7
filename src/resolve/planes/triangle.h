// The plane `triangle`: which triangle, line or point of its primitive is seen.
#pragma once

#include <cstdint>

#include "resolve/planes/plane_tile.h"

namespace facet {

// Pieces of what was clipped or widened have the number of the whole.
inline void WriteTriangle(const PlaneTile& t) {
  constexpr std::uint32_t kNothing = 0xffffffff;
  WritePixels(t, kNothing, [&t](std::size_t sample) { return t.RecordAt(sample).primitive; });
}

}  // namespace facet
