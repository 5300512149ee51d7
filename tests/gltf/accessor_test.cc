// Accessors: component types, normalisation, strides, sparse replacement, bounds.
#include <gtest/gtest.h>

#include <cmath>

#include "gltf_files.h"

namespace facet {
namespace {

using testing::FileMaker;
using testing::LoadBytes;
using testing::LoadError;
using testing::Pack;

const Primitive& First(const LoadedScene& loaded) { return loaded.scene.meshes.at(0).primitives.at(0); }

TEST(Accessor, NormalizedUnsignedTexCoordsAndColors) {
  FileMaker file;
  file.Attribute("POSITION", file.Triangle());
  file.Attribute("TEXCOORD_0", file.Accessor(file.View(Pack<std::uint8_t>({0, 255, 51, 102, 0, 128, 1, 254}), 0), 5121,
                                             3, "VEC2", ",\"normalized\":true"));
  file.Attribute("TEXCOORD_1", file.Accessor(file.View(Pack<std::uint16_t>({0, 65535, 13107, 26214, 1, 65534})), 5123,
                                             3, "VEC2", ",\"normalized\":true"));
  file.Attribute("COLOR_0",
                 file.Accessor(file.View(Pack<std::uint8_t>({255, 51, 0, 0, 0, 255, 102, 0, 0, 0, 255, 0}), 4), 5121, 3,
                               "VEC3", ",\"normalized\":true"));
  const LoadedScene loaded = LoadBytes(file.AsGlb());
  const Primitive& p = First(loaded);
  EXPECT_TRUE(loaded.report.warnings.empty());
  EXPECT_EQ(p.tex_coords.at(0)[0], glm::vec2(0.0f, 1.0f));
  EXPECT_EQ(p.tex_coords[0][1], glm::vec2(51.0f / 255.0f, 102.0f / 255.0f));
  EXPECT_EQ(p.tex_coords[0][2], glm::vec2(0.0f, 128.0f / 255.0f));
  EXPECT_EQ(p.tex_coords.at(1)[1], glm::vec2(13107.0f / 65535.0f, 26214.0f / 65535.0f));
  EXPECT_EQ(p.colors[0], glm::vec4(1.0f, 51.0f / 255.0f, 0.0f, 1.0f)) << "RGB has alpha 1";
  EXPECT_EQ(p.colors[1], glm::vec4(0.0f, 1.0f, 102.0f / 255.0f, 1.0f));
}

TEST(Accessor, NormalizedSignedIntegersStopAtMinusOne) {
  // Morph targets keep signed values as they are, unlike normals, which are made unit.
  FileMaker file;
  file.Attribute("POSITION", file.Triangle());
  const int bytes = file.Accessor(file.View(Pack<std::int8_t>({-128, -127, 127, 0, 64, -64, 1, 0, 0, 0, 0, 0}), 4),
                                  5120, 3, "VEC3", ",\"normalized\":true");
  const int shorts =
      file.Accessor(file.View(Pack<std::int16_t>({-32768, -32767, 32767, 0, 16384, -1, 0, 0, 0, 0, 0, 0}), 8), 5122, 3,
                    "VEC3", ",\"normalized\":true");
  file.PrimitiveMore() =
      ",\"targets\":[{\"POSITION\":" + std::to_string(bytes) + "},{\"POSITION\":" + std::to_string(shorts) + "}]";
  const LoadedScene loaded = LoadBytes(file.AsGlb());
  const auto& targets = First(loaded).targets;
  ASSERT_EQ(targets.size(), 2u);
  EXPECT_EQ(targets[0].positions[0], glm::vec3(-1.0f, -1.0f, 1.0f));
  EXPECT_EQ(targets[0].positions[1], glm::vec3(64.0f / 127.0f, -64.0f / 127.0f, 1.0f / 127.0f));
  EXPECT_EQ(targets[1].positions[0], glm::vec3(-1.0f, -1.0f, 1.0f));
  EXPECT_EQ(targets[1].positions[1], glm::vec3(16384.0f / 32767.0f, -1.0f / 32767.0f, 0.0f));
}

TEST(Accessor, IntegersThatAreNotNormalizedKeepTheirValue) {
  FileMaker file;
  file.RootMore() =
      ",\"extensionsUsed\":[\"KHR_mesh_quantization\"],\"extensionsRequired\":[\"KHR_mesh_quantization\"]";
  file.Attribute("POSITION", file.Accessor(file.View(Pack<std::int16_t>({-300, 0, 7, 0, 1000, 0, 0, 0, 0, 1, 2, 0}), 8),
                                           5122, 3, "VEC3"));
  const LoadedScene loaded = LoadBytes(file.AsGlb());
  EXPECT_TRUE(loaded.report.warnings.empty());
  EXPECT_EQ(First(loaded).positions[0], glm::vec3(-300.0f, 0.0f, 7.0f));
  EXPECT_EQ(First(loaded).positions[1], glm::vec3(1000.0f, 0.0f, 0.0f));
}

TEST(Accessor, InterleavedAttributesHaveStrideAndOffset) {
  FileMaker file;
  const int view = file.View(Pack<float>({0, 0, 0, .25f, .5f, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}), 20);
  file.Attribute("POSITION", file.Accessor(view, 5126, 3, "VEC3"));
  file.Attribute("TEXCOORD_0", file.Accessor(view, 5126, 3, "VEC2", ",\"byteOffset\":12"));
  const LoadedScene loaded = LoadBytes(file.AsGlb());
  EXPECT_EQ(First(loaded).positions[2], glm::vec3(0, 1, 0));
  EXPECT_EQ(First(loaded).tex_coords[0][0], glm::vec2(.25f, .5f));
  EXPECT_EQ(First(loaded).tex_coords[0][2], glm::vec2(0, 1));
}

TEST(Accessor, LastElementNeedsNoPadding) {
  // The last vertex may end before its stride does: 2 * 16 + 12 bytes are enough for three.
  FileMaker file;
  file.Attribute("POSITION",
                 file.Accessor(file.View(Pack<float>({0, 0, 0, 9, 1, 0, 0, 9, 0, 1, 0}), 16), 5126, 3, "VEC3"));
  EXPECT_EQ(First(LoadBytes(file.AsGlb())).positions[2], glm::vec3(0, 1, 0));
}

TEST(Accessor, SparseReplacesWithAndWithoutBase) {
  const auto sparse = [](FileMaker& file) {
    const int indices = file.View(Pack<std::uint16_t>({1}));
    const int values = file.View(Pack<float>({5, 6, 7}));
    return ",\"sparse\":{\"count\":1,\"indices\":{\"bufferView\":" + std::to_string(indices) +
           ",\"componentType\":5123},\"values\":{\"bufferView\":" + std::to_string(values) + "}}";
  };
  FileMaker based;
  const std::string over_base = sparse(based);
  based.Attribute("POSITION",
                  based.Accessor(based.View(Pack<float>({1, 2, 3, 0, 0, 0, 4, 4, 4})), 5126, 3, "VEC3", over_base));
  const LoadedScene loaded_based = LoadBytes(based.AsGlb());
  EXPECT_EQ(First(loaded_based).positions[0], glm::vec3(1, 2, 3));
  EXPECT_EQ(First(loaded_based).positions[1], glm::vec3(5, 6, 7));
  EXPECT_EQ(First(loaded_based).positions[2], glm::vec3(4, 4, 4));

  FileMaker zeros;
  const std::string over_zeros = sparse(zeros);
  zeros.Attribute("POSITION", zeros.Accessor(-1, 5126, 3, "VEC3", over_zeros));
  const LoadedScene loaded_zeros = LoadBytes(zeros.AsGlb());
  EXPECT_EQ(First(loaded_zeros).positions[0], glm::vec3(0));
  EXPECT_EQ(First(loaded_zeros).positions[1], glm::vec3(5, 6, 7));
}

TEST(Accessor, SparseIndicesBeyondTheEndAreRefused) {
  FileMaker file;
  const int indices = file.View(Pack<std::uint8_t>({3}));
  const int values = file.View(Pack<float>({5, 6, 7}));
  file.Attribute(
      "POSITION",
      file.Accessor(-1, 5126, 3, "VEC3",
                    ",\"sparse\":{\"count\":1,\"indices\":{\"bufferView\":" + std::to_string(indices) +
                        ",\"componentType\":5121},\"values\":{\"bufferView\":" + std::to_string(values) + "}}"));
  EXPECT_NE(LoadError(file.AsGlb(), ErrorCode::InvalidInput).find("accessors[0].sparse.indices"), std::string::npos);
}

TEST(Accessor, ReachingPastTheViewIsRefusedWithItsPlace) {
  FileMaker file;
  file.Attribute("POSITION", file.Accessor(file.View(Pack<float>({0, 0, 0, 1, 1, 1})), 5126, 3, "VEC3"));
  const std::string message = LoadError(file.AsGlb(), ErrorCode::InvalidInput);
  EXPECT_EQ(message.find("test.glb: accessors[0]: 3 elements"), 0u) << message;

  FileMaker offset;
  offset.Attribute("POSITION", offset.Accessor(offset.View(Pack<float>({0, 0, 0, 1, 1, 1, 2, 2, 2})), 5126, 3, "VEC3",
                                               ",\"byteOffset\":9007199254740000"));
  LoadError(offset.AsGlb(), ErrorCode::InvalidInput);
}

TEST(Accessor, HugeCountsAreRefusedBeforeMemoryIsTaken) {
  for (const char* count : {"4294967295", "9007199254740991", "100000000"}) {
    FileMaker file;
    file.Attribute("POSITION", 0);
    file.RootMore() =
        ",\"accessors\":[{\"componentType\":5126,\"count\":" + std::string(count) + ",\"type\":\"VEC3\"}]";
    LoadError(file.AsGlb(), std::string(count).size() > 10 ? ErrorCode::Unsupported : ErrorCode::OutOfMemory);
  }
}

TEST(Accessor, FewBytesSharedByManyPrimitivesAreBounded) {
  // 2000 primitives of 65 536 unbacked vertices would take 1.5 GB.
  FileMaker file;
  file.Attribute("POSITION", file.Accessor(-1, 5126, 65536, "VEC3"));
  std::string& more = file.PrimitiveMore();
  for (int i = 0; i < 2000; ++i) more += "},{\"attributes\":{\"POSITION\":0}";
  LoadError(file.AsGlb(), ErrorCode::OutOfMemory);
}

TEST(Accessor, TheMemoryLimitHolds) {
  FileMaker file;
  file.Attribute("POSITION", file.Accessor(-1, 5126, 1000000, "VEC3"));
  LoadOptions options;
  options.memory_limit = 13'000'000;
  EXPECT_EQ(First(LoadBytes(file.AsGlb(), options)).positions.size(), 1000000u);
  options.memory_limit = 11'000'000;
  const std::string error = LoadError(file.AsGlb(), ErrorCode::OutOfMemory, options);
  EXPECT_NE(error.find("this needs 11.4 MiB for the scene"), std::string::npos) << error;
}

TEST(Accessor, WhatIsNotFiniteBecomesZeroWithOneWarning) {
  FileMaker file;
  const float inf = HUGE_VALF, nan = std::nanf("");
  file.Attribute("POSITION", file.Floats({inf, 1, nan, 1, -inf, 0, 0, 1, 0}, "VEC3", 3));
  const LoadedScene loaded = LoadBytes(file.AsGlb());
  EXPECT_EQ(First(loaded).positions[0], glm::vec3(0, 1, 0));
  EXPECT_EQ(First(loaded).positions[1], glm::vec3(1, 0, 0));
  ASSERT_EQ(loaded.report.warnings.size(), 1u);
  EXPECT_EQ(loaded.report.warnings[0],
            "meshes[0].primitives[0].attributes.POSITION: 3 numbers that are not finite were replaced by 0");
}

}  // namespace
}  // namespace facet
