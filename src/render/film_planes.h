// The planes of a film besides colour: which may be asked for, and their memory.
#pragma once

#include <vector>

#include "base/memory_budget.h"
#include "facet/film.h"

namespace facet {

// Throws Error(InvalidUsage) unless each is a plane and is asked for once.
void CheckPlanes(const std::vector<PlaneKind>& planes);

// For a film, or a band of one, of this size. Throws Error(OutOfMemory).
void ChargePlanes(const std::vector<PlaneKind>& planes, int width, int rows, MemoryBudget& budget);

// Makes the film's planes these, as large as the film says that it is; their pixels are not set. Their memory is used
// again.
void SizePlanes(const std::vector<PlaneKind>& planes, Film& film);

}  // namespace facet
