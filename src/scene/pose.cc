#include "scene/pose.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "base/float_environment.h"
#include "base/memory_budget.h"
#include "base/parallel.h"
#include "facet/error.h"
#include "material/model_parameters.h"
#include "scene/bounds.h"
#include "scene/deform.h"
#include "scene/geometry.h"
#include "scene/held_bytes.h"
#include "scene/hierarchy.h"
#include "scene/tangents.h"
#include "scene/topology.h"

namespace facet {
namespace {

// One geometry of the posed scene: a primitive of the scene, or a copy that is deformed or has generated attributes.
struct Shape {
  const Primitive* primitive = nullptr;
  int mesh = -1, index = -1;  // of the primitive in its mesh
  bool morphed = false;
  const std::vector<float>* weights = nullptr;  // of the morph targets
  const JointMatrices* joints = nullptr;        // null: not skinned
  bool needs_tangents = false;
  TextureRef normal_map;
  bool IsDeformed() const { return morphed || joints != nullptr; }
  bool NeedsNormals() const { return needs_tangents && primitive->normals.empty(); }
  bool IsCopy() const { return IsDeformed() || NeedsNormals(); }  // flat normals need separate vertices
  std::string Where() const { return "mesh " + std::to_string(mesh) + ", primitive " + std::to_string(index); }
};

// What Pose() and PosedBounds() have in common: the geometries, and where each is drawn. Shapes point to the nodes'
// weights and to the joints, whose addresses do not change when the plan is moved.
struct Plan {
  std::vector<MemoryLease> memory;
  std::vector<Shape> shapes;
  std::vector<std::size_t> shape_of_drawable;
  std::vector<Drawable> drawables;  // without geometry
  std::deque<JointMatrices> joints;
  PosedNodes nodes;
  std::vector<int> visible;
};

void CheckSetting(int index, std::size_t count, const char* what) {
  if (index >= -1 && (index == -1 || std::size_t(index) < count)) return;
  throw Error(ErrorCode::InvalidUsage,
              std::string(what) + " " + std::to_string(index) + " is not one of " + std::to_string(count), "pose",
              "count from 0, or leave it out");
}

void CheckSettings(const Scene& scene, const PoseSettings& settings) {
  CheckSetting(settings.scene, scene.scenes.size(), "scene");
  CheckSetting(settings.animation, scene.animations.size(), "animation");
  CheckSetting(settings.variant, scene.variants.size(), "variant");
  if (std::isnan(settings.time)) throw Error(ErrorCode::InvalidUsage, "the time is not a number", "pose");
}

std::size_t CopiesOf(const Node& node) { return node.instances.empty() ? 1 : node.instances.size(); }

int MaterialOf(const Primitive& primitive, int variant) {
  if (variant >= 0 && std::size_t(variant) < primitive.variant_materials.size()) {
    const int material = primitive.variant_materials[std::size_t(variant)];
    if (material >= 0) return material;
  }
  return primitive.material;
}

// What shading reads of a material, without some features.
MaterialFeatures FeaturesWithout(const Material& material, const FeatureSet& without) {
  if (material.parameters != nullptr && without != FeatureSet()) {
    FeatureSet stated;
    Material left;
    left.model = material.model;
    left.parameters = std::make_shared<const ModelParameters>(WithoutFeatures(*material.parameters, without, stated));
    return FeaturesOf(left);
  }
  MaterialFeatures read = FeaturesOf(material);
  for (const SlotInfo& slot : SlotsOf(material.model)) {
    if (slot.tangent_space && without.Has(slot.feature)) read &= ~BitOf(slot.slot);
  }
  return without.Has(Feature::Anisotropy) ? read & ~kAnisotropy : read;
}

// The first texture that shading reads in tangent space, by the rule of the frame plan; null: none. First is the normal
// texture: models do not agree on the order of their rows, but on its slot. Anisotropy without a texture has the
// tangents of the first UV set.
const TextureRef* TangentSpaceTexture(const Scene& scene, const Material& material, const FeatureSet& without) {
  const MaterialFeatures read = FeaturesWithout(material, without);
  const SlotInfo* first = nullptr;
  for (const SlotInfo& slot : SlotsOf(material.model)) {
    if (!slot.tangent_space || (read & BitOf(slot.slot)) == 0 || (first != nullptr && first->slot < slot.slot))
      continue;
    if (scene.textures[std::size_t(TextureIn(material, slot).texture)].image >= 0) first = &slot;
  }
  if (first != nullptr) return &TextureIn(material, *first);
  static const TextureRef first_uv_set;
  return (read & (kAnisotropy | kTangents)) != 0 ? &first_uv_set : nullptr;
}

Shape MakeShape(const Scene& scene, const Primitive& primitive, int material, const PoseSettings& settings) {
  Shape shape;
  shape.primitive = &primitive;
  if (material >= 0 && ClassOf(primitive.topology) == PrimitiveClass::Triangles) {
    const Material& used = scene.materials[std::size_t(material)];
    const TextureRef* const texture = TangentSpaceTexture(scene, used, settings.without);
    shape.needs_tangents =
        texture != nullptr && (settings.generate_tangents || primitive.normals.empty() || primitive.tangents.empty());
    if (texture != nullptr) shape.normal_map = *texture;
  }
  return shape;
}

using SharedShapes = std::map<const Primitive*, std::size_t>;  // undeformed shapes, shared by all nodes with the mesh

// The index in plan.shapes of each primitive of the node's mesh (of no meaning for those without vertices).
std::vector<std::size_t> AddShapes(const Scene& scene, int node_index, const PoseSettings& settings,
                                   SharedShapes& shared, Plan& plan) {
  const Node& node = scene.nodes[std::size_t(node_index)];
  const Mesh& mesh = scene.meshes[std::size_t(node.mesh)];
  const JointMatrices* joints = nullptr;  // made when the first primitive uses them
  std::vector<std::size_t> shapes(mesh.primitives.size());
  for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
    const Primitive& primitive = mesh.primitives[p];
    if (primitive.positions.empty()) continue;
    Shape shape = MakeShape(scene, primitive, MaterialOf(primitive, settings.variant), settings);
    shape.mesh = node.mesh;
    shape.index = int(p);
    shape.weights = plan.nodes.weights[std::size_t(node_index)];
    shape.morphed = settings.morph_targets && IsMorphed(primitive, *shape.weights);
    if (settings.skins && node.skin >= 0 && !primitive.joints.empty()) {
      if (joints == nullptr) {
        plan.joints.push_back(PlaceJoints(scene.skins[std::size_t(node.skin)], plan.nodes.world_from_node,
                                          plan.nodes.world_from_node[std::size_t(node_index)]));
        joints = &plan.joints.back();
      }
      shape.joints = joints;
    }
    shapes[p] = plan.shapes.size();
    if (!shape.IsDeformed()) {
      const auto [place, is_new] = shared.emplace(&primitive, shapes[p]);
      shapes[p] = place->second;
      if (!is_new) continue;
    }
    plan.shapes.push_back(std::move(shape));
  }
  return shapes;
}

void AddDrawables(const Scene& scene, int node_index, int variant, const std::vector<std::size_t>& shapes,
                  Plan& plan) {
  const Node& node = scene.nodes[std::size_t(node_index)];
  const Mesh& mesh = scene.meshes[std::size_t(node.mesh)];
  const glm::dmat4& world_from_node = plan.nodes.world_from_node[std::size_t(node_index)];
  const std::size_t copies = CopiesOf(node);
  for (std::size_t copy = 0; copy < copies; ++copy) {
    const glm::dmat4 world_from_copy =
        node.instances.empty() ? world_from_node : world_from_node * ToMatrix(node.instances[copy]);
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
      if (mesh.primitives[p].positions.empty()) continue;
      const JointMatrices* skin = plan.shapes[shapes[p]].joints;
      // A skinned mesh is placed by its joints and not by its node, so the node's instances do not apply.
      if (skin != nullptr && copy > 0) continue;
      Drawable drawable;
      drawable.world_from_mesh = skin != nullptr ? skin->world_from_local : world_from_copy;
      drawable.material = MaterialOf(mesh.primitives[p], variant);
      drawable.node = node_index;
      drawable.mesh = node.mesh;
      drawable.primitive = int(p);
      plan.drawables.push_back(drawable);
      plan.shape_of_drawable.push_back(shapes[p]);
    }
  }
}

