// What a small file asks for is charged: where many parts of it share one, where no buffer holds the numbers, where
// they must be put in order. Each pair of files differs in what is read, and in nothing else that takes memory.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/least_limit.h"
#include "gltf_files.h"

namespace facet {
namespace {

using testing::FileMaker;
using testing::LoadBytes;
using testing::LoadError;
using testing::WithinMemory;

std::uint64_t LeastFor(const std::string& bytes) {
  const testing::TempFolder folder;
  const auto path = folder.Write("test.glb", bytes);
  return LeastLimit([&](std::uint64_t limit) { LoadGltf(path, WithinMemory(limit)); });
}

// The scene of `asks` takes from `least` bytes up to an eighth more than that of `others`, whose length is the same;
// with one byte less it is refused by its size.
void ExpectCharged(const std::string& asks, const std::string& others, std::uint64_t least) {
  ASSERT_EQ(asks.size(), others.size());
  const std::uint64_t with = LeastFor(asks), without = LeastFor(others);
  EXPECT_GE(with, without + least - least / 32);
  EXPECT_LE(with, without + least + least / 8 + 65536);
  const std::string refusal = LoadError(asks, ErrorCode::OutOfMemory, WithinMemory(with - 1));
  EXPECT_NE(refusal.find("this needs "), std::string::npos) << refusal;
  EXPECT_NE(refusal.find(" for the scene"), std::string::npos) << refusal;
  EXPECT_NE(refusal.find("and the memory limit is "), std::string::npos) << refusal;
}

// The same text where facet does not read `word`.
std::string Without(std::string text, const std::string& word) {
  std::string other = word;
  other.back() = '#';
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find('"' + word + '"', at)) != std::string::npos; ++count) {
    text.replace(at + 1, word.size(), other);
  }
  EXPECT_GT(count, 0u) << word;
  return text;
}

constexpr std::size_t kSparse = 50000;

// Points of which all are replaced, of which `primitives` primitives draw the first three.
std::string SparseFile(bool ascending, int primitives) {
  std::vector<std::uint32_t> targets(kSparse);
  for (std::size_t k = 0; k < kSparse; ++k) targets[k] = std::uint32_t(ascending ? k : kSparse - 1 - k);
  std::vector<float> values;
  for (std::size_t k = 0; k < kSparse; ++k) values.insert(values.end(), {float(targets[k]), 0.5f, -1.0f});
  const auto bytes = [](const auto& numbers) {
    return std::string(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(numbers[0]));
  };
  FileMaker file;
  const std::string index_view = std::to_string(file.View(bytes(targets)));
  const std::string value_view = std::to_string(file.View(bytes(values)));
  const std::string sparse = ",\"sparse\":{\"count\":" + std::to_string(kSparse) +
                             ",\"indices\":{\"bufferView\":" + index_view +
                             ",\"componentType\":5125},\"values\":{\"bufferView\":" + value_view + "}}";
  file.Attribute("POSITION", file.Accessor(-1, 5126, kSparse, "VEC3", sparse));
  const std::string corners =
      std::to_string(file.Accessor(file.View(testing::Pack<std::uint8_t>({0, 1, 2})), 5121, 3, "SCALAR"));
  file.PrimitiveMore() = ",\"indices\":" + corners;
  for (int i = 1; i < primitives; ++i) {
    file.PrimitiveMore() += "},{\"attributes\":{\"POSITION\":0},\"indices\":" + corners;
  }
  return file.AsGlb();
}

