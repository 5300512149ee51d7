#include <gtest/gtest.h>

#include "gltf_files.h"

namespace facet {
namespace {

using testing::FileMaker;
using testing::LoadBytes;
using testing::LoadError;
using testing::Pack;

const Primitive& First(const LoadedScene& loaded) { return loaded.scene.meshes.at(0).primitives.at(0); }

int Indices(FileMaker& file, int component_type, const std::string& bytes, std::size_t count) {
  const int accessor = file.Accessor(file.View(bytes), component_type, count, "SCALAR");
  file.PrimitiveMore() += ",\"indices\":" + std::to_string(accessor);
  return accessor;
}

TEST(Primitive, IndicesOfAllTypes) {
  const std::vector<std::uint32_t> expected{2, 0, 1};
  for (const auto& [type, bytes] : {std::pair<int, std::string>{5121, Pack<std::uint8_t>({2, 0, 1})},
                                    {5123, Pack<std::uint16_t>({2, 0, 1})},
                                    {5125, Pack<std::uint32_t>({2, 0, 1})}}) {
    FileMaker file;
    file.Attribute("POSITION", file.Triangle());
    Indices(file, type, bytes, 3);
    EXPECT_EQ(First(LoadBytes(file.AsGlb())).indices, expected) << type;
  }
}

TEST(Primitive, AllModes) {
  const Topology expected[] = {Topology::Points,    Topology::Lines,         Topology::LineLoop,   Topology::LineStrip,
                               Topology::Triangles, Topology::TriangleStrip, Topology::TriangleFan};
  for (int mode = 0; mode < 7; ++mode) {
    FileMaker file;
    file.Attribute("POSITION", file.Floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 2, 0, 0, 2, 1, 0}, "VEC3", 3));
    file.PrimitiveMore() = ",\"mode\":" + std::to_string(mode);
    const LoadedScene loaded = LoadBytes(file.AsGlb());
    EXPECT_EQ(First(loaded).topology, expected[mode]);
    EXPECT_TRUE(First(loaded).indices.empty());
    EXPECT_TRUE(loaded.report.warnings.empty());
  }
  FileMaker file;
  file.Attribute("POSITION", file.Triangle());
  file.PrimitiveMore() = ",\"mode\":7";
  LoadError(file.AsGlb(), ErrorCode::InvalidInput);
}

TEST(Primitive, IndicesOutOfRangeAndRestartsAreRefused) {
  FileMaker out;
  out.Attribute("POSITION", out.Triangle());
  Indices(out, 5123, Pack<std::uint16_t>({0, 1, 3}), 3);
  EXPECT_NE(LoadError(out.AsGlb(), ErrorCode::InvalidInput).find("index 3 is not one of 3"), std::string::npos);
  FileMaker restart;
  restart.Attribute("POSITION", restart.Triangle());
  Indices(restart, 5123, Pack<std::uint16_t>({0, 1, 0xFFFF}), 3);
  EXPECT_NE(LoadError(restart.AsGlb(), ErrorCode::InvalidInput).find("restart"), std::string::npos);
  FileMaker floats;
  floats.Attribute("POSITION", floats.Triangle());
  Indices(floats, 5126, Pack<float>({0, 1, 2}), 3);
  LoadError(floats.AsGlb(), ErrorCode::InvalidInput);
}

TEST(Primitive, LeftOverIndicesAreDroppedWithAWarning) {
  FileMaker file;
  file.Attribute("POSITION", file.Triangle());
  Indices(file, 5121, Pack<std::uint8_t>({0, 1, 2, 2, 1}), 5);
  const LoadedScene loaded = LoadBytes(file.AsGlb());
  EXPECT_EQ(First(loaded).indices.size(), 3u);
  EXPECT_EQ(loaded.report.warnings.size(), 1u);
}

