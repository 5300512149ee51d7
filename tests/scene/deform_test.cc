#include <gtest/gtest.h>

#include <cstring>

#include "base/parallel.h"
#include "facet/error.h"
#include "scene/pose.h"
#include "scene_helpers.h"

namespace facet {
namespace {

// --- Morph targets --------------------------------------------------------------------------------------------------

Scene Morphing() {
  Primitive primitive = Triangle();
  primitive.normals.assign(3, {0, 0, 1});
  primitive.tangents.assign(3, {1, 0, 0, -1});
  primitive.tex_coords = {{{0, 0}, {1, 0}, {0, 1}}, {{5, 5}, {5, 5}, {5, 5}}};
  primitive.colors.assign(3, {0.5f, 0.5f, 0.5f, 1});
  primitive.targets.resize(2);
  primitive.targets[0].positions = {{0, 0, 1}, {0, 0, 2}, {0, 0, 4}};
  primitive.targets[0].normals.assign(3, {1, 0, 0});
  primitive.targets[0].tangents.assign(3, {0, 0, -1});
  primitive.targets[1].positions = {{1, 0, 0}, {1, 0, 0}, {1, 0, 0}};
  primitive.targets[1].tex_coords = {{}, {{1, 2}, {1, 2}, {1, 2}}};
  primitive.targets[1].colors.assign(3, {0.5f, 0.25f, 2.0f, -1});
  Scene scene = SceneOf(primitive);
  scene.meshes[0].weights = {0, 0};
  return scene;
}

TEST(Morph, AddsWeightedDisplacements) {
  Scene scene = Morphing();
  EXPECT_TRUE(Pose(scene, {}).owned.empty()) << "all weights zero: nothing to deform";
  scene.nodes[0].weights = {1.0f, -0.5f};
  const PosedScene posed = Pose(scene, {});
  const Primitive& made = *posed.drawables[0].geometry;
  EXPECT_EQ(made.positions[0], glm::vec3(-0.5f, 0, 1));
  EXPECT_EQ(made.positions[2], glm::vec3(-0.5f, 1, 4));
  const float h = float(std::sqrt(0.5));
  EXPECT_EQ(made.normals[1], glm::vec3(h, 0, h)) << "unit again";
  EXPECT_EQ(made.tangents[1], glm::vec4(h, 0, -h, -1)) << "handedness is not morphed";
  EXPECT_EQ(made.tex_coords[0][1], glm::vec2(1, 0));
  EXPECT_EQ(made.tex_coords[1][1], glm::vec2(4.5f, 4));
  EXPECT_EQ(made.colors[0], glm::vec4(0.25f, 0.375f, 0, 1)) << "clamped to [0, 1]";
  EXPECT_EQ(posed.bounds.low, glm::dvec3(-0.5, 0, 1));
  EXPECT_EQ(posed.bounds.high, glm::dvec3(0.5, 1, 4));
  EXPECT_TRUE(made.targets.empty());
}

TEST(Morph, WeightsComeFromAnimationNodeAndMeshInThisOrder) {
  Scene scene = Morphing();
  scene.meshes[0].weights = {1, 0};
  EXPECT_EQ(Pose(scene, {}).bounds.high.z, 4.0);
  scene.nodes[0].weights = {2, 0};
  EXPECT_EQ(Pose(scene, {}).bounds.high.z, 8.0);
  scene.animations.resize(1);
  scene.animations[0].channels = {{0, AnimationPath::Weights, Interpolation::Linear, {0.0f, 1.0f}, {0, 0, 1, 0}}};
  EXPECT_EQ(Pose(scene, {.animation = 0, .time = 0.75}).bounds.high.z, 3.0);
  EXPECT_EQ(PosedBounds(scene, {.animation = 0, .time = 0.75}).high.z, 3.0);
}

TEST(Morph, FlatNormalsForNormalMapsFollowTheMorphedSurface) {
  Scene scene = Morphing();
  Primitive& primitive = scene.meshes[0].primitives[0];
  primitive.normals.clear();
  primitive.tangents.clear();
  primitive.targets[0].normals.clear();
  primitive.targets[0].tangents.clear();
  primitive.material = 0;
  AddNormalMap(scene);
  scene.nodes[0].weights = {1, 0};
  const PosedScene posed = Pose(scene, {});
  // (0,0,1) (1,0,2) (0,1,4): edges (1,0,1), (0,1,3); normal (-1,-3,1)
  const glm::dvec3 normal(posed.drawables[0].geometry->normals[0]);
  EXPECT_LT(Distance(normal, glm::normalize(glm::dvec3(-1, -3, 1))), 1e-7);
}

// --- Skins ----------------------------------------------------------------------------------------------------------

// A bar along +Y from 0 to 2. The lower end follows joint node 1 at the origin, the upper end joint node 2 at
// (0, 1, 0), the middle both.
Scene BentBar(double bend_radians) {
  Primitive bar;
  bar.positions = {{-1, 0, 0}, {1, 0, 0}, {-1, 1, 0}, {1, 1, 0}, {-1, 2, 0}, {1, 2, 0}};
  bar.normals.assign(6, {0, 1, 0});
  bar.tangents.assign(6, {1, 0, 0, 1});
  bar.indices = {0, 1, 3, 0, 3, 2, 2, 3, 5, 2, 5, 4};
  const glm::vec4 low(1, 0, 0, 0), both(0.5f, 0.5f, 0, 0), high(0, 1, 0, 0);
  bar.joints = {std::vector<glm::u16vec4>(6, glm::u16vec4(0, 1, 0, 0))};
  bar.weights = {{low, low, both, both, high, high}};
  Scene scene = SceneOf(bar);
  scene.nodes.resize(3);
  scene.nodes[0].transform.translation = {100, 200, 300};  // without effect on a skinned mesh
  scene.nodes[0].skin = 0;
  scene.nodes[1].children = {2};
  scene.nodes[2].transform.translation = {0, 1, 0};
  scene.nodes[2].transform.rotation = RotationAbout({0, 0, 1}, bend_radians);
  glm::mat4 inverse(1.0f);
  inverse[3] = glm::vec4(0, -1, 0, 1);
  scene.skins.push_back({"bar", {1, 2}, {glm::mat4(1.0f), inverse}});
  return scene;
}

TEST(Skin, BendsABar) {
  const PosedScene posed = Pose(BentBar(kTestPi / 2), {});
  const Drawable& bar = posed.drawables[0];
  EXPECT_LT(Distance(WorldPosition(bar, 0), {-1, 0, 0}), 1e-6);
  // Turned by 90 degrees around (0, 1): (x, y) -> (1 - y, 1 + x).
  EXPECT_LT(Distance(WorldPosition(bar, 4), {-1, 0, 0}), 1e-6);
  EXPECT_LT(Distance(WorldPosition(bar, 5), {-1, 2, 0}), 1e-6);
  // The mean of both.
  EXPECT_LT(Distance(WorldPosition(bar, 3), glm::dvec3(0.5, 1.5, 0)), 1e-6);
  EXPECT_LT(Distance(glm::dvec3(bar.geometry->normals[5]), {-1, 0, 0}), 1e-6);
  EXPECT_LT(Distance(glm::dvec3(bar.geometry->tangents[5]), {0, 1, 0}), 1e-6);
  EXPECT_LT(Distance(glm::dvec3(bar.geometry->normals[3]), glm::normalize(glm::dvec3(-1, 1, 0))), 1e-6);
  EXPECT_LT(Distance(posed.bounds.low, {-1, 0, 0}), 1e-6);
  EXPECT_LT(Distance(posed.bounds.high, {1, 2, 0}), 1e-6);
  const Bounds bounds = PosedBounds(BentBar(kTestPi / 2), {});
  EXPECT_EQ(bounds.low, posed.bounds.low);
  EXPECT_EQ(bounds.high, posed.bounds.high);
}

TEST(Skin, WeightsAreDividedByTheirSum) {
  Scene scene = BentBar(0.7);
  const PosedScene before = Pose(scene, {});
  for (glm::vec4& weights : scene.meshes[0].primitives[0].weights[0]) weights *= 4.0f;
  const PosedScene after = Pose(scene, {});
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(before.drawables[0].geometry->positions[i], after.drawables[0].geometry->positions[i]);
  }
}

TEST(Skin, SeveralSetsOfInfluencesAddUp) {
  Scene scene = BentBar(0.7);
  const PosedScene before = Pose(scene, {});
  Primitive& bar = scene.meshes[0].primitives[0];
  bar.joints.assign(3, std::vector<glm::u16vec4>(6, glm::u16vec4(9)));  // of no weight, so of no harm
  const auto weights = bar.weights[0];
  bar.weights.assign(3, std::vector<glm::vec4>(6, glm::vec4(0)));
  for (std::size_t i = 0; i < 6; ++i) {
    bar.joints[0][i].w = 0;
    bar.weights[0][i].w = weights[i].x;
    bar.joints[2][i].y = 1;
    bar.weights[2][i].y = weights[i].y;
  }
  const PosedScene after = Pose(scene, {});
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(before.drawables[0].geometry->positions[i], after.drawables[0].geometry->positions[i]);
  }
}

