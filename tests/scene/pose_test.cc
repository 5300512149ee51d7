#include "scene/pose.h"

#include <gtest/gtest.h>

#include <array>
#include <set>

#include "facet/error.h"
#include "facet/models.h"
#include "material/slots.h"
#include "scene/topology.h"
#include "scene_helpers.h"

namespace facet {
namespace {

ErrorCode CodeOf(const Scene& scene, const PoseSettings& settings) {
  try {
    Pose(scene, settings);
  } catch (const Error& error) {
    return error.code();
  }
  ADD_FAILURE() << "accepted";
  return ErrorCode::Internal;
}

TEST(Pose, MultipliesDownTheHierarchy) {
  Scene scene = SceneOf(Triangle());
  scene.nodes.resize(3);
  scene.nodes[0].transform.translation = {0, 0, 5};
  scene.nodes[1].children = {0};
  scene.nodes[1].transform.rotation = RotationAbout({0, 1, 0}, kTestPi / 2);
  scene.nodes[2].children = {1};
  scene.nodes[2].matrix = glm::dmat4(2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4, 0, 10, 20, 30, 1);
  const PosedScene posed = Pose(scene, {});
  ASSERT_EQ(posed.drawables.size(), 1u);
  // (x, y, z) -> (x, y, z + 5) -> (z + 5, y, -x) -> (2 z + 10 + 10, 3 y + 20, -4 x + 30)
  EXPECT_LT(Distance(WorldPosition(posed.drawables[0], 1), {20, 20, 26}), 1e-13);
  EXPECT_LT(Distance(WorldPosition(posed.drawables[0], 2), {20, 23, 30}), 1e-13);
  EXPECT_LT(Distance(posed.bounds.low, {20, 20, 26}), 1e-13);
  EXPECT_LT(Distance(posed.bounds.high, {20, 23, 30}), 1e-13);
}

TEST(Pose, RefersToUndeformedGeometry) {
  const Scene scene = SceneOf(Triangle());
  const PosedScene posed = Pose(scene, {});
  EXPECT_EQ(posed.drawables[0].geometry, &scene.meshes[0].primitives[0]);
  EXPECT_TRUE(posed.owned.empty());
}

TEST(Pose, VisibilityIsInherited) {
  Scene scene = SceneOf(Triangle());
  scene.nodes.resize(4);
  scene.lights.resize(1);
  scene.cameras.resize(1);
  scene.nodes[1].children = {0, 2, 3};
  scene.nodes[2].light = 0;
  scene.nodes[3].camera = 0;
  EXPECT_EQ(Pose(scene, {}).drawables.size(), 1u);
  EXPECT_EQ(Pose(scene, {}).lights.size(), 1u);
  EXPECT_EQ(Pose(scene, {}).cameras.size(), 1u);
  scene.nodes[1].visible = false;
  const PosedScene hidden = Pose(scene, {});
  EXPECT_TRUE(hidden.drawables.empty());
  EXPECT_TRUE(hidden.lights.empty());
  EXPECT_TRUE(hidden.bounds.empty);
  ASSERT_EQ(hidden.cameras.size(), 1u) << "KHR_node_visibility does not affect cameras";
  EXPECT_EQ(hidden.cameras[0].camera, 0);
}

TEST(Pose, ASceneThatBeginsAtAChildLeavesItsParentsOut) {
  Scene scene = SceneOf(Triangle());
  scene.cameras.resize(1);
  scene.nodes.resize(4);
  scene.nodes[0].transform.translation = {1, 0, 0};  // with the mesh
  scene.nodes[1].transform.translation = {10, 0, 0};
  scene.nodes[2].transform.translation = {100, 0, 0};
  scene.nodes[3].camera = 0;
  scene.nodes[2].children = {1};
  scene.nodes[1].children = {0, 3};
  const auto x_of = [&](const PoseSettings& settings) {
    return Pose(scene, settings).drawables.at(0).world_from_mesh[3].x;
  };
  scene.scenes = {{"whole", {2}}, {"child", {1}}, {"grandchild", {0}}, {"both", {0, 2}}};
  EXPECT_EQ(x_of({}), 111.0);
  EXPECT_EQ(x_of({.scene = 1}), 11.0);
  EXPECT_EQ(Pose(scene, {.scene = 1}).cameras.at(0).world_from_camera[3].x, 10.0);
  EXPECT_EQ(x_of({.scene = 2}), 1.0);
  EXPECT_EQ(x_of({.scene = 3}), 111.0) << "its parents are in the scene";
  scene.nodes[2].visible = false;
  EXPECT_EQ(x_of({.scene = 1}), 11.0) << "what is not in the scene hides nothing";
}

TEST(Pose, ChoosesTheScene) {
  Scene scene = SceneOf(Triangle());
  scene.nodes.resize(3);
  scene.nodes[1].mesh = scene.nodes[2].mesh = 0;
  EXPECT_EQ(Pose(scene, {}).drawables.size(), 3u) << "no scenes: every node without a parent";
  scene.scenes = {{"a", {2}}, {"b", {1, 0}}};
  EXPECT_EQ(Pose(scene, {}).drawables.size(), 1u);
  EXPECT_EQ(Pose(scene, {}).drawables[0].node, 2);
  scene.default_scene = 1;
  const PosedScene posed = Pose(scene, {});
  ASSERT_EQ(posed.drawables.size(), 2u);
  EXPECT_EQ(posed.drawables[0].node, 1);
  EXPECT_EQ(posed.drawables[1].node, 0);
  EXPECT_EQ(Pose(scene, {.scene = 0}).drawables[0].node, 2);
}

TEST(Pose, WalksDepthFirst) {
  Scene scene = SceneOf(Triangle());
  scene.nodes.resize(5);
  for (Node& node : scene.nodes) node.mesh = 0;
  scene.nodes[4].children = {2, 1};
  scene.nodes[2].children = {3, 0};
  const PosedScene posed = Pose(scene, {});
  std::vector<int> order;
  for (const Drawable& drawable : posed.drawables) order.push_back(drawable.node);
  EXPECT_EQ(order, (std::vector<int>{4, 2, 3, 0, 1}));
}

TEST(Pose, RefusesWhatDoesNotExist) {
  const Scene scene = SceneOf(Triangle());
  EXPECT_EQ(CodeOf(scene, {.scene = 0}), ErrorCode::InvalidUsage);
  EXPECT_EQ(CodeOf(scene, {.animation = 0}), ErrorCode::InvalidUsage);
  EXPECT_EQ(CodeOf(scene, {.variant = 2}), ErrorCode::InvalidUsage);
  EXPECT_EQ(CodeOf(scene, {.variant = -2}), ErrorCode::InvalidUsage);
  EXPECT_EQ(CodeOf(scene, {.time = std::nan("")}), ErrorCode::InvalidUsage);
  Scene broken = scene;
  broken.nodes[0].mesh = 9;
  EXPECT_EQ(CodeOf(broken, {}), ErrorCode::InvalidInput);
}

TEST(Pose, PlacesInstances) {
  Scene scene = SceneOf(Triangle());
  scene.nodes[0].transform.scale = {2, 2, 2};
  scene.nodes[0].instances = {{{1, 0, 0}}, {{0, 3, 0}, RotationAbout({0, 0, 1}, kTestPi / 2)}};
  const PosedScene posed = Pose(scene, {});
  ASSERT_EQ(posed.drawables.size(), 2u);
  EXPECT_EQ(WorldPosition(posed.drawables[0], 1), glm::dvec3(4, 0, 0));
  EXPECT_LT(Distance(WorldPosition(posed.drawables[1], 1), {0, 8, 0}), 1e-14);
  EXPECT_EQ(posed.drawables[0].geometry, posed.drawables[1].geometry);
  EXPECT_LT(Distance(posed.bounds.low, {-2, 0, 0}), 1e-14);
  EXPECT_LT(Distance(posed.bounds.high, {4, 8, 0}), 1e-14);
}

TEST(Pose, VariantsChooseMaterials) {
  Primitive primitive = Triangle();
  primitive.material = 0;
  primitive.variant_materials = {1, -1};
  Scene scene = SceneOf(primitive);
  scene.materials.resize(2);
  scene.variants = {"one", "two"};
  EXPECT_EQ(Pose(scene, {}).drawables[0].material, 0);
  EXPECT_EQ(Pose(scene, {.variant = 0}).drawables[0].material, 1);
  EXPECT_EQ(Pose(scene, {.variant = 1}).drawables[0].material, 0) << "left alone by this variant";
}

// Without what only shading reads, the scene's own geometry is drawn, and with tangents it is what Pose() draws.
TEST(Pose, LeavesCompletionToOthers) {
  Primitive strip;
  strip.topology = Topology::TriangleStrip;
  strip.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}, {0, 2, 0}};
  strip.normals.assign(5, {0, 0, 1});
  strip.tex_coords = {{}, {{0, 0}, {1, 0}, {0, 1}, {0.5f, 1}, {0, 0.3f}}};
  strip.material = 0;
  Scene scene = SceneOf(strip);
  AddNormalMap(scene);
  scene.materials[0].normal_texture.tex_coord = 1;
  Primitive morphed = strip, plain = strip, flat = strip;
  morphed.targets.resize(1);
  morphed.targets[0].positions.assign(5, {0, 0, 2});
  plain.material = -1;
  scene.meshes[0].primitives.push_back(morphed);
  scene.meshes[0].primitives.push_back(plain);
  flat.normals.clear();
  flat.topology = Topology::Triangles;
  flat.indices = {0, 1, 2};  // and no others, which normals of triangles' own lose
  scene.meshes[0].primitives.push_back(flat);
  scene.meshes[0].weights = {0.5f};
  scene.nodes.push_back(scene.nodes[0]);

