// Small scenes made by hand.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <memory>

#include "facet/error.h"
#include "facet/scene.h"
#include "scene/pose.h"

namespace facet {

constexpr double kTestPi = 3.14159265358979323846;

inline Primitive Triangle() {
  Primitive primitive;
  primitive.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  return primitive;
}

class NoSource : public ImageSource {
 public:
  Image Decode() const override { throw Error(ErrorCode::NotFound, "posing decodes nothing"); }
  std::string Name() const override { return "normal map"; }
};

// Makes the one material of `scene`, with a normal map.
inline void AddNormalMap(Scene& scene) {
  scene.images.push_back({"normal map", std::make_shared<NoSource>()});
  scene.textures.resize(1);
  scene.textures[0].image = 0;
  scene.materials.resize(1);
  scene.materials[0].normal_texture.texture = 0;
}

// One mesh of one primitive, held by one node.
inline Scene SceneOf(Primitive primitive) {
  Scene scene;
  scene.meshes.emplace_back();
  scene.meshes[0].primitives.push_back(std::move(primitive));
  scene.nodes.emplace_back();
  scene.nodes[0].mesh = 0;
  return scene;
}

inline glm::dquat RotationAbout(const glm::dvec3& unit_axis, double radians) {
  return glm::dquat(std::cos(radians / 2), std::sin(radians / 2) * unit_axis);
}

inline glm::dvec3 WorldPosition(const Drawable& drawable, std::size_t vertex) {
  return glm::dvec3(drawable.world_from_mesh * glm::dvec4(glm::dvec3(drawable.geometry->positions[vertex]), 1.0));
}

inline double Distance(const glm::dvec3& a, const glm::dvec3& b) { return glm::length(a - b); }

}  // namespace facet
