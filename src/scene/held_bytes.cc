#include "scene/held_bytes.h"

#include <string>
#include <vector>

#include "facet/models.h"

namespace facet {
namespace {

template <class T>
std::uint64_t Array(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

template <class T>
std::uint64_t Arrays(const std::vector<std::vector<T>>& sets) {
  std::uint64_t bytes = Array(sets);
  for (const std::vector<T>& set : sets) bytes += Array(set);
  return bytes;
}

// Short ones lie within the struct that has them.
std::uint64_t Name(const std::string& name) { return name.size() < sizeof(std::string) ? 0 : name.size() + 1; }

}  // namespace

std::uint64_t HeldBytes(const Primitive& p) {
  std::uint64_t bytes = Array(p.positions) + Array(p.normals) + Array(p.tangents) + Arrays(p.tex_coords) +
                        Array(p.colors) + Arrays(p.joints) + Arrays(p.weights) + Array(p.indices) + Array(p.targets) +
                        Array(p.variant_materials);
  for (const MorphTarget& t : p.targets) {
    bytes += Array(t.positions) + Array(t.normals) + Array(t.tangents) + Arrays(t.tex_coords) + Array(t.colors);
  }
  return bytes;
}

std::uint64_t HeldBytes(const Scene& scene) {
  std::uint64_t bytes = Array(scene.images) + Array(scene.textures) + Array(scene.materials) + Array(scene.meshes) +
                        Array(scene.skins) + Array(scene.cameras) + Array(scene.lights) + Array(scene.nodes) +
                        Array(scene.animations) + Array(scene.scenes) + Array(scene.variants);
  for (const SceneImage& image : scene.images) {
    bytes += Name(image.name) + (image.source != nullptr ? image.source->BytesHeld() : 0);
  }
  for (const Texture& texture : scene.textures) bytes += Name(texture.name);
  for (const Material& material : scene.materials) {
    bytes += Name(material.name) + (material.parameters != nullptr ? sizeof(ModelParameters) : 0);
  }
  for (const Mesh& mesh : scene.meshes) {
    bytes += Name(mesh.name) + Array(mesh.primitives) + Array(mesh.weights);
    for (const Primitive& primitive : mesh.primitives) bytes += HeldBytes(primitive);
  }
  for (const Skin& skin : scene.skins) bytes += Name(skin.name) + Array(skin.joints) + Array(skin.inverse_bind);
  for (const Camera& camera : scene.cameras) bytes += Name(camera.name);
  for (const Light& light : scene.lights) bytes += Name(light.name);
  for (const Node& node : scene.nodes) {
    bytes += Name(node.name) + Array(node.children) + Array(node.weights) + Array(node.instances);
  }
  for (const Animation& animation : scene.animations) {
    bytes += Name(animation.name) + Array(animation.channels);
    for (const AnimationChannel& channel : animation.channels) bytes += Array(channel.times) + Array(channel.values);
  }
  for (const SceneRoots& roots : scene.scenes) bytes += Name(roots.name) + Array(roots.nodes);
  for (const std::string& variant : scene.variants) bytes += Name(variant);
  return bytes;
}

std::uint64_t HeldBytes(const PosedScene& posed) {
  std::uint64_t bytes =
      Array(posed.drawables) + Array(posed.lights) + Array(posed.cameras) + Array(posed.needs_tangents);
  for (const GeometryWithoutTangents& geometry : posed.needs_tangents) bytes += Array(geometry.drawables);
  for (const Primitive& copy : posed.owned) bytes += sizeof(Primitive) + HeldBytes(copy);
  return bytes;
}

}  // namespace facet