  const PosedScene posed = PoseWithoutTangents(scene, {}), whole = Pose(scene, {});
  ASSERT_EQ(posed.drawables.size(), 8u);
  ASSERT_EQ(posed.needs_tangents.size(), 1u) << "not what is deformed, or has no normals or no normal map";
  EXPECT_EQ(posed.needs_tangents[0].drawables, (std::vector<std::size_t>{0, 4}));
  EXPECT_EQ(posed.needs_tangents[0].normal_map.tex_coord, 1);
  EXPECT_EQ(posed.drawables[0].geometry, &scene.meshes[0].primitives[0]);
  EXPECT_EQ(posed.drawables[4].geometry, &scene.meshes[0].primitives[0]);
  EXPECT_EQ(posed.drawables[1].geometry->tangents, whole.drawables[1].geometry->tangents);
  EXPECT_EQ(posed.drawables[1].geometry->positions[0].z, 1.0f);
  EXPECT_FALSE(posed.drawables[1].geometry->tangents.empty());
  EXPECT_EQ(posed.bounds.high, whole.bounds.high);
  // The same places, which decide how the scene is framed.
  for (std::size_t d = 0; d < posed.drawables.size(); ++d) {
    const auto places = [&](const PosedScene& p) {
      std::set<std::array<float, 3>> set;
      for (const glm::vec3& v : p.drawables[d].geometry->positions) set.insert({v.x, v.y, v.z});
      return set;
    };
    EXPECT_EQ(places(posed), places(whole)) << d;
  }
  EXPECT_EQ(posed.drawables[3].geometry->positions.size(), 3u);