struct PlanSize {
  std::uint64_t drawables = 0, shapes = 0, joints = 0;  // at most
};

// Counts what is allocated below, since a small file may ask for any number: many nodes and instances may share a mesh
// of many primitives, and many nodes a skin of many joints.
PlanSize SizePlan(const Scene& scene, const PoseSettings& settings, const std::vector<int>& visible) {
  PlanSize size;
  std::vector<bool> has_targets(scene.meshes.size(), false);
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    const std::vector<Primitive>& primitives = scene.meshes[m].primitives;
    size.shapes += primitives.size();
    has_targets[m] = std::any_of(primitives.begin(), primitives.end(),
                                 [](const Primitive& primitive) { return !primitive.targets.empty(); });
  }
  for (const int index : visible) {
    const Node& node = scene.nodes[std::size_t(index)];
    if (node.mesh < 0) continue;
    const std::uint64_t primitives = scene.meshes[std::size_t(node.mesh)].primitives.size();
    const bool has_skin = settings.skins && node.skin >= 0;
    size.drawables += primitives * CopiesOf(node);
    if (has_skin || has_targets[std::size_t(node.mesh)]) size.shapes += primitives;
    if (has_skin) size.joints += scene.skins[std::size_t(node.skin)].joints.size();
  }
  return size;
}

