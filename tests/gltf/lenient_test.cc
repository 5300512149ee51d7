// Files that break rules: strict about where things are, liberal about how they look, and about what is not shown.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <set>

#include "everything.h"
#include "facet/scene.h"

namespace facet {
namespace {

using nlohmann::json;
using testing::Everything;
using Pointer = json::json_pointer;

// What came of loading: a scene with warnings, or an error.
struct Outcome {
  std::optional<LoadedScene> loaded;
  std::string error;

  const std::vector<std::string>& Warnings() const { return loaded->report.warnings; }
};

Outcome Load(const std::string& bytes) {
  Outcome outcome;
  try {
    outcome.loaded = testing::LoadBytes(bytes);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::InvalidInput) << error.what();
    outcome.error = error.what();
  }
  return outcome;
}

Outcome Load(const json& file) { return Load(file.dump()); }

json With(const char* pointer, const json& value) {
  json file = Everything();
  file[Pointer(pointer)] = value;
  return file;
}

json Without(const Pointer& pointer) {
  json file = Everything();
  file[pointer.parent_pointer()].erase(pointer.back());
  return file;
}

std::string Digest(const LoadedScene& loaded) {
  const SceneDigests digests = HashScene(loaded.scene);
  return ToHex(digests.description) + ToHex(digests.geometry) + ToHex(digests.textures);
}

// "/nodes/0/mesh" to "nodes[0].mesh".
std::string PlaceOf(const Pointer& pointer) {
  std::string place;
  for (Pointer at = pointer; !at.empty(); at.pop_back()) {
    const std::string key = at.back();
    const bool is_index = key.find_first_not_of("0123456789") == std::string::npos;
    place = is_index ? "[" + key + "]" + place : "." + key + place;
  }
  return place.substr(place.empty() ? 0 : 1);
}

bool AnyHas(const std::vector<std::string>& lines, const std::string& text) {
  return std::any_of(lines.begin(), lines.end(),
                     [&](const std::string& line) { return line.find(text) != std::string::npos; });
}

// Every member of every object in the file.
void ListMembers(const json& value, const Pointer& at, std::vector<Pointer>& members) {
  if (value.is_object()) {
    for (const auto& item : value.items()) {
      members.push_back(at / item.key());
      ListMembers(item.value(), at / item.key(), members);
    }
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) ListMembers(value[i], at / i, members);
  }
}

std::vector<Pointer> AllMembers() {
  std::vector<Pointer> members;
  ListMembers(Everything(), Pointer(), members);
  return members;
}

TEST(Lenient, TheFileWithEverythingIsValid) {
  const Outcome outcome = Load(Everything());
  ASSERT_TRUE(outcome.loaded) << outcome.error;
  EXPECT_EQ(outcome.Warnings(), std::vector<std::string>());
  EXPECT_GT(AllMembers().size(), 200u);
}

TEST(Lenient, NullIsAsGoodAsAbsentForEveryMember) {
  for (const Pointer& member : AllMembers()) {
    SCOPED_TRACE(member.to_string());
    json file = Everything();
    file[member] = nullptr;
    const Outcome null = Load(file), absent = Load(Without(member));
    ASSERT_EQ(null.loaded.has_value(), absent.loaded.has_value()) << null.error << absent.error;
    EXPECT_EQ(null.error, absent.error);
    if (!null.loaded) continue;
    EXPECT_EQ(Digest(*null.loaded), Digest(*absent.loaded));
    EXPECT_TRUE(AnyHas(null.Warnings(), PlaceOf(member) + ": null is read as absent"));
    EXPECT_EQ(null.Warnings().size(), absent.Warnings().size() + 1);
  }
}

// What facet has no use for.
bool IsRead(const Pointer& member) {
  const std::string path = member.to_string(), key = member.back();
  const bool is_nameless = path.starts_with("/accessors/") || path.starts_with("/bufferViews/") ||
                           path.starts_with("/buffers/") || path.starts_with("/samplers/");
  return !(is_nameless && key == "name") && key != "min" && key != "max" && key != "mimeType";
}

