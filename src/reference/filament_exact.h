// How light passes surfaces of the model "filament", for the rays of the reference: Filament's parameters in the place
// of glTF's. What Filament approximates by a sphere of the stated thickness is traced through the geometry.
#pragma once

#include "reference/transmission_exact.h"

namespace facet {

// As ExitAt() and EntryAt().
ExactInterface FilamentExitAt(const ExactMaterial& material, const SurfacePoint& point);
ExactEntry FilamentEntryAt(const ExactMaterial& material, const glm::dvec4& base, const SurfacePoint& point,
                           const ExactLight& light);

// For add, multiply and screen: `own` is the surface's light before and after.
void BlendFilament(const ExactMaterial& material, glm::dvec3& own, ExactEntry& entry);

}  // namespace facet
