// Where a scene lies and how large it is: far away, tiny, huge; and depths over twelve orders of magnitude.
#include <cmath>

#include "render/hand_built.h"
#include "stability/stability_case.h"

namespace facet::stability {
namespace {

constexpr double kPi = 3.14159265358979324;

// A lit sphere through which rectangles cut, opaque, masked and blended, everything `scale` times as large and moved by
// `offset`; the camera goes along.
struct Stage {
  Scene scene;
  RenderSettings settings;
};

Stage MakeStage(double scale, const glm::dvec3& offset) {
  Stage stage;
  Uniform random(3);
  Material lit;
  lit.metallic_factor = 0.3f;
  lit.roughness_factor = 0.4f;
  lit.double_sided = true;
  lit.base_color_texture =
      Ref(AddTexture(stage.scene, MakeImage(16, 16, [&](int, int) {
                       return glm::u8vec4(random() * 256, random() * 256, random() * 256, random() * 256);
                     })));
  Transform place;
  place.translation = offset;
  place.scale = glm::dvec3(scale);
  Add(stage.scene, Sphere(1.0f, 16, 24), AddMaterial(stage.scene, lit), place);
  for (const AlphaMode mode : {AlphaMode::Opaque, AlphaMode::Mask, AlphaMode::Blend}) {
    lit.alpha_mode = mode;
    place.rotation = glm::normalize(glm::dquat(random(-1, 1), random(-1, 1), random(-1, 1), random(-1, 1)));
    Add(stage.scene, Rectangle(-1.3f, -1.1f, 1.2f, 1.1f), AddMaterial(stage.scene, lit), place);
  }
  Light sun;
  sun.type = LightType::Directional;
  sun.intensity = 3.0f;
  stage.scene.lights.push_back(sun);
  Node node;
  node.light = 0;
  node.transform.rotation = glm::normalize(glm::dquat(0.9, -0.3, 0.2, 0.1));
  stage.scene.nodes.push_back(node);
  // 0.6, 0.8 and 2^-2: the eye's place is exact wherever the offset is a number of few digits.
  FreeCamera camera = Perspective(0.9, offset + scale * glm::dvec3(0.25, 0.5, 3.0));
  camera.lens.znear = scale * 0x1p-7;
  stage.settings = Settings(64, 48, 4, camera);
  stage.settings.environment = ConstantEnvironment(0.5f);
  return stage;
}

Film DrawStage(double scale, const glm::dvec3& offset, Measured& m) {
  const Stage stage = MakeStage(scale, offset);
  RenderStats stats;
  const Film film = Draw(stage.scene, stage.settings, m, &stats);
  m.Expect(stats.covered_pixels > 500 && stats.fragments_blended > 100, "the stage is not seen");
  return film;
}

// Numbers of few binary digits: their sums with the scene's own numbers are exact in double, so nothing may change.
Measured MeasureExactOffsets() {
  Measured m;
  const Film expected = DrawStage(1.0, glm::dvec3(0.0), m);
  for (const double offset : {0x1p-20, 0x1p20, 0x1p30}) {
    m.Error(double(DifferingPixels(DrawStage(1.0, {offset, -offset, offset}, m), expected)));
  }
  return m;
}

// Offsets in decimals round in double: at 1e9 by 2^-24 of a unit, 6e-8. The image of 48 pixels shows 2 tan(0.45) * 3
// = 2.9 units: vertices move by 1e-6 pixel, and 1 / 256 pixel is the grid, so one snapped number in 2000 may go the
// other way. Of some 800 numbers on the screen none or one does, which changes pixels along one edge; the bound allows
// one in a hundred.
Measured MeasureDecimalOffsets() {
  Measured m;
  const Film expected = DrawStage(1.0, glm::dvec3(0.0), m);
  for (const double offset : {1e-6, 1e6, 1e9}) {
    const Film film = DrawStage(1.0, {offset, -offset, offset}, m);
    m.Error(double(DifferingPixels(film, expected, 1e-3f)) / double(film.pixels.size()));
  }
  return m;
}

Measured MeasureExactSizes() {
  Measured m;
  const Film expected = DrawStage(1.0, glm::dvec3(0.0), m);
  for (const double scale : {0x1p-30, 0x1p-20, 0x1p20, 0x1p30}) {
    m.Error(double(DifferingPixels(DrawStage(scale, glm::dvec3(0.0), m), expected)));
  }
  return m;
}

// As for offsets: matrices round to float once, by 2^-25 of themselves, 1e-6 pixel at 48 pixels.
Measured MeasureDecimalSizes() {
  Measured m;
  const Film expected = DrawStage(1.0, glm::dvec3(0.0), m);
  for (const double scale : {1e-9, 1e-6, 1e-3, 1e3, 1e6, 1e9}) {
    const Film film = DrawStage(scale, glm::dvec3(0.0), m);
    m.Error(double(DifferingPixels(film, expected, 1e-3f)) / double(film.pixels.size()));
  }
  return m;
}

// A mesh whose own vertices lie far out, at numbers that floats hold exactly: 2^20 + k / 8.
Measured MeasureBakedOffsets() {
  Measured m;
  const auto draw = [&m](float offset) {
    Scene scene;
    Primitive p = Rectangle(-1.0f, -0.75f, 0.5f, 1.0f);
    for (glm::vec3& v : p.positions) v += glm::vec3(offset, offset, -offset);
    Material material;
    material.roughness_factor = 0.5f;
    Add(scene, p, AddMaterial(scene, material));
    RenderSettings settings = Settings(64, 48, 4, Perspective(0.9, glm::dvec3(offset, offset, -double(offset) + 2.5)));
    settings.environment = ConstantEnvironment(1.0f);
    return Draw(scene, settings, m);
  };
  const Film expected = draw(0.0f);
  for (const float offset : {0x1p10f, 0x1p20f}) m.Error(double(DifferingPixels(draw(offset), expected, 1e-3f)));
  return m;
}

// --- Depth ----------------------------------------------------------------------------------------------------------

// Two rectangles that fill the view, the farther one first in the file, at `distance` and `distance * (1 + step)`.
// Returns the pixels in which the farther one is seen.
std::size_t WrongAt(double distance, double step, double near_distance, double far_distance, Measured& m) {
  Scene scene;
  const int far_material = AddMaterial(scene, Unlit({1, 0, 0, 1})),
            near_material = AddMaterial(scene, Unlit({0, 1, 0, 1}));
  Transform place;
  place.scale = glm::dvec3(2.0 * distance);
  place.translation = {0.0, 0.0, -distance * (1.0 + step)};
  Add(scene, Rectangle(-1, -1, 1, 1), far_material, place);
  place.translation = {0.0, 0.0, -distance};
  Add(scene, Rectangle(-1, -1, 1, 1), near_material, place);
  FreeCamera camera = Perspective(0.9, glm::dvec3(0.0));
  camera.lens.znear = near_distance;
  camera.lens.zfar = far_distance;
  const Film film = Draw(scene, Settings(16, 16, 1, camera), m);
  std::size_t wrong = 0;
  for (const glm::vec4& pixel : film.pixels) wrong += pixel != glm::vec4(0, 1, 0, 1);
  return wrong;
}

// Depth as OpenGL has it, in float: z = f (d - n) / (d (f - n)), smaller is nearer.
bool NaiveTellsApart(double distance, double step, double near_distance, double far_distance) {
  const auto depth = [&](double d) {
    return static_cast<float>(far_distance / (far_distance - near_distance)) -
           static_cast<float>(far_distance * near_distance / (far_distance - near_distance)) / static_cast<float>(d);
  };
  return depth(distance) < depth(distance * (1.0 + step));
}

// Near plane 1e-3, far plane 1e9. What is measured is the smallest step between two surfaces, relative to their
// distance, from which on the nearer one is always seen. Bound: 1 / distance as a float has a spacing of 2^-23 of
// itself at worst, and the plane through three such numbers errs by two more: 4 * 2^-23; steps are tried in powers of
// two.
Measured MeasureDepthRange() {
  Measured m;
  constexpr double kNear = 1e-3, kFar = 1e9;
  for (const double distance : {2e-3, 0.1, 1.0, 1e3, 1e6, 9e8}) {
    double resolved = 1.0, naive = 1.0;
    for (double step = 0.0625; step > 1e-9 && WrongAt(distance, step, kNear, kFar, m) == 0; step *= 0.5)
      resolved = step;
    for (double step = 0.0625; step > 1e-9 && NaiveTellsApart(distance, step, kNear, kFar); step *= 0.5) naive = step;
    m.Error(resolved);
    m.NaiveError(naive);
  }
  return m;
}

// Stacks of 40 layers that are closer than floats can tell: coplanar ones show the first of the file; closer than the
// resolution, the choice is the same on every target (Draw checks it), tile size and thread count.
Measured MeasureCoplanarStacks() {
  Measured m;
  for (const double step : {0.0, 1e-9, 3e-8}) {
    Scene scene;
    Uniform random(9);
    constexpr int kLayers = 40;
    for (int i = 0; i < kLayers; ++i) {
      Transform place;
      place.rotation = glm::angleAxis(0.6, glm::dvec3(0.6, 0.8, 0.0));
      place.translation = {0.0, 0.0, 1.0 + step * (kLayers - i)};
      Primitive layer = Rectangle(-6, -6, 6, 6);
      if (step > 0.0 && i % 2 == 1) layer.indices = {0, 1, 3, 1, 2, 3};  // the other diagonal: other rounding
      Add(scene, layer, AddMaterial(scene, Unlit({float(i + 1) / 64.0f, random(), random(), 1})), place);
    }
    RenderSettings settings = Settings(48, 48, 4, Perspective(0.9, {0, 0, 4}));
    const Film film = Draw(scene, settings, m);
    for (const int tile_size : {8, 64}) {
      for (const int threads : {1, 3}) {
        settings.tile_size = tile_size;
        settings.threads = threads;
        m.Expect(SameBytes(Render(scene, settings), film), "the stack depends on tiles or threads");
      }
    }
    if (step > 0.0) continue;
    for (const glm::vec4& pixel : film.pixels) m.Error(pixel.r == 1.0f / 64.0f ? 0.0 : 1.0);
  }
  return m;
}

// A floor one unit below the eye, from 1e6 behind it to 1e6 ahead: covers what lies below the horizon, whole pixels.
Measured MeasureEyePlane() {
  Measured m;
  for (const float extent : {10.0f, 1e3f, 1e6f}) {
    Scene scene;
    Primitive floor;
    floor.positions = {{-extent, -1, extent}, {extent, -1, extent}, {extent, -1, -extent}, {-extent, -1, -extent}};
    floor.indices = {0, 1, 2, 0, 2, 3};
    Add(scene, floor, AddMaterial(scene, Unlit({1, 1, 1, 1})));
    const FreeCamera camera = Perspective(0.9, glm::dvec3(0.0));
    constexpr int kSize = 32;
    const Film film = Draw(scene, Settings(kSize, kSize, 1, camera), m);
    const double focal = kSize * 0.5 / std::tan(0.45);
    const double last_row = kSize * 0.5 + focal / double(extent);  // where the far edge lies
    for (int y = 0; y < kSize; ++y) {
      if (std::fabs(y + 0.5 - last_row) < 1.0 / 256.0) continue;  // the grid decides
      for (int x = 0; x < kSize; ++x) {
        const double across = (x + 0.5 - kSize * 0.5) / focal, distance = focal / (y + 0.5 - kSize * 0.5);
        const bool below = y + 0.5 > last_row && std::fabs(across * distance) < double(extent);
        m.Error(std::fabs(film.pixels[std::size_t(y * kSize + x)].a - (below ? 1.0 : 0.0)));
      }
    }
  }
  return m;
}

// The eye inside a sphere sees it everywhere; in the plane of a triangle, and with all of one behind it, nothing.
Measured MeasureEyeInside() {
  Measured m;
  for (const float radius : {1e-3f, 1.0f, 1e6f}) {
    Scene scene;
    Add(scene, Sphere(radius, 12, 20), AddMaterial(scene, Unlit({1, 1, 1, 1})));
    FreeCamera camera = Perspective(1.2, {0.3 * radius, -0.2 * radius, 0.1 * radius});
    camera.lens.znear = 1e-12;
    RenderStats stats;
    Draw(scene, Settings(32, 32, 4, camera), m, &stats);
    m.Error(std::fabs(double(stats.covered_pixels) - 32.0 * 32.0));
  }
  for (const double x : {0.0, 0.25, -0.5}) {
    Scene scene;
    Transform edge_on;
    edge_on.rotation = glm::angleAxis(kPi / 2, glm::dvec3(0, 1, 0));
    edge_on.translation.x = 0.0;
    Material lit;
    lit.double_sided = true;
    const int material = AddMaterial(scene, lit);
    Add(scene, Rectangle(-1, -1, 1, 1), material, edge_on);
    Transform behind;
    behind.translation = {0, 0, 5};
    Add(scene, Rectangle(-1, -1, 1, 1), material, behind);
    RenderSettings settings = Settings(32, 32, 4, Perspective(0.9, {x == 0.0 ? 0.0 : 0x1p-1000 * x, 0.0, 0.0}));
    settings.environment = ConstantEnvironment(1.0f);
    RenderStats stats;
    Draw(scene, settings, m, &stats);
    // Seen end on a surface may cover the samples on its line, not more than a column of pixels on each side.
    m.Expect(stats.covered_pixels <= 64, "a surface seen end on covers an area");
  }
  return m;
}

}  // namespace

std::vector<Case> PlacementCases() {
  return {
      {"placement", "moved by 2^-20, 2^20 and 2^30 units", "vertices in world space as floats jitter by 64 units",
       "matrices relative to the eye in double, then rounded", "pixels that differ", 0.0, MeasureExactOffsets},
      {"placement", "moved by 1e-6, 1e6 and 1e9 units", "the same, and a shaking camera",
       "double rounds the scene's own numbers, no more", "of the pixels differ by 1e-3", 0.01, MeasureDecimalOffsets},
      {"placement", "vertices at 2^10 and 2^20 in the mesh", "products of large floats cancel",
       "vertices relative to the eye in mesh space, exactly", "pixels that differ by 1e-3", 0.0, MeasureBakedOffsets},
      {"placement", "sizes of 2^-30 to 2^30 units", "fixed epsilons swallow or miss everything",
       "no epsilon has a length; normals from cofactors", "pixels that differ", 0.0, MeasureExactSizes},
      {"placement", "sizes of 1e-9 to 1e9 units", "the same", "the same", "of the pixels differ by 1e-3", 0.01,
       MeasureDecimalSizes},
      {"placement", "near plane 1e-3, far plane 1e9", "depth buffers tell nothing apart but the first metres",
       "depth is 1 / distance as a float, nearer is larger", "relative step resolved", 4 * 0x1p-23, MeasureDepthRange},
      {"placement", "coplanar and nearly coplanar stacks", "z-fighting that changes with GPU, tiles and threads",
       "the first in the file wins; rounding is the same everywhere", "pixels of a later layer", 0.0,
       MeasureCoplanarStacks},
      {"placement", "a floor through the eye's plane", "division by w = 0; wrap-around behind the eye",
       "clipping in homogeneous space, in double", "of a pixel's coverage", 0.0, MeasureEyePlane},
      {"placement", "the eye inside, in the plane of and beyond a surface", "holes at the near plane; infinite edges",
       "no near plane is needed: any positive one will do", "pixels missed", 0.0, MeasureEyeInside},
  };
}

}  // namespace facet::stability