TEST(Skin, WithoutWeightsTheFirstJointPlacesTheVertex) {
  Scene scene = BentBar(0.7), expected = scene;
  Primitive& bar = scene.meshes[0].primitives[0];
  for (const std::size_t i : {2u, 5u}) {
    bar.weights[0][i] = glm::vec4(0);
    bar.joints[0][i] = glm::u16vec4(i == 2 ? 0 : 1, 0, 1, 1);
    expected.meshes[0].primitives[0].joints[0][i] = bar.joints[0][i];
    expected.meshes[0].primitives[0].weights[0][i] = glm::vec4(1, 0, 0, 0);
  }
  const PosedScene posed = Pose(scene, {}), right = Pose(expected, {});
  for (std::size_t i = 0; i < bar.positions.size(); ++i) {
    EXPECT_EQ(WorldPosition(posed.drawables[0], i), WorldPosition(right.drawables[0], i)) << i;
  }
  // A joint that there is not can place nothing: the node does.
  bar.joints[0][5].x = 9;
  EXPECT_LT(Distance(WorldPosition(Pose(scene, {}).drawables[0], 5), {101, 202, 300}), 1e-5);
}

TEST(Skin, RefusesJointsThatDoNotExist) {
  Scene scene = BentBar(0.7);
  scene.meshes[0].primitives[0].joints[0][3].y = 2;
  try {
    Pose(scene, {});
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
    EXPECT_NE(std::string(error.what()).find("vertex 3 follows joint 2"), std::string::npos) << error.what();
  }
}