Plan MakePlan(const Scene& scene, const PoseSettings& settings) {
  CheckSettings(scene, settings);
  ValidateScene(scene);
  Plan plan;
  plan.visible = NodesOf(scene, settings.scene, /*with_hidden=*/false);
  const PlanSize size = SizePlan(scene, settings, plan.visible);
  plan.memory.emplace_back(scene.nodes.size(), sizeof(glm::dmat4) + sizeof(Transform) + 64, "placed nodes");
  plan.memory.emplace_back(size.drawables, sizeof(Drawable) + 64, "drawables");
  plan.memory.emplace_back(size.shapes, sizeof(Shape) + sizeof(Bounds) + 96, "drawables");
  plan.memory.emplace_back(size.joints, sizeof(glm::dmat4), "joint matrices");
  plan.shapes.reserve(size.shapes);
  plan.drawables.reserve(size.drawables);
  plan.shape_of_drawable.reserve(size.drawables);
  const Animation* animation =
      settings.animation < 0 ? nullptr : &scene.animations[std::size_t(settings.animation)];
  plan.nodes = PlaceNodes(scene, settings.scene, animation, settings.time);
  SharedShapes shared;
  for (const int index : plan.visible) {
    if (scene.nodes[std::size_t(index)].mesh < 0) continue;
    const std::vector<std::size_t> shapes = AddShapes(scene, index, settings, shared, plan);
    AddDrawables(scene, index, settings.variant, shapes, plan);
  }
  return plan;
}

std::vector<std::vector<std::size_t>> DrawablesOfShapes(const Plan& plan) {
  std::vector<std::vector<std::size_t>> drawables(plan.shapes.size());
  for (std::size_t i = 0; i < plan.drawables.size(); ++i) drawables[plan.shape_of_drawable[i]].push_back(i);
  return drawables;
}

// The most memory that BuildCopy() takes, without that of tangents, which are charged separately.
std::uint64_t CopyBytes(const Shape& shape) {
  const Primitive& p = *shape.primitive;
  std::uint64_t per_vertex = sizeof(glm::vec3);
  if (!p.normals.empty() || shape.needs_tangents) per_vertex += sizeof(glm::vec3);
  if (!p.tangents.empty() || shape.needs_tangents) per_vertex += sizeof(glm::vec4);
  if (!p.colors.empty()) per_vertex += sizeof(glm::vec4);
  for (const auto& set : p.tex_coords) per_vertex += set.empty() ? 0 : sizeof(glm::vec2);
  if (shape.joints != nullptr && shape.needs_tangents) {
    per_vertex += p.joints.size() * (sizeof(glm::u16vec4) + sizeof(glm::vec4));
  }
  const std::uint64_t corners = 3 * std::uint64_t{PrimitiveCount(p)};
  const std::uint64_t vertices = shape.NeedsNormals() ? corners : p.positions.size();
  const std::uint64_t indices = shape.needs_tangents ? corners : p.indices.size();
  return vertices * per_vertex + indices * sizeof(std::uint32_t) + p.tex_coords.size() * sizeof(p.tex_coords[0]);
}

