#include "scene/hierarchy.h"

#include <optional>

#include "scene/animation.h"

namespace facet {
namespace {

std::vector<int> Roots(const Scene& scene) {
  std::vector<bool> is_child(scene.nodes.size(), false);
  for (const Node& node : scene.nodes) {
    for (const int child : node.children) is_child[std::size_t(child)] = true;
  }
  std::vector<int> roots;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    if (!is_child[i]) roots.push_back(int(i));
  }
  return roots;
}

// The roots of the chosen scene.
std::vector<int> Starts(const Scene& scene, int scene_index) {
  if (scene_index < 0) scene_index = scene.default_scene;
  if (scene_index < 0 && !scene.scenes.empty()) scene_index = 0;
  return scene_index < 0 ? Roots(scene) : scene.scenes[std::size_t(scene_index)].nodes;
}

}  // namespace

glm::dmat4 ToMatrix(const Transform& transform) {
  const glm::dmat3 rotation = glm::mat3_cast(NormalizedOrIdentity(transform.rotation));
  return glm::dmat4(glm::dvec4(rotation[0] * transform.scale.x, 0.0), glm::dvec4(rotation[1] * transform.scale.y, 0.0),
                    glm::dvec4(rotation[2] * transform.scale.z, 0.0), glm::dvec4(transform.translation, 1.0));
}

Transform ToTransform(const glm::dmat4& matrix) {
  glm::dmat3 axes(matrix);
  glm::dvec3 scale(glm::length(axes[0]), glm::length(axes[1]), glm::length(axes[2]));
  if (glm::determinant(axes) < 0.0) scale.x = -scale.x;
  glm::dquat rotation(1.0, 0.0, 0.0, 0.0);
  if (scale.x != 0.0 && scale.y != 0.0 && scale.z != 0.0) {
    for (int i = 0; i < 3; ++i) axes[i] /= scale[i];
    rotation = NormalizedOrIdentity(glm::quat_cast(axes));
  }
  return {glm::dvec3(matrix[3]), rotation, scale};
}

PosedNodes PlaceNodes(const Scene& scene, int scene_index, const Animation* animation, double time) {
  const std::size_t count = scene.nodes.size();
  PosedNodes posed;
  posed.weights.resize(count);
  std::vector<Transform> transforms(count);
  std::vector<bool> animated(count, false);
  for (std::size_t i = 0; i < count; ++i) {
    const Node& node = scene.nodes[i];
    transforms[i] = node.transform;
    const bool of_mesh = node.weights.empty() && node.mesh >= 0;
    posed.weights[i] = of_mesh ? &scene.meshes[std::size_t(node.mesh)].weights : &node.weights;
  }
  if (animation != nullptr) {
    for (const AnimationChannel& channel : animation->channels) {
      if (channel.node < 0 || channel.times.empty()) continue;
      const std::size_t i = std::size_t(channel.node);
      if (channel.path == AnimationPath::Weights) {
        posed.weights[i] = &posed.sampled.emplace_back(SampleWeights(channel, time));
        continue;
      }
      // glTF forbids animating a node that has a matrix. If it happens, the components that are not animated are kept.
      if (!animated[i] && scene.nodes[i].matrix) transforms[i] = ToTransform(*scene.nodes[i].matrix);
      animated[i] = true;
      if (channel.path == AnimationPath::Translation) transforms[i].translation = SampleVector(channel, time);
      if (channel.path == AnimationPath::Scale) transforms[i].scale = SampleVector(channel, time);
      if (channel.path == AnimationPath::Rotation) transforms[i].rotation = SampleRotation(channel, time);
    }
  }

  posed.world_from_node.assign(count, glm::dmat4(1.0));
  const auto local = [&](std::size_t i) {
    return scene.nodes[i].matrix && !animated[i] ? *scene.nodes[i].matrix : ToMatrix(transforms[i]);
  };
  std::vector<bool> in_scene(count, false);  // the roots, and their descendants as the walk reaches them
  for (const int start : Starts(scene, scene_index)) in_scene[std::size_t(start)] = true;
  std::vector<int> open = Roots(scene);
  for (const int root : open) posed.world_from_node[std::size_t(root)] = local(std::size_t(root));
  while (!open.empty()) {
    const std::size_t parent = std::size_t(open.back());
    open.pop_back();
    for (const int index : scene.nodes[parent].children) {
      const std::size_t child = std::size_t(index);
      const bool begins_here = in_scene[child] && !in_scene[parent];
      posed.world_from_node[child] = begins_here ? local(child) : posed.world_from_node[parent] * local(child);
      if (in_scene[parent]) in_scene[child] = true;
      open.push_back(index);
    }
  }
  return posed;
}

std::vector<int> NodesOf(const Scene& scene, int scene_index, bool with_hidden) {
  const std::vector<int> starts = Starts(scene, scene_index);
  std::vector<int> order;
  std::vector<bool> seen(scene.nodes.size(), false);
  std::vector<int> open(starts.rbegin(), starts.rend());  // an explicit stack, since hierarchies can be deep
  while (!open.empty()) {
    const int index = open.back();
    open.pop_back();
    const Node& node = scene.nodes[std::size_t(index)];
    if (seen[std::size_t(index)] || !(node.visible || with_hidden)) continue;
    seen[std::size_t(index)] = true;
    order.push_back(index);
    open.insert(open.end(), node.children.rbegin(), node.children.rend());
  }
  return order;
}

}  // namespace facet
