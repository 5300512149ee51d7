// Tiles are lit by the lights that reach them, and the image must not show it: neither where a tile ends, nor that a
// light was left out.
#include <gtest/gtest.h>

#include <cmath>

#include "facet/shader.h"
#include "render/hand_built.h"
#include "shade/shade_fragments.h"

namespace facet {
namespace {

constexpr int kSize = 64;

// What tiles are shaded with, as a shader of a user's own: those are given all lights.
class AllLights final : public FragmentShader {
 public:
  void Shade(const ShadeTask& task) const override { ShadeFragments(task); }
};

void AddLight(Scene& scene, const glm::dvec3& place, float range) {
  Light light;
  light.intensity = 10.0f;
  light.range = range;
  scene.lights.push_back(light);
  Node node;
  node.light = int(scene.lights.size()) - 1;
  node.transform.translation = place;
  scene.nodes.push_back(node);
}

Material White() {
  Material material;
  material.double_sided = true;
  material.metallic_factor = 0.0f;
  return material;
}

// Every tile size gives the image that all lights give. Returns it.
Film ExpectAllLights(const Scene& scene, RenderSettings settings, const std::string& what) {
  const AllLights all;
  settings.shader = &all;
  const Film expected = Render(scene, settings);
  settings.shader = nullptr;
  for (const int tile_size : {8, 16, 32, 64}) {
    settings.tile_size = tile_size;
    EXPECT_TRUE(SameBytes(Render(scene, settings), expected)) << what << ", tiles of " << tile_size;
  }
  return expected;
}

// A floor that goes on beyond the far plane, seen at so low an angle that the last row of pixels before its end, to
// which the cut is snapped, shows what lies beyond: lit by lights that reach no nearer. A wire stands in one tile.
TEST(ManyLights, BeyondTheFarPlane) {
  constexpr double kFar = 100.0;
  for (const double beyond : {0.1, 0.2, 0.3, 0.38}) {
    Scene scene;
    const int white = AddMaterial(scene, White());
    Primitive floor;
    floor.positions = {{-1, 0, -1}, {1, 0, -1}, {2000, 0, -2000}, {-2000, 0, -2000}};
    floor.normals.assign(4, glm::vec3(0, 1, 0));
    floor.indices = {0, 1, 2, 0, 2, 3};
    Add(scene, floor, white);
    Primitive wire;
    wire.positions = {{-0.3f, 0.2f, -1}, {-0.298f, 0.2f, -1}, {-0.3f, 0.9f, -1}};
    Add(scene, wire, white);
    for (int i = 0; i < 100; ++i) AddLight(scene, {2.0 * i - 99.0, 0.05, -(kFar + beyond)}, 0.7f * float(beyond));
    FreeCamera camera = Perspective(0.8, {0, 1, 0});
    // The samples of the first row below the horizon, half a pixel down, see the floor at kFar + beyond.
    camera.lens.yfov = 2.0 * std::atan(0.5 * kSize / (0.5 * (kFar + beyond)));
    camera.lens.zfar = kFar;
    const Film film =
        ExpectAllLights(scene, Settings(kSize, kSize, 1, camera), std::to_string(beyond) + " beyond the far plane");
    bool lit = false;
    for (int x = 0; x < kSize; ++x) lit |= film.pixels[std::size_t(kSize / 2 * kSize + x)].r > 0.0f;
    EXPECT_TRUE(lit) << beyond << ": the row shows nothing";
  }
}

// Lights that touch large triangles, clipped by all planes, at the very places that pixels show, and reach no farther
// than a thousandth of the distance: whichever is left out is missed.
TEST(ManyLights, AtThePlacesThatPixelsShow) {
  Uniform random(7);
  int lit_scenes = 0;
  constexpr int kScenes = 200;
  for (int round = 0; round < kScenes; ++round) {
    const auto far_place = [&] {
      const double size = std::pow(10.0, random(-1, 4));
      return glm::dvec3(random(-size, size), random(-size, size), random(-size, 0.3 * size));
    };
    Scene scene;
    const int white = AddMaterial(scene, White());
    FreeCamera camera = Perspective(random(0.2, 2.0), {0, 0, 0});
    camera.lens.znear = std::pow(10.0, random(-2, 1));
    camera.lens.zfar = camera.lens.znear * std::pow(10.0, random(0.3, 4));
    const double focal = 0.5 * kSize / std::tan(0.5 * *&camera.lens.yfov);
    std::vector<glm::dvec3> places;
    for (int i = 0; i < 3; ++i) {
      Primitive p;
      p.topology = i < 2 ? Topology::Triangles : Topology::Lines;
      for (int k = 0; k < (i < 2 ? 3 : 2); ++k) p.positions.emplace_back(far_place());
      if (i == 2) p.normals.assign(2, glm::vec3(0, 1, 0));  // without them lines are not lit
      const glm::dvec3 a(p.positions[0]), b(p.positions[1]);
      if (i < 2) {
        const glm::dvec3 normal = glm::normalize(glm::cross(b - a, glm::dvec3(p.positions[2]) - a));
        for (int k = 0; k < 400; ++k) {
          const glm::dvec3 ray((int(random(0, kSize)) + 0.5 - kSize / 2) / focal,
                               (kSize / 2 - int(random(0, kSize)) - 0.5) / focal, -1.0);
          const double distance = glm::dot(a, normal) / glm::dot(ray, normal);
          const glm::dvec3 place = ray * distance;
          if (distance > 0.0) places.push_back(place - normal * std::copysign(3e-4 * distance, glm::dot(ray, normal)));
        }
      } else {
        for (int k = 0; k < 200; ++k)
          places.push_back(a + (b - a) * random() + glm::dvec3(0, 3e-4 * glm::length(a), 0));
      }
      Add(scene, p, white);
    }
    std::size_t used = 0;
    for (const glm::dvec3& place : places) {
      // Most near the far and the near plane, where they are hard.
      const bool hard =
          std::fabs(-place.z / camera.lens.zfar - 1.0) < 0.2 || std::fabs(-place.z / camera.lens.znear - 1.0) < 0.2;
      if (used < 100 && (hard || random() < 0.1)) AddLight(scene, place, 1e-3f * float(glm::length(place))), ++used;
    }
    const Film film = ExpectAllLights(scene, Settings(kSize, kSize, round % 2 == 0 ? 1 : 4, camera),
                                      "scene " + std::to_string(round));
    bool lit = false;
    for (const glm::vec4& pixel : film.pixels) lit |= pixel.r > 0.0f;
    lit_scenes += lit;
  }
  EXPECT_GT(lit_scenes, kScenes / 4);
}

}  // namespace
}  // namespace facet