  EXPECT_TRUE(whole.needs_tangents.empty());
  EXPECT_EQ(whole.drawables[0].geometry, whole.drawables[4].geometry) << "made once";
  const Primitive& expected = *whole.drawables[0].geometry;
  const Primitive with_tangents = WithTangents(strip, scene.materials[0].normal_texture);
  EXPECT_EQ(with_tangents.tangents, expected.tangents);
  EXPECT_EQ(with_tangents.normals, expected.normals);
  EXPECT_EQ(with_tangents.indices, expected.indices);
  // Triangle by triangle the same positions: what was cut and binned before names the same triangles after.
  ASSERT_EQ(PrimitiveCount(with_tangents), PrimitiveCount(strip));
  for (std::uint32_t t = 0; t < PrimitiveCount(strip); ++t) {
    const auto before = PrimitiveVertices(strip, t), after = PrimitiveVertices(with_tangents, t);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(with_tangents.positions[after[k]], strip.positions[before[k]]) << t << " " << k;
    }
  }
}

TEST(Pose, AnimatesNodes) {
  Scene scene = SceneOf(Triangle());
  scene.nodes[0].transform.scale = {3, 3, 3};
  scene.animations.resize(1);
  scene.animations[0].channels = {
      {0, AnimationPath::Translation, Interpolation::Linear, {0.0f, 2.0f}, {0, 0, 0, 4, 0, 0}},
      {-1, AnimationPath::Translation, Interpolation::Step, {0.0f}, {9, 9, 9}}};
  EXPECT_EQ(WorldPosition(Pose(scene, {.animation = 0, .time = 1.0}).drawables[0], 1), glm::dvec3(5, 0, 0));
  EXPECT_EQ(WorldPosition(Pose(scene, {.animation = 0, .time = 7.0}).drawables[0], 1), glm::dvec3(7, 0, 0));
  EXPECT_EQ(WorldPosition(Pose(scene, {.time = 1.0}).drawables[0], 1), glm::dvec3(3, 0, 0)) << "rest pose";
  // A matrix's parts stay unless they are animated.
  scene.nodes[0].matrix = glm::dmat4(0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 7, 7, 7, 1);
  EXPECT_LT(Distance(WorldPosition(Pose(scene, {.animation = 0, .time = 1.0}).drawables[0], 1), {2, 2, 0}), 1e-14);
}

