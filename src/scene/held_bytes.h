// How much memory a scene takes, for the budgets of those that keep one.
#pragma once

#include <cstdint>

#include "facet/scene.h"
#include "scene/pose.h"

namespace facet {

// Of the arrays, not of the struct itself.
std::uint64_t HeldBytes(const Primitive& primitive);

// Geometry, nodes, animations, and encoded images; names and what a material takes count as well.
std::uint64_t HeldBytes(const Scene& scene);

// Without the scene that it was made from.
std::uint64_t HeldBytes(const PosedScene& posed);

}  // namespace facet