// The deformed copy of a shape's primitive, with normals and tangents if they are needed. Tangents are generated
// between morphing and skinning, because morphing moves the surface relative to its UVs, while skinning transforms
// tangents too.
Primitive BuildCopy(const Shape& shape) {
  Primitive copy = CopyWithoutDeformers(*shape.primitive);
  if (shape.morphed) ApplyMorph(*shape.primitive, *shape.weights, copy);
  if (shape.joints != nullptr && shape.needs_tangents) {
    copy.joints = shape.primitive->joints;  // because vertices will be split
    copy.weights = shape.primitive->weights;
  }
  if (shape.NeedsNormals()) MakeFlat(copy);
  if (shape.needs_tangents) MakeTangents(shape.normal_map, copy);
  if (shape.joints != nullptr) {
    ApplySkin(*shape.joints, shape.needs_tangents ? copy : *shape.primitive, shape.Where(), copy);
  }
  copy.joints.clear();
  copy.weights.clear();
  return copy;
}

// The box of a shape in mesh space. Of a deformed copy only the positions are built.
Bounds BoundsOfShape(const Shape& shape, std::vector<glm::vec3>& positions) {
  const MemoryLease lease(shape.primitive->positions.size(), sizeof(glm::vec3), kPosed);
  Primitive copy;
  copy.positions = shape.primitive->positions;
  if (shape.morphed) ApplyMorph(*shape.primitive, *shape.weights, copy);
  if (shape.joints != nullptr) ApplySkin(*shape.joints, *shape.primitive, shape.Where(), copy);
  positions = std::move(copy.positions);
  return BoundsOf(positions);
}

void PlaceLights(const Scene& scene, const Plan& plan, PosedScene& posed) {
  for (const int index : plan.visible) {
    const Node& node = scene.nodes[std::size_t(index)];
    if (node.light < 0) continue;
    const glm::dmat4& world_from_node = plan.nodes.world_from_node[std::size_t(index)];
    PosedLight light;
    light.light = &scene.lights[std::size_t(node.light)];
    light.position_world = glm::dvec3(world_from_node[3]);
    const glm::dvec3 backward(world_from_node[2]);
    const double length = std::sqrt(glm::dot(backward, backward));
    if (length > 0.0 && std::isfinite(length)) light.direction_world = -backward / length;
    posed.lights.push_back(light);
  }
}

void PlaceCameras(const Scene& scene, int scene_index, const Plan& plan, PosedScene& posed) {
  if (scene.cameras.empty()) return;
  for (const int index : NodesOf(scene, scene_index, /*with_hidden=*/true)) {
    const int camera = scene.nodes[std::size_t(index)].camera;
    if (camera >= 0) posed.cameras.push_back({camera, plan.nodes.world_from_node[std::size_t(index)]});
  }
}

// Calls visit(positions, their box, world_from_mesh) for everything that is drawn; positions are in mesh space.
template <class Visit>
void ForEachPlaced(const Scene& scene, const PoseSettings& settings, const Visit& visit) {
  const FloatEnvironment environment;
  const Plan plan = MakePlan(scene, settings);
  const std::vector<std::vector<std::size_t>> drawables_of_shape = DrawablesOfShapes(plan);
  std::vector<glm::vec3> positions;  // of one shape at a time
  for (std::size_t i = 0; i < plan.shapes.size(); ++i) {
    const Bounds local = BoundsOfShape(plan.shapes[i], positions);
    for (const std::size_t drawable : drawables_of_shape[i]) {
      visit(positions, local, plan.drawables[drawable].world_from_mesh);
    }
  }
}

}  // namespace