TEST(Pose, LightsShineAlongTheirNodes) {
  Scene scene;
  scene.lights.resize(1);
  scene.nodes.resize(1);
  scene.nodes[0].light = 0;
  scene.nodes[0].transform = {{1, 2, 3}, RotationAbout({0, 1, 0}, kTestPi / 2), {5, 5, 5}};
  const PosedScene posed = Pose(scene, {});
  ASSERT_EQ(posed.lights.size(), 1u);
  EXPECT_EQ(posed.lights[0].position_world, glm::dvec3(1, 2, 3));
  EXPECT_LT(Distance(posed.lights[0].direction_world, {-1, 0, 0}), 1e-15);
}

TEST(Pose, BoundsSkipVerticesThatAreNotFinite) {
  Primitive primitive = Triangle();
  primitive.positions.push_back({std::numeric_limits<float>::quiet_NaN(), 100, 100});
  primitive.positions.push_back({std::numeric_limits<float>::infinity(), 100, 100});
  const PosedScene posed = Pose(SceneOf(primitive), {});
  EXPECT_EQ(posed.bounds.low, glm::dvec3(0, 0, 0));
  EXPECT_EQ(posed.bounds.high, glm::dvec3(1, 1, 0));
}

TEST(Pose, BoundsOfTurnedMeshesAreThoseOfTheirVertices) {
  Primitive primitive;  // a diamond: turned by 45 degrees a square, whose box is smaller than the box's box
  primitive.positions = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  primitive.indices = {0, 1, 2, 2, 3, 0};
  Scene scene = SceneOf(primitive);
  scene.nodes[0].transform.rotation = RotationAbout({0, 0, 1}, kTestPi / 4);
  const Bounds bounds = Pose(scene, {}).bounds;
  EXPECT_NEAR(bounds.high.x, std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(bounds.low.y, -std::sqrt(0.5), 1e-15);
}

TEST(Pose, MirrorsAndZeroScalesStayFinite) {
  Scene scene = SceneOf(Triangle());
  scene.nodes[0].transform.scale = {-1, 0, 1};
  const PosedScene posed = Pose(scene, {});
  EXPECT_EQ(posed.bounds.low, glm::dvec3(-1, 0, 0));
  EXPECT_EQ(posed.bounds.high, glm::dvec3(0, 0, 0));
  const Bounds bounds = PosedBounds(scene, {});
  EXPECT_EQ(bounds.low, posed.bounds.low);
  EXPECT_EQ(bounds.high, posed.bounds.high);
}

// Tangents cost time and split vertices: they are made only where shading reads them.
TEST(Pose, MakesNoTangentsThatNobodyReads) {
  Primitive square;
  square.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  square.tex_coords = {{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};
  square.material = 0;
  for (const Topology topology : {Topology::Points, Topology::Lines, Topology::LineLoop, Topology::LineStrip,
                                  Topology::Triangles, Topology::TriangleStrip, Topology::TriangleFan}) {
    square.topology = topology;
    square.indices = topology == Topology::Triangles ? std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}
                                                     : std::vector<std::uint32_t>{};
    Scene scene = SceneOf(square);
    AddNormalMap(scene);
    const auto has_tangents = [](const Scene& s) {
      const Primitive* geometry = Pose(s, {}).drawables[0].geometry;
      return geometry != &s.meshes[0].primitives[0];
    };
    EXPECT_EQ(has_tangents(scene), topology >= Topology::Triangles);
    scene.materials[0].model = ShadingModel::Unlit;
    EXPECT_FALSE(has_tangents(scene)) << "unlit";
    scene.materials[0].model = ShadingModel::MetallicRoughness;
    scene.textures[0].image = -1;
    EXPECT_FALSE(has_tangents(scene)) << "a texture without image";
  }
}

TEST(Pose, MakesTangentsAnewWhereAsked) {
  Primitive primitive = Triangle();
  primitive.normals.assign(3, {0, 0, 1});
  primitive.tex_coords = {{{0, 0}, {1, 0}, {0, 1}}};
  primitive.tangents.assign(3, {0, 1, 0, 1});  // not what the UVs say
  primitive.material = 0;
  Scene scene = SceneOf(primitive);
  AddNormalMap(scene);
  PoseSettings settings;
  EXPECT_EQ(Pose(scene, settings).drawables[0].geometry->tangents[0].y, 1.0f);
  settings.generate_tangents = true;
  const PosedScene posed = Pose(scene, settings);
  EXPECT_EQ(posed.drawables[0].geometry->tangents[0], glm::vec4(1, 0, 0, posed.drawables[0].geometry->tangents[0].w));
}

TEST(Pose, MakesTheTangentsThatNormalMapsNeed) {
  Primitive strip;
  strip.topology = Topology::TriangleStrip;
  strip.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}};
  strip.tex_coords = {{{0, 1}, {1, 1}, {0, 0}, {1, 0}}};
  strip.tangents.assign(4, {0, 0, 1, 1});  // of no use without normals
  strip.material = 0;
  Scene scene = SceneOf(strip);
  AddNormalMap(scene);
  scene.nodes.push_back(scene.nodes[0]);
  const PosedScene posed = Pose(scene, {});
  ASSERT_EQ(posed.drawables.size(), 2u);
  EXPECT_EQ(posed.drawables[0].geometry, posed.drawables[1].geometry) << "completed once, shared";
  const Primitive& made = *posed.drawables[0].geometry;
  EXPECT_EQ(made.topology, Topology::Triangles);
  ASSERT_EQ(made.positions.size(), 6u);
  ASSERT_EQ(made.normals.size(), 6u);
  ASSERT_EQ(made.tangents.size(), 6u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(made.normals[i], glm::vec3(0, 0, 1));
    EXPECT_LT(Distance(glm::dvec3(made.tangents[i]), {1, 0, 0}), 1e-7);
    EXPECT_EQ(made.tangents[i].w, 1.0f);
  }
  // The second triangle, (1, 0, 0) (1, 1, 1) (0, 1, 0), keeps the strip's winding: its normal looks up too.
  const glm::dvec3 expected = glm::normalize(glm::dvec3(-1, -1, 1));
  EXPECT_LT(Distance(glm::dvec3(made.normals[5]), expected), 1e-7);

  scene.materials[0].normal_texture.texture = -1;
  EXPECT_EQ(Pose(scene, {}).drawables[0].geometry, &scene.meshes[0].primitives[0]) << "without a normal map";
}