// What a member may not be is an error or leaves a warning, and never makes another error of what would load without
// the member: the reader does not get lost.
TEST(Lenient, WrongTypesAreAnErrorOrAWarningForEveryMember) {
  for (const Pointer& member : AllMembers()) {
    if (!IsRead(member)) continue;
    const bool is_attribute_list = member.back() == "attributes" || member.back() == "extensions";
    for (const json& value : {json("text"), json(-7), json(1e300), json(true), json::array({"text"}), json::object()}) {
      const json right = Everything()[member];
      const bool same_type = right.type() == value.type() || (right.is_number() && value.is_number());
      if (same_type || (is_attribute_list && value.is_object())) continue;
      SCOPED_TRACE(member.to_string() + " = " + value.dump());
      json file = Everything();
      file[member] = value;
      const Outcome outcome = Load(file);
      if (!outcome.loaded) continue;
      EXPECT_FALSE(outcome.Warnings().empty()) << "accepted without a word";
    }
  }
}

TEST(Lenient, MinusOneIsAsGoodAsAbsentForEveryIndex) {
  for (const char* index :
       {"/scene",
        "/nodes/0/mesh",
        "/nodes/3/skin",
        "/nodes/1/camera",
        "/nodes/2/extensions/KHR_lights_punctual/light",
        "/textures/0/source",
        "/textures/0/sampler",
        "/textures/0/extensions/EXT_texture_webp/source",
        "/skins/0/inverseBindMatrices",
        "/skins/0/skeleton",
        "/meshes/0/primitives/0/indices",
        "/meshes/0/primitives/0/material",
        "/meshes/0/primitives/0/attributes/NORMAL",
        "/meshes/0/primitives/0/attributes/POSITION",
        "/meshes/1/primitives/0/targets/0/POSITION",
        "/accessors/15/bufferView",
        "/materials/0/normalTexture/index",
        "/materials/0/normalTexture/texCoord",
        "/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/texCoord",
        "/nodes/5/extensions/EXT_mesh_gpu_instancing/attributes/TRANSLATION",
        "/animations/0/channels/0/target/node",
        "/animations/0/samplers/0/input",
        "/meshes/0/primitives/0/extensions/KHR_materials_variants/mappings/0/material"}) {
    SCOPED_TRACE(index);
    const Pointer pointer(index);
    const Outcome minus_one = Load(With(index, -1)), absent = Load(Without(pointer));
    ASSERT_TRUE(minus_one.loaded && absent.loaded) << minus_one.error << absent.error;
    EXPECT_EQ(Digest(*minus_one.loaded), Digest(*absent.loaded));
    EXPECT_TRUE(AnyHas(minus_one.Warnings(), PlaceOf(pointer) + ": -1 is read as absent"));
  }
}

struct Mistake {
  const char* pointer;
  json value;
  const char* warning;  // a part of it
};

