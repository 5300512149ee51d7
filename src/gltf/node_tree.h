// The node hierarchy, the scenes, and which parts of the file are visible in the default image.
#pragma once

#include <cstddef>
#include <vector>

#include "facet/scene.h"
#include "gltf/context.h"

namespace facet::gltf {

// How the visible nodes of the default scene use a mesh.
struct MeshUse {
  bool shown = false;
  bool skinned = false;  // by at least one node
  std::vector<bool>
      moving_targets;  // morph targets that it or one of them gives a weight other than 0; others may lack
};

// What is visible with default settings: the visible nodes of the default scene, at rest.
struct Shown {
  std::vector<bool> nodes, skins;  // by index
  std::vector<MeshUse> meshes;
};

// Fills the nodes' names, children and visibility (KHR_node_visibility), the scenes and the default one. In the result
// every node has at most one parent, and none is its own ancestor. Throws Error(InvalidInput) if visible nodes break
// this rule or refer to nodes that do not exist; other broken links are dropped with a warning.
Shown ReadNodeTree(Context& context, Scene& scene);

}  // namespace facet::gltf
