// EXT_meshopt_compression, against meshoptimizer's own encoders.
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <cmath>

#include "gltf_files.h"

namespace facet {
namespace {

using testing::FileMaker;
using testing::LoadBytes;
using testing::LoadError;

const Primitive& First(const LoadedScene& loaded) { return loaded.scene.meshes.at(0).primitives.at(0); }

constexpr std::size_t kSide = 17, kCount = kSide * kSide;

std::vector<glm::vec3> GridPositions() {
  std::vector<glm::vec3> positions;
  for (std::size_t i = 0; i < kCount; ++i)
    positions.emplace_back(float(i % kSide), float(i / kSide), float(i % 7) * 0.125f);
  return positions;
}

std::vector<std::uint32_t> GridIndices() {
  std::vector<std::uint32_t> indices;
  constexpr std::uint32_t side = kSide;
  for (std::uint32_t y = 0; y + 1 < side; ++y) {
    for (std::uint32_t x = 0; x + 1 < side; ++x) {
      const std::uint32_t i = y * side + x;
      for (const std::uint32_t k : {i, i + 1, i + side, i + 1, i + 1 + side, i + side}) indices.push_back(k);
    }
  }
  return indices;
}

std::string PackVertices(const void* data, std::size_t count, std::size_t stride) {
  std::string packed(meshopt_encodeVertexBufferBound(count, stride), '\0');
  packed.resize(
      meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(packed.data()), packed.size(), data, count, stride));
  return packed;
}

// A view of `count` elements that unpacks from `packed`. Its own bytes, the fallback, are zeros.
int PackedView(FileMaker& file, const std::string& packed, std::size_t count, std::size_t stride,
               const std::string& mode, const std::string& filter = {}) {
  file.View(packed);
  const std::size_t offset = file.Bin().size() - packed.size();
  return file.View(std::string(count * stride, '\0'), 0,
                   ",\"extensions\":{\"EXT_meshopt_compression\":{\"buffer\":0,\"byteOffset\":" +
                       std::to_string(offset) + ",\"byteLength\":" + std::to_string(packed.size()) +
                       ",\"byteStride\":" + std::to_string(stride) + ",\"count\":" + std::to_string(count) +
                       ",\"mode\":\"" + mode + "\"" + (filter.empty() ? "" : ",\"filter\":\"" + filter + "\"") + "}}");
}

TEST(Meshopt, AttributesAndTriangles) {
  const auto positions = GridPositions();
  const auto indices = GridIndices();
  std::string packed_indices(meshopt_encodeIndexBufferBound(indices.size(), kCount), '\0');
  packed_indices.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(packed_indices.data()),
                                                  packed_indices.size(), indices.data(), indices.size()));
  FileMaker file;
  file.Attribute("POSITION",
                 file.Accessor(PackedView(file, PackVertices(positions.data(), kCount, 12), kCount, 12, "ATTRIBUTES"),
                               5126, kCount, "VEC3"));
  const int index_view = PackedView(file, packed_indices, indices.size(), 4, "TRIANGLES");
  file.PrimitiveMore() = ",\"indices\":" + std::to_string(file.Accessor(index_view, 5125, indices.size(), "SCALAR"));
  file.RootMore() =
      ",\"extensionsUsed\":[\"EXT_meshopt_compression\"],\"extensionsRequired\":[\"EXT_meshopt_compression\"]";
  const LoadedScene loaded = LoadBytes(file.AsGlb());
  EXPECT_TRUE(loaded.report.warnings.empty());
  EXPECT_EQ(First(loaded).positions, positions);
  // The codec may rotate a triangle's corners.
  ASSERT_EQ(First(loaded).indices.size(), indices.size());
  for (std::size_t t = 0; t < indices.size(); t += 3) {
    const std::uint32_t* got = First(loaded).indices.data() + t;
    const std::uint32_t* want = indices.data() + t;
    const bool same = (got[0] == want[0] && got[1] == want[1] && got[2] == want[2]) ||
                      (got[0] == want[1] && got[1] == want[2] && got[2] == want[0]) ||
                      (got[0] == want[2] && got[1] == want[0] && got[2] == want[1]);
    ASSERT_TRUE(same) << "triangle " << t / 3;
  }
}

TEST(Meshopt, IndexSequences) {
  const std::vector<std::uint32_t> indices{0, 5, 5, 9, 288, 1, 2};
  std::string packed(meshopt_encodeIndexSequenceBound(indices.size(), kCount), '\0');
  packed.resize(meshopt_encodeIndexSequence(reinterpret_cast<unsigned char*>(packed.data()), packed.size(),
                                            indices.data(), indices.size()));
  const auto positions = GridPositions();
  FileMaker file;
  file.Attribute("POSITION",
                 file.Accessor(PackedView(file, PackVertices(positions.data(), kCount, 12), kCount, 12, "ATTRIBUTES"),
                               5126, kCount, "VEC3"));
  const int view = PackedView(file, packed, indices.size(), 2, "INDICES");
  file.PrimitiveMore() =
      ",\"mode\":3,\"indices\":" + std::to_string(file.Accessor(view, 5123, indices.size(), "SCALAR"));
  EXPECT_EQ(First(LoadBytes(file.AsGlb())).indices, indices);
}