// Each loads, says so, and has what the file has elsewhere.
TEST(Lenient, MistakesThatDoNotMatterAreWarnings) {
  const Mistake mistakes[] = {
      // What nothing shows.
      {"/cameras/1/orthographic/xmag", 0, "cameras[1]: cannot be used (cameras[1].orthographic: xmag or ymag is zero)"},
      {"/cameras/0/perspective/yfov", 0, "cameras[0].perspective.yfov: is not between 0 and pi"},
      {"/cameras/0/perspective/yfov", 4, "is not between 0 and pi"},
      {"/cameras/0/perspective/znear", 0, "cameras[0].perspective.znear: is not positive; 0.01 is used"},
      {"/cameras/0/perspective/zfar", 0.01, "cameras[0].perspective.zfar: is not beyond znear; none is used"},
      {"/cameras/0/perspective/aspectRatio", 0, "cameras[0].perspective.aspectRatio: is not positive"},
      {"/cameras/1/orthographic/znear", -1, "cameras[1].orthographic.znear: is negative; 0 is used"},
      {"/cameras/1/type", "fisheye", "\"fisheye\" is not a type that glTF knows; orthographic is used"},
      {"/cameras/1", "text", "cameras[1]: is not an object"},
      {"/nodes/1/camera", 7, "nodes[1].camera: ignored (7 is not one of the 2 cameras)"},
      {"/nodes/8/mesh", 77, "nodes[8]: its mesh is ignored"},
      {"/nodes/8/translation", {1, 2}, "nodes[8]: its transform is ignored (nodes[8].translation: has 2 numbers"},
      {"/nodes/8/children", {99}, "nodes[8]: a link to another node is ignored"},
      {"/nodes/8/children", {8}, "nodes[8]: a link to another node is ignored (is its own ancestor)"},
      {"/nodes/8/children", {7}, "nodes[7]: is a child of both nodes[6] and nodes[8]"},
      {"/nodes/4/children", {7}, "nodes[7]: is a child of both nodes[4] and nodes[6]; it is drawn below the latter"},
      {"/scenes/1/nodes/0", 99, "scenes[1]: a link to a node is ignored"},
      {"/meshes/2/primitives/0/indices", 99, "meshes[2].primitives[0]: ignored"},
      {"/meshes/2/primitives/0/mode", 7, "meshes[2].primitives[0]: ignored"},
      {"/meshes/2/primitives", 5, "meshes[2]: ignored"},
      {"/accessors/15/count", 1000, "meshes[2].primitives[0]: ignored"},
      {"/accessors/15/sparse/indices/bufferView", 99, "meshes[2].primitives[0]: ignored"},
      {"/accessors/15/type", "VEC7", "meshes[2].primitives[0]: ignored"},
      // How things look.
      {"/materials/0/pbrMetallicRoughness/baseColorTexture/index", 5, "baseColorTexture.index: ignored (5 is not one"},
      {"/materials/0/pbrMetallicRoughness/baseColorFactor", {1, 0, 0}, "baseColorFactor: has 3 numbers instead of 4"},
      {"/materials/0/pbrMetallicRoughness/baseColorFactor", {1, 0, 0, 1, 1}, "the first are read"},
      {"/materials/0/pbrMetallicRoughness/baseColorFactor", {1, 0}, "baseColorFactor: ignored (has 2 numbers"},
      {"/materials/0/pbrMetallicRoughness", 5, "materials[0].pbrMetallicRoughness: ignored (is not an object)"},
      {"/materials/0/emissiveFactor", {1, 1, 1, 1}, "emissiveFactor: has 4 numbers instead of 3; the first are read"},
      {"/materials/0/emissiveFactor", {1}, "materials[0].emissiveFactor: ignored (has 1 numbers instead of 3)"},
      {"/materials/0/alphaMode", "CLIP", "\"CLIP\" is unknown; OPAQUE is used"},
      {"/materials/0/alphaMode", 2, "materials[0].alphaMode: ignored (is not a string)"},
      {"/materials/0/normalTexture/texCoord", 70000, "materials[0].normalTexture.texCoord: ignored"},
      {"/materials/0/normalTexture", 0, "materials[0].normalTexture: ignored (is not an object)"},
      {"/materials/0/extensions/KHR_materials_emissive_strength/emissiveStrength", "2", "emissiveStrength: ignored"},
      {"/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/scale", 2,
       "scale: ignored"},
      {"/materials/0", 5, "materials[0]: is not an object; an empty one is read"},
      {"/meshes/0/primitives/0/material", 9, "meshes[0].primitives[0].material: ignored (9 is not one of the 4"},
      {"/meshes/0/primitives/0/extensions/KHR_materials_variants/mappings/0/material", 9,
       "mappings[0].material: ignored"},
      {"/meshes/0/primitives/0/extensions/KHR_materials_variants/mappings/0/variants", {9}, "variants[0]: ignored"},
      {"/meshes/0/primitives/0/attributes/NORMAL", 99, "attributes.NORMAL: ignored (99 is not one of"},
      {"/meshes/0/primitives/0/attributes/TEXCOORD_1", 99, "attributes.TEXCOORD_1: ignored"},
      {"/meshes/0/primitives/0/attributes/TEXCOORD_0", 11, "attributes.TEXCOORD_0: ignored (has 2 elements"},
      {"/meshes/0/primitives/0/attributes/TANGENT", 1, "attributes.TANGENT: ignored (does not have 4 components)"},
      {"/meshes/0/primitives/0/attributes/TEXCOORD_0", 1,
       "attributes.TEXCOORD_0: has 3 components; the first 2 are read"},
      {"/meshes/0/primitives/0/attributes/COLOR_0", "red", "attributes.COLOR_0: ignored (is not an index)"},
      {"/accessors/1/count", 0, "attributes.NORMAL: ignored (has 0 elements"},
      {"/accessors/1/componentType", 1, "attributes.NORMAL: ignored (accessors[1].componentType: 1 is not a value"},
      {"/accessors/1/byteOffset", 10000, "attributes.NORMAL: ignored (accessors[1]: 3 elements from byte 10000"},
      {"/meshes/1/primitives/0/targets", 5, "meshes[1].primitives[0].targets: ignored (is not an array)"},
      {"/meshes/1/weights", "none", "meshes[1].weights: ignored (is not an array)"},
      {"/textures/0/sampler", 3, "textures[0].sampler: ignored (3 is not one of the 1 samplers)"},
      {"/textures/0/source", 3, "textures[0].source: ignored"},
      {"/textures/0/extensions/EXT_texture_webp/source", 3, "EXT_texture_webp.source: ignored"},
      {"/samplers/0/wrapS", 10496, "samplers[0].wrapS: ignored (10496 is not a value that glTF knows)"},
      {"/samplers/0/wrapT", "REPEAT", "samplers[0].wrapT: ignored"},
      {"/samplers/0/magFilter", 9987, "samplers[0].magFilter: ignored"},
      {"/samplers/0/minFilter", 1, "samplers[0].minFilter: ignored"},
      {"/images/0/uri", 5, "images[0]: what it should show stays white (images[0].uri: is not a string)"},
      {"/images/0/bufferView", 99, "images[0]: what it should show stays white (images[0].bufferView: 99 is not one"},
      {"/extensions/KHR_lights_punctual/lights/0/color", {1, 1}, "lights[0].color: ignored"},
      {"/extensions/KHR_lights_punctual/lights/0/intensity", -2, "lights[0].intensity: is negative; 0 is used"},
      {"/extensions/KHR_lights_punctual/lights/0/type", 1, "lights[0].type: ignored"},
      {"/extensions/KHR_lights_punctual/lights/0", 1, "lights[0]: is not an object; an empty one is read"},
      {"/nodes/2/extensions/KHR_lights_punctual/light", 4, "light: ignored (4 is not one of the 1 lights)"},
      {"/extensions/KHR_materials_variants/variants/0/name", 4, "variants[0].name: ignored"},
      {"/nodes/0/extensions/KHR_node_visibility/visible", "no", "visible: ignored (is not true or false)"},
      // What is not asked for.
      {"/animations/0/channels/0/sampler", 9, "animations[0].channels[0]: ignored"},
      {"/animations/0/channels/0/target", 9, "animations[0].channels[0]: ignored"},
      {"/animations/0/channels/0/target/node", 99, "animations[0].channels[0]: ignored"},
      {"/animations/0/channels/0/target/path", "color", "animations[0].channels[0]: ignored"},
      {"/animations/0/channels", "x", "animations[0].channels: ignored (is not an array)"},
      {"/animations/0/samplers/0/input", 99, "animations[0].channels[0]: ignored"},
      {"/animations/0/samplers/0/output", 14, "values do not have 3 components"},
      {"/animations/0/samplers/0/interpolation", "CUBICSPLINE", "has 2 elements for 2 keys of 3"},
      {"/animations/0/samplers/0/interpolation", "BEZIER", "\"BEZIER\" is unknown; LINEAR is used"},
      {"/animations/0", 1, "animations[0]: is not an object"},
      // Names, notes and lists.
      {"/nodes/0/name", 4, "nodes[0].name: ignored (is not a string)"},
      {"/scenes/0/name", 4, "scenes[0].name: ignored"},
      {"/asset/generator", 4, "asset.generator: ignored"},
      {"/asset/version", 2.0, "asset.version: is not a version such as \"2.0\"; it is read as 2.0"},
      {"/asset/version", "2", "asset.version: is not a version such as \"2.0\"; it is read as 2.0"},
      {"/asset/minVersion", "new", "asset.minVersion: ignored"},
      {"/extensionsUsed/0", 4, "extensionsUsed[0]: ignored: is not a string"},
      {"/extensionsUsed", 4, "extensionsUsed: ignored (is not an array)"},
      {"/scene", 4, "scene: ignored (4 is not one of the 2 scenes)"},
      {"/scene", "0", "scene: ignored (is not an index)"},
      {"/skins/0/skeleton", 99, "skins[0].skeleton: ignored"},
      {"/bufferViews/1/byteStride", 14, "bufferViews[1].byteStride: 14 is not a multiple of 4"},
      {"/buffers/0/byteLength", 100000, "buffers[0]: has "},
      {"/buffers/0/byteLength", "many", "buffers[0].byteLength: ignored"},
  };
  const LoadedScene base = *Load(Everything()).loaded;
  for (const Mistake& mistake : mistakes) {
    SCOPED_TRACE(std::string(mistake.pointer) + " = " + mistake.value.dump());
    const Outcome outcome = Load(With(mistake.pointer, mistake.value));
    ASSERT_TRUE(outcome.loaded) << outcome.error;
    EXPECT_TRUE(AnyHas(outcome.Warnings(), mistake.warning)) << json(outcome.Warnings()).dump(1);
    const Primitive& drawn = outcome.loaded->scene.meshes.at(0).primitives.at(0);
    EXPECT_EQ(drawn.positions, base.scene.meshes[0].primitives[0].positions);
    EXPECT_EQ(drawn.indices, base.scene.meshes[0].primitives[0].indices);
    EXPECT_EQ(outcome.loaded->scene.nodes.size(), base.scene.nodes.size());
  }
}