TEST(Primitive, IndicesThatMakeNoTriangleDrawNone) {
  FileMaker file;
  file.Attribute("POSITION", file.Triangle());
  Indices(file, 5121, Pack<std::uint8_t>({0, 2}), 2);
  const LoadedScene loaded = LoadBytes(file.AsGlb());
  EXPECT_TRUE(loaded.scene.meshes.at(0).primitives.empty()) << "without indices all vertices would be drawn";
  EXPECT_EQ(loaded.report.warnings.size(), 1u);
}

TEST(Primitive, VerticesFarFromTheIndicesAreIgnored) {
  FileMaker file;
  file.Attribute("POSITION",
                 file.Floats({9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 0, 0, 0, 1, 0, 0, 0, 1, 0, 9, 9, 9}, "VEC3", 3));
  file.Attribute("TEXCOORD_0", file.Floats({9, 9, 9, 9, 9, 9, 9, 9, 0, 1, .5f, 0, 1, 1, 9, 9}, "VEC2", 2));
  Indices(file, 5121, Pack<std::uint8_t>({4, 5, 6}), 3);
  const LoadedScene loaded = LoadBytes(file.AsGlb());
  EXPECT_EQ(First(loaded).indices, (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(First(loaded).positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(First(loaded).tex_coords.at(0), (std::vector<glm::vec2>{{0, 1}, {.5f, 0}, {1, 1}}));
}

TEST(Primitive, AttributesOfTooFewElementsAreIgnored) {
  FileMaker file;
  file.Attribute("POSITION", file.Triangle());
  file.Attribute("TEXCOORD_0", file.Floats({0, 0, 1, 1}, "VEC2", 2));
  file.Attribute("TEXCOORD_1", file.Floats({0, 0, 1, 1, 2, 2, 3, 3}, "VEC2", 2));
  const LoadedScene loaded = LoadBytes(file.AsGlb());
  EXPECT_TRUE(First(loaded).tex_coords.at(0).empty());
  EXPECT_EQ(First(loaded).tex_coords.at(1), (std::vector<glm::vec2>{{0, 0}, {1, 1}, {2, 2}}));
  EXPECT_EQ(loaded.report.warnings.size(), 2u);
}

TEST(Primitive, WithoutVerticesOrIndicesItIsIgnored) {
  FileMaker vertices;
  vertices.Attribute("POSITION", vertices.Accessor(vertices.View("...."), 5126, 0, "VEC3"));
  FileMaker indices;
  indices.Attribute("POSITION", indices.Triangle());
  indices.PrimitiveMore() = ",\"indices\":" + std::to_string(indices.Accessor(-1, 5123, 0, "SCALAR"));
  for (const FileMaker& file : {vertices, indices}) {
    const LoadedScene loaded = LoadBytes(file.AsGlb());
    EXPECT_TRUE(loaded.scene.meshes.at(0).primitives.empty());
    ASSERT_EQ(loaded.report.warnings.size(), 1u);
    EXPECT_EQ(loaded.report.warnings[0].rfind("meshes[0].primitives[0]: ignored: the primitive has no ", 0), 0u);
  }
}

TEST(Primitive, WithoutPositionsItIsIgnored) {
  FileMaker file;
  file.Attribute("TEXCOORD_0", file.Floats({0, 0, 1, 1, 0, 1}, "VEC2", 2));
  const LoadedScene loaded = LoadBytes(file.AsGlb());
  EXPECT_TRUE(loaded.scene.meshes.at(0).primitives.empty());
  EXPECT_EQ(loaded.report.warnings.size(), 1u);
}

TEST(Primitive, NormalsAndTangentsAreMadeUnit) {
  FileMaker file;
  file.Attribute("POSITION", file.Triangle());
  file.Attribute("NORMAL", file.Floats({0, 0, 1, 0, 3, 4, 0, 0, 0}, "VEC3", 3));
  file.Attribute("TANGENT", file.Floats({1, 0, 0, 1, 2, 0, 0, -1, 0, 1, 0, .25f}, "VEC4", 4));
  const LoadedScene loaded = LoadBytes(file.AsGlb());
  EXPECT_EQ(First(loaded).normals[0], glm::vec3(0, 0, 1));
  EXPECT_NEAR(First(loaded).normals[1].y, 0.6f, 1e-7f);
  EXPECT_NEAR(First(loaded).normals[1].z, 0.8f, 1e-7f);
  EXPECT_EQ(First(loaded).normals[2], glm::vec3(0, 0, 1));
  EXPECT_EQ(First(loaded).tangents[1], glm::vec4(1, 0, 0, -1));
  EXPECT_EQ(First(loaded).tangents[2], glm::vec4(0, 1, 0, 1));
  EXPECT_EQ(loaded.report.warnings.size(), 2u) << "a zero normal, a handedness of 0.25";
}

TEST(Primitive, JointsAndWeightsOfManySets) {
  FileMaker file;
  file.Attribute("POSITION", file.Triangle());
  for (int set = 0; set < 3; ++set) {
    const auto joint = static_cast<std::uint8_t>(set);
    file.Attribute("JOINTS_" + std::to_string(set),
                   file.Accessor(file.View(Pack<std::uint8_t>({joint, 0, 0, 200, joint, 0, 0, 0, joint, 0, 0, 0}), 4),
                                 5121, 3, "VEC4"));
    file.Attribute("WEIGHTS_" + std::to_string(set),
                   file.Accessor(file.View(Pack<std::uint8_t>({255, 0, 0, 0, 51, 0, 0, 0, 0, 0, 0, 0}), 4), 5121, 3,
                                 "VEC4", ",\"normalized\":true"));
  }
  file.NodeMore() = ",\"skin\":0";
  file.NodesMore() = ",{},{},{}";
  file.RootMore() = ",\"skins\":[{\"joints\":[1,2,3]}]";
  const LoadedScene loaded = LoadBytes(file.AsGlb());
  ASSERT_EQ(First(loaded).joints.size(), 3u);
  EXPECT_EQ(First(loaded).joints[2][0], glm::u16vec4(2, 0, 0, 0)) << "200 has no weight, and is cleared";
  EXPECT_EQ(First(loaded).weights[1][1], glm::vec4(51.0f / 255.0f, 0, 0, 0));
  EXPECT_EQ(loaded.report.warnings,
            std::vector<std::string>{
                "meshes[0].primitives[0]: 1 vertices without weights follow the joint of their first slot"});
}

TEST(Primitive, AJointThatTheSkinDoesNotHaveIsRefused) {
  FileMaker file;
  file.Attribute("POSITION", file.Triangle());
  file.Attribute("JOINTS_0",
                 file.Accessor(file.View(Pack<std::uint16_t>({1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0})), 5123, 3, "VEC4"));
  file.Attribute("WEIGHTS_0", file.Floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4", 4));
  file.NodeMore() = ",\"skin\":0";
  file.NodesMore() = ",{}";
  file.RootMore() = ",\"skins\":[{\"joints\":[1]}]";
  EXPECT_NE(LoadError(file.AsGlb(), ErrorCode::InvalidInput).find("joint 1"), std::string::npos);
}

TEST(Primitive, MorphTargetsOfEveryAttribute) {
  FileMaker file;
  file.Attribute("POSITION", file.Triangle());
  file.Attribute("NORMAL", file.Floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3));
  file.Attribute("TEXCOORD_0", file.Floats({0, 0, 1, 0, 0, 1}, "VEC2", 2));
  file.Attribute("COLOR_0", file.Floats({1, 1, 1, 1, 1, 1, 1, 1, 1}, "VEC3", 3));
  const int position = file.Floats({0, 0, 5, 0, 0, 6, 0, 0, 7}, "VEC3", 3);
  const int tex_coord = file.Floats({-1, 0, -1, 0, -1, 0}, "VEC2", 2);
  const int color = file.Floats({-1, 0, 0, -1, 0, 0, -1, 0, 0}, "VEC3", 3);
  file.PrimitiveMore() = ",\"targets\":[{\"POSITION\":" + std::to_string(position) +
                         ",\"NORMAL\":" + std::to_string(position) + ",\"TEXCOORD_0\":" + std::to_string(tex_coord) +
                         ",\"COLOR_0\":" + std::to_string(color) + "},{}]";
  const LoadedScene loaded = LoadBytes(file.AsGlb());
  ASSERT_EQ(First(loaded).targets.size(), 2u);
  const MorphTarget& target = First(loaded).targets[0];
  EXPECT_EQ(target.positions[2], glm::vec3(0, 0, 7));
  EXPECT_EQ(target.normals[1], glm::vec3(0, 0, 6));
  EXPECT_EQ(target.tex_coords.at(0)[0], glm::vec2(-1, 0));
  EXPECT_EQ(target.colors[0], glm::vec4(-1, 0, 0, 0)) << "a displacement does not touch the alpha it does not name";
  EXPECT_TRUE(First(loaded).targets[1].positions.empty());
  EXPECT_EQ(loaded.scene.meshes[0].weights, (std::vector<float>{0, 0}));
  EXPECT_TRUE(loaded.report.warnings.empty());
}

TEST(Primitive, VariantsByIndex) {
  FileMaker file;
  file.Attribute("POSITION", file.Triangle());
  file.PrimitiveMore() = R"(,"material":0,"extensions":{"KHR_materials_variants":{"mappings":[
      {"material":2,"variants":[0,2]},{"material":1,"variants":[1]}]}})";
  file.RootMore() = R"(,"materials":[{},{},{}],"extensionsUsed":["KHR_materials_variants"],"extensions":{
      "KHR_materials_variants":{"variants":[{"name":"a"},{"name":"b"},{"name":"c"},{"name":"d"}]}})";
  const LoadedScene loaded = LoadBytes(file.AsGlb());
  EXPECT_EQ(loaded.scene.variants, (std::vector<std::string>{"a", "b", "c", "d"}));
  EXPECT_EQ(First(loaded).variant_materials, (std::vector<int>{2, 1, 2, -1}));
}