// --- Anisotropy, which needs tangents even without a texture
// ----------------------------------------------------------

// A right triangle in the plane z = 0 with normals along z, anisotropic.
Scene AnisotropicTriangle() {
  Primitive primitive = Triangle();
  primitive.normals.assign(3, {0, 0, 1});
  primitive.material = 0;
  Scene scene = SceneOf(primitive);
  scene.materials.resize(1);
  scene.materials[0].anisotropy_strength = 0.5f;
  return scene;
}

Primitive& Only(Scene& scene) { return scene.meshes[0].primitives[0]; }

std::vector<glm::vec4> PosedTangents(const Scene& scene, const PoseSettings& settings = {}) {
  return Pose(scene, settings).drawables[0].geometry->tangents;
}

TEST(PoseForAnisotropy, TangentsFollowTheFirstUvSet) {
  Scene scene = AnisotropicTriangle();
  Only(scene).tex_coords = {{{0, 0}, {0, 1}, {-1, 0}}, {{0, 0}, {1, 0}, {0, 1}}};  // u runs along -y
  const std::vector<glm::vec4> tangents = PosedTangents(scene);
  ASSERT_EQ(tangents.size(), 3u);
  for (const glm::vec4& t : tangents) EXPECT_LT(Distance(glm::dvec3(t), {0, -1, 0}), 1e-6);
  EXPECT_TRUE(scene.meshes[0].primitives[0].tangents.empty());

  // A texture in tangent space names another set, and so decides.
  AddNormalMap(scene);
  scene.materials[0].anisotropy_strength = 0.5f;
  scene.materials[0].normal_texture.tex_coord = 1;
  for (const glm::vec4& t : PosedTangents(scene)) EXPECT_LT(Distance(glm::dvec3(t), {1, 0, 0}), 1e-6);
  std::swap(scene.materials[0].normal_texture, scene.materials[0].anisotropy_texture);
  for (const glm::vec4& t : PosedTangents(scene)) EXPECT_LT(Distance(glm::dvec3(t), {1, 0, 0}), 1e-6);
  // One without a picture is none.
  scene.textures[0].image = -1;
  for (const glm::vec4& t : PosedTangents(scene)) EXPECT_LT(Distance(glm::dvec3(t), {0, -1, 0}), 1e-6);
}

