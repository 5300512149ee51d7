#include "gltf/nodes.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <optional>
#include <utility>

#include "base/memory_budget.h"

namespace facet::gltf {
namespace {

glm::dquat ToUnit(const double* xyzw, const Place& place) {
  const double squared = xyzw[0] * xyzw[0] + xyzw[1] * xyzw[1] + xyzw[2] * xyzw[2] + xyzw[3] * xyzw[3];
  if (!(squared > 0.0) || !std::isfinite(squared)) {
    place.Warn("is no rotation; none is used");
    return {1.0, 0.0, 0.0, 0.0};
  }
  constexpr double kTolerance = 0.01;  // quantised rotations are unit up to quantisation
  if (std::fabs(squared - 1.0) > kTolerance) place.Warn("is not unit; it was normalised");
  const double length = std::sqrt(squared);
  return {xyzw[3] / length, xyzw[0] / length, xyzw[1] / length, xyzw[2] / length};
}

void ReadTransform(const Json& object, Node& node, const Place& place) {
  const std::vector<double> matrix = NumbersAt(object, "matrix", 16, place);
  if (!matrix.empty()) {
    node.matrix = glm::make_mat4(matrix.data());
    const glm::dmat4& m = *node.matrix;
    if (m[0][3] != 0.0 || m[1][3] != 0.0 || m[2][3] != 0.0 || m[3][3] != 1.0) {
      Place(place, "matrix").Warn("is not affine; its last row was replaced by 0, 0, 0, 1");
      for (int c = 0; c < 4; ++c) (*node.matrix)[c][3] = c == 3 ? 1.0 : 0.0;
    }
    return;
  }
  const std::vector<double> translation = NumbersAt(object, "translation", 3, place);
  const std::vector<double> rotation = NumbersAt(object, "rotation", 4, place);
  const std::vector<double> scale = NumbersAt(object, "scale", 3, place);
  if (!translation.empty()) node.transform.translation = glm::make_vec3(translation.data());
  if (!scale.empty()) node.transform.scale = glm::make_vec3(scale.data());
  if (!rotation.empty()) node.transform.rotation = ToUnit(rotation.data(), Place(place, "rotation"));
}

// EXT_mesh_gpu_instancing.
void ReadInstances(Context& context, AccessorReader& reader, const Json& object, Node& node, const Place& place) {
  constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";
  const Json* extension = ExtensionOf(object, kInstancing, place);
  if (!extension) return;
  const Place extensions_place(place, "extensions");
  const Place instancing_place(extensions_place, kInstancing);
  const Json* attributes = ObjectAt(*extension, "attributes", instancing_place);
  if (!attributes) return;
  const Place attributes_place(instancing_place, "attributes");
  std::vector<Transform> instances;
  bool is_empty = false;
  const auto read = [&](const char* semantic, int components, const auto& store) {
    const int accessor =
        IndexAt(*attributes, semantic, context.document.Count("accessors"), "accessors", attributes_place);
    if (accessor < 0) return;
    const Place attribute_place(attributes_place, semantic);
    const AccessorView& view = reader.View(accessor);
    if (view.is_matrix || view.components != components) {
      Fail(attribute_place, "does not have " + std::to_string(components) + " components");
    }
    is_empty = is_empty || view.count == 0;
    if (instances.empty()) {
      context.Charge(view.count, sizeof(Transform), attribute_place);
      instances.resize(view.count);
    }
    if (view.count != instances.size()) Fail(attribute_place, "does not have as many elements as the others");
    const MemoryLease lease(view.count, static_cast<std::size_t>(components) * sizeof(float), "reading instances");
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
    t.rotation = ToUnit(xyzw, where);
  });
  if (is_empty) {
    instancing_place.Warn("has no instances; the mesh is not drawn");
    node.mesh = -1;
  }
  node.instances = std::move(instances);
}

constexpr std::size_t kNoSkin = std::numeric_limits<std::size_t>::max();

// The joints that the primitives of a skinned mesh use.
struct SkinnedMesh {
  bool has_joints = false;
  int largest = -1;              // joint that has a weight
  std::size_t largest_in = 0;    // a primitive that uses it
  std::size_t fewest = kNoSkin;  // joints of the skins
};

template <class Visit>
void ForEachJoint(Primitive& primitive, const Visit& visit) {
  for (std::size_t set = 0; set < primitive.joints.size(); ++set) {
    for (std::size_t v = 0; v < primitive.joints[set].size(); ++v) {
      for (int c = 0; c < 4; ++c) visit(primitive.joints[set][v][c], primitive.weights[set][v][c]);
    }
  }
}

SkinnedMesh Survey(Mesh& mesh) {
  SkinnedMesh survey;
  for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
    survey.has_joints = survey.has_joints || !mesh.primitives[p].joints.empty();
    const int before = survey.largest;
    ForEachJoint(mesh.primitives[p], [&](std::uint16_t joint, float weight) {
      if (weight > 0.0f && joint > survey.largest) survey.largest = joint;
    });
    if (survey.largest > before) survey.largest_in = p;
  }
  return survey;
}

