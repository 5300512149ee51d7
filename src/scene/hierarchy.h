// Where every node is at one moment.
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
  // Morph weights, the mesh's own where neither node nor animation has any; in the scene, or in `sampled`. Never null.
  std::vector<const std::vector<float>*> weights;
  std::deque<std::vector<float>> sampled;
};

// Translation * rotation * scale. The rotation is normalised first; a zero one turns nothing.
glm::dmat4 ToMatrix(const Transform& transform);

// The transform that a matrix is made of, exact where it has no shear. A mirror becomes a negative x scale.
Transform ToTransform(const glm::dmat4& matrix);

// Places all nodes, whichever scene they belong to: joints may lie outside of the scene that uses them. The nodes that
// the chosen scene (-1: the default one) begins with stand by themselves, whatever their parents. `animation` may be
// null: the rest pose. Needs a valid scene (see ValidateScene).
PosedNodes PlaceNodes(const Scene& scene, int scene_index, const Animation* animation, double time);

// The nodes of the chosen scene (-1: the default one), depth first, each once; those that are hidden, and what is below
// them, where they are asked for.
std::vector<int> NodesOf(const Scene& scene, int scene_index, bool with_hidden);

}  // namespace facet
