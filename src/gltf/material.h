// Materials, with the extensions that facet has.
#pragma once

#include "facet/scene.h"
#include "gltf/context.h"

namespace facet::gltf {

// Nothing in a material is an error: factors outside of their range are clamped, with a warning, and what is broken is
// read as if it were absent.
void ReadMaterials(Context& context, Scene& scene);

}  // namespace facet::gltf
