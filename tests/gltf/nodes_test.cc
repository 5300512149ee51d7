// Nodes, scenes, cameras, lights, instances.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "gltf_files.h"

namespace facet {
namespace {

using testing::FileMaker;
using testing::LoadBytes;
using testing::LoadError;
using testing::Pack;

std::string Root(const std::string& members) { return R"({"asset":{"version":"2.0"},)" + members + "}"; }

TEST(Nodes, TransformsAndMatrices) {
  const LoadedScene loaded = LoadBytes(Root(R"("nodes":[{"name":"a","translation":[1,2,3],"rotation":[0,0,2,0],
      "scale":[1,-1,0],"children":[1]},{"matrix":[1,0,0,0,0,2,0,0,0,0,3,0,4,5,6,1]},{"rotation":[0,0,0,0]}])"));
  const Node& node = loaded.scene.nodes.at(0);
  EXPECT_EQ(node.name, "a");
  EXPECT_EQ(node.transform.translation, glm::dvec3(1, 2, 3));
  EXPECT_EQ(node.transform.rotation, glm::dquat(0, 0, 0, 1)) << "w, x, y, z; made unit";
  EXPECT_EQ(node.transform.scale, glm::dvec3(1, -1, 0));
  EXPECT_EQ(node.children, std::vector<int>{1});
  EXPECT_FALSE(node.matrix);
  ASSERT_TRUE(loaded.scene.nodes[1].matrix);
  EXPECT_EQ((*loaded.scene.nodes[1].matrix)[3], glm::dvec4(4, 5, 6, 1)) << "columns first";
  EXPECT_EQ(loaded.scene.nodes[2].transform.rotation, glm::dquat(1, 0, 0, 0));
  EXPECT_EQ(loaded.report.warnings.size(), 2u);
}

TEST(Nodes, CyclesAreRefusedAndTheLastParentCounts) {
  EXPECT_NE(LoadError(Root(R"("nodes":[{"children":[1]},{"children":[0]}])"), ErrorCode::InvalidInput)
                .find("its own ancestor"),
            std::string::npos);
  LoadError(Root(R"("nodes":[{"children":[0]}])"), ErrorCode::InvalidInput);
  LoadError(Root(R"("nodes":[{},{"children":[2]},{"children":[3]},{"children":[1]}])"), ErrorCode::InvalidInput);
  const LoadedScene shared = LoadBytes(Root(R"("nodes":[{"children":[2]},{"children":[2]},{}])"));
  EXPECT_EQ(shared.scene.nodes[0].children, std::vector<int>{});
  EXPECT_EQ(shared.scene.nodes[1].children, std::vector<int>{2});
  ASSERT_EQ(shared.report.warnings.size(), 1u);
  EXPECT_NE(shared.report.warnings[0].find("nodes[2]: is a child of both nodes[0] and nodes[1]; it is drawn below"),
            std::string::npos);
  // Two parents that list the same many children: no search for each of them.
  std::string all = "2";
  for (int i = 3; i < 200000; ++i) all += "," + std::to_string(i);
  std::string leaves;
  for (int i = 2; i < 200000; ++i) leaves += ",{}";
  const std::string parent = R"({"children":[)" + all + "]}";
  const LoadedScene many = LoadBytes(Root("\"nodes\":[" + parent + "," + parent + leaves + "]"));
  EXPECT_TRUE(many.scene.nodes[0].children.empty());
  EXPECT_EQ(many.scene.nodes[1].children.size(), 199998u);
  EXPECT_EQ(many.report.warnings.size(), 1u) << "which counts the others";
  const LoadedScene twice = LoadBytes(Root(R"("nodes":[{"children":[1,1]},{}])"));
  EXPECT_EQ(twice.scene.nodes[0].children, std::vector<int>{1});
  EXPECT_EQ(twice.report.warnings.size(), 1u);
}

TEST(Nodes, DeepHierarchiesNeedNoStack) {
  std::string nodes = R"("nodes":[{})";
  for (int i = 0; i < 100000; ++i) nodes += ",{\"children\":[" + std::to_string(i) + "]}";
  EXPECT_EQ(LoadBytes(Root(nodes + "]")).scene.nodes.size(), 100001u);
}

TEST(Nodes, SeveralScenesAndTheDefault) {
  const LoadedScene loaded =
      LoadBytes(Root(R"("scene":1,"scenes":[{"nodes":[0],"name":"x"},{"nodes":[1,0]}],"nodes":[{},{}])"));
  ASSERT_EQ(loaded.scene.scenes.size(), 2u);
  EXPECT_EQ(loaded.scene.default_scene, 1);
  EXPECT_EQ(loaded.scene.scenes[0].name, "x");
  EXPECT_EQ(loaded.scene.scenes[1].nodes, (std::vector<int>{1, 0}));
  EXPECT_EQ(LoadBytes(Root(R"("nodes":[{}])")).scene.default_scene, -1);
}

TEST(Nodes, Cameras) {
  const LoadedScene loaded = LoadBytes(Root(R"("nodes":[{"camera":1}],"cameras":[
      {"type":"perspective","perspective":{"yfov":0.5,"znear":0.25,"aspectRatio":2}},
      {"name":"o","type":"orthographic","orthographic":{"xmag":2,"ymag":-3,"znear":0,"zfar":10}}])"));
  EXPECT_EQ(loaded.scene.nodes[0].camera, 1);
  EXPECT_EQ(loaded.scene.cameras[0].yfov, 0.5);
  EXPECT_EQ(loaded.scene.cameras[0].aspect, 2.0);
  EXPECT_EQ(loaded.scene.cameras[0].zfar, std::numeric_limits<double>::infinity());
  EXPECT_TRUE(loaded.scene.cameras[1].orthographic);
  EXPECT_EQ(loaded.scene.cameras[1].name, "o");
  EXPECT_EQ(loaded.scene.cameras[1].ymag, 3.0);
}

TEST(Nodes, Lights) {
  const LoadedScene loaded = LoadBytes(Root(R"("extensionsUsed":["KHR_lights_punctual"],"extensions":{
      "KHR_lights_punctual":{"lights":[{"type":"directional","color":[1,0.5,0],"intensity":3},
      {"type":"spot","name":"s","range":4,"spot":{"innerConeAngle":0.1,"outerConeAngle":0.2}},{"type":"point"},
      {"type":"sphere"},{"type":"spot","spot":{}}]}},
      "nodes":[{"extensions":{"KHR_lights_punctual":{"light":1}}},{}])"));
  EXPECT_EQ(loaded.scene.nodes[0].light, 1);
  EXPECT_EQ(loaded.scene.nodes[1].light, -1);
  const auto& lights = loaded.scene.lights;
  EXPECT_EQ(lights[0].type, LightType::Directional);
  EXPECT_EQ(lights[0].color, glm::vec3(1, 0.5f, 0));
  EXPECT_EQ(lights[0].intensity, 3.0f);
  EXPECT_EQ(lights[1].type, LightType::Spot);
  EXPECT_EQ(lights[1].range, 4.0f);
  EXPECT_EQ(lights[1].inner_cone_angle, 0.1f);
  EXPECT_EQ(lights[1].outer_cone_angle, 0.2f);
  EXPECT_EQ(lights[2].type, LightType::Point);
  EXPECT_EQ(lights[2].intensity, 1.0f);
  EXPECT_TRUE(std::isinf(lights[2].range));
  EXPECT_EQ(lights[3].intensity, 0.0f) << "an unknown kind stays dark";
  EXPECT_FLOAT_EQ(lights[4].outer_cone_angle, 0.785398163f);
  EXPECT_EQ(loaded.report.warnings.size(), 1u);
}

TEST(Nodes, InstancesAndVisibility) {
  FileMaker file;
  file.Attribute("POSITION", file.Triangle());
  const int translation = file.Floats({1, 0, 0, 2, 0, 0}, "VEC3", 3);
  const int rotation = file.Accessor(file.View(Pack<std::int16_t>({0, 0, 32767, 0, 0, 0, 0, 32767})), 5122, 2, "VEC4",
                                     ",\"normalized\":true");
  const int scale = file.Floats({1, 1, 1, 2, 3, 4}, "VEC3", 3);
  file.RootMore() = ",\"extensionsUsed\":[\"EXT_mesh_gpu_instancing\",\"KHR_node_visibility\"]";
  file.NodeMore() =
      ",\"extensions\":{\"KHR_node_visibility\":{\"visible\":false},\"EXT_mesh_gpu_instancing\":"
      "{\"attributes\":{\"TRANSLATION\":" +
      std::to_string(translation) + ",\"ROTATION\":" + std::to_string(rotation) +
      ",\"SCALE\":" + std::to_string(scale) + ",\"_ID\":0}}}";
  const LoadedScene loaded = LoadBytes(file.AsGlb());
  const Node& node = loaded.scene.nodes.at(0);
  EXPECT_FALSE(node.visible);
  ASSERT_EQ(node.instances.size(), 2u);
  EXPECT_EQ(node.instances[1].translation, glm::dvec3(2, 0, 0));
  EXPECT_EQ(node.instances[0].rotation, glm::dquat(0, 0, 0, 1));
  EXPECT_EQ(node.instances[1].scale, glm::dvec3(2, 3, 4));
  EXPECT_TRUE(loaded.report.warnings.empty());
}

TEST(Nodes, NoInstancesAreNoMesh) {
  FileMaker file;
  file.RootMore() = ",\"extensionsUsed\":[\"EXT_mesh_gpu_instancing\"]";
  file.Attribute("POSITION", file.Triangle());
  file.NodeMore() = ",\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{\"TRANSLATION\":" +
                    std::to_string(file.Accessor(-1, 5126, 0, "VEC3")) + "}}}";
  const LoadedScene loaded = LoadBytes(file.AsGlb());
  EXPECT_EQ(loaded.scene.nodes.at(0).mesh, -1);
  EXPECT_EQ(loaded.report.warnings.size(), 1u);
}

TEST(Nodes, SkinsReadTheirMatrices) {
  FileMaker file;
  file.Attribute("POSITION", file.Triangle());
  const int matrices = file.Floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 7, 8, 9, 1}, "MAT4", 16);
  file.NodesMore() = ",{}";
  file.RootMore() =
      ",\"skins\":[{\"joints\":[1],\"inverseBindMatrices\":" + std::to_string(matrices) + "},{\"joints\":[0,1]}]";
  const LoadedScene loaded = LoadBytes(file.AsGlb());
  EXPECT_EQ(loaded.scene.skins.at(0).inverse_bind.at(0)[3], glm::vec4(7, 8, 9, 1));
  EXPECT_TRUE(loaded.scene.skins.at(1).inverse_bind.empty());
  file.RootMore() = ",\"skins\":[{\"joints\":[0,1],\"inverseBindMatrices\":" + std::to_string(matrices) + "}]";
  EXPECT_EQ(LoadBytes(file.AsGlb()).report.warnings.size(), 1u) << "no node uses it";
  file.NodeMore() = ",\"skin\":0";
  EXPECT_NE(LoadError(file.AsGlb(), ErrorCode::InvalidInput).find("has 1 matrices for 2 joints"), std::string::npos);
}

