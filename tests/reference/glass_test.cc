// What the reference sees through surfaces, against closed forms of optics: thin walls, slabs, spheres, prisms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "closed_form.h"
#include "reference/reference.h"
#include "render/hand_built.h"

namespace facet {
namespace {

constexpr double kPi = 3.14159265358979324;
constexpr double kSmoothest = 0.045;  // perceptual roughness, of what is reflected

ReferenceSettings Effort(int samples, int environment_samples, int batches) {
  ReferenceSettings settings;
  settings.samples = samples;
  settings.environment_samples = environment_samples;
  settings.batches = batches;
  return settings;
}

Material Glass(const glm::vec3& base, float roughness = 0.0f) {
  Material material;
  material.base_color_factor = glm::vec4(base, 1.0f);
  material.metallic_factor = 0.0f;
  material.roughness_factor = roughness;
  material.transmission_factor = 1.0f;
  return material;
}

Material SolidGlass(const glm::vec3& base, float ior, float roughness = 0.0f) {
  Material material = Glass(base, roughness);
  material.thickness_factor = 1.0f;
  material.ior = ior;
  return material;
}

Transform TurnedAboutY(double angle, const glm::dvec3& translation = glm::dvec3(0.0)) {
  Transform transform;
  transform.rotation = glm::dquat(std::cos(0.5 * angle), 0.0, std::sin(0.5 * angle), 0.0);
  transform.translation = translation;
  return transform;
}

// A closed solid: a polygon in x and y, counter-clockwise, from z0 to z1.
Primitive Prism(const std::vector<glm::vec2>& polygon, float z0, float z1) {
  Primitive p;
  const auto n = std::uint32_t(polygon.size());
  for (const float z : {z0, z1}) {
    for (const glm::vec2& corner : polygon) p.positions.emplace_back(corner.x, corner.y, z);
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    p.indices.insert(p.indices.end(), {i, next, n + next, i, n + next, n + i});
    if (i >= 1 && i + 1 < n) p.indices.insert(p.indices.end(), {n, n + i, n + i + 1, 0, i + 1, i});
  }
  return p;
}
Primitive Box(float half_x, float half_y, float z0, float z1) {
  return Prism({{-half_x, -half_y}, {half_x, -half_y}, {half_x, half_y}, {-half_x, half_y}}, z0, z1);
}

// An unlit card whose red grows with x and whose green with y, both 0.5 in the middle; blue is 1.
constexpr double kCard = 8.0;  // half its side
Primitive Card(float z) {
  Primitive p = Rectangle(-float(kCard), -float(kCard), float(kCard), float(kCard), z);
  for (const glm::vec3& at : p.positions) {
    p.colors.emplace_back(0.5 + 0.5 * at.x / kCard, 0.5 + 0.5 * at.y / kCard, 1.0, 1.0);
  }
  return p;
}
glm::dvec2 PlaceOnCard(const glm::dvec4& color) { return (glm::dvec2(color) / color.z - 0.5) * (2.0 * kCard); }

// One ray along -Z, from (x, y, 10).
RenderSettings OneRay(double x = 0.0, double y = 0.0) { return Settings(1, 1, 1, Orthographic(1e-5, {x, y, 10})); }
glm::dvec4 Seen(const Scene& scene, const RenderSettings& settings, const ReferenceSettings& effort = Effort(1, 1, 2)) {
  return RenderReference(scene, settings, effort).pixels[0];
}

void ExpectNear(const glm::dvec3& is, const glm::dvec3& expected, double tolerance, const char* what) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(is[c], expected[c], tolerance) << what << ", channel " << c;
}

TEST(ReferenceGlass, ClearPanesTintWhatIsBehind) {
  const glm::vec3 base(0.8f, 0.5f, 0.25f);
  const ClosedForm model(glm::dvec3(base), 0.0, kSmoothest);
  const glm::vec4 behind(0.3f, 0.6f, 0.9f, 1.0f);
  for (const double tilt : {0.0, 0.6}) {
    glm::dvec3 tint = glm::dvec3(base) * model.LeftAt(std::cos(tilt));
    for (int panes = 1; panes <= 3; ++panes) {
      Scene scene;
      for (int i = 0; i < panes; ++i) {
        Add(scene, Rectangle(-2, -2, 2, 2), AddMaterial(scene, Glass(base)), TurnedAboutY(tilt, {0.1, 0, -i}));
      }
      const glm::dvec3 passing = glm::pow(tint, glm::dvec3(panes));
      const glm::dvec4 nothing = Seen(scene, OneRay());
      EXPECT_EQ(glm::dvec3(nothing), glm::dvec3(0.0));
      EXPECT_NEAR(nothing.w, 1.0 - (passing.x + passing.y + passing.z) / 3.0, 1e-6);
      Add(scene, Rectangle(-9, -9, 9, 9, -8), AddMaterial(scene, Unlit(behind)));
      const glm::dvec4 pixel = Seen(scene, OneRay());
      ExpectNear(glm::dvec3(pixel), passing * glm::dvec3(behind), 1e-6, "panes");
      EXPECT_EQ(pixel.w, 1.0);
    }
  }
}

// The part of the surface that does not transmit keeps its diffuse light, and alpha is coverage.
TEST(ReferenceGlass, TransmissionIsAShareAndAlphaIsCoverage) {
  const ClosedForm model(glm::dvec3(1.0), 0.0, kSmoothest);
  const double left = model.LeftAt(1.0);
  Material material = Glass(glm::vec3(1.0f));
  material.transmission_factor = 0.25f;
  material.alpha_mode = AlphaMode::Blend;
  material.base_color_factor.w = 0.5f;
  Scene scene;
  Add(scene, Rectangle(-2, -2, 2, 2), AddMaterial(scene, material));
  Add(scene, Rectangle(-9, -9, 9, 9, -8), AddMaterial(scene, Unlit({0.4f, 0.6f, 0.8f, 1.0f})));
  const glm::dvec3 card(0.4, 0.6, 0.8);
  ExpectNear(glm::dvec3(Seen(scene, OneRay())), card * (0.5 + 0.5 * 0.25 * left), 1e-6, "covered by a half");
  // Behind a second pane the same layer is met by a ray.
  Add(scene, Rectangle(-2, -2, 2, 2, 1), AddMaterial(scene, Glass(glm::vec3(1.0f))));
  const ReferenceFilm film = RenderReference(scene, OneRay(), Effort(256, 1, 16));
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(film.pixels[0][c], card[c] * (0.5 + 0.5 * 0.25 * left) * left, 5.0 * film.standard_error[0][c] + 1e-6);
    EXPECT_LT(film.standard_error[0][c], 0.002);
  }
}