TEST(Skin, KeepsPrecisionFarFromTheOrigin) {
  Scene near_scene = BentBar(0.7), far_scene = BentBar(0.7);
  far_scene.nodes[1].transform.translation = {1e8, -1e8, 1e8};
  const PosedScene near_pose = Pose(near_scene, {}), far_pose = Pose(far_scene, {});
  for (std::size_t i = 0; i < 6; ++i) {
    const glm::dvec3 offset = WorldPosition(far_pose.drawables[0], i) - WorldPosition(near_pose.drawables[0], i);
    EXPECT_LT(Distance(offset, {1e8, -1e8, 1e8}), 1e-7);
  }
}

TEST(Skin, NormalsUseTheInverseTranspose) {
  Scene scene = BentBar(0.0);
  scene.nodes[1].transform.scale = {1, 4, 1};
  for (glm::vec3& normal : scene.meshes[0].primitives[0].normals) normal = glm::normalize(glm::vec3(1, 1, 0));
  const PosedScene posed = Pose(scene, {});
  EXPECT_LT(Distance(glm::dvec3(posed.drawables[0].geometry->normals[0]), glm::normalize(glm::dvec3(4, 1, 0))), 1e-6);
  // Flattened onto a plane there is no inverse, but a normal.
  scene.nodes[1].transform.scale = {1, 0, 1};
  const PosedScene flat = Pose(scene, {});
  EXPECT_LT(Distance(glm::dvec3(flat.drawables[0].geometry->normals[0]), {0, 1, 0}), 1e-6);
}

