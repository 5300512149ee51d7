// Tiles are lit by the lights that reach them.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "light/lighting.h"

namespace facet {

// Of the lights of `lighting`, in their order, those that may reach the box from `low` to `high` (relative to the eye,
// world axes). All others give nothing there, exactly: a light with a range ends at it (KHR_lights_punctual). Lights
// without one reach everything.
void LightsReaching(const LightingData& lighting, const glm::dvec3& low, const glm::dvec3& high,
                    std::vector<PunctualLight>& reaching);

}  // namespace facet
