// Animations.
#pragma once

#include "facet/scene.h"
#include "gltf/accessor.h"

namespace facet::gltf {

// Needs the scene's nodes and meshes. Channels that cannot move anything are left out with a warning; keys whose time
// does not increase are dropped with one. Throws Error(InvalidInput) for wrong types and sizes.
void ReadAnimations(Context& context, AccessorReader& reader, Scene& scene);

}  // namespace facet::gltf
