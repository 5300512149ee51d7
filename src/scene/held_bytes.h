// The memory that scenes take, to be charged to memory budgets.
#pragma once

#include <cstdint>

#include "facet/scene.h"
#include "scene/pose.h"

namespace facet {

// The bytes of the arrays, without the struct itself.
std::uint64_t HeldBytes(const Primitive& primitive);

// Geometry, nodes, animations, encoded images, materials and names.
std::uint64_t HeldBytes(const Scene& scene);

// Without the scene that it refers to.
std::uint64_t HeldBytes(const PosedScene& posed);

}  // namespace facet