TEST(Budget, SparseElementsInDisorderAreChargedForPuttingThemInOrder) {
  const std::string disorder = SparseFile(false, 1);
  // A copy of the elements, and two lists of numbers while they are sorted.
  ExpectCharged(disorder, SparseFile(true, 1), kSparse * (3 * sizeof(float) + 2 * sizeof(std::uint32_t)));
  const LoadedScene loaded = LoadBytes(disorder);
  const auto& positions = loaded.scene.meshes.at(0).primitives.at(0).positions;
  ASSERT_EQ(positions.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(positions[i], glm::vec3(float(i), 0.5f, -1.0f));
}

TEST(Budget, ASparseAccessorIsReadOnceHoweverManyShareIt) {
  constexpr int kPrimitives = 16;
  const std::string shared = SparseFile(false, kPrimitives);
  EXPECT_LT(LeastFor(shared), LeastFor(SparseFile(false, 1)) + kSparse * sizeof(std::uint32_t));
  const LoadedScene loaded = LoadBytes(shared);
  ASSERT_EQ(loaded.scene.meshes.at(0).primitives.size(), std::size_t(kPrimitives));
  for (const Primitive& p : loaded.scene.meshes[0].primitives) EXPECT_EQ(p.positions.at(2), glm::vec3(2, 0.5f, -1));
  const auto& warnings = loaded.report.warnings;
  EXPECT_EQ(std::count_if(warnings.begin(), warnings.end(),
                          [](const std::string& w) { return w.find("do not increase") != std::string::npos; }),
            1);
}

TEST(Budget, CountsAPrimitivesMaterialsByVariant) {
  constexpr std::size_t kVariants = 2000, kPrimitives = 200;
  FileMaker file;
  file.Attribute("POSITION", file.Triangle());
  const std::string mapping =
      ",\"extensions\":{\"KHR_materials_variants\":{\"mappings\":[{\"material\":0,\"variants\":[0]}]}}";
  file.PrimitiveMore() = mapping;
  for (std::size_t i = 1; i < kPrimitives; ++i) {
    file.PrimitiveMore() += "},{\"attributes\":{\"POSITION\":0}" + mapping;
  }
  std::string names = "{\"name\":\"a\"}";
  for (std::size_t i = 1; i < kVariants; ++i) names += ",{\"name\":\"a\"}";
  file.RootMore() =
      ",\"materials\":[{}],\"extensionsUsed\":[\"KHR_materials_variants\"],\"extensions\":{\"KHR_"
      "materials_variants\":{\"variants\":[" +
      names + "]}}";
  const std::string asks = file.AsGlb();
  EXPECT_EQ(LoadBytes(asks).scene.meshes[0].primitives.back().variant_materials.size(), kVariants);
  ExpectCharged(asks, Without(asks, "mappings"), kVariants * kPrimitives * sizeof(int));
}

TEST(Budget, CountsMorphTargetsOfEveryPrimitive) {
  constexpr std::size_t kTargets = 16, kPrimitives = 8, kVertices = 1000;
  FileMaker file;
  file.Attribute("POSITION", file.Accessor(-1, 5126, kVertices, "VEC3"));
  std::string targets = ",\"mode\":0,\"targets\":[{\"POSITION\":0}";
  for (std::size_t i = 1; i < kTargets; ++i) targets += ",{\"POSITION\":0}";
  file.PrimitiveMore() = targets + "]";
  for (std::size_t i = 1; i < kPrimitives; ++i) {
    file.PrimitiveMore() += "},{\"attributes\":{\"POSITION\":0}" + targets + "]";
  }
  const std::string asks = file.AsGlb();
  ExpectCharged(asks, Without(asks, "targets"),
                kTargets * kPrimitives * (kVertices * sizeof(glm::vec3) + sizeof(MorphTarget)));
}

// Targets that hold nothing.
TEST(Budget, CountsEmptyMorphTargets) {
  constexpr std::size_t kTargets = 5000;
  FileMaker file;
  file.Attribute("POSITION", file.Triangle());
  std::string targets = "{}";
  for (std::size_t i = 1; i < kTargets; ++i) targets += ",{}";
  file.PrimitiveMore() = ",\"targets\":[" + targets + "]";
  const std::string asks = file.AsGlb();
  ExpectCharged(asks, Without(asks, "targets"), kTargets * sizeof(MorphTarget));
}

TEST(Budget, CountsTheMatricesOfEverySkin) {
  constexpr std::size_t kSkins = 40, kJoints = 400;
  FileMaker file;
  file.Attribute("POSITION", file.Triangle());
  const std::string matrices = std::to_string(file.Accessor(-1, 5126, kJoints, "MAT4"));
  std::string joints = "0";
  for (std::size_t i = 1; i < kJoints; ++i) joints += ",0";
  const std::string skin = "{\"joints\":[" + joints + "],\"inverseBindMatrices\":" + matrices + "}";
  std::string skins = skin;
  for (std::size_t i = 1; i < kSkins; ++i) skins += "," + skin;
  file.RootMore() = ",\"skins\":[" + skins + "]";
  const std::string asks = file.AsGlb();
  const LoadedScene loaded = LoadBytes(asks);
  ASSERT_EQ(loaded.scene.skins.size(), kSkins);
  EXPECT_EQ(loaded.scene.skins.back().inverse_bind.size(), kJoints);
  ExpectCharged(asks, Without(asks, "inverseBindMatrices"), kSkins * kJoints * sizeof(glm::mat4));
}

TEST(Budget, CountsTheInstancesOfEveryNode) {
  constexpr std::size_t kNodes = 10, kInstances = 10000;
  FileMaker file;
  file.Attribute("POSITION", file.Triangle());
  const std::string places = std::to_string(file.Accessor(-1, 5126, kInstances, "VEC3"));
  const std::string instances =
      ",\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{\"TRANSLATION\":" + places + "}}}";
  file.NodeMore() = instances;
  for (std::size_t i = 1; i < kNodes; ++i) file.NodesMore() += ",{\"mesh\":0" + instances + "}";
  file.RootMore() = ",\"extensionsUsed\":[\"EXT_mesh_gpu_instancing\"]";
  const std::string asks = file.AsGlb();
  const LoadedScene loaded = LoadBytes(asks);
  EXPECT_EQ(loaded.scene.nodes.back().instances.size(), kInstances);
  // The numbers of one accessor as well, while they are read.
  ExpectCharged(asks, Without(asks, "TRANSLATION"),
                kNodes * kInstances * sizeof(Transform) + kInstances * sizeof(glm::vec3));
}

// Curves of many channels that share their keys.
TEST(Budget, CountsTheKeysOfEveryChannel) {
  constexpr std::size_t kChannels = 100, kKeys = 1000;
  FileMaker file;
  file.Attribute("POSITION", file.Triangle());
  const std::string times = std::to_string(file.Accessor(-1, 5126, kKeys, "SCALAR"));
  const std::string values = std::to_string(file.Accessor(-1, 5126, kKeys, "VEC3"));
  std::string channels;
  for (std::size_t i = 0; i < kChannels; ++i) {
    channels += std::string(i ? "," : "") + "{\"sampler\":0,\"target\":{\"node\":" + std::to_string(i) +
                ",\"path\":\"translation\"}}";
    if (i > 0) file.NodesMore() += ",{}";
  }
  file.RootMore() = ",\"animations\":[{\"channels\":[" + channels + "],\"samplers\":[{\"input\":" + times +
                    ",\"output\":" + values + "}]}]";
  const std::string asks = file.AsGlb();
  EXPECT_EQ(LoadBytes(asks).scene.animations.at(0).channels.size(), kChannels);
  ExpectCharged(asks, Without(asks, "channels"), kChannels * kKeys * 4 * sizeof(float));
}

}  // namespace
}  // namespace facet