// Many layers that are covered by glass in parts: each halves the light that it covers, and the work stays in bounds.
TEST(ReferenceGlass, StacksOfBlendedGlass) {
  Material material = Glass(glm::vec3(0.5f));
  material.alpha_mode = AlphaMode::Blend;
  material.base_color_factor.w = 0.25f;
  Scene scene;
  const int blended = AddMaterial(scene, material);
  for (int i = 0; i < 30; ++i) Add(scene, Rectangle(-2, -2, 2, 2, -0.1f * float(i)), blended);
  Add(scene, Rectangle(-9, -9, 9, 9, -8), AddMaterial(scene, Unlit({1, 1, 1, 1})));
  const double left = 0.75 + 0.25 * 0.5 * ClosedForm(glm::dvec3(1.0), 0.0, kSmoothest).LeftAt(1.0);
  const ReferenceFilm film = RenderReference(scene, OneRay(), Effort(64, 1, 16));
  EXPECT_NEAR(film.pixels[0].y, std::pow(left, 30.0), 5.0 * film.standard_error[0].y);
  EXPECT_LT(film.standard_error[0].y, 0.1 * std::pow(left, 30.0));
  EXPECT_EQ(film.pixels[0].w, 1.0);
}

// A ray meets alpha-tested and blended surfaces, and backs, as the camera does.
TEST(ReferenceGlass, RaysSeeWhatTheCameraSees) {
  Scene scene;
  Material masked = Unlit({1, 1, 1, 0.4f}, AlphaMode::Mask), culled = Unlit({1, 1, 1, 1});
  masked.alpha_cutoff = 0.5f;
  culled.double_sided = false;
  Add(scene, Rectangle(-2, -2, 2, 2, -1), AddMaterial(scene, masked));
  Add(scene, Rectangle(-2, -2, 2, 2), AddMaterial(scene, culled), TurnedAboutY(kPi, {0, 0, -2}));
  Add(scene, Rectangle(-2, -2, 2, 2, -3), AddMaterial(scene, Unlit({1, 0, 0, 0.25f}, AlphaMode::Blend)));
  Add(scene, Rectangle(-2, -2, 2, 2, -4), AddMaterial(scene, Unlit({0, 1, 0, 0.5f}, AlphaMode::Blend)));
  const glm::dvec4 bare = Seen(scene, OneRay());
  EXPECT_NEAR(bare.w, 1.0 - 0.75 * 0.5, 1e-7);
  const double left = ClosedForm(glm::dvec3(1.0), 0.0, kSmoothest).LeftAt(1.0);
  Add(scene, Rectangle(-2, -2, 2, 2), AddMaterial(scene, Glass(glm::vec3(1.0f))));
  const glm::dvec4 pixel = Seen(scene, OneRay());
  ExpectNear(glm::dvec3(pixel), glm::dvec3(bare) * left, 1e-6, "behind glass");
  EXPECT_NEAR(pixel.w, 1.0 - left * (1.0 - bare.w), 1e-6);
  // And the environment, where it is the background.
  RenderSettings settings = OneRay();
  settings.environment = ConstantEnvironment(0.5f);
  settings.background = Background::Environment;
  const double reflected = 0.5 * (1.0 - left);
  const glm::dvec4 bright = Seen(scene, settings, Effort(64, 16, 16));
  EXPECT_NEAR(bright.y, reflected + left * (0.75 * (0.5 + 0.5 * 0.5)), 2e-4);
  EXPECT_EQ(bright.w, 1.0);
}