// Replaces joints that the skin does not have and no vertex uses by the first joint. Warns of vertices without joints.
void ClearUnusedJoints(const SkinnedMesh& survey, const std::vector<std::size_t>& primitives_read,
                       const Place& primitives_place, Mesh& mesh) {
  for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
    Primitive& primitive = mesh.primitives[p];
    ForEachJoint(primitive, [&](std::uint16_t& joint, float) { joint = joint < survey.fewest ? joint : 0; });
    std::size_t loose = 0;
    for (std::size_t v = 0; v < primitive.positions.size() && !primitive.joints.empty(); ++v) {
      loose += std::all_of(primitive.weights.begin(), primitive.weights.end(),
                           [v](const std::vector<glm::vec4>& set) { return set[v] == glm::vec4(0.0f); });
    }
    if (loose == 0) continue;
    Place(primitives_place, primitives_read[p])
        .Warn(std::to_string(loose) + " vertices without weights follow the joint of their first slot");
  }
}

class NodeReader {
 public:
  NodeReader(Context& context, AccessorReader& reader, const std::vector<bool>& usable_cameras, Scene& scene)
      : context_(context),
        reader_(reader),
        usable_cameras_(usable_cameras),
        scene_(scene),
        skinned_(scene.meshes.size()) {}

  // Parts are read separately: if one is broken and the node is invisible, the others are kept.
  void Read(std::size_t index, bool shown, const Place& place) {
    const Json& object = context_.Object("nodes", index);
    Node& node = scene_.nodes[index];
    const auto part = [&](bool needed, const char* what, const auto& read) { context_.Try(needed, place, what, read); };
    part(shown, "its transform is ignored", [&] { ReadTransform(object, node, place); });
    part(shown, "its mesh is ignored",
         [&] { node.mesh = IndexAt(object, "mesh", scene_.meshes.size(), "meshes", place); });
    const bool draws = shown && node.mesh >= 0;
    node.skin = draws ? IndexAt(object, "skin", scene_.skins.size(), "skins", place)
                      : LenientIndex(object, "skin", scene_.skins.size(), "skins", place);
    part(draws, "its skin is ignored", [&] { AttachSkin(node, Place(place, "skin")); });
    part(draws, "its instances are ignored", [&] { ReadInstances(context_, reader_, object, node, place); });
    node.camera = LenientIndex(object, "camera", scene_.cameras.size(), "cameras", place);
    if (node.camera >= 0 && !usable_cameras_[static_cast<std::size_t>(node.camera)]) node.camera = -1;
    ReadLight(object, node, place);
    ReadWeights(object, node, place);
  }

  void ClearUnusedJoints() {
    const Place meshes_place(context_.place, "meshes");
    for (std::size_t m = 0; m < skinned_.size(); ++m) {
      if (!skinned_[m] || skinned_[m]->fewest == kNoSkin) continue;
      const Place mesh_place(meshes_place, m);
      gltf::ClearUnusedJoints(*skinned_[m], context_.primitives_read[m], Place(mesh_place, "primitives"),
                              scene_.meshes[m]);
    }
  }

