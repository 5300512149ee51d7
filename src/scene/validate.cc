#include <cmath>
#include <string>

#include "facet/error.h"
#include "facet/scene.h"

namespace facet {
namespace {

[[noreturn]] void Fail(const std::string& where, const std::string& what) {
  throw Error(ErrorCode::InvalidInput, what, where);
}

std::string At(const char* list, std::size_t index) { return std::string(list) + " " + std::to_string(index); }

// `index` names one of `count` things, or none where that is allowed.
void CheckIndex(int index, std::size_t count, bool none_allowed, const std::string& where, const char* what) {
  if (index == -1 && none_allowed) return;
  if (index < 0 || std::size_t(index) >= count) {
    Fail(where, std::string(what) + " " + std::to_string(index) + " is not one of " + std::to_string(count));
  }
}

void CheckSize(std::size_t size, std::size_t expected, bool empty_allowed, const std::string& where, const char* what) {
  if (size == expected || (empty_allowed && size == 0)) return;
  Fail(where, std::string(what) + " has " + std::to_string(size) + " entries instead of " + std::to_string(expected));
}

void CheckTextureRef(const TextureRef& ref, const Scene& scene, const std::string& where, const char* what) {
  CheckIndex(ref.texture, scene.textures.size(), true, where, what);
  if (ref.tex_coord < 0) Fail(where, std::string(what) + " uses UV set " + std::to_string(ref.tex_coord));
}

void CheckMaterial(const Material& material, const Scene& scene, const std::string& where) {
  CheckTextureRef(material.base_color_texture, scene, where, "base colour texture");
  CheckTextureRef(material.metallic_roughness_texture, scene, where, "metallic-roughness texture");
  CheckTextureRef(material.normal_texture, scene, where, "normal texture");
  CheckTextureRef(material.occlusion_texture, scene, where, "occlusion texture");
  CheckTextureRef(material.emissive_texture, scene, where, "emissive texture");
}

void CheckTarget(const MorphTarget& target, std::size_t count, const std::string& where) {
  CheckSize(target.positions.size(), count, true, where, "positions");
  CheckSize(target.normals.size(), count, true, where, "normals");
  CheckSize(target.tangents.size(), count, true, where, "tangents");
  for (const auto& set : target.tex_coords) CheckSize(set.size(), count, true, where, "a UV set");
  CheckSize(target.colors.size(), count, true, where, "colours");
}

void CheckPrimitive(const Primitive& primitive, const Scene& scene, const std::string& where) {
  const std::size_t count = primitive.positions.size();
  CheckSize(primitive.normals.size(), count, true, where, "normals");
  CheckSize(primitive.tangents.size(), count, true, where, "tangents");
  for (const auto& set : primitive.tex_coords) CheckSize(set.size(), count, true, where, "a UV set");
  CheckSize(primitive.colors.size(), count, true, where, "colours");
  CheckSize(primitive.weights.size(), primitive.joints.size(), false, where, "the list of weight sets");
  for (const auto& set : primitive.joints) CheckSize(set.size(), count, false, where, "a set of joints");
  for (const auto& set : primitive.weights) CheckSize(set.size(), count, false, where, "a set of weights");
  std::uint32_t largest = 0;  // one pass without branches: there are millions
  for (const std::uint32_t index : primitive.indices) largest = index > largest ? index : largest;
  if (!primitive.indices.empty() && largest >= count) {
    Fail(where, "index " + std::to_string(largest) + " is not one of " + std::to_string(count) + " vertices");
  }
  for (std::size_t i = 0; i < primitive.targets.size(); ++i) {
    CheckTarget(primitive.targets[i], count, where + ", " + At("target", i));
  }
  CheckIndex(primitive.material, scene.materials.size(), true, where, "material");
  CheckSize(primitive.variant_materials.size(), scene.variants.size(), true, where, "the variants' materials");
  for (const int material : primitive.variant_materials) {
    CheckIndex(material, scene.materials.size(), true, where, "variant material");
  }
}

void CheckCamera(const Camera& camera, const std::string& where) {
  if (camera.orthographic) {
    const bool fine = std::isfinite(camera.xmag) && std::isfinite(camera.ymag) && camera.xmag != 0 && camera.ymag != 0;
    if (!fine) Fail(where, "xmag and ymag must be finite and not zero");
    if (!(camera.znear >= 0)) Fail(where, "znear must not be negative");
  } else {
    if (!(camera.yfov > 0 && camera.yfov < 3.14159265358979)) Fail(where, "yfov must lie between 0 and pi");
    if (camera.aspect && !(*camera.aspect > 0 && std::isfinite(*camera.aspect))) {
      Fail(where, "the aspect ratio must be positive");
    }
    if (!(camera.znear > 0)) Fail(where, "znear must be positive");
  }
  if (!(camera.zfar > camera.znear)) Fail(where, "zfar must be larger than znear");
}

void CheckNodes(const Scene& scene) {
  const std::size_t count = scene.nodes.size();
  std::vector<int> parents(count, -1);
  for (std::size_t i = 0; i < count; ++i) {
    const Node& node = scene.nodes[i];
    const std::string where = At("node", i);
    CheckIndex(node.mesh, scene.meshes.size(), true, where, "mesh");
    CheckIndex(node.skin, scene.skins.size(), true, where, "skin");
    CheckIndex(node.camera, scene.cameras.size(), true, where, "camera");
    CheckIndex(node.light, scene.lights.size(), true, where, "light");
    for (const int child : node.children) {
      CheckIndex(child, count, false, where, "child");
      if (parents[std::size_t(child)] >= 0) {
        Fail(where, "node " + std::to_string(child) + " is already a child of node " +
                        std::to_string(parents[std::size_t(child)]));
      }
      parents[std::size_t(child)] = int(i);
    }
  }
  // With one parent at most, whatever a walk from the roots does not reach lies on a cycle or hangs from one.
  std::vector<int> open;
  std::vector<bool> reached(count, false);
  for (std::size_t i = 0; i < count; ++i) {
    if (parents[i] < 0) open.push_back(int(i));
  }
  while (!open.empty()) {
    const std::size_t node = std::size_t(open.back());
    open.pop_back();
    reached[node] = true;
    for (const int child : scene.nodes[node].children) open.push_back(child);
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!reached[i]) Fail(At("node", i), "the node is its own ancestor, or descends from one that is");
  }
}

void CheckChannel(const AnimationChannel& channel, const Scene& scene, const std::string& where) {
  CheckIndex(channel.node, scene.nodes.size(), true, where, "node");
  for (std::size_t i = 0; i < channel.times.size(); ++i) {
    if (!std::isfinite(channel.times[i])) Fail(where, At("time", i) + " is not finite");
    if (i > 0 && !(channel.times[i] >= channel.times[i - 1])) Fail(where, At("time", i) + " decreases");
  }
  const std::size_t keys = channel.times.size() * (channel.interpolation == Interpolation::CubicSpline ? 3 : 1);
  if (channel.path == AnimationPath::Weights) {
    const bool fits = keys == 0 ? channel.values.empty() : channel.values.size() % keys == 0;
    if (!fits) Fail(where, std::to_string(channel.values.size()) + " weights do not divide by the number of keys");
  } else {
    CheckSize(channel.values.size(), keys * (channel.path == AnimationPath::Rotation ? 4 : 3), false, where, "values");
  }
}

}  // namespace