// Where things are cannot be guessed.
TEST(Lenient, WhatThePictureNeedsIsStrict) {
  const std::pair<const char*, json> needed[] = {
      {"/accessors/0/componentType", 1},
      {"/accessors/0/type", "VEC7"},
      {"/accessors/0/type", "VEC2"},
      {"/accessors/0/count", -3},
      {"/accessors/0/count", 1000000},
      {"/accessors/0/byteOffset", "far"},
      {"/accessors/0/byteOffset", 100000},
      {"/accessors/0/bufferView", 99},
      {"/accessors/0/normalized", "no"},
      {"/accessors/6/componentType", 5126},
      {"/accessors/6/count", 10000},
      {"/bufferViews/0/buffer", 9},
      {"/bufferViews/0/byteLength", -1},
      {"/bufferViews/0/byteOffset", 1e9},
      {"/bufferViews/0/byteStride", "wide"},
      {"/buffers/0/uri", "data:application/octet-stream;base64,AAAA"},
      {"/buffers/0/uri", "data:application/octet-stream;base64,?"},
      {"/buffers/0/uri", 5},
      {"/meshes/0/primitives", 5},
      {"/meshes/0/primitives/0", 5},
      {"/meshes/0/primitives/0/attributes", 5},
      {"/meshes/0/primitives/0/attributes/POSITION", 99},
      {"/meshes/0/primitives/0/indices", 99},
      {"/meshes/0/primitives/0/mode", 7},
      {"/meshes/1/primitives/0/attributes/JOINTS_0", 99},
      {"/meshes/1/primitives/0/attributes/WEIGHTS_0", 3},
      {"/skins/0/joints", {99}},
      {"/skins/0/joints", 5},
      {"/skins/0/inverseBindMatrices", 8},
      {"/nodes/0/mesh", 99},
      {"/nodes/3/skin", 99},
      {"/nodes/0/translation", {1, 2}},
      {"/nodes/0/rotation", {0, 0, 1}},
      {"/nodes/0/scale", 2},
      {"/nodes/1/matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}},
      {"/nodes/6/children", {99}},
      {"/nodes/6/children", {6}},
      {"/nodes/7/children", {6}},
      {"/nodes/5/extensions/EXT_mesh_gpu_instancing/attributes/TRANSLATION", 13},
      {"/nodes/5/extensions/EXT_mesh_gpu_instancing/attributes/ROTATION", 8},
      {"/scenes/0/nodes/0", 99},
      {"/asset/version", "1.0.1x"},
  };
  for (const auto& [pointer, value] : needed) {
    SCOPED_TRACE(std::string(pointer) + " = " + value.dump());
    const Outcome outcome = Load(With(pointer, value));
    EXPECT_FALSE(outcome.loaded) << json(outcome.loaded ? outcome.Warnings() : std::vector<std::string>()).dump(1);
  }
}

// The same mistakes, where only another scene has them, or a hidden node.
TEST(Lenient, WhatIsNotShownNeverRefusesTheFile) {
  const std::pair<const char*, json> broken_parts[] = {
      {"/accessors", {{"componentType", 1}, {"count", "x"}}},
      {"/accessors", 5},
      {"/accessors", {{"bufferView", 0}, {"componentType", 5126}, {"count", 99999}, {"type", "VEC3"}}},
      {"/bufferViews", {{"buffer", 99}}},
      {"/bufferViews", {{"buffer", 0}, {"byteOffset", 8}, {"byteLength", 99999}}},
      {"/buffers", {{"byteLength", 8}, {"uri", "missing.bin"}}},
      {"/buffers", {{"byteLength", "x"}, {"uri", 4}}},
      {"/meshes", {{"primitives", 5}}},
      {"/meshes", {{"primitives", {{{"attributes", {{"POSITION", 99}}}}}}}},
      {"/materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 99}}}}}}},
      {"/textures", {{"source", 99}, {"sampler", 99}}},
      {"/images", {{"bufferView", 99}}},
      {"/images", {{"uri", "missing.png"}}},
      {"/samplers", {{"wrapS", 1}, {"minFilter", "x"}}},
      {"/skins", {{"joints", {99}}}},
      {"/skins", json::object()},
      {"/cameras", {{"type", "perspective"}}},
      {"/cameras", json::object()},
      {"/nodes", {{"mesh", 99}, {"skin", 99}, {"camera", 99}, {"translation", {1}}, {"children", {98, 99}}}},
      {"/nodes", nullptr},
      {"/animations", {{"channels", {json::object(), 5}}, {"samplers", {5}}}},
      {"/animations", json::object()},
      {"/scenes", {{"nodes", {99}}}},
      {"/scenes", {{"nodes", "all"}}},
      {"/extensions/KHR_lights_punctual/lights", json::object()},
      {"/extensions/KHR_materials_variants/variants", 5},
  };
  const LoadedScene base = *Load(Everything()).loaded;
  for (const auto& [list, part] : broken_parts) {
    SCOPED_TRACE(std::string(list) + " and " + part.dump());
    json file = Everything();
    file[Pointer(list)].push_back(part);
    const Outcome outcome = Load(file);
    ASSERT_TRUE(outcome.loaded) << outcome.error;
    EXPECT_TRUE(part == json::object() || !outcome.Warnings().empty());
    EXPECT_EQ(ToHex(HashScene(outcome.loaded->scene).geometry), ToHex(HashScene(base.scene).geometry));
  }
  // A hidden node shows nothing.
  json hidden = With("/nodes/0/mesh", 99);
  hidden["nodes"][0]["extensions"]["KHR_node_visibility"]["visible"] = false;
  EXPECT_TRUE(Load(hidden).loaded);
  // A morph target of a weight other than 0 moves what is shown.
  json morphed = With("/meshes/1/primitives/0/targets/0/POSITION", 99);
  EXPECT_TRUE(Load(morphed).error.find("targets[0].POSITION: 99") != std::string::npos) << "node 3 gives it 0.5";
  morphed["nodes"][3]["weights"][0] = 0;
  EXPECT_TRUE(Load(morphed).loaded);
  // A mesh that nothing skins may have broken joints.
  json unskinned = With("/meshes/1/primitives/0/attributes/JOINTS_0", 99);
  unskinned["nodes"][3].erase("skin");
  EXPECT_TRUE(Load(unskinned).loaded);
}

TEST(Lenient, NullAndMinusOneInListsAreAbsent) {
  for (const json& nothing : {json(nullptr), json(-1)}) {
    json file = Everything();
    file["nodes"][6]["children"].insert(file["nodes"][6]["children"].begin(), nothing);
    file["scenes"][0]["nodes"].push_back(nothing);
    file["meshes"][0]["primitives"].push_back(nothing);
    const Outcome outcome = Load(file);
    ASSERT_TRUE(outcome.loaded) << outcome.error;
    EXPECT_EQ(Digest(*outcome.loaded), Digest(*Load(Everything()).loaded));
    const std::string said = ": " + nothing.dump() + " is read as absent";
    EXPECT_EQ(outcome.Warnings(), (std::vector<std::string>{"nodes[6].children[0]" + said, "scenes[0].nodes[7]" + said,
                                                            "meshes[0].primitives[1]" + said}));
  }
}

TEST(Lenient, ABrokenCameraIsNotOffered) {
  json file = With("/cameras/0/perspective/yfov", 0);
  const Outcome outcome = Load(file);
  ASSERT_TRUE(outcome.loaded) << outcome.error;
  EXPECT_EQ(outcome.loaded->scene.cameras.size(), 2u) << "the others keep their numbers";
  EXPECT_EQ(outcome.loaded->scene.nodes[1].camera, -1);
}

TEST(Lenient, MistakesOfOneKindAreOneLine) {
  json file = Everything();
  for (auto& accessor : file["accessors"]) accessor["min"] = nullptr;
  const Outcome outcome = Load(file);
  ASSERT_TRUE(outcome.loaded);
  EXPECT_EQ(outcome.Warnings(),
            std::vector<std::string>{"accessors[0].min: null is read as absent (and in 15 more places)"});
}

TEST(Lenient, ScenesMayNameNodesThatHaveParents) {
  // Node 7 hangs from node 6, which the scene has: it stays there.
  json file = Everything();
  file["scenes"][0]["nodes"] = {7, 0, 6};
  const Outcome both = Load(file);
  ASSERT_TRUE(both.loaded) << both.error;
  EXPECT_EQ(both.loaded->scene.scenes[0].nodes, (std::vector<int>{0, 6}));
  EXPECT_TRUE(AnyHas(both.Warnings(), "scenes[0].nodes: nodes[7] is not a root node; it stays below nodes[6]"));
  // Without its parent the scene begins there.
  file["scenes"][0]["nodes"] = {0, 7};
  const Outcome alone = Load(file);
  ASSERT_TRUE(alone.loaded) << alone.error;
  EXPECT_EQ(alone.loaded->scene.scenes[0].nodes, (std::vector<int>{0, 7}));
  EXPECT_TRUE(AnyHas(alone.Warnings(), "nodes[7] is not a root node; the scene begins there, without nodes[6]"));
}

TEST(Lenient, NumbersBeyondDoubleAreTheLargest) {
  std::string text = Everything().dump();
  const std::string zfar = "\"zfar\":100";
  text.replace(text.find(zfar), zfar.size(), "\"zfar\":1e309");
  const Outcome outcome = Load(text);
  ASSERT_TRUE(outcome.loaded) << outcome.error;
  EXPECT_GT(outcome.loaded->scene.cameras[0].zfar, 1e308);
  EXPECT_EQ(outcome.Warnings(), std::vector<std::string>{"cameras[0].perspective.zfar: is beyond the range of numbers; "
                                                         "the largest is read"});
}

TEST(Lenient, BytesThatAreNotUtf8AreReplaced) {
  const std::pair<std::string, std::string> names[] = {
      {"caf\xE9", "caf\xEF\xBF\xBD"},                            // Latin-1
      {"\xA3 \xC3\xA9", "\xEF\xBF\xBD \xC3\xA9"},                // one byte among UTF-8
      {"\xE6\x97", "\xEF\xBF\xBD\xEF\xBF\xBD"},                  // cut
      {"\xED\xA0\x80", "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD"},  // a surrogate
      {"\xF5\x80\x80\x80\xC0\xAF", "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD"}};
  for (const auto& [bytes, expected] : names) {
    std::string text = Everything().dump();
    text.replace(text.find("triangle"), 8, bytes);
    const Outcome outcome = Load(text);
    ASSERT_TRUE(outcome.loaded) << outcome.error;
    EXPECT_EQ(outcome.loaded->scene.nodes[0].name, expected);
    ASSERT_EQ(outcome.Warnings().size(), 1u);
    EXPECT_EQ(outcome.Warnings()[0], "nodes[0].name: is not UTF-8; what cannot be read of it became U+FFFD");
  }
  std::string text = Everything().dump();
  text.insert(1, "\"extras\":{\"author\":\"Ren\xE9\"},");
  EXPECT_EQ(Load(text).Warnings().size(), 1u) << "where nothing that is read is touched, too";
}

// A texture that shows, of the core or of an extension, and whose coordinates the geometry lacks, has a warning.
TEST(Lenient, TexturesWithoutCoordinatesAreNamed) {
  struct Case {
    int material;
    std::set<std::string> textures;
  };
  for (const Case& c : {Case{0,
                             {"base colour texture", "metallic-roughness texture", "normal texture",
                              "occlusion texture", "emissive texture"}},
                        Case{2, {"clear coat texture", "sheen colour texture", "iridescence texture"}}, Case{1, {}}}) {
    for (const bool missing : {false, true}) {
      json file = Everything();
      json& primitive = file["meshes"][0]["primitives"][0];
      primitive["material"] = c.material;
      primitive.erase("extensions");
      for (const char* name : {"TEXCOORD_0", "TEXCOORD_1"}) {
        if (missing) primitive["attributes"].erase(name);
      }
      std::set<std::string> named;
      const Outcome outcome = Load(file);
      ASSERT_TRUE(outcome.loaded) << outcome.error;
      for (const std::string& line : outcome.Warnings()) {
        const std::string begin = "meshes[0].primitives[0].attributes: TEXCOORD_0 is missing, by which the ";
        if (line.starts_with(begin)) named.insert(line.substr(begin.size(), line.find(" of materials") - begin.size()));
      }
      const bool all = std::includes(named.begin(), named.end(), c.textures.begin(), c.textures.end());
      EXPECT_TRUE(missing ? all : named.empty()) << c.material;
      if (c.material == 1) {
        EXPECT_TRUE(named.empty()) << "it reads none";
      }
    }
  }
}

}  // namespace
}  // namespace facet