TEST(Meshopt, Filters) {
  // Octahedral normals, exponential positions and quaternions come back within their quantisation.
  std::vector<glm::vec4> normals, rotations;
  std::vector<glm::vec3> positions;
  for (std::size_t i = 0; i < kCount; ++i) {
    const glm::vec3 n = glm::normalize(glm::vec3(float(i % 5) - 2.0f, float(i % 3) - 1.0f, float(i % 7) - 2.5f));
    normals.emplace_back(n, 0.0f);
    rotations.push_back(glm::normalize(glm::vec4(n, float(i % 4))));
    positions.push_back(glm::vec3(n) * std::ldexp(1.0f, int(i % 9)));
  }
  std::vector<std::int16_t> octahedral(kCount * 4), quaternions(kCount * 4);
  std::vector<std::uint32_t> exponential(kCount * 3);
  meshopt_encodeFilterOct(octahedral.data(), kCount, 8, 12, &normals[0].x);
  meshopt_encodeFilterQuat(quaternions.data(), kCount, 8, 12, &rotations[0].x);
  meshopt_encodeFilterExp(exponential.data(), kCount, 12, 15, &positions[0].x);
  FileMaker file;
  const auto attribute = [&](const std::string& packed, std::size_t stride, const char* filter) {
    return PackedView(file, packed, kCount, stride, "ATTRIBUTES", filter);
  };
  file.Attribute("POSITION", file.Accessor(attribute(PackVertices(exponential.data(), kCount, 12), 12, "EXPONENTIAL"),
                                           5126, kCount, "VEC3"));
  file.Attribute("NORMAL", file.Accessor(attribute(PackVertices(octahedral.data(), kCount, 8), 8, "OCTAHEDRAL"), 5122,
                                         kCount, "VEC4", ",\"normalized\":true"));
  // NORMAL must be VEC3: the same view, read with a stride of 8.
  const std::string json = file.Json();
  std::string fixed = json;
  const std::size_t at = fixed.find("\"type\":\"VEC4\"");
  ASSERT_NE(at, std::string::npos);
  fixed.replace(at, 13, "\"type\":\"VEC3\"");
  const std::size_t filter = fixed.find("\"filter\":\"OCTAHEDRAL\"");
  const std::size_t view = fixed.rfind("\"byteOffset\"", fixed.rfind("\"extensions\"", filter));
  fixed.insert(view, "\"byteStride\":8,");
  const LoadedScene loaded = LoadBytes(testing::Glb(fixed, file.Bin()));
  for (std::size_t i = 0; i < kCount; ++i) {
    ASSERT_LT(glm::length(First(loaded).normals[i] - glm::vec3(normals[i])), 2e-3f) << i;
    ASSERT_LT(glm::length(First(loaded).positions[i] - positions[i]), 1e-3f * glm::length(positions[i])) << i;
  }
}

TEST(Meshopt, QuaternionsOfAnimations) {
  std::vector<glm::vec4> rotations;
  for (int i = 0; i < 32; ++i) rotations.push_back(glm::normalize(glm::vec4(float(i), 3.0f, float(i % 5), 7.0f)));
  std::vector<std::int16_t> packed(rotations.size() * 4);
  meshopt_encodeFilterQuat(packed.data(), rotations.size(), 8, 14, &rotations[0].x);
  FileMaker file;
  std::string times;
  file.Attribute("POSITION", file.Triangle());
  for (int i = 0; i < 32; ++i) times += testing::Pack({float(i)});
  const int input = file.Accessor(file.View(times), 5126, 32, "SCALAR");
  const int output =
      file.Accessor(PackedView(file, PackVertices(packed.data(), 32, 8), 32, 8, "ATTRIBUTES", "QUATERNION"), 5122, 32,
                    "VEC4", ",\"normalized\":true");
  file.RootMore() =
      ",\"animations\":[{\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"rotation\"}}],\"samplers\":[{"
      "\"input\":" +
      std::to_string(input) + ",\"output\":" + std::to_string(output) + "}]}]";
  const LoadedScene loaded = LoadBytes(file.AsGlb());
  const auto& values = loaded.scene.animations.at(0).channels.at(0).values;
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    const glm::vec4 q(values[i * 4], values[i * 4 + 1], values[i * 4 + 2], values[i * 4 + 3]);
    ASSERT_GT(std::fabs(glm::dot(q, rotations[i])), 0.9999f) << i;
  }
}

TEST(Meshopt, DamageIsAnErrorOrTheFallback) {
  const auto positions = GridPositions();
  std::string packed = PackVertices(positions.data(), kCount, 12);
  packed.resize(packed.size() / 2);
  FileMaker file;
  file.Attribute("POSITION", file.Accessor(PackedView(file, packed, kCount, 12, "ATTRIBUTES"), 5126, kCount, "VEC3"));
  file.RootMore() = ",\"extensionsUsed\":[\"EXT_meshopt_compression\"]";
  file.PrimitiveMore() = ",\"mode\":0";
  const LoadedScene loaded = LoadBytes(file.AsGlb());
  EXPECT_EQ(loaded.report.warnings.size(), 1u);
  EXPECT_EQ(First(loaded).positions.size(), kCount) << "the view's own bytes";
  file.RootMore() += ",\"extensionsRequired\":[\"EXT_meshopt_compression\"]";
  EXPECT_NE(LoadError(file.AsGlb(), ErrorCode::InvalidInput).find("EXT_meshopt_compression"), std::string::npos);
}

TEST(Meshopt, ClaimsBeyondTheBytesAreRefusedBeforeMemoryIsTaken) {
  FileMaker file;
  std::string json = R"({"asset":{"version":"2.0"},"extensionsRequired":["EXT_meshopt_compression"],
      "buffers":[{"byteLength":64},
      {"byteLength":4000000000000,"extensions":{"EXT_meshopt_compression":{"fallback":true}}}],
      "bufferViews":[{"buffer":1,"byteLength":4000000000000,"byteStride":16,"extensions":{"EXT_meshopt_compression":
      {"buffer":0,"byteLength":64,"byteStride":16,"count":250000000000,"mode":"ATTRIBUTES"}}}],
      "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}]})";
  LoadError(testing::Glb(json, std::string(64, 'x')), ErrorCode::InvalidInput);
}

}  // namespace
}  // namespace facet
