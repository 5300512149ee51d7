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

// Gives the film these planes, of its width and height, reusing their memory. Their pixels are not set.
void SizePlanes(const std::vector<PlaneKind>& planes, Film& film);

}  // namespace facet
