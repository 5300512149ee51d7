// One small file that has every kind of thing that facet reads.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "gltf_files.h"

namespace facet::testing {

// nodes: 0 a textured triangle; 1 a camera; 2 a light; 3 a skinned triangle; 4 its joint; 5 instances of the first;
// 6 has a child, 7. The second scene holds a mesh of its own, node 8, that the first does not show.
// materials: 0 core glTF; 1 unlit; 2 every layer; 3 specular-glossiness; the last two are on nothing.
// images: 0 a picture in the file. Animation 0 moves nodes 0 (translation), 4 (rotation) and 3 (weights).
inline nlohmann::json Everything() {
  FileMaker file;
  const int position = file.Triangle();  // 0
  file.Attribute("POSITION", position);
  file.Attribute("NORMAL", file.Floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3));                        // 1
  file.Attribute("TANGENT", file.Floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4", 4));              // 2
  file.Attribute("TEXCOORD_0", file.Floats({0, 0, 1, 0, 0, 1}, "VEC2", 2));                             // 3
  file.Attribute("TEXCOORD_1", file.Floats({0, 0, 2, 0, 0, 2}, "VEC2", 2));                             // 4
  file.Attribute("COLOR_0", file.Floats({1, 0, 0, 1, 1, 0, 1, 0, 1}, "VEC3", 3));                       // 5
  file.Accessor(file.View(Pack<std::uint16_t>({0, 1, 2})), 5123, 3, "SCALAR");                          // 6
  file.Accessor(file.View(Pack<std::uint8_t>({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0})), 5121, 3, "VEC4");  // 7
  file.Floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4", 4);                                         // 8
  file.Floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, "MAT4", 16);                            // 9
  file.Floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);  // 10: a displacement
  file.Floats({0, 1}, "SCALAR", 1);                     // 11: times
  file.Floats({0, 0, 0, 1, 1, 1}, "VEC3", 3);           // 12
  file.Floats({0, 0, 0, 1, 0, 0, 1, 0}, "VEC4", 4);     // 13
  file.Floats({0, 1}, "SCALAR", 1);                     // 14: weights
  const int sparse_indices = file.View(Pack<std::uint16_t>({1, 0}));
  const int sparse_values = file.View(Pack<float>({3, 0, 0}));
  file.Accessor(0, 5126, 3, "VEC3",
                ",\"byteOffset\":0,\"min\":[0,0,0],\"max\":[1,1,0],\"normalized\":false,\"sparse\":{\"count\":1,"
                "\"indices\":{\"bufferView\":" +
                    std::to_string(sparse_indices) +
                    ",\"byteOffset\":0,\"componentType\":5123},"
                    "\"values\":{\"bufferView\":" +
                    std::to_string(sparse_values) + ",\"byteOffset\":0}}");  // 15
  const char* const png =
      "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGNoAAAAggCBd81ytgAAAABJRU5ErkJggg==";
  nlohmann::json json = nlohmann::json::parse(file.Json("data:application/octet-stream;base64," + Base64(file.Bin())));
  json["buffers"][0]["name"] = "b";
  json["bufferViews"][0]["byteStride"] = 12;
  json["bufferViews"][0]["name"] = "v";
  json["accessors"][0]["name"] = "a";
  json.merge_patch(nlohmann::json::parse(R"({
    "asset": {"generator": "g", "copyright": "c", "minVersion": "2.0"},
    "extensionsUsed": ["KHR_lights_punctual", "KHR_materials_variants", "KHR_materials_unlit", "KHR_texture_transform",
                       "KHR_materials_emissive_strength", "KHR_node_visibility", "EXT_mesh_gpu_instancing",
                       "EXT_texture_webp", "KHR_materials_clearcoat", "KHR_materials_sheen", "KHR_materials_specular",
                       "KHR_materials_ior", "KHR_materials_transmission", "KHR_materials_volume",
                       "KHR_materials_dispersion", "KHR_materials_diffuse_transmission", "KHR_materials_iridescence",
                       "KHR_materials_anisotropy", "KHR_materials_pbrSpecularGlossiness"],
    "extensions": {
      "KHR_lights_punctual": {"lights": [
        {"type": "spot", "name": "l", "color": [1, 1, 0.5], "intensity": 2, "range": 10,
         "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.5}}]},
      "KHR_materials_variants": {"variants": [{"name": "w"}]}},
    "images": [{"uri": "", "name": "i", "mimeType": "image/png"}],
    "samplers": [{"magFilter": 9728, "minFilter": 9984, "wrapS": 33071, "wrapT": 33648, "name": "s"}],
    "textures": [{"source": 0, "sampler": 0, "name": "t", "extensions": {"EXT_texture_webp": {"source": 0}}}],
    "materials": [
      {"name": "m", "pbrMetallicRoughness": {
         "baseColorFactor": [1, 0.5, 0.25, 1], "metallicFactor": 0.5, "roughnessFactor": 0.25,
         "baseColorTexture": {"index": 0, "texCoord": 1, "extensions": {"KHR_texture_transform":
           {"offset": [0.5, 0.5], "rotation": 1, "scale": [2, 2], "texCoord": 0}}},
         "metallicRoughnessTexture": {"index": 0, "texCoord": 0}},
       "normalTexture": {"index": 0, "texCoord": 0, "scale": 0.5},
       "occlusionTexture": {"index": 0, "texCoord": 0, "strength": 0.5},
       "emissiveTexture": {"index": 0, "texCoord": 0}, "emissiveFactor": [1, 1, 1],
       "alphaMode": "MASK", "alphaCutoff": 0.25, "doubleSided": true,
       "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 2}}},
      {"extensions": {"KHR_materials_unlit": {}}},
      {"name": "layers", "extensions": {
        "KHR_materials_clearcoat": {"clearcoatFactor": 0.5, "clearcoatTexture": {"index": 0},
          "clearcoatRoughnessFactor": 0.5, "clearcoatRoughnessTexture": {"index": 0},
          "clearcoatNormalTexture": {"index": 0, "scale": 0.5}},
        "KHR_materials_sheen": {"sheenColorFactor": [1, 0.5, 0.25], "sheenColorTexture": {"index": 0},
          "sheenRoughnessFactor": 0.5, "sheenRoughnessTexture": {"index": 0}},
        "KHR_materials_specular": {"specularFactor": 0.5, "specularTexture": {"index": 0},
          "specularColorFactor": [2, 0.5, 0.25], "specularColorTexture": {"index": 0}},
        "KHR_materials_ior": {"ior": 1.25},
        "KHR_materials_transmission": {"transmissionFactor": 0.5, "transmissionTexture": {"index": 0}},
        "KHR_materials_volume": {"thicknessFactor": 2, "thicknessTexture": {"index": 0}, "attenuationDistance": 3,
          "attenuationColor": [1, 0.5, 0.25]},
        "KHR_materials_dispersion": {"dispersion": 0.5},
        "KHR_materials_diffuse_transmission": {"diffuseTransmissionFactor": 0.5,
          "diffuseTransmissionTexture": {"index": 0}, "diffuseTransmissionColorFactor": [1, 0.5, 0.25],
          "diffuseTransmissionColorTexture": {"index": 0}},
        "KHR_materials_iridescence": {"iridescenceFactor": 0.5, "iridescenceTexture": {"index": 0},
          "iridescenceIor": 1.5, "iridescenceThicknessMinimum": 500, "iridescenceThicknessMaximum": 200,
          "iridescenceThicknessTexture": {"index": 0}},
        "KHR_materials_anisotropy": {"anisotropyStrength": 0.5, "anisotropyRotation": 1,
          "anisotropyTexture": {"index": 0}}}},
      {"name": "older", "extensions": {"KHR_materials_pbrSpecularGlossiness": {
        "diffuseFactor": [1, 0.5, 0.25, 1], "diffuseTexture": {"index": 0}, "specularFactor": [1, 0.5, 0.25],
        "glossinessFactor": 0.5, "specularGlossinessTexture": {"index": 0}}}}],
    "cameras": [
      {"name": "p", "type": "perspective", "perspective": {"yfov": 1, "znear": 0.1, "zfar": 100, "aspectRatio": 1}},
      {"name": "o", "type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": 0, "zfar": 10}}],
    "skins": [{"name": "k", "joints": [4], "inverseBindMatrices": 9, "skeleton": 4}],
    "animations": [{"name": "n",
      "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}},
                   {"sampler": 1, "target": {"node": 4, "path": "rotation"}},
                   {"sampler": 2, "target": {"node": 3, "path": "weights"}}],
      "samplers": [{"input": 11, "output": 12, "interpolation": "STEP"}, {"input": 11, "output": 13},
                   {"input": 11, "output": 14, "interpolation": "LINEAR"}]}],
    "scenes": [{"name": "one", "nodes": [0, 1, 2, 3, 4, 5, 6]}, {"name": "two", "nodes": [8]}],
    "nodes": [
      {"name": "triangle", "mesh": 0, "translation": [1, 2, 3], "rotation": [0, 0, 1, 0], "scale": [1, 2, 1],
       "extensions": {"KHR_node_visibility": {"visible": true}}},
      {"name": "eye", "camera": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1]},
      {"extensions": {"KHR_lights_punctual": {"light": 0}}},
      {"mesh": 1, "skin": 0, "weights": [0.5]},
      {"name": "joint"},
      {"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 12}}}},
      {"children": [7]},
      {"name": "child"},
      {"mesh": 2}],
    "meshes": [
      {"name": "first", "primitives": [{"attributes": {}, "indices": 6, "material": 0, "mode": 4,
        "extensions": {"KHR_materials_variants": {"mappings": [{"material": 1, "variants": [0]}]}}}]},
      {"primitives": [{"attributes": {"POSITION": 0, "JOINTS_0": 7, "WEIGHTS_0": 8}, "targets": [{"POSITION": 10}]}],
       "weights": [0]},
      {"primitives": [{"attributes": {"POSITION": 15}}]}]})"));
  json["images"][0]["uri"] = "data:image/png;base64," + std::string(png);
  for (int set = 0; set < 6; ++set) {
    const char* const names[] = {"POSITION", "NORMAL", "TANGENT", "TEXCOORD_0", "TEXCOORD_1", "COLOR_0"};
    json["meshes"][0]["primitives"][0]["attributes"][names[set]] = set;
  }
  return json;
}

}  // namespace facet::testing
