// Materials, with the extensions that facet supports.
#pragma once

#include "facet/scene.h"
#include "gltf/context.h"

namespace facet::gltf {

// Reads all materials. Nothing in a material is an error: factors out of range are clamped with a warning, and broken
// members count as absent.
void ReadMaterials(Context& context, Scene& scene);

}  // namespace facet::gltf