TEST(PoseForAnisotropy, WithoutUvsTangentsArePerpendicularToNormals) {
  for (const bool empty_set : {false, true}) {
    Scene scene = AnisotropicTriangle();
    if (empty_set) Only(scene).tex_coords.resize(1);
    const std::vector<glm::vec4> tangents = PosedTangents(scene);
    ASSERT_EQ(tangents.size(), 3u);
    for (const glm::vec4& t : tangents) {
      EXPECT_NEAR(glm::length(glm::vec3(t)), 1.0f, 1e-6f);
      EXPECT_NEAR(t.z, 0.0f, 1e-6f);
      EXPECT_EQ(t, tangents[0]) << "one plane has one direction";
    }
    Only(scene).normals.clear();  // flat
    const PosedScene posed = Pose(scene, {});
    const Primitive& flat = *posed.drawables[0].geometry;
    ASSERT_EQ(flat.tangents.size(), 3u);
    for (std::size_t v = 0; v < 3; ++v) {
      EXPECT_NEAR(glm::dot(glm::vec3(flat.tangents[v]), flat.normals[v]), 0.0f, 1e-6f);
    }
  }
}

TEST(PoseForAnisotropy, TheFilesTangentsStay) {
  Scene scene = AnisotropicTriangle();
  Only(scene).tangents.assign(3, {0.6f, 0.8f, 0, -1});
  EXPECT_EQ(PosedTangents(scene), Only(scene).tangents);
  EXPECT_TRUE(Pose(scene, {}).owned.empty());
  EXPECT_NE(PosedTangents(scene, {.generate_tangents = true}), Only(scene).tangents);
}

TEST(PoseForAnisotropy, NothingIsMadeWhereNothingReadsIt) {
  const Scene scene = AnisotropicTriangle();
  PoseSettings without;
  without.without.Add(Feature::Anisotropy);
  EXPECT_TRUE(PosedTangents(scene, without).empty());
  const auto expect_none = [](Scene changed, const char* why) {
    const PosedScene posed = Pose(changed, {});
    EXPECT_TRUE(posed.owned.empty()) << why;
    EXPECT_TRUE(posed.needs_tangents.empty()) << why;
  };
  Scene changed = scene;
  changed.materials[0].anisotropy_strength = 0.0f;
  changed.materials[0].anisotropy_rotation = 1.0f;
  expect_none(changed, "no strength");
  changed = scene;
  changed.materials[0].model = ShadingModel::Unlit;
  expect_none(changed, "unlit");
  for (const Topology topology : {Topology::Points, Topology::Lines, Topology::LineLoop, Topology::LineStrip}) {
    changed = scene;
    Only(changed).topology = topology;
    Only(changed).indices =
        topology == Topology::Lines ? std::vector<std::uint32_t>{0, 1} : std::vector<std::uint32_t>{};
    expect_none(changed, "points and lines have none");
  }
}

