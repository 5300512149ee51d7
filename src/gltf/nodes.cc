#include "gltf/nodes.h"

#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <limits>

#include "math/round_to_float.h"

namespace facet::gltf {
namespace {

glm::dquat ToUnit(Context& context, const double* xyzw, const Place& place) {
  const double squared = xyzw[0] * xyzw[0] + xyzw[1] * xyzw[1] + xyzw[2] * xyzw[2] + xyzw[3] * xyzw[3];
  if (!(squared > 0.0) || !std::isfinite(squared)) {
    context.Warn(place, "is no rotation; none is used");
    return {1.0, 0.0, 0.0, 0.0};
  }
  constexpr double kTolerance = 0.01;  // quantised rotations are unit to within their steps
  if (std::fabs(squared - 1.0) > kTolerance) context.Warn(place, "is not unit; it was normalised");
  const double length = std::sqrt(squared);
  return {xyzw[3] / length, xyzw[0] / length, xyzw[1] / length, xyzw[2] / length};
}

void ReadTransform(Context& context, const tinygltf::Node& from, Node& node, const Place& place) {
  if (from.matrix.size() == 16) {
    node.matrix = glm::make_mat4(from.matrix.data());
    const glm::dmat4& m = *node.matrix;
    if (m[0][3] != 0.0 || m[1][3] != 0.0 || m[2][3] != 0.0 || m[3][3] != 1.0) {
      context.Warn(Place(place, "matrix"), "is not affine; its last row was replaced by 0, 0, 0, 1");
      for (int c = 0; c < 4; ++c) (*node.matrix)[c][3] = c == 3 ? 1.0 : 0.0;
    }
    return;
  }
  if (from.translation.size() == 3) node.transform.translation = glm::make_vec3(from.translation.data());
  if (from.scale.size() == 3) node.transform.scale = glm::make_vec3(from.scale.data());
  if (from.rotation.size() == 4) {
    node.transform.rotation = ToUnit(context, from.rotation.data(), Place(place, "rotation"));
  }
}

// EXT_mesh_gpu_instancing.
std::vector<Transform> ReadInstances(Context& context, AccessorReader& reader, const Json& object, const Place& place) {
  constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";
  const Json* extension = ExtensionOf(object, kInstancing, place);
  if (!extension) return {};
  const Place extensions_place(place, "extensions");
  const Place instancing_place(extensions_place, kInstancing);
  const Json* attributes = ObjectAt(*extension, "attributes", instancing_place);
  if (!attributes) return {};
  const Place attributes_place(instancing_place, "attributes");
  std::vector<Transform> instances;
  const auto read = [&](const char* semantic, int components, const auto& store) {
    const int accessor =
        IndexAt(*attributes, semantic, context.document.core.accessors.size(), "accessors", attributes_place);
    if (accessor < 0) return;
    const Place attribute_place(attributes_place, semantic);
    const AccessorView view = reader.View(accessor);
    if (view.is_matrix || view.components != components) {
      Fail(attribute_place, "does not have " + std::to_string(components) + " components");
    }
    if (instances.empty()) {
      context.Charge(view.count, sizeof(Transform), attribute_place);
      instances.resize(view.count);
    }
    if (view.count != instances.size()) Fail(attribute_place, "does not have as many elements as the others");
    std::vector<float> values(view.count * static_cast<std::size_t>(components));
    reader.ReadFloats(view, {0, view.count}, components, values.data(), attribute_place);
    for (std::size_t i = 0; i < view.count; ++i) {
      store(instances[i], values.data() + i * static_cast<std::size_t>(components), attribute_place);
    }
  };
  read("TRANSLATION", 3, [](Transform& t, const float* v, const Place&) { t.translation = {v[0], v[1], v[2]}; });
  read("SCALE", 3, [](Transform& t, const float* v, const Place&) { t.scale = {v[0], v[1], v[2]}; });
  read("ROTATION", 4, [&](Transform& t, const float* v, const Place& where) {
    const double xyzw[4] = {v[0], v[1], v[2], v[3]};
    t.rotation = ToUnit(context, xyzw, where);
  });
  return instances;
}

std::size_t TargetCount(const Mesh& mesh) {
  return mesh.primitives.empty() ? 0 : mesh.primitives.front().targets.size();
}

// Joint indices that the skin does not have are an error, unless their weight is zero: those are cleared.
void CheckJoints(Mesh& mesh, std::size_t joint_count, int skin, const Place& mesh_place) {
  std::size_t p = 0;
  for (Primitive& primitive : mesh.primitives) {
    const Place primitives_place(mesh_place, "primitives");
    const Place place(primitives_place, p++);
    for (std::size_t set = 0; set < primitive.joints.size(); ++set) {
      for (std::size_t v = 0; v < primitive.joints[set].size(); ++v) {
        for (int c = 0; c < 4; ++c) {
          std::uint16_t& joint = primitive.joints[set][v][c];
          if (joint < joint_count) continue;
          if (primitive.weights[set][v][c] > 0.0f) {
            Fail(place, "joint " + std::to_string(joint) + " is not one of the " + std::to_string(joint_count) +
                            " of skins[" + std::to_string(skin) + "]");
          }
          joint = 0;
        }
      }
    }
  }
}

// `checked` is, for each mesh, the fewest joints that it was checked against: many nodes may share one mesh.
void AttachSkin(Context& context, Scene& scene, Node& node, std::vector<std::size_t>& checked, const Place& place) {
  if (node.skin < 0) return;
  bool skinned = false;
  if (node.mesh >= 0) {
    for (const Primitive& primitive : scene.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
      skinned = skinned || !primitive.joints.empty();
    }
  }
  const auto skin = static_cast<std::size_t>(node.skin);
  if (!skinned || scene.skins[skin].joints.empty()) {
    context.Warn(place, "ignored: a skin for what has no joints");
    node.skin = -1;
    return;
  }
  const Place meshes_place(context.place, "meshes");
  std::size_t& fewest = checked[static_cast<std::size_t>(node.mesh)];
  if (scene.skins[skin].joints.size() >= fewest) return;
  fewest = scene.skins[skin].joints.size();
  CheckJoints(scene.meshes[static_cast<std::size_t>(node.mesh)], scene.skins[skin].joints.size(), node.skin,
              Place(meshes_place, static_cast<std::size_t>(node.mesh)));
}

Node ReadNode(Context& context, AccessorReader& reader, Scene& scene, std::vector<std::size_t>& checked,
              std::size_t index, const Place& place) {
  const auto& from = context.document.core.nodes[index];
  const Json& object = context.Object("nodes", index);
  Node node;
  node.name = from.name;
  node.children = from.children;
  node.mesh = from.mesh;
  node.skin = from.skin;
  node.camera = from.camera;
  ReadTransform(context, from, node, place);
  for (const double weight : from.weights) node.weights.push_back(RoundToFiniteFloat(weight));
  if (!node.weights.empty()) {
    const std::size_t targets = node.mesh >= 0 ? TargetCount(scene.meshes[static_cast<std::size_t>(node.mesh)]) : 0;
    if (node.weights.size() != targets) {
      context.Warn(Place(place, "weights"), "has " + std::to_string(node.weights.size()) + " numbers for " +
                                                std::to_string(targets) + " morph targets");
      node.weights.resize(targets, 0.0f);
    }
  }
  const Place extensions_place(place, "extensions");
  if (const Json* light = ExtensionOf(object, "KHR_lights_punctual", place)) {
    node.light =
        RequireIndex(*light, "light", scene.lights.size(), "lights", Place(extensions_place, "KHR_lights_punctual"));
  }
  if (const Json* visibility = ExtensionOf(object, "KHR_node_visibility", place)) {
    node.visible = BoolAt(*visibility, "visible", Place(extensions_place, "KHR_node_visibility")).value_or(true);
  }
  node.instances = ReadInstances(context, reader, object, place);
  AttachSkin(context, scene, node, checked, place);
  return node;
}

// Every node has one parent at most, and none is its own ancestor.
std::vector<int> CheckForest(const Scene& scene, const Place& list_place) {
  std::vector<int> parents(scene.nodes.size(), -1);
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    for (const int child : scene.nodes[i].children) {
      int& parent = parents[static_cast<std::size_t>(child)];
      if (parent >= 0) {
        Fail(Place(list_place, static_cast<std::size_t>(child)),
             "is a child of both nodes[" + std::to_string(parent) + "] and nodes[" + std::to_string(i) + "]");
      }
      parent = static_cast<int>(i);
    }
  }
  // A walk upwards that meets itself is a cycle; one that meets an earlier walk is not.
  std::vector<std::size_t> met(scene.nodes.size(), 0);
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    for (int at = static_cast<int>(i); at >= 0; at = parents[static_cast<std::size_t>(at)]) {
      std::size_t& mark = met[static_cast<std::size_t>(at)];
      if (mark == i + 1) Fail(Place(list_place, static_cast<std::size_t>(at)), "is its own ancestor");
      if (mark != 0) break;
      mark = i + 1;
    }
  }
  return parents;
}

}  // namespace

