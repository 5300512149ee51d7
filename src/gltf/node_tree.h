// Which node hangs from which, the scenes, and what of the file the default picture shows.
#pragma once

#include <cstddef>
#include <vector>

#include "facet/scene.h"
#include "gltf/context.h"

namespace facet::gltf {

// What the nodes of the default scene make of a mesh.
struct MeshUse {
  bool shown = false;
  bool skinned = false;  // by one of them
  std::vector<bool>
      moving_targets;  // morph targets that it or one of them gives a weight other than 0; others may lack
};

// What the picture shows that is made without further choices: the visible nodes of the default scene, at rest.
struct Shown {
  std::vector<bool> nodes, skins;  // by index
  std::vector<MeshUse> meshes;
};

// Fills the nodes' names, children and visibility (KHR_node_visibility), the scenes and the default one. Every node has
// one parent at most, and none is its own ancestor. Throws Error(InvalidInput) where shown nodes break that rule, or
// name nodes that there are not; links elsewhere are dropped with a warning.
Shown ReadNodeTree(Context& context, Scene& scene);

}  // namespace facet::gltf
