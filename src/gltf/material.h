// Materials, with the extensions that facet has.
#pragma once

#include "facet/scene.h"
#include "gltf/context.h"

namespace facet::gltf {

// Factors outside of their range are clamped, with a warning.
void ReadMaterials(Context& context, Scene& scene);

}  // namespace facet::gltf
