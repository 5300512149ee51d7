// Animations.
#pragma once

#include "facet/scene.h"
#include "gltf/accessor.h"

namespace facet::gltf {

// Reads all animations. The scene's nodes and meshes must have been read. Channels that cannot be read or have no
// effect are ignored with a warning; keys whose time decreases are dropped with a warning.
void ReadAnimations(Context& context, AccessorReader& reader, Scene& scene);

}  // namespace facet::gltf