// Displacement d sin a (1 - cos a / sqrt(n^2 - sin^2 a)), and absorption along d / cos b.
TEST(ReferenceGlass, ASlabDisplacesAndAbsorbs) {
  for (const float ior : {1.0f, 1.33f, 1.5f, 2.4f}) {
    for (const double angle : {0.0, 0.3, 0.8, 1.3}) {
      const double d = 0.75, n = double(ior), sine = std::sin(angle);
      const double inside = std::sqrt(1.0 - sine * sine / (n * n));
      Material glass = SolidGlass(glm::vec3(1.0f), ior);
      Scene scene;
      Add(scene, Card(-6), AddMaterial(scene, Unlit(glm::vec4(1.0f))));
      const int slab = AddMaterial(scene, glass);
      Add(scene, Box(4, 4, -0.75f, 0), slab, TurnedAboutY(angle));
      const glm::dvec4 clear = Seen(scene, OneRay());
      EXPECT_NEAR(PlaceOnCard(clear).x, -d * sine * (1.0 - std::cos(angle) / (n * inside)), 1e-5) << n << " " << angle;
      EXPECT_NEAR(PlaceOnCard(clear).y, 0.0, 2e-5);
      scene.materials[std::size_t(slab)].attenuation_color = {0.5f, 0.25f, 0.125f};
      scene.materials[std::size_t(slab)].attenuation_distance = 0.5f;
      const glm::dvec4 dark = Seen(scene, OneRay());
      const glm::dvec3 passing = glm::pow(glm::dvec3(0.5, 0.25, 0.125), glm::dvec3(d / inside / 0.5));
      ExpectNear(glm::dvec3(dark) / glm::dvec3(clear), passing, 1e-6, "absorbed");
    }
  }
}

