// Surfaces with transmission and volumes at the ends of their parameters, and at all sizes.
#include <limits>

#include "render/hand_built.h"
#include "stability/stability_case.h"

namespace facet::stability {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

Material Glass(float thickness, float attenuation_distance, float ior) {
  Material glass;
  glass.metallic_factor = 0.0f;
  glass.roughness_factor = 0.2f;
  glass.transmission_factor = 1.0f;
  glass.thickness_factor = thickness;
  glass.attenuation_distance = attenuation_distance;
  glass.attenuation_color = {0.9f, 0.5f, 0.1f};
  glass.ior = ior;
  glass.dispersion = 1.0f;
  return glass;
}

// A glass sphere before a board with stripes. `camera_scale`: of the distances that the camera sees.
Film DrawGlass(const Material& glass, const glm::dvec3& scale, double camera_scale, Measured& m) {
  Scene scene;
  Material board;
  board.model = ShadingModel::Unlit;
  board.base_color_texture = Ref(
      AddTexture(scene, MakeImage(8, 8, [](int x, int y) { return glm::u8vec4(x % 2 * 200, y % 2 * 200, 120, 255); })));
  Transform ball, behind;
  ball.scale = scale;
  behind.scale = glm::dvec3(camera_scale);
  behind.translation.z = -2.0 * camera_scale;
  const int board_index = AddMaterial(scene, board), glass_index = AddMaterial(scene, glass);
  Add(scene, Rectangle(-2, -2, 2, 2), board_index, behind);
  Add(scene, Sphere(0.8f, 12, 16), glass_index, ball);
  FreeCamera camera = Perspective(0.9, glm::dvec3(0, 0, 3) * camera_scale);
  camera.lens.znear *= camera_scale;
  RenderSettings settings = Settings(48, 48, 4, camera);
  settings.environment = ConstantEnvironment(1.0f);
  return Draw(scene, settings, m);
}

Measured MeasureSizes() {
  Measured m;
  const Film expected = DrawGlass(Glass(0.5f, 0.25f, 1.5f), glm::dvec3(1.0), 1.0, m);
  m.Expect(DifferingPixels(DrawGlass(Glass(0.0f, 0.25f, 1.5f), glm::dvec3(1.0), 1.0, m), expected) > 200,
           "the volume is not seen");
  for (const double scale : {0x1p-30, 0x1p-4, 0x1p30}) {
    const Material glass = Glass(0.5f, float(0.25 * scale), 1.5f);
    m.Error(double(DifferingPixels(DrawGlass(glass, glm::dvec3(scale), scale, m), expected)));
  }
  return m;
}

// Draw() refuses what is negative or not finite, or differs between instruction sets. The error counts the pixels in
// which a volume that absorbs everything differs from a surface that lets nothing pass.
Measured MeasureEnds() {
  Measured m;
  for (const float thickness : {0.0f, 1e-30f, 1.0f, 1e9f, 3e38f}) {
    for (const float distance : {1e-30f, 1.0f, 3e38f, kInfinity}) {
      for (const float ior : {0.0f, 1.0f, 1.5f, 100.0f, 3e38f}) {
        DrawGlass(Glass(thickness, distance, ior), glm::dvec3(1.0), 1.0, m);
      }
    }
  }
  for (const glm::dvec3& scale :
       {glm::dvec3(0.0), glm::dvec3(1.0, 1.0, 0.0), glm::dvec3(-1.0), glm::dvec3(1e9, 1.0, 1e-9), glm::dvec3(1e9)}) {
    DrawGlass(Glass(1.0f, 1.0f, 1.5f), scale, 1.0, m);
  }
  Material dark = Glass(1.0f, 1e-30f, 1.5f), opaque = dark;
  dark.attenuation_color = opaque.attenuation_color = glm::vec3(0.0f);
  opaque.base_color_factor = {0.0f, 0.0f, 0.0f, 1.0f};
  m.Error(double(
      DifferingPixels(DrawGlass(dark, glm::dvec3(1.0), 1.0, m), DrawGlass(opaque, glm::dvec3(1.0), 1.0, m), 1e-6f)));
  return m;
}

}  // namespace

std::vector<Case> GlassCases() {
  return {
      {"layers", "volumes of 2^-30 to 2^30 units", "offsets and blurs with a length of their own",
       "thickness under the node's scale; depths compared by their ratio", "pixels that differ", 0.0, MeasureSizes},
      {"layers", "thickness 0 to 3e38, attenuation distance 1e-30 to ∞, index 0 to 3e38, scales 0, -1 and 1e9",
       "0 · ∞ in the exponent; refraction with a root of a negative number",
       "bounded exponents and roots; scale 0 is thin", "pixels that differ", 0.0, MeasureEnds},
  };
}

}  // namespace facet::stability