void ReadNodes(Context& context, AccessorReader& reader, Scene& scene) {
  const auto& core = context.document.core;
  const Place list_place(context.place, "nodes");
  std::vector<std::size_t> checked(scene.meshes.size(), std::numeric_limits<std::size_t>::max());
  for (std::size_t i = 0; i < core.nodes.size(); ++i) {
    scene.nodes.push_back(ReadNode(context, reader, scene, checked, i, Place(list_place, i)));
  }
  const std::vector<int> parents = CheckForest(scene, list_place);

  std::vector<std::size_t> stands_in(scene.nodes.size(), 0);  // the last scene that named the node, counted from 1
  const Place scenes_place(context.place, "scenes");
  for (std::size_t i = 0; i < core.scenes.size(); ++i) {
    SceneRoots roots{core.scenes[i].name, {}};
    const Place scene_place(scenes_place, i);
    const Place nodes_place(scene_place, "nodes");
    for (std::size_t k = 0; k < core.scenes[i].nodes.size(); ++k) {
      const int node = core.scenes[i].nodes[k];
      const Place place(nodes_place, k);
      if (parents[static_cast<std::size_t>(node)] >= 0) Fail(place, "is not a root node");
      std::size_t& mark = stands_in[static_cast<std::size_t>(node)];
      if (mark == i + 1) {
        context.Warn(place, "ignored: the node stands in the scene already");
        continue;
      }
      mark = i + 1;
      roots.nodes.push_back(node);
    }
    scene.scenes.push_back(std::move(roots));
  }
  scene.default_scene = core.defaultScene;
}

}  // namespace facet::gltf