// Absorption is per metre of the world, however the mesh is scaled.
TEST(ReferenceGlass, AttenuationIsInTheWorld) {
  Material glass = SolidGlass(glm::vec3(1.0f), 1.5f);
  Transform scaled;
  scaled.scale = glm::dvec3(2.0);
  Scene scene;
  Add(scene, Card(-6), AddMaterial(scene, Unlit(glm::vec4(1.0f))));
  Add(scene, Box(4, 4, -0.5f, 0), AddMaterial(scene, glass), scaled);
  const double clear = Seen(scene, OneRay()).z;
  scene.materials[1].attenuation_color = glm::vec3(0.5f);
  scene.materials[1].attenuation_distance = 1.0f;
  EXPECT_NEAR(Seen(scene, OneRay()).z / clear, 0.5, 1e-6);
  // Without an exit, the stated thickness is that of the mesh.
  scene.materials[1].thickness_factor = 0.25f;
  scene.meshes[1].primitives[0] = Rectangle(-2, -2, 2, 2);
  scene.meshes[1].primitives[0].material = 1;
  EXPECT_NEAR(Seen(scene, OneRay()).z / clear, std::sqrt(0.5), 1e-6);
}

// A single sheet has no exit: a slab of the stated thickness along the ray, or up to what stands behind it.
TEST(ReferenceGlass, AnOpenMeshIsASlab) {
  const double angle = 0.7, n = 1.4, inside = std::asin(std::sin(angle) / n);
  for (const float thickness : {0.5f, 100.0f}) {
    Material glass = SolidGlass(glm::vec3(1.0f), 1.4f);
    glass.thickness_factor = thickness;
    Scene scene;
    Add(scene, Card(-6), AddMaterial(scene, Unlit(glm::vec4(1.0f))));
    Add(scene, Rectangle(-4, -4, 4, 4), AddMaterial(scene, glass), TurnedAboutY(angle));
    const bool meets_card = thickness > 10.0f;
    const double x = meets_card ? -6.0 * std::tan(angle - inside) : -0.5 * std::sin(angle - inside);
    const double path = meets_card ? 6.0 / std::cos(angle - inside) : 0.5;
    const glm::dvec4 clear = Seen(scene, OneRay());
    EXPECT_NEAR(PlaceOnCard(clear).x, x, 2e-5) << thickness;
    scene.materials[1].attenuation_color = glm::vec3(0.5f);
    scene.materials[1].attenuation_distance = 1.0f;
    EXPECT_NEAR(Seen(scene, OneRay()).z / clear.z, std::pow(0.5, path), 1e-6) << thickness;
  }
}

// A ball lens: at height h, the ray turns by twice the difference of the angles towards the axis.
TEST(ReferenceGlass, ASphereFocuses) {
  const double n = 1.5, radius = 1.0, card = -6.0;
  Scene scene;
  Add(scene, Card(float(card)), AddMaterial(scene, Unlit(glm::vec4(1.0f))));
  Add(scene, Sphere(float(radius), 160, 320), AddMaterial(scene, SolidGlass(glm::vec3(1.0f), float(n))));
  for (const double height : {0.0, 0.1, 0.3, 0.55, 0.8}) {
    const double outside = std::asin(height), inside = std::asin(height / n), turn = 2.0 * (outside - inside);
    // Round the centre, from where it enters at the angle `outside` from +Z.
    const double exit = outside + (kPi - 2.0 * inside);
    const double x = std::sin(exit), z = std::cos(exit);
    const double expected = x - std::tan(turn) * (z - card);
    for (const double around : {0.0, 0.5, 2.0}) {
      const glm::dvec2 axis(std::cos(around), std::sin(around));
      const glm::dvec2 place = PlaceOnCard(Seen(scene, OneRay(height * axis.x, height * axis.y)));
      EXPECT_NEAR(place.x, expected * axis.x, 3e-3) << height << " " << around;
      EXPECT_NEAR(place.y, expected * axis.y, 3e-3) << height << " " << around;
    }
  }
  EXPECT_NEAR(PlaceOnCard(Seen(scene, OneRay(1e-9, -1e-9))).x, 0.0, 1e-3);
}