 private:
  // A joint with a weight that the skin does not have is an error.
  void AttachSkin(Node& node, const Place& place) {
    if (node.skin < 0) return;
    const int skin = std::exchange(node.skin, -1);
    const std::size_t joint_count = scene_.skins[static_cast<std::size_t>(skin)].joints.size();
    SkinnedMesh* mesh = nullptr;
    if (node.mesh >= 0) {
      const auto m = static_cast<std::size_t>(node.mesh);
      if (!skinned_[m]) skinned_[m] = Survey(scene_.meshes[m]);
      mesh = &*skinned_[m];
    }
    if (mesh == nullptr || !mesh->has_joints || joint_count == 0) {
      place.Warn("ignored: a skin for what has no joints");
      return;
    }
    if (mesh->largest >= 0 && static_cast<std::size_t>(mesh->largest) >= joint_count) {
      const auto m = static_cast<std::size_t>(node.mesh);
      const Place meshes_place(context_.place, "meshes");
      const Place mesh_place(meshes_place, m), primitives_place(mesh_place, "primitives");
      Fail(Place(primitives_place, context_.primitives_read[m][mesh->largest_in]),
           "joint " + std::to_string(mesh->largest) + " is not one of the " + std::to_string(joint_count) +
               " of skins[" + std::to_string(skin) + "]");
    }
    mesh->fewest = std::min(mesh->fewest, joint_count);
    node.skin = skin;
  }

  void ReadLight(const Json& object, Node& node, const Place& place) const {
    constexpr const char* kLights = "KHR_lights_punctual";
    const Json* extension = ExtensionOf(object, kLights, place);
    if (!extension) return;
    const Place extensions_place(place, "extensions");
    const Place light_place(extensions_place, kLights);
    if (!Find(*extension, "light")) light_place.Warn("\"light\" is missing");
    node.light = LenientIndex(*extension, "light", scene_.lights.size(), "lights", light_place);
  }

  void ReadWeights(const Json& object, Node& node, const Place& place) const {
    node.weights = LenientFloats(object, "weights", place);
    if (node.weights.empty()) return;
    const std::size_t targets = node.mesh >= 0 ? scene_.meshes[static_cast<std::size_t>(node.mesh)].weights.size() : 0;
    if (node.weights.size() == targets) return;
    Place(place, "weights")
        .Warn("has " + std::to_string(node.weights.size()) + " numbers for " + std::to_string(targets) +
              " morph targets");
    if (node.weights.size() > targets) node.weights.resize(targets);  // missing ones count as zero
  }

  Context& context_;
  AccessorReader& reader_;
  const std::vector<bool>& usable_cameras_;
  Scene& scene_;
  std::vector<std::optional<SkinnedMesh>> skinned_;  // by mesh
};

// By node: whether it or a descendant has a mesh, a camera or a light. The transforms of other nodes do not matter.
std::vector<bool> CarryThings(const Context& context, const Scene& scene) {
  std::vector<int> parents(scene.nodes.size(), -1);
  for (std::size_t i = 0; i < parents.size(); ++i) {
    for (const int child : scene.nodes[i].children) parents[std::size_t(child)] = int(i);
  }
  std::vector<bool> carry(parents.size(), false);
  for (std::size_t i = 0; i < parents.size(); ++i) {
    const Json& object = context.Object("nodes", i);
    const bool has_things = Find(object, "mesh") != nullptr || Find(object, "camera") != nullptr ||
                            Find(object, "extensions") != nullptr;  // lights
    for (int at = has_things ? int(i) : -1; at >= 0 && !carry[std::size_t(at)]; at = parents[std::size_t(at)]) {
      carry[std::size_t(at)] = true;
    }
  }
  for (const Skin& skin : scene.skins) {
    for (int at : skin.joints) {
      for (; at >= 0 && !carry[std::size_t(at)]; at = parents[std::size_t(at)]) carry[std::size_t(at)] = true;
    }
  }
  return carry;
}

}  // namespace

void ReadNodes(Context& context, AccessorReader& reader, const Shown& shown, const std::vector<bool>& usable_cameras,
               Scene& scene) {
  const Place list_place(context.place, "nodes");
  NodeReader nodes(context, reader, usable_cameras, scene);
  const std::vector<bool> carry = CarryThings(context, scene);
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) nodes.Read(i, shown.nodes[i] && carry[i], Place(list_place, i));
  nodes.ClearUnusedJoints();
}

}  // namespace facet::gltf
