// Boxes around vertices.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/pose.h"

namespace facet {

// The box of the finite ones among `positions`, whether an index uses them or not.
Bounds BoundsOf(const std::vector<glm::vec3>& positions);

// Makes `bounds` hold another box.
void AddBounds(const Bounds& other, Bounds& bounds);

// Makes `bounds` hold every finite one of `positions`, placed by `world_from_mesh`. Exact: the box of the placed
// vertices, not of the placed box, which is larger where the matrix turns. `local` must be BoundsOf(positions).
void AddPlaced(const std::vector<glm::vec3>& positions, const Bounds& local, const glm::dmat4& world_from_mesh,
               Bounds& bounds);

// Raises `reach` to the largest distance of a placed position from a point of the world. Positions that are not finite
// are skipped. Runs in parallel; the result does not depend on it.
void AddReach(const std::vector<glm::vec3>& positions, const Bounds& local, const glm::dmat4& world_from_mesh,
              const glm::dvec3& point, double& reach);

}  // namespace facet
