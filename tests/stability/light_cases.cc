// Lights of any strength and at any distance, degenerate cones, environments with broken pixels, and mirrors.
#include <cmath>
#include <limits>

#include "light/lighting-inl.h"
#include "light/punctual.h"
#include "render/hand_built.h"
#include "stability/stability_case.h"

namespace facet::stability {
namespace {

namespace lanes = HWY_NAMESPACE;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kPi = 3.14159265358979324f;
constexpr int kSize = 24;

int AddLight(Scene& scene, const Light& light, const Transform& place) {
  scene.lights.push_back(light);
  Node node;
  node.light = int(scene.lights.size()) - 1;
  node.transform = place;
  scene.nodes.push_back(node);
  return int(scene.nodes.size()) - 1;
}

Light MakeLight(LightType type, float intensity) {
  Light light;
  light.type = type;
  light.intensity = intensity;
  return light;
}

Scene SphereScene(float roughness, float metallic) {
  Scene scene;
  Material material;
  material.roughness_factor = roughness;
  material.metallic_factor = metallic;
  Add(scene, Sphere(0.9f, 24, 36), AddMaterial(scene, material));
  return scene;
}

RenderSettings SphereSettings() { return Settings(kSize, kSize, 1, Perspective(0.7, {0, 0, 3})); }

RenderSettings QuickEnvironment(RenderSettings settings, const EnvironmentSettings& environment) {
  settings.environment = environment;
  settings.environment_size = 64;
  settings.environment_samples = 24;
  return settings;
}

// Light is linear: radiance over intensity is the same at any intensity. Bound: the sum over three lights of rounded
// products, 2^-24 of each factor; intensities that are no powers of two round too: 8 * 2^-24. Below 1e-4 of a white
// surface digits count against that, because floats end at 1e-38.
Measured MeasureIntensities() {
  Measured m;
  const auto draw = [&m](float intensity) {
    Scene scene = SphereScene(0.3f, 0.4f);
    Transform place;
    place.translation = {1.5, 1.0, 2.0};
    AddLight(scene, MakeLight(LightType::Point, intensity), place);
    place.rotation = glm::angleAxis(0.3, glm::dvec3(1, 0, 0));
    place.translation = {0.0, -0.5, 3.0};
    AddLight(scene, MakeLight(LightType::Spot, intensity), place);
    AddLight(scene, MakeLight(LightType::Directional, intensity), place);
    return Draw(scene, SphereSettings(), m);
  };
  const Film expected = draw(1.0f);
  for (const float intensity : {1e-30f, 1e-20f, 1e-6f, 1e6f, 1e20f, 1e30f}) {
    const Film film = draw(intensity);
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
      for (int c = 0; c < 3; ++c) {
        const double want = double(expected.pixels[i][c]), got = double(film.pixels[i][c]) / double(intensity);
        m.Error(std::fabs(got - want) / std::fmax(want, 1e-4));
      }
    }
  }
  return m;
}

// What floats cannot hold becomes black, and is counted: each fragment of the rectangle. What is no light at all is
// refused.
Measured MeasureOverflow() {
  Measured m;
  for (const float strength : {1.0f, 10.0f}) {
    Scene scene;
    Material material;
    material.roughness_factor = 0.0f;
    Add(scene, Rectangle(-1, -1, 1, 1), AddMaterial(scene, material));
    Transform place;
    place.translation = {0, 0, 1e-2};
    // Candela over the square of a centimetre: 1e42 lux.
    Light light = MakeLight(LightType::Directional, 3e38f);
    light.color = glm::vec3(10.0f);  // 3e39 lux
    AddLight(scene, light, {});
    light = MakeLight(LightType::Point, 3e38f);
    light.color = glm::vec3(strength);
    AddLight(scene, light, place);
    const Film film = Draw(scene, Settings(kSize, kSize, 1, Orthographic(1.0)), m, nullptr, kSize * kSize);
    for (const glm::vec4& pixel : film.pixels) m.Error(double(pixel.r));
  }
  for (const float nonsense : {kNan, -1.0f, -kInfinity}) {
    const auto refuse = [&](const Light& light, const char* culprit) {
      Scene scene = SphereScene(0.5f, 0.0f);
      AddLight(scene, light, {});
      ExpectRefused(scene, SphereSettings(), culprit, m);
    };
    refuse(MakeLight(LightType::Point, nonsense), "light 0: intensity");
    Light light = MakeLight(LightType::Spot, 1.0f);
    light.range = nonsense;
    refuse(light, "light 0: range");
    light = MakeLight(LightType::Directional, 1.0f);
    light.color = glm::vec3(nonsense);
    refuse(light, "light 0: colour");
  }
  return m;
}

// The illuminance under a point light `height` above a surface and as far aside: I cos / d^2, which below a millimetre
// stays what it is there. Bound: differences, squares, sum, root and quotients, some ten roundings.
Measured MeasureLightAtSurface() {
  Measured m;
  for (double height = 10.0; height > 1e-15; height *= 0.31) {
    PosedLight posed;
    const Light light = MakeLight(LightType::Point, 1.0f);
    posed.light = &light;
    posed.position_world = {height, 0.0, height};
    const std::vector<PunctualLight> lights = MakePunctualLights({posed}, glm::dvec3(0.0));
    const auto sample = lanes::SamplePunctual(lights[0], lanes::Vec3<float>{0, 0, 0});
    const long double x = lights[0].position_eye[0], d2 = 2 * x * x;
    const long double exact = std::sqrt(0.5L) / std::fmax(d2, static_cast<long double>(1e-6f));
    m.Error(double(std::fabs(static_cast<long double>(sample.irradiance.x) * sample.direction.z - exact) / exact));
  }
  for (const double height : {1e-3, 1e-9, 1e-30, 0.0, -1e-9}) {
    Scene scene;
    Add(scene, Rectangle(-1, -1, 1, 1), AddMaterial(scene, Material()));
    Transform place;
    place.translation = {1.0 / kSize, 1.0 / kSize, height};  // above a pixel's centre
    AddLight(scene, MakeLight(LightType::Point, 1.0f), place);
    AddLight(scene, MakeLight(LightType::Spot, 1.0f), place);
    Draw(scene, Settings(kSize, kSize, 1, Orthographic(1.0)), m);
  }
  return m;
}

// Cones against their definition: full intensity within the inner angle, none outside the outer one. The recommended
// ramp is 0.001 wide in cosines at least, which is left out. Angles in radians off the axis.
Measured MeasureCones() {
  Measured m;
  struct Cone {
    float inner, outer;
  };
  for (const Cone cone : {Cone{0, 0},
                          {0, 1e-6f},
                          {0, kPi / 2},
                          {kPi / 2, kPi / 2},
                          {kPi, kPi},
                          {0.7f, 0.7f},
                          {1.0f, 0.5f},
                          {0.3f, kPi},
                          {kNan, 0.5f},
                          {0.1f, kNan},
                          {-1.0f, 7.0f}}) {
    Light light = MakeLight(LightType::Spot, 1.0f);
    light.inner_cone_angle = cone.inner;
    light.outer_cone_angle = cone.outer;
    PosedLight posed;
    posed.light = &light;
    posed.direction_world = {0, 0, -1};
    const std::vector<PunctualLight> lights = MakePunctualLights({posed}, glm::dvec3(0.0));
    const bool defined = cone.inner >= 0.0f && cone.inner <= cone.outer && cone.outer <= kPi;
    for (double angle = 0.0; angle < 3.14159; angle += 0.01) {
      const lanes::Vec3<float> at{float(std::sin(angle)), 0.0f, float(-std::cos(angle))};
      const double got = double(lanes::SamplePunctual(lights[0], at).irradiance.x);
      m.Expect(got >= 0.0 && got <= 1.0 + 1e-6, "a cone makes light");
      if (!defined) continue;
      const double inner = std::cos(double(cone.inner)), outer = std::cos(double(cone.outer)), c = std::cos(angle);
      if (c > std::fmax(inner, outer + 0.001) + 1e-6) m.Error(std::fabs(got - 1.0));
      if (c < outer - 1e-6) m.Error(got);
    }
  }
  return m;
}

// --- Environments
// -----------------------------------------------------------------------------------------------------

EnvironmentSettings EnvironmentOf(const std::function<float(int, int)>& radiance) {
  EnvironmentSettings environment = ConstantEnvironment(0.0f);
  auto image = std::make_shared<Image>(*environment.image);
  for (int i = 0; i < 16 * 8; ++i) {
    for (int c = 0; c < 3; ++c) image->As<float>()[3 * i + c] = radiance(i % 16, i / 16);
  }
  environment.image = image;
  return environment;
}

// A sky with one pixel that is `sun` times brighter: linear, so the sky's image plus `sun` times the pixel's alone.
// Bound: the widest lobes are sums over 64 x 64 texels, rounded term by term: 4096 * 2^-24 of the whole.
Measured MeasureSun() {
  Measured m;
  for (const float roughness : {0.0f, 0.3f, 1.0f}) {
    const Scene scene = SphereScene(roughness, 0.5f);
    const auto draw = [&](float sky, float sun) {
      const auto radiance = [&](int x, int y) { return x == 11 && y == 2 ? sun : sky; };
      return Draw(scene, QuickEnvironment(SphereSettings(), EnvironmentOf(radiance)), m);
    };
    const Film sky = draw(1.0f, 0.0f), unit = draw(0.0f, 1.0f);
    for (const float sun : {1e3f, 1e6f, 1e8f}) {
      const Film both = draw(1.0f, sun);
      for (std::size_t i = 0; i < both.pixels.size(); ++i) {
        const double want = double(sky.pixels[i].r) + double(sun) * double(unit.pixels[i].r);
        if (want > 0.0) m.Error(std::fabs(double(both.pixels[i].r) - want) / want);
      }
    }
  }
  return m;
}

// Pixels that are no light count as none, and the report says how many numbers they were.
Measured MeasureBrokenEnvironment() {
  Measured m;
  const Scene scene = SphereScene(0.3f, 0.5f);
  const auto draw = [&](float bad, std::size_t warnings) {
    const auto radiance = [&](int x, int y) { return (x + 2 * y) % 5 == 0 ? bad : float(x + 1); };
    RenderSettings settings = QuickEnvironment(SphereSettings(), EnvironmentOf(radiance));
    settings.background = Background::Environment;
    RenderStats stats;
    const Film film = Draw(scene, settings, m, &stats);
    m.Expect(stats.warnings.size() == warnings, "replaced pixels are not reported, or too often");
    return film;
  };
  const Film expected = draw(0.0f, 0);
  for (const float bad : {kNan, kInfinity, -kInfinity, -1.0f, -1e-30f}) {
    m.Error(double(DifferingPixels(draw(bad, 1), expected)));
  }
  return m;
}

// A sphere of white material in constant light is as bright as that light, whatever roughness, metalness and light.
// Bound: the furnace's, by the tables' interpolation.
Measured MeasureEnvironmentFurnace() {
  Measured m;
  for (const float radiance : {1e-30f, 1.0f, 1e8f}) {
    Scene scene;
    const Primitive ball = Sphere(0.45f, 16, 24);
    int i = 0;
    for (const float roughness : {0.0f, 1e-6f, 1.0f}) {
      for (const float metallic : {0.0f, 0.5f, 1.0f}) {
        Material material;
        material.roughness_factor = roughness;
        material.metallic_factor = metallic;
        Transform place;
        place.translation = {i % 3 - 1.0, i / 3 - 1.0, 0.0};
        Add(scene, ball, AddMaterial(scene, material), place);
        ++i;
      }
    }
    const Film film =
        Draw(scene, QuickEnvironment(Settings(48, 48, 1, Orthographic(1.5)), ConstantEnvironment(radiance)), m);
    for (const glm::vec4& pixel : film.pixels) {
      if (pixel.a > 0.0f) m.Error(std::fabs(double(pixel.g) / double(radiance) - 1.0));
    }
  }
  return m;
}

// --- Mirrors
// -----------------------------------------------------------------------------------------------------------

// Lit by a point light alone, materials from roughness 0 to 0.045 are one: a highlight of alpha 0.002, the same bits,
// and it is seen. In an environment they are not: the mirror shows the image itself.
Measured MeasureMirrorUnderPointLight() {
  Measured m;
  const auto draw = [&m](float roughness) {
    Scene scene = SphereScene(roughness, 1.0f);
    Transform place;
    place.translation = {0.4, 0.3, 3.0};
    AddLight(scene, MakeLight(LightType::Point, 100.0f), place);
    RenderSettings settings = SphereSettings();
    settings.width = settings.height = 256;  // a highlight of 0.2 degrees must meet a pixel's centre
    return Draw(scene, settings, m);
  };
  const Film expected = draw(0.045f);
  float brightest = 0.0f;
  for (const glm::vec4& pixel : expected.pixels) brightest = std::fmax(brightest, pixel.r);
  m.Expect(brightest > 100.0f, "the highlight is not seen");
  for (const float roughness : {0.0f, 1e-6f, 1e-3f, 0.04f}) m.Error(double(DifferingPixels(draw(roughness), expected)));
  return m;
}

// Towards roughness 0 an environment's reflection approaches the mirror's, without a step. Bound: levels are mixed in
// proportion to 8 * roughness, and the two sharpest differ by the whole contrast at most, here 1.
Measured MeasureMirrorsLimit() {
  Measured m;
  const auto draw = [&m](float roughness) {
    const auto radiance = [](int x, int y) { return (x + y) % 2 == 0 ? 1.0f : 0.0f; };
    RenderSettings settings = QuickEnvironment(SphereSettings(), EnvironmentOf(radiance));
    settings.specular_antialiasing = false;  // which is wider than these roughnesses
    return Draw(SphereScene(roughness, 1.0f), settings, m);
  };
  const Film mirror = draw(0.0f);
  for (const float roughness : {1e-6f, 1e-4f, 1e-2f}) {
    const Film film = draw(roughness);
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
      m.Error(std::fabs(double(film.pixels[i].r) - double(mirror.pixels[i].r)) / double(roughness));
    }
  }
  return m;
}

}  // namespace

