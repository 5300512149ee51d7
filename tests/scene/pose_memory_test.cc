// What posing a scene takes is charged before it is made: a few nodes may ask for any number of drawables, joint
// matrices and deformed copies.
#include <gtest/gtest.h>

#include "base/bytes_text.h"
#include "base/least_limit.h"
#include "scene/pose.h"
#include "scene_helpers.h"

namespace facet {
namespace {

constexpr std::uint64_t kMiB = 1 << 20;

// Refused under `small` by what it asks for, done under `large`.
void ExpectCharged(const Scene& scene, std::uint64_t small, std::uint64_t large, const std::string& what) {
  const std::string refusal = MemoryRefusalUnder(small, [&] { Pose(scene, {}); });
  EXPECT_NE(refusal.find(what), std::string::npos) << refusal;
  EXPECT_NE(refusal.find("and the memory limit is " + BytesText(double(small))), std::string::npos) << refusal;
  EXPECT_EQ(MemoryRefusalUnder(large, [&] { Pose(scene, {}); }), "");
}

TEST(PoseMemory, CountsInstancesTimesPrimitives) {
  Scene scene = SceneOf(Triangle());
  scene.meshes[0].primitives.resize(100, Triangle());
  scene.nodes[0].instances.resize(100);
  EXPECT_EQ(Pose(scene, {}).drawables.size(), 10000u);
  ExpectCharged(scene, kMiB, 16 * kMiB,
                "this needs " + BytesText(10000.0 * (sizeof(Drawable) + 64)) + " for drawables");
}

TEST(PoseMemory, CountsNodesTimesPrimitives) {
  Scene scene = SceneOf(Triangle());
  scene.meshes[0].primitives.resize(100, Triangle());
  scene.nodes.resize(100, scene.nodes[0]);
  ExpectCharged(scene, kMiB, 16 * kMiB, " for drawables");
}

TEST(PoseMemory, CountsTheJointsOfEveryNodesSkin) {
  constexpr std::size_t kNodes = 100, kJoints = 200;
  Primitive skinned = Triangle();
  skinned.joints = {std::vector<glm::u16vec4>(3, glm::u16vec4(0))};
  skinned.weights = {std::vector<glm::vec4>(3, glm::vec4(1, 0, 0, 0))};
  Scene scene = SceneOf(skinned);
  scene.skins.resize(1);
  scene.skins[0].joints.assign(kJoints, 0);
  scene.nodes[0].skin = 0;
  scene.nodes.resize(kNodes, scene.nodes[0]);
  EXPECT_TRUE(Pose(scene, {}).skinned);
  ExpectCharged(scene, 2 * kMiB, 16 * kMiB,
                BytesText(double(kNodes * kJoints * sizeof(glm::dmat4))) + " for joint matrices");
}

// Each node with other weights has a copy of its own.
TEST(PoseMemory, CountsDeformedCopies) {
  constexpr std::size_t kNodes = 50, kVertices = 3000;
  Primitive morphed;
  morphed.positions.assign(kVertices, glm::vec3(1));
  morphed.targets.resize(1);
  morphed.targets[0].positions.assign(kVertices, glm::vec3(1));
  Scene scene = SceneOf(morphed);
  scene.meshes[0].weights = {0.0f};
  for (std::size_t i = 0; i < kNodes; ++i) {
    scene.nodes.resize(i + 1, scene.nodes[0]);
    scene.nodes[i].weights = {float(i + 1)};
  }
  EXPECT_EQ(Pose(scene, {}).owned.size(), kNodes);
  ExpectCharged(scene, kNodes * kVertices * sizeof(glm::vec3) / 2, 16 * kMiB, " for posed geometry");
}

TEST(PoseMemory, IsGivenBack) {
  Scene scene = SceneOf(Triangle());
  scene.nodes[0].instances.resize(1000);
  MemoryBudget budget(16 * kMiB);
  const MemoryBudget::Scope scope(budget);
  Pose(scene, {});
  EXPECT_EQ(budget.Left(), budget.limit()) << "who keeps the posed scene charges it";
}

}  // namespace
}  // namespace facet
