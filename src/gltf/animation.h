// Animations.
#pragma once

#include "facet/scene.h"
#include "gltf/accessor.h"

namespace facet::gltf {

// Needs the scene's nodes and meshes. Channels that cannot be read or move nothing are left out with a warning; keys
// whose time decreases are dropped with one.
void ReadAnimations(Context& context, AccessorReader& reader, Scene& scene);

}  // namespace facet::gltf