std::vector<Case> LightCases() {
  return {
      {"light", "intensities of 1e-30 to 1e30", "fixed-point or half-float light ends at 65504",
       "floats throughout; nothing is compared with a length or a level", "relative", 8 * 0x1p-24, MeasureIntensities},
      {"light", "lights that overflow; infinite, negative and NaN ones", "one NaN pixel, and a bloom of it",
       "black and counted; refused, by name", "radiance left", 0.0, MeasureOverflow},
      {"light", "a point light 10 m to 1e-15 m away", "1 / d² is infinite, and 0 · infinity NaN",
       "illuminance stays what it is at a millimetre", "relative", 1e-6, MeasureLightAtSurface},
      {"light", "spot cones of 0 and 180 degrees, inverted, NaN", "division by equal cosines",
       "a ramp 0.001 wide in cosines at least", "of full light", 1e-5, MeasureCones},
      {"light", "a sun of 1e3 to 1e8 in a sky of 1", "fireflies, or half floats that clip it",
       "float maps, each lobe summed at the level that it needs", "relative", 4096 * 0x1p-24, MeasureSun},
      {"light", "NaN, infinite and negative environment pixels", "everything that the filter touches is NaN",
       "count as no light; a warning says how many", "pixels that differ", 0.0, MeasureBrokenEnvironment},
      {"light", "white spheres in constant light of 1e-30 to 1e8", "bright or dark rims, by roughness",
       "the energy that one lobe leaves goes to the others", "of what comes in", 0.02, MeasureEnvironmentFurnace},
      {"light", "α = 0 lit by a point light", "nothing, a single pixel, or NaN",
       "drawn as roughness 0.045: a highlight of 0.2 degrees", "pixels that differ", 0.0, MeasureMirrorUnderPointLight},
      {"light", "roughness to 0 in an environment", "a step where a mirror begins",
       "linear between the mirror's level and the next", "change per roughness", 8.0, MeasureMirrorsLimit},
  };
}

}  // namespace facet::stability