TEST(Nodes, WhatNothingHangsFromMayBeBroken) {
  for (const char* broken : {R"({"scale":[1]})", R"({"rotation":"x"})", R"({"matrix":[1,2]})", R"({"skin":9})",
                             R"({"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":99}}}})"}) {
    FileMaker file;
    file.Attribute("POSITION", file.Triangle());
    file.NodesMore() = std::string(",") + broken;
    file.RootMore() = ",\"extensionsUsed\":[\"EXT_mesh_gpu_instancing\"]";
    std::string json = file.Json();
    json.replace(json.find("\"nodes\":[0]"), 11, "\"nodes\":[0,1]");
    EXPECT_EQ(LoadBytes(testing::Glb(json, file.Bin())).report.warnings.size(), 1u) << broken;
    // What draws, or carries what draws, must be right.
    std::string with_mesh = json;
    with_mesh.insert(with_mesh.find(broken) + 1, "\"mesh\":0,");
    LoadError(testing::Glb(with_mesh, file.Bin()), ErrorCode::InvalidInput);
  }
  FileMaker file;
  file.Attribute("POSITION", file.Triangle());
  file.NodesMore() = R"(,{"scale":[1],"children":[0]})";
  std::string json = file.Json();
  json.replace(json.find("\"nodes\":[0]"), 11, "\"nodes\":[1]");
  LoadError(testing::Glb(json, file.Bin()), ErrorCode::InvalidInput);
}

TEST(Nodes, MorphWeightsFollowTheTargets) {
  FileMaker file;
  file.Attribute("POSITION", file.Triangle());
  file.PrimitiveMore() = ",\"targets\":[{\"POSITION\":0},{\"POSITION\":0}]";
  file.MeshMore() = ",\"weights\":[0.25,0.5]";
  file.NodeMore() = ",\"weights\":[1]";
  const LoadedScene loaded = LoadBytes(file.AsGlb());
  EXPECT_EQ(loaded.scene.meshes[0].weights, (std::vector<float>{0.25f, 0.5f}));
  EXPECT_EQ(loaded.scene.nodes[0].weights, (std::vector<float>{1})) << "those that are missing count as 0";
  EXPECT_EQ(loaded.report.warnings.size(), 1u);
}

}  // namespace
}  // namespace facet