// Whatever the order of a model's rows, the normal texture decides, and each is left out by its own feature.
TEST(PoseForAnisotropy, OtherModelsHaveTheSameRule) {
  Scene scene = AnisotropicTriangle();
  Only(scene).tex_coords = {{{0, 0}, {1, 0}, {0, 1}}, {{0, 0}, {0, 1}, {-1, 0}}};
  AddNormalMap(scene);
  TextureRef second{.texture = 0};
  second.tex_coord = 1;
  FilamentParameters p;
  p.clear_coat.value = 1.0f;
  p.clear_coat_normal.texture.texture = 0;
  p.normal.texture = second;
  const auto tangents = [&](const FilamentParameters& parameters, std::initializer_list<Feature> without) {
    scene.materials[0] = Material();
    scene.materials[0].model = ShadingModel::Filament;
    scene.materials[0].parameters = std::make_shared<const ModelParameters>(parameters);
    PoseSettings settings;
    settings.without = without;
    return PosedTangents(scene, settings);
  };
  const auto along = [](const std::vector<glm::vec4>& all, const glm::dvec3& direction) {
    return all.size() == 3 && Distance(glm::dvec3(all[0]), direction) < 1e-6;
  };
  EXPECT_TRUE(along(tangents(p, {}), {0, -1, 0})) << "by the second set";
  EXPECT_TRUE(along(tangents(p, {Feature::Clearcoat}), {0, -1, 0}));
  EXPECT_TRUE(along(tangents(p, {Feature::NormalTexture}), {1, 0, 0})) << "by that of the coat";
  EXPECT_TRUE(tangents(p, {Feature::NormalTexture, Feature::Clearcoat}).empty());
  FilamentParameters bent;
  bent.bent_normal.texture = second;
  EXPECT_TRUE(along(tangents(bent, {Feature::Anisotropy}), {0, -1, 0}));
  EXPECT_TRUE(tangents(bent, {Feature::Occlusion}).empty());
  FilamentParameters brushed;
  brushed.anisotropy.value = 0.5f;
  EXPECT_TRUE(along(tangents(brushed, {Feature::Clearcoat}), {1, 0, 0}));
  EXPECT_TRUE(tangents(brushed, {Feature::Anisotropy}).empty());
}

TEST(PoseForAnisotropy, DeformedSurfacesTakeTheirTangentsAlong) {
  Scene scene = AnisotropicTriangle();
  Only(scene).tex_coords = {{{0, 0}, {1, 0}, {0, 1}}};
  Only(scene).joints = {{glm::u16vec4(0), glm::u16vec4(0), glm::u16vec4(0)}};
  Only(scene).weights = {{glm::vec4(1, 0, 0, 0), glm::vec4(1, 0, 0, 0), glm::vec4(1, 0, 0, 0)}};
  scene.skins.resize(1);
  scene.skins[0].joints = {1};
  scene.nodes[0].skin = 0;
  scene.nodes.resize(2);
  scene.nodes[1].transform.rotation = RotationAbout({0, 0, 1}, kTestPi / 2);
  const PosedScene posed = Pose(scene, {});
  const Drawable& drawable = posed.drawables[0];
  ASSERT_EQ(drawable.geometry->tangents.size(), 3u);
  for (const glm::vec4& t : drawable.geometry->tangents) {
    const glm::dvec3 world = glm::dmat3(drawable.world_from_mesh) * glm::dvec3(t);
    EXPECT_LT(Distance(world, {0, 1, 0}), 1e-6);
  }
}

}  // namespace
}  // namespace facet
