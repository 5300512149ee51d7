// Light culling for tiles.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "light/lighting.h"

namespace facet {

// Finds the lights of `lighting`, in their order, that may reach the box from `low` to `high` (relative to the eye,
// world axes). All others contribute exactly 0 there: by KHR_lights_punctual a light is 0 beyond its range. Lights
// without a range reach everything.
void LightsReaching(const LightingData& lighting, const glm::dvec3& low, const glm::dvec3& high,
                    std::vector<PunctualLight>& reaching);

}  // namespace facet
