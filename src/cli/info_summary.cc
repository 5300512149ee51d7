#include "cli/info_summary.h"

#include <algorithm>
#include <set>
#include <utility>

#include "material/model_parameters.h"
#include "material/models/models.h"
#include "scene/camera.h"
#include "scene/pose.h"

namespace facet::cli {
namespace {

Geometry Count(const Primitive& primitive) {
  const std::uint64_t n = primitive.indices.empty() ? primitive.positions.size() : primitive.indices.size();
  Geometry count;
  count.primitives = 1;
  count.vertices = primitive.positions.size();
  switch (primitive.topology) {
    case Topology::Points: count.points = n; break;
    case Topology::Lines: count.lines = n / 2; break;
    case Topology::LineLoop: count.lines = n >= 2 ? n : 0; break;
    case Topology::LineStrip: count.lines = n >= 2 ? n - 1 : 0; break;
    case Topology::Triangles: count.triangles = n / 3; break;
    case Topology::TriangleStrip:
    case Topology::TriangleFan: count.triangles = n >= 3 ? n - 2 : 0; break;
  }
  return count;
}

MeshSummary SummarizeMesh(const Mesh& mesh) {
  MeshSummary summary;
  summary.name = mesh.name;
  for (const Primitive& primitive : mesh.primitives) {
    summary.geometry += Count(primitive);
    summary.morph_targets = std::max(summary.morph_targets, primitive.targets.size());
    summary.normals |= !primitive.normals.empty();
    summary.tangents |= !primitive.tangents.empty();
    summary.colors |= !primitive.colors.empty();
    summary.tex_coord_sets = std::max(summary.tex_coord_sets, primitive.tex_coords.size());
    summary.influences = std::max(summary.influences, primitive.joints.size() * 4);
  }
  return summary;
}

MaterialSummary SummarizeMaterial(const Material& material) {
  MaterialSummary summary;
  summary.material = &material;
  for (const SlotInfo& slot : SlotsOf(material.model)) {
    const TextureRef& ref = TextureIn(material, slot);
    if (!ref) continue;
    const bool transformed = ref.offset != glm::vec2(0.0f) || ref.scale != glm::vec2(1.0f) || ref.rotation != 0.0f;
    summary.textures.push_back({slot.key, ref, transformed});
  }
  for (const FactorFeature& factor : kFactorFeatures) {
    const bool is_layer = (kLayerFeatures & factor.bit) != 0, reads = (InfoOf(material.model).reads & factor.bit) != 0;
    if (is_layer && !reads && factor.is_stated(material)) summary.ignored.emplace_back(factor.name);
  }
  return summary;
}

AnimationSummary SummarizeAnimation(const Animation& animation) {
  AnimationSummary summary;
  summary.name = animation.name;
  summary.channels = animation.channels.size();
  for (const AnimationChannel& channel : animation.channels) {
    if (!channel.times.empty()) {
      summary.duration_seconds = std::max(summary.duration_seconds, static_cast<double>(channel.times.back()));
    }
    switch (channel.path) {
      case AnimationPath::Translation: ++summary.translations; break;
      case AnimationPath::Rotation: ++summary.rotations; break;
      case AnimationPath::Scale: ++summary.scales; break;
      case AnimationPath::Weights: ++summary.weights; break;
    }
  }
  return summary;
}

SceneSummary SummarizeScene(const Scene& scene, int index, const std::vector<MeshSummary>& meshes) {
  SceneSummary summary;
  const SceneRoots& roots = scene.scenes[static_cast<std::size_t>(index)];
  summary.name = roots.name;
  std::vector<int> pending = roots.nodes;  // no recursion, as the hierarchy may be very deep; it is a forest
  while (!pending.empty()) {
    const Node& node = scene.nodes[static_cast<std::size_t>(pending.back())];
    pending.pop_back();
    if (!node.visible) continue;
    ++summary.nodes;
    if (node.mesh >= 0) {
      const std::size_t copies = std::max<std::size_t>(1, node.instances.size());
      for (std::size_t i = 0; i < copies; ++i) summary.drawn += meshes[static_cast<std::size_t>(node.mesh)].geometry;
    }
    pending.insert(pending.end(), node.children.begin(), node.children.end());
  }
  PoseSettings pose;
  pose.scene = index;
  const Bounds bounds = PosedBounds(scene, pose);
  summary.empty = bounds.empty;
  summary.low = bounds.low;
  summary.high = bounds.high;
  return summary;
}

}  // namespace

Geometry& Geometry::operator+=(const Geometry& other) {
  primitives += other.primitives;
  vertices += other.vertices;
  triangles += other.triangles;
  lines += other.lines;
  points += other.points;
  return *this;
}

FileSummary Summarize(const LoadedScene& file, std::string input) {
  const Scene& scene = file.scene;
  FileSummary summary;
  summary.file = &file;
  summary.input = std::move(input);
  for (const Mesh& mesh : scene.meshes) {
    summary.meshes.push_back(SummarizeMesh(mesh));
    summary.geometry += summary.meshes.back().geometry;
  }
  for (const Material& material : scene.materials) summary.materials.push_back(SummarizeMaterial(material));
  for (const Mesh& mesh : scene.meshes) {
    for (const Primitive& primitive : mesh.primitives) {
      std::set<int> used(primitive.variant_materials.begin(), primitive.variant_materials.end());
      used.insert(primitive.material);
      for (const int material : used) {
        if (material >= 0) ++summary.materials[static_cast<std::size_t>(material)].primitives;
      }
    }
  }
  for (const SceneImage& image : scene.images) {
    summary.images.push_back({image.name, image.source->Name(), 0, image.source->Header()});
  }
  for (const Texture& texture : scene.textures) {
    if (texture.image >= 0) ++summary.images[static_cast<std::size_t>(texture.image)].textures;
  }
  for (const Animation& animation : scene.animations) summary.animations.push_back(SummarizeAnimation(animation));
  for (int i = 0; i < static_cast<int>(scene.scenes.size()); ++i) {
    summary.scenes.push_back(SummarizeScene(scene, i, summary.meshes));
  }
  const ResolvedCamera camera = ResolveCamera(AutoCamera(), scene, PoseWithoutTangents(scene, PoseSettings()), 1, 1);
  summary.camera = {camera.world_from_camera, camera.lens};
  summary.camera_target_distance = camera.target_distance;
  return summary;
}

const char* NameOf(LightType type) {
  switch (type) {
    case LightType::Directional: return "directional";
    case LightType::Point: return "point";
    case LightType::Spot: return "spot";
  }
  return "";
}

const char* NameOf(AlphaMode mode) {
  switch (mode) {
    case AlphaMode::Opaque: return "OPAQUE";
    case AlphaMode::Mask: return "MASK";
    case AlphaMode::Blend: return "BLEND";
  }
  return "";
}

}  // namespace facet::cli