TEST(Primitive, OwnAttributesAreSilentAndUnknownOnesAreNot) {
  FileMaker file;
  file.Attribute("POSITION", file.Triangle());
  file.Attribute("_OWN", file.Triangle());
  EXPECT_TRUE(LoadBytes(file.AsGlb()).report.warnings.empty());
  file.Attribute("TEXCOORD_4000000000", file.Triangle());
  file.Attribute("FOO", file.Triangle());
  EXPECT_EQ(LoadBytes(file.AsGlb()).report.warnings.size(), 2u);
}

TEST(Primitive, DamagedDracoFallsBackOnlyWhereThereIsSomething) {
  FileMaker file;
  file.Attribute("POSITION", file.Triangle());
  const int packed = file.View("DRACO\2\2 no such thing");
  file.PrimitiveMore() = ",\"extensions\":{\"KHR_draco_mesh_compression\":{\"bufferView\":" + std::to_string(packed) +
                         ",\"attributes\":{\"POSITION\":0}}}";
  file.RootMore() = ",\"extensionsUsed\":[\"KHR_draco_mesh_compression\"]";
  const LoadedScene loaded = LoadBytes(file.AsGlb());
  EXPECT_EQ(First(loaded).positions.size(), 3u);
  EXPECT_EQ(loaded.report.warnings.size(), 1u);
  file.RootMore() += ",\"extensionsRequired\":[\"KHR_draco_mesh_compression\"]";
  LoadError(file.AsGlb(), ErrorCode::InvalidInput);
}

}  // namespace
}  // namespace facet