// Half a cube: what enters one leg at a right angle meets the hypotenuse at 45 degrees, and is reflected to the other
// leg where the index is above the square root of two.
TEST(ReferenceGlass, APrismReflectsAll) {
  for (const float ior : {1.38f, 1.45f}) {
    Scene scene;
    // In x and z: legs along z = 1 and x = -1.
    Primitive prism = Prism({{-1, -1}, {1, -1}, {-1, 1}}, -3, 3);
    Transform upright;  // y to -z
    upright.rotation = glm::dquat(std::sqrt(0.5), -std::sqrt(0.5), 0.0, 0.0);
    Add(scene, prism, AddMaterial(scene, SolidGlass(glm::vec3(1.0f), ior)), upright);
    Add(scene, Rectangle(-4, -4, 4, 4), AddMaterial(scene, Unlit({1, 0, 0, 1})), TurnedAboutY(0.5 * kPi, {-4, 0, 0}));
    Add(scene, Rectangle(-9, -9, 9, 9, -5), AddMaterial(scene, Unlit({0, 1, 0, 1})));
    const glm::dvec4 pixel = Seen(scene, OneRay(-0.3, 0.1));
    const bool is_total = double(ior) > std::sqrt(2.0);
    EXPECT_EQ(pixel.x > 0.9, is_total) << ior;
    EXPECT_EQ(pixel.y > 0.9, !is_total) << ior;
    EXPECT_EQ(std::min(pixel.x, pixel.y), 0.0);
  }
}

// The same, but open where the ray goes: it was to leave by the hypotenuse, which reflects all, and is in the medium
// for ever. What the medium does not absorb at all comes from nowhere; of the rest nothing comes.
TEST(ReferenceGlass, ARayThatNeverLeavesItsMedium) {
  Primitive open;
  open.positions = {{-1, -1, 0},  {1, -1, 0},  {1, 1, 0},  {-1, 1, 0},    // the leg that it enters by
                    {-1, -1, -3}, {-1, 1, -3}, {1, 1, -1}, {1, -1, -1}};  // the hypotenuse
  open.indices = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
  Material glass = SolidGlass(glm::vec3(1.0f), 1.5f);
  glass.attenuation_color = {0.9f, 1.0f, 0.9f};
  Scene scene;
  const int material = AddMaterial(scene, glass);
  Add(scene, open, material);
  const double left = ClosedForm(glm::dvec3(1.0), 0.0, kSmoothest).LeftAt(1.0);
  for (const bool absorbs : {false, true}) {
    if (absorbs) scene.materials[std::size_t(material)].attenuation_distance = 1e6f;
    const ReferenceFilm film = RenderReference(scene, OneRay(-0.3, 0.1), Effort(1, 1, 2));
    const double of_absorbed = absorbs ? 0.0 : left;
    ASSERT_EQ(film.through.size(), 1u);
    ExpectNear(film.through[0], {of_absorbed, left, of_absorbed}, 1e-6, "from nowhere");
    EXPECT_NEAR(film.pixels[0].w, 1.0 - (left + 2.0 * of_absorbed) / 3.0, 1e-6);
    EXPECT_EQ(glm::dvec3(film.pixels[0]), glm::dvec3(0.0));
    RenderSettings settings = OneRay(-0.3, 0.1);
    settings.environment = ConstantEnvironment(0.5f);
    settings.background = Background::Environment;
    const ReferenceFilm bright = RenderReference(scene, settings, Effort(64, 16, 16));
    EXPECT_TRUE(bright.through.empty());
    const double reflected = 0.5 * (1.0 - left);
    ExpectNear(glm::dvec3(bright.pixels[0]), glm::dvec3(of_absorbed, left, of_absorbed) * 0.5 + reflected, 2e-3, "lit");
  }
}

