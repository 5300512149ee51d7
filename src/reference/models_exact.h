// The shading models, as the reference evaluates them.
#pragma once

#include <glm/glm.hpp>

#include "reference/material_exact.h"
#include "reference/radiance_exact.h"

namespace facet {

// Radiance towards the eye, by the material's model. `base_color`: the material's at this point.
glm::dvec3 RadianceByModel(const ExactMaterial& material, const glm::dvec3& base_color, const SurfacePoint& point,
                           const ExactLight& light, const SampleRun& run);

}  // namespace facet