PosedScene PoseWithoutTangents(const Scene& scene, const PoseSettings& settings) {
  const FloatEnvironment environment;
  Plan plan = MakePlan(scene, settings);
  PosedScene posed;
  posed.settings = settings;
  std::vector<const Primitive*> geometries(plan.shapes.size());
  std::vector<std::pair<std::size_t, Primitive*>> copies;
  for (std::size_t i = 0; i < plan.shapes.size(); ++i) {
    geometries[i] = plan.shapes[i].primitive;
    posed.skinned |= plan.shapes[i].joints != nullptr;
    posed.morphed |= plan.shapes[i].morphed;
    if (!plan.shapes[i].IsCopy()) continue;
    geometries[i] = &posed.owned.emplace_back();
    copies.emplace_back(i, &posed.owned.back());
  }
  std::vector<MemoryLease> leases(copies.size());
  ParallelFor(copies.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Shape& shape = plan.shapes[copies[i].first];
      leases[i] = MemoryLease(CopyBytes(shape), 1, kPosed);
      Primitive& copy = *copies[i].second;
      copy = BuildCopy(shape);
      leases[i] = MemoryLease();
      leases[i] = MemoryLease(HeldBytes(copy), 1, kPosed);
    }
  });

  // Unless they are deformed, the file's vertices count, as in PosedBounds().
  const auto positions_of = [&](std::size_t i) -> const std::vector<glm::vec3>& {
    const Shape& shape = plan.shapes[i];
    return (shape.IsDeformed() ? geometries[i] : shape.primitive)->positions;
  };
  std::vector<Bounds> local(plan.shapes.size());
  ParallelFor(plan.shapes.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) local[i] = BoundsOf(positions_of(i));
  });
  const std::vector<std::vector<std::size_t>> drawables_of_shape = DrawablesOfShapes(plan);
  for (std::size_t i = 0; i < plan.shapes.size(); ++i) {
    for (const std::size_t drawable : drawables_of_shape[i]) {
      plan.drawables[drawable].geometry = geometries[i];
      plan.drawables[drawable].bounds_mesh = local[i];
      AddPlaced(positions_of(i), local[i], plan.drawables[drawable].world_from_mesh, posed.bounds);
    }
    if (plan.shapes[i].needs_tangents && !plan.shapes[i].IsCopy()) {
      posed.needs_tangents.push_back({drawables_of_shape[i], plan.shapes[i].normal_map});
    }
  }
  posed.drawables = std::move(plan.drawables);
  PlaceLights(scene, plan, posed);
  PlaceCameras(scene, settings.scene, plan, posed);
  return posed;
}

Primitive WithTangents(const Primitive& geometry, const TextureRef& normal_map) {
  Primitive copy = CopyWithoutDeformers(geometry);
  MakeTangents(normal_map, copy);
  return copy;
}

PosedScene Pose(const Scene& scene, const PoseSettings& settings) {
  const FloatEnvironment environment;
  PosedScene posed = PoseWithoutTangents(scene, settings);
  const std::vector<GeometryWithoutTangents> needs_tangents = std::exchange(posed.needs_tangents, {});
  const std::size_t first = posed.owned.size();
  posed.owned.resize(first + needs_tangents.size());
  ParallelFor(needs_tangents.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Primitive& with_tangents = posed.owned[first + i];
      with_tangents =
          WithTangents(*posed.drawables[needs_tangents[i].drawables[0]].geometry, needs_tangents[i].normal_map);
      for (const std::size_t drawable : needs_tangents[i].drawables)
        posed.drawables[drawable].geometry = &with_tangents;
    }
  });
  return posed;
}

Bounds PosedBounds(const Scene& scene, const PoseSettings& settings) {
  Bounds bounds;
  ForEachPlaced(scene, settings, [&](const auto& positions, const Bounds& local, const glm::dmat4& world_from_mesh) {
    AddPlaced(positions, local, world_from_mesh, bounds);
  });
  return bounds;
}

double PosedReach(const Scene& scene, const PoseSettings& settings, const glm::dvec3& point) {
  double reach = 0.0;
  ForEachPlaced(scene, settings, [&](const auto& positions, const Bounds& local, const glm::dmat4& world_from_mesh) {
    AddReach(positions, local, world_from_mesh, point, reach);
  });
  return reach;
}

}  // namespace facet