// Light that passes a surface diffusely is absorbed over the stated thickness, in metres.
TEST(ReferenceGlass, AVolumeAbsorbsWhatPassesDiffusely) {
  for (const float transmission : {0.0f, 0.5f}) {
    for (const bool from_behind : {false, true}) {
      Material material;
      material.metallic_factor = 0.0f;
      material.diffuse_transmission_factor = 1.0f;
      material.transmission_factor = transmission;
      material.ior = 1.0f;
      material.double_sided = true;
      Scene scene;
      const int index = AddMaterial(scene, material);
      Transform transform = TurnedAboutY(from_behind ? kPi : 0.0);
      transform.scale = glm::dvec3(0.5);
      Add(scene, Rectangle(-4, -4, 4, 4), index, transform);
      Light light;
      light.type = LightType::Directional;
      light.intensity = 3.0f;
      scene.lights.push_back(light);
      Node node;
      node.light = 0;
      node.transform = TurnedAboutY(2.8);
      scene.nodes.push_back(node);
      const glm::dvec4 thin = Seen(scene, OneRay());
      EXPECT_GT(thin.y, 0.1);
      Material& thick = scene.materials[std::size_t(index)];
      thick.thickness_factor = 0.6f;
      thick.attenuation_color = {0.5f, 1.0f, 0.25f};
      thick.attenuation_distance = 0.3f;
      const glm::dvec3 expected = from_behind ? glm::dvec3(1.0) : glm::dvec3(0.5, 1.0, 0.25);
      ExpectNear(glm::dvec3(Seen(scene, OneRay())) / glm::dvec3(thin), expected, 1e-6, "absorbed");
    }
  }
}

// Each channel is displaced by its own index: 20 / dispersion is the Abbe number.
TEST(ReferenceGlass, DispersionBendsEachChannelByItsOwn) {
  Material glass = SolidGlass(glm::vec3(1.0f), 1.6f);
  glass.dispersion = 2.0f;
  const double angle = 0.9, sine = std::sin(angle), spread = 0.6 * 0.025 * 2.0;
  Scene scene;
  Primitive card = Card(-6);
  for (std::size_t i = 0; i < 4; ++i) card.colors[i] = glm::vec4(glm::vec3(card.colors[i].x), 1.0f);
  Add(scene, card, AddMaterial(scene, Unlit(glm::vec4(1.0f))));
  const double bare = Seen(scene, OneRay()).x;
  EXPECT_NEAR(bare, 0.5, 1e-5);
  Add(scene, Box(4, 4, -0.75f, 0), AddMaterial(scene, glass), TurnedAboutY(angle));
  const glm::dvec4 pixel = Seen(scene, OneRay());
  const auto ramp = [&](double n) {
    const double shift = 0.75 * sine * (1.0 - std::cos(angle) / std::sqrt(n * n - sine * sine));
    return 0.5 - 0.5 * shift / kCard;
  };
  EXPECT_NEAR(pixel.x / pixel.y, ramp(1.6 - spread) / ramp(1.6), 1e-6);
  EXPECT_NEAR(pixel.z / pixel.y, ramp(1.6 + spread) / ramp(1.6), 1e-6);
}

// A solid inside another of the same index is not there, but for its tint; a hole is a hole.
TEST(ReferenceGlass, MediaInsideMedia) {
  const double angle = 0.5, d = 1.0, n = 1.5, sine = std::sin(angle);
  const auto displaced = [&](double thickness) {
    return -thickness * sine * (1.0 - std::cos(angle) / std::sqrt(n * n - sine * sine));
  };
  Scene scene;
  Add(scene, Card(-6), AddMaterial(scene, Unlit(glm::vec4(1.0f))));
  const int glass = AddMaterial(scene, SolidGlass(glm::vec3(1.0f), float(n)));
  Add(scene, Box(4, 4, -1, 0), glass, TurnedAboutY(angle));
  const glm::dvec4 alone = Seen(scene, OneRay());
  EXPECT_NEAR(PlaceOnCard(alone).x, displaced(d), 1e-5);
  // Tilted otherwise, so that it would bend the ray if it did.
  Add(scene, Box(0.6f, 0.6f, -0.1f, 0.1f), glass, TurnedAboutY(0.2, glm::dvec3(-0.25, 0, -0.45)));
  const glm::dvec4 filled = Seen(scene, OneRay());
  EXPECT_NEAR(PlaceOnCard(filled).x, displaced(d), 1e-5);
  EXPECT_LT(filled.z, 0.99 * alone.z);
  // A cavity is a part of the same mesh with its inside out.
  Scene hollow;
  Add(hollow, Card(-6), AddMaterial(hollow, Unlit(glm::vec4(1.0f))));
  AddMaterial(hollow, SolidGlass(glm::vec3(1.0f), float(n)));
  Primitive body = Box(4, 4, -1, 0), hole = Box(3, 3, -0.75f, -0.25f);
  for (std::size_t i = 0; i < hole.indices.size(); i += 3) std::swap(hole.indices[i], hole.indices[i + 1]);
  const auto offset = std::uint32_t(body.positions.size());
  body.positions.insert(body.positions.end(), hole.positions.begin(), hole.positions.end());
  for (const std::uint32_t i : hole.indices) body.indices.push_back(offset + i);
  Add(hollow, body, 1, TurnedAboutY(angle));
  EXPECT_NEAR(PlaceOnCard(Seen(hollow, OneRay())).x, displaced(0.5), 1e-5);
}