void ValidateScene(const Scene& scene) {
  for (std::size_t i = 0; i < scene.images.size(); ++i) {
    if (scene.images[i].source == nullptr) Fail(At("image", i), "it has no source");
  }
  for (std::size_t i = 0; i < scene.textures.size(); ++i) {
    CheckIndex(scene.textures[i].image, scene.images.size(), true, At("texture", i), "image");
  }
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    CheckMaterial(scene.materials[i], scene, At("material", i));
  }
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    for (std::size_t j = 0; j < scene.meshes[i].primitives.size(); ++j) {
      CheckPrimitive(scene.meshes[i].primitives[j], scene, At("mesh", i) + ", " + At("primitive", j));
    }
  }
  for (std::size_t i = 0; i < scene.skins.size(); ++i) {
    for (const int joint : scene.skins[i].joints) {
      CheckIndex(joint, scene.nodes.size(), false, At("skin", i), "joint");
    }
    CheckSize(scene.skins[i].inverse_bind.size(), scene.skins[i].joints.size(), true, At("skin", i),
              "the list of inverse bind matrices");
  }
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) CheckCamera(scene.cameras[i], At("camera", i));
  CheckNodes(scene);
  for (std::size_t i = 0; i < scene.animations.size(); ++i) {
    for (std::size_t j = 0; j < scene.animations[i].channels.size(); ++j) {
      CheckChannel(scene.animations[i].channels[j], scene, At("animation", i) + ", " + At("channel", j));
    }
  }
  for (std::size_t i = 0; i < scene.scenes.size(); ++i) {
    for (const int node : scene.scenes[i].nodes) {
      CheckIndex(node, scene.nodes.size(), false, At("scene", i), "node");
    }
  }
  CheckIndex(scene.default_scene, scene.scenes.size(), true, "the scene", "default scene");
}

}  // namespace facet
