// Node matrices that are singular or mirror, quaternions that are not unit, skins without weights.
#include <algorithm>
#include <cmath>
#include <limits>

#include "render/hand_built.h"
#include "stability/stability_case.h"

namespace facet::stability {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kWidth = 48, kHeight = 40;

void AddSun(Scene& scene, const glm::dquat& rotation) {
  Light sun;
  sun.type = LightType::Directional;
  sun.intensity = 2.0f;
  scene.lights.push_back(sun);
  Node node;
  node.light = int(scene.lights.size()) - 1;
  node.transform.rotation = rotation;
  scene.nodes.push_back(node);
}

const glm::dquat kSunRotation = glm::normalize(glm::dquat(0.9, -0.3, 0.25, 0.05));

// Glossy spheres with a texture and a normal map, under one placement.
Scene MakeScene(const Transform& place) {
  Scene scene;
  Uniform random(21);
  const auto noise = [&random](int low) {
    return MakeImage(8, 8, [&](int, int) {
      return glm::u8vec4(low + random() * (256 - low), low + random() * (256 - low), 255 - random() * 60, 255);
    });
  };
  Material material;
  material.base_color_texture = Ref(AddTexture(scene, noise(0)));
  material.normal_texture = Ref(AddTexture(scene, noise(90)));
  material.roughness_factor = 0.3f;
  material.metallic_factor = 0.5f;
  Add(scene, Sphere(0.8f, 14, 22), AddMaterial(scene, material), place);
  AddSun(scene, kSunRotation);
  return scene;
}

RenderSettings SceneSettings(int samples = 4) {
  return Settings(kWidth, kHeight, samples, Perspective(0.8, {0, 0, 3}));
}

Film DrawAt(const Transform& place, Measured& m) { return Draw(MakeScene(place), SceneSettings(), m); }

// Scales of which one, two or all axes vanish: what is left is a surface, a line or a point, and finite. Those that
// leave no number of a float are not seen; those that are no numbers are refused.
Measured MeasureSingular() {
  Measured m;
  for (const glm::dvec3& scale :
       {glm::dvec3(1, 1, 0), glm::dvec3(0, 1, 1), glm::dvec3(1, 0, 0), glm::dvec3(0), glm::dvec3(1, 1, 1e-300),
        glm::dvec3(1e-200), glm::dvec3(1e200, 1, 1), glm::dvec3(1, 1e300, 1), glm::dvec3(1e308)}) {
    Transform place;
    place.scale = scale;
    RenderStats stats;
    Draw(MakeScene(place), SceneSettings(), m, &stats);
    const bool flat = scale == glm::dvec3(1, 1, 0) || scale == glm::dvec3(1, 1, 1e-300);
    m.Expect(!flat || stats.covered_pixels > 300, "a sphere pressed flat is not seen");
    m.Expect(glm::length(scale) < 1e100 || stats.covered_pixels == 0, "what has no place is seen");
  }
  for (const glm::dvec3& scale : {glm::dvec3(1, kInfinity, 1), glm::dvec3(kNan)}) {
    Transform place;
    place.scale = scale;
    ExpectRefused(MakeScene(place), SceneSettings(), "node 0: the scale", m);
  }
  m.Error(double(m.sanitised));
  return m;
}

// A mirrored scene shows the mirrored image. Bound: coordinates x and width - x round apart by half an ULP each,
// which moves a colour by some 1e-6 of itself, and the weights of texels are rounded on another side, by 1/16384; a
// highlight of alpha 0.09 enlarges this by 2 / alpha.
Measured MeasureMirrored() {
  Measured m;
  Transform place;
  place.rotation = glm::normalize(glm::dquat(0.7, 0.3, -0.5, 0.2));
  place.translation = {0.1, 0.05, 0.0};
  // One sample a pixel: the patterns of more are not symmetric.
  const Film film = Draw(MakeScene(place), SceneSettings(1), m);
  // The mirror x -> -x of everything: the root's matrix mirrors all nodes, the light's direction too.
  Scene scene = MakeScene(place);
  Node root;
  root.children = {0, 1};
  root.matrix = glm::dmat4(1.0);
  (*root.matrix)[0][0] = -1.0;
  scene.nodes.push_back(root);
  Film mirrored = Draw(scene, SceneSettings(1), m);
  for (int y = 0; y < kHeight; ++y) {
    std::reverse(mirrored.pixels.begin() + y * kWidth, mirrored.pixels.begin() + (y + 1) * kWidth);
  }
  m.Error(LargestRelativeDifference(film, mirrored, 0.1));
  return m;
}

// A multiple of a unit quaternion is the same rotation; one without direction is none where an animation gives it, and
// refused as a node's own. Bound: matrices in double that
// differ in their last bits round to floats that differ by one at times; as for skins.
Measured MeasureQuaternions() {
  Measured m;
  const glm::dquat unit = glm::normalize(glm::dquat(0.7, 0.3, -0.5, 0.2));
  Transform place;
  place.rotation = unit;
  const Film expected = DrawAt(place, m);
  for (const double length : {1e-30, 1e-3, 0.999, 1.001, 7.0, 1e30, -1.0}) {
    place.rotation = unit * length;
    m.Error(LargestRelativeDifference(DrawAt(place, m), expected, 0.1));
  }
  place.rotation = glm::dquat(1, 0, 0, 0);
  const Film unturned = DrawAt(place, m);
  place.rotation = unit;
  Scene animated = MakeScene(place);
  animated.animations.resize(1);
  animated.animations[0].channels.push_back(
      {0, AnimationPath::Rotation, Interpolation::Linear, {0.0f}, {0.0f, 0.0f, 0.0f, 0.0f}});
  RenderSettings settings = SceneSettings();
  settings.animation = 0;
  m.Error(double(DifferingPixels(Draw(animated, settings, m), unturned)));
  for (const double part : {0.0, kNan, kInfinity}) {
    place.rotation = glm::dquat(part, part, part, part);
    ExpectRefused(MakeScene(place), SceneSettings(), "node 0: the rotation", m);
  }
  return m;
}

// A bar of two joints. Vertices without weights go where their node goes; weights that do not sum to 1 are divided by
// their sum. Bound: skinned positions are rounded to float once more, 2^-24 of a unit, against an eye 3 units away; a
// highlight of alpha 0.36 enlarges the angle's error little: 1e-5 is room for ten such roundings.
Scene MakeSkinned(const std::vector<glm::vec4>& weights) {
  Scene scene;
  Primitive bar;
  for (int i = 0; i <= 4; ++i) {
    for (const float x : {-0.2f, 0.2f}) {
      bar.positions.emplace_back(x, -0.8f + 0.4f * float(i), 0.0f);
      bar.normals.emplace_back(0, 0, 1);
      bar.joints.resize(1);
      bar.joints[0].emplace_back(0, 1, 0, 0);
    }
  }
  for (std::uint32_t i = 0; i < 8; i += 2)
    bar.indices.insert(bar.indices.end(), {i, i + 1, i + 2, i + 1, i + 3, i + 2});
  bar.weights = {weights};
  Material material;
  material.double_sided = true;
  material.roughness_factor = 0.6f;
  const int node = Add(scene, bar, AddMaterial(scene, material));
  scene.nodes[std::size_t(node)].skin = 0;
  scene.skins.resize(1);
  for (const double x : {-0.4, 0.4}) {
    Node joint;
    joint.transform.translation = {x, 0, 0};
    joint.transform.rotation = glm::angleAxis(x, glm::dvec3(0, 0, 1));
    scene.skins[0].joints.push_back(int(scene.nodes.size()));
    scene.nodes.push_back(joint);
  }
  AddSun(scene, kSunRotation);
  return scene;
}

Measured MeasureSkins() {
  Measured m;
  const auto draw = [&m](const glm::vec4& weight, bool skinned) {
    Scene scene = MakeSkinned(std::vector<glm::vec4>(10, weight));
    if (!skinned) {
      scene.nodes[0].skin = -1;
      Primitive& bar = scene.meshes[0].primitives[0];
      bar.joints.clear(), bar.weights.clear();
    }
    RenderStats stats;
    const Film film = Draw(scene, SceneSettings(), m, &stats);
    m.Expect(stats.covered_pixels > 50, "the bar is not seen");
    return film;
  };
  const float nan = float(kNan), infinity = float(kInfinity);
  const Film resting = draw(glm::vec4(0.0f), false), half = draw({0.5f, 0.5f, 0, 0}, true);
  const Film first = draw({1, 0, 0, 0}, true);
  for (const glm::vec4& none : {glm::vec4(0.0f), glm::vec4(-0.0f), glm::vec4(nan), glm::vec4(-1.0f)}) {
    m.Error(LargestRelativeDifference(draw(none, true), first, 0.1));
  }
  m.Error(LargestRelativeDifference(draw({infinity, 0, 0, 0}, true), resting, 0.1));
  for (const float size : {1e-38f, 1e-3f, 3.0f, 1e38f}) {
    m.Error(LargestRelativeDifference(draw({size, size, 0, 0}, true), half, 0.1));
  }
  m.Error(LargestRelativeDifference(draw({0.5f, 0.5f, nan, -1.0f}, true), half, 0.1));
  return m;
}

}  // namespace

std::vector<Case> TransformCases() {
  return {
      {"transforms", "scales that are singular, too large, infinite, NaN",
       "inverse transposes are NaN, and so is the light",
       "cofactors; a normal without direction faces the eye; what is no number is refused", "fragments not finite", 0.0,
       MeasureSingular},
      {"transforms", "a mirrored scene against the mirrored picture", "inside out, with bumps that point inwards",
       "determinant turns winding, normals and bitangents", "relative", 5e-4, MeasureMirrored},
      {"transforms", "quaternions of length 1e-30 to 1e30, 0, NaN", "shear and size by the quaternion's length",
       "normalised in double; without direction: refused, in an animation no rotation", "relative", 1e-5,
       MeasureQuaternions},
      {"transforms", "skins with zero, negative, NaN and tiny weights", "vertices collapse to the origin or vanish",
       "divided by their sum in double; none: the joint of the first slot; infinite: the node's place", "relative",
       1e-5, MeasureSkins},
  };
}

}  // namespace facet::stability