TEST(Skin, MirrorsShowInTheDeterminant) {
  Scene scene = BentBar(0.0);
  scene.nodes[1].transform.scale = {-1, 1, 1};
  for (glm::vec3& normal : scene.meshes[0].primitives[0].normals) normal = glm::normalize(glm::vec3(1, 1, 0));
  const PosedScene posed = Pose(scene, {});
  const Drawable& bar = posed.drawables[0];
  EXPECT_LT(glm::determinant(glm::dmat3(bar.world_from_mesh)), 0.0) << "so that the winding is turned";
  EXPECT_LT(Distance(WorldPosition(bar, 1), {-1, 0, 0}), 1e-6);
  const glm::dvec3 normal_world = glm::dmat3(bar.world_from_mesh) * glm::dvec3(bar.geometry->normals[1]);
  EXPECT_LT(Distance(normal_world, glm::normalize(glm::dvec3(-1, 1, 0))), 1e-6);
  EXPECT_EQ(bar.geometry->tangents[1].w, 1.0f);
}

TEST(Skin, GoesAfterMorph) {
  Scene scene = BentBar(kTestPi / 2);
  Primitive& bar = scene.meshes[0].primitives[0];
  bar.targets.resize(1);
  bar.targets[0].positions.assign(6, {0, 0, 3});
  bar.targets[0].positions[5] = {1, 0, 0};
  scene.nodes[0].weights = {1};
  const PosedScene posed = Pose(scene, {});
  EXPECT_LT(Distance(WorldPosition(posed.drawables[0], 5), {-1, 3, 0}), 1e-6);  // (2, 2, 0) turned
  EXPECT_LT(Distance(WorldPosition(posed.drawables[0], 0), {-1, 0, 3}), 1e-6);
}

// --- Threads --------------------------------------------------------------------------------------------------------

// Large enough for several pieces of work.
Scene LargeScene() {
  constexpr int kSide = 200;
  Primitive grid;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const float u = float(x) / kSide, v = float(y) / kSide;
      grid.positions.push_back({u, v, u * v});
      grid.normals.push_back(glm::normalize(glm::vec3(-v, -u, 1)));
      grid.weights.resize(1);
      grid.joints.resize(1);
      grid.joints[0].push_back({0, 1, 0, 1});
      grid.weights[0].push_back({u, v, 0.1f, u * v});
    }
  }
  grid.tex_coords.resize(1);
  for (const glm::vec3& p : grid.positions) grid.tex_coords[0].push_back({p.x * p.x, p.y});
  for (std::uint32_t y = 0; y + 1 < kSide; ++y) {
    for (std::uint32_t x = 0; x + 1 < kSide; ++x) {
      const std::uint32_t i = y * kSide + x;
      grid.indices.insert(grid.indices.end(), {i, i + 1, i + kSide, i + 1, i + kSide + 1, i + kSide});
    }
  }
  grid.material = 0;
  grid.targets.resize(1);
  grid.targets[0].positions.assign(grid.positions.size(), {0.1f, 0.2f, 0.3f});
  Scene scene = BentBar(1.0);
  scene.meshes[0].primitives = {grid, grid, grid};
  scene.nodes[0].weights = {0.37f};
  AddNormalMap(scene);
  return scene;
}

template <class T>
bool SameBits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

TEST(Pose, IsTheSameForAnyNumberOfThreads) {
  const Scene scene = LargeScene();
  PosedScene reference;
  RunWithThreads(1, [&] { reference = Pose(scene, {}); });
  for (const int threads : {2, 3, 8}) {
    PosedScene posed;
    RunWithThreads(threads, [&] { posed = Pose(scene, {}); });
    ASSERT_EQ(posed.drawables.size(), reference.drawables.size());
    EXPECT_EQ(std::memcmp(&posed.bounds.low, &reference.bounds.low, 2 * sizeof(glm::dvec3)), 0);
    for (std::size_t i = 0; i < posed.drawables.size(); ++i) {
      const Primitive &a = *posed.drawables[i].geometry, &b = *reference.drawables[i].geometry;
      EXPECT_TRUE(SameBits(a.positions, b.positions));
      EXPECT_TRUE(SameBits(a.normals, b.normals));
      EXPECT_TRUE(SameBits(a.tangents, b.tangents));
      EXPECT_TRUE(SameBits(a.indices, b.indices));
    }
  }
}

}  // namespace
}  // namespace facet