// White glass in constant light cannot be told from it. What is caught inside for too long is missing: under half a
// percent of a diamond's with a matt surface.
TEST(ReferenceGlass, WhiteFurnace) {
  for (const int shape : {0, 1, 2}) {
    for (const float roughness : {0.0f, 0.3f, 1.0f}) {
      for (const float ior : {1.2f, 1.5f, 2.4f}) {
        Scene scene;
        Material material =
            shape == 0 ? Glass(glm::vec3(1.0f), roughness) : SolidGlass(glm::vec3(1.0f), ior, roughness);
        material.ior = ior;
        material.dispersion = shape == 1 ? 1.0f : 0.0f;
        const int glass = AddMaterial(scene, material);
        if (shape < 2) Add(scene, Sphere(1.0f, 40, 80), glass);
        if (shape == 2) Add(scene, Box(0.6f, 0.8f, -0.7f, 0.7f), glass, TurnedAboutY(0.5));
        RenderSettings settings = Settings(8, 8, 4, Perspective(0.3, {0, 0, 8.0}));
        settings.environment = ConstantEnvironment(0.7f);
        settings.background = Background::Environment;
        const ReferenceFilm film = RenderReference(scene, settings, Effort(16, 4, 8));
        double sum = 0.0;
        for (std::size_t i = 0; i < film.pixels.size(); ++i) {
          EXPECT_NEAR(film.pixels[i].w, 1.0, 1e-12);
          sum += film.pixels[i].y / (0.7 * double(film.pixels.size()));
        }
        const std::string what = std::to_string(shape) + " " + std::to_string(roughness) + " " + std::to_string(ior);
        RecordProperty("furnace " + what, std::to_string(sum));
        const double noise = film.rms_error / (0.7 * std::sqrt(double(film.pixels.size())));
        EXPECT_LT(sum, 1.0 + 4.0 * noise) << what;
        EXPECT_GT(sum, 1.0 - 4.0 * noise - (ior > 2.0f && roughness == 0.3f ? 0.01 : 1e-4)) << what;
        EXPECT_LT(noise, 0.006) << what;
      }
    }
  }
}

