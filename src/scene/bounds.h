// Bounding boxes of vertices.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/pose.h"

namespace facet {

// The box of all finite positions, whether an index uses them or not.
Bounds BoundsOf(const std::vector<glm::vec3>& positions);

// Enlarges `bounds` to contain another box.
void AddBounds(const Bounds& other, Bounds& bounds);

// Enlarges `bounds` to contain all finite positions, transformed by `world_from_mesh`. Exact: the box of the
// transformed vertices, not of the transformed box, which is larger if the matrix rotates. `local` must be
// BoundsOf(positions).
void AddPlaced(const std::vector<glm::vec3>& positions, const Bounds& local, const glm::dmat4& world_from_mesh,
               Bounds& bounds);

// Raises `reach` to the largest distance of a transformed position from a point in world space. Positions that are not
// finite are skipped. Runs in parallel; the result does not depend on the number of threads.
void AddReach(const std::vector<glm::vec3>& positions, const Bounds& local, const glm::dmat4& world_from_mesh,
              const glm::dvec3& point, double& reach);

}  // namespace facet
