// The node hierarchy at one moment: local values and world transforms of all nodes.
#pragma once

#include <deque>
#include <glm/glm.hpp>
#include <vector>

#include "facet/scene.h"
#include "scene/pose.h"

namespace facet {

// The state of every node of a scene, which must outlive it, by index into Scene::nodes.
struct PosedNodes {
  std::vector<glm::dmat4> world_from_node;
  // Morph weights: those of the animation, else of the node, else of the mesh. They lie in the scene or in `sampled`.
  // Never null.
  std::vector<const std::vector<float>*> weights;
  std::deque<std::vector<float>> sampled;
};

// Translation * rotation * scale. The rotation is normalised first; a zero quaternion counts as the identity.
glm::dmat4 ToMatrix(const Transform& transform);

// Decomposes a matrix into a transform, which is exact if it has no shear. A mirror becomes a negative x scale.
Transform ToTransform(const glm::dmat4& matrix);

// Computes the transforms of all nodes, whichever scene they belong to, because joints may lie outside of the scene
// that uses them. The parents of the roots of the chosen scene (-1: the default one) are ignored. `animation`: null for
// the rest pose. Needs a valid scene (see ValidateScene).
PosedNodes PlaceNodes(const Scene& scene, int scene_index, const Animation* animation, double time);

// The nodes of the chosen scene (-1: the default one), each once, in depth-first order. Hidden nodes and their
// descendants are included if they are asked for.
std::vector<int> NodesOf(const Scene& scene, int scene_index, bool with_hidden);

}  // namespace facet