// A thin wall scatters what is behind it as a white metal of that roughness reflects what is mirrored.
TEST(ReferenceGlass, ARoughPaneScattersAsItReflects) {
  const auto pane_or_metal = [](bool metal, float roughness) {
    Material material = Glass(glm::vec3(1.0f), roughness);
    if (metal) material.metallic_factor = 1.0f;
    Scene scene;
    Add(scene, Rectangle(-9, -9, 9, 9), AddMaterial(scene, material), TurnedAboutY(0.7));
    return scene;
  };
  // The same in front and behind: it changes with height only.
  auto image = std::make_shared<Image>();
  image->width = 16;
  image->height = 32;
  image->channels = 3;
  image->type = ChannelType::F32;
  image->encoding = Encoding::Linear;
  image->bytes.resize(image->PixelCount() * 3 * sizeof(float));
  for (std::size_t i = 0; i < image->PixelCount() * 3; ++i) image->As<float>()[i] = i / 48 % 8 < 4 ? 2.0f : 0.125f;
  for (const float roughness : {0.15f, 0.4f, 1.0f}) {
    RenderSettings settings = OneRay();
    settings.environment.kind = EnvironmentSettings::Kind::Image;
    settings.environment.image = image;
    const ReferenceSettings effort = Effort(256, 4, 32);
    const double left = ClosedForm(glm::dvec3(1.0), 0.0, double(roughness)).LeftAt(std::cos(0.7));
    const ReferenceFilm metal = RenderReference(pane_or_metal(true, roughness), settings, effort);
    const ReferenceFilm alone = RenderReference(pane_or_metal(false, roughness), settings, effort);
    settings.background = Background::Environment;
    const ReferenceFilm both = RenderReference(pane_or_metal(false, roughness), settings, effort);
    const double passed = both.pixels[0].x - alone.pixels[0].x, expected = left * metal.pixels[0].x;
    const double noise = both.standard_error[0].x + alone.standard_error[0].x + metal.standard_error[0].x;
    EXPECT_NEAR(passed, expected, 4.0 * noise + 1e-6) << roughness;
    EXPECT_LT(noise, 0.02 * expected) << roughness;
  }
}

// A lamp behind a thin wall by the same lobe, to the last digits.
TEST(ReferenceGlass, ALampBehindAPane) {
  for (const float roughness : {0.2f, 0.6f, 1.0f}) {
    const double tilt = 0.4, shine = 0.9;  // of the pane and the lamp, about +Y from +Z
    const auto scene_with = [&](bool metal) {
      Scene scene;
      Material material = Glass(glm::vec3(1.0f), roughness);
      if (metal) material.metallic_factor = 1.0f;
      Add(scene, Rectangle(-5, -5, 5, 5), AddMaterial(scene, material), TurnedAboutY(tilt));
      Light light;
      light.type = LightType::Directional;
      light.intensity = 3.0f;
      scene.lights.push_back(light);
      Node node;
      node.light = 0;
      // In front of the metal, and mirrored by the pane's plane, behind it.
      node.transform = TurnedAboutY(metal ? shine : kPi + 2.0 * tilt - shine);
      scene.nodes.push_back(node);
      return scene;
    };
    const double left = ClosedForm(glm::dvec3(1.0), 0.0, double(roughness)).LeftAt(std::cos(tilt));
    const double expected = left * Seen(scene_with(true), OneRay()).x;
    EXPECT_NEAR(Seen(scene_with(false), OneRay()).x / expected, 1.0, 1e-5) << roughness;
  }
}

// A ball of clear glass and one of rough glass in front of a striped wall.
TEST(ReferenceGlass, TheSameBitsOnAnyNumberOfThreads) {
  Scene scene;
  Material clear = SolidGlass({0.9f, 1.0f, 0.8f}, 1.5f);
  clear.dispersion = 3.0f;
  Transform left, right;
  left.translation.x = -0.6;
  right.translation.x = 0.6;
  Add(scene, Sphere(0.5f, 24, 48), AddMaterial(scene, clear), left);
  Add(scene, Sphere(0.5f, 24, 48), AddMaterial(scene, SolidGlass({0.5f, 0.9f, 1.0f}, 1.3f, 0.4f)), right);
  Add(scene, Card(-2), AddMaterial(scene, Unlit(glm::vec4(1.0f))));
  RenderSettings settings = Settings(16, 16, 4, Perspective(0.5, {0, 0, 5}));
  settings.environment.kind = EnvironmentSettings::Kind::Studio;
  settings.threads = 1;
  const ReferenceFilm one = RenderReference(scene, settings, Effort(4, 2, 3));
  for (const int threads : {2, 5}) {
    settings.threads = threads;
    const ReferenceFilm many = RenderReference(scene, settings, Effort(4, 2, 3));
    EXPECT_EQ(std::memcmp(one.pixels.data(), many.pixels.data(), one.pixels.size() * sizeof(glm::dvec4)), 0);
  }
}

}  // namespace
}  // namespace facet
