#include "cli/tiny_scene.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

namespace facet::test {
namespace {

template <class T>
void Append(std::vector<std::uint8_t>& bytes, std::initializer_list<T> values) {
  for (const T value : values) {
    std::array<std::uint8_t, sizeof(T)> raw;
    std::memcpy(raw.data(), &value, sizeof(T));
    bytes.insert(bytes.end(), raw.begin(), raw.end());
  }
}

std::string Base64(const std::vector<std::uint8_t>& bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = bytes.size() - i;
    const std::uint32_t triple = std::uint32_t(bytes[i]) << 16 | (left > 1 ? std::uint32_t(bytes[i + 1]) << 8 : 0u) |
                                 (left > 2 ? std::uint32_t(bytes[i + 2]) : 0u);
    text += kDigits[triple >> 18];
    text += kDigits[triple >> 12 & 63];
    text += left > 1 ? kDigits[triple >> 6 & 63] : '=';
    text += left > 2 ? kDigits[triple & 63] : '=';
  }
  return text;
}

}  // namespace

std::string TinyScene(const std::string& extra) {
  std::vector<std::uint8_t> bytes;
  Append<float>(bytes, {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0});  // positions: 48 bytes
  Append<std::uint16_t>(bytes, {0, 1, 2, 0, 2, 3});                // indices: 12 bytes, at 48
  Append<float>(bytes, {0, 1});                                    // times: 8 bytes, at 60
  Append<float>(bytes, {0, 0, 0, 10, 0, 0});                       // translations: 24 bytes, at 68
  return R"({"asset": {"version": "2.0", "generator": "facet's tests"},)" +
         (extra.find("extensionsUsed") == extra.npos
              ? R"("extensionsUsed": ["KHR_materials_unlit", "KHR_materials_variants"],)" + extra
              : extra) +
         R"(
"scene": 0,
"scenes": [{"name": "Main", "nodes": [0, 1, 2]}, {"name": "Small", "nodes": [3, 1, 2]},
           {"name": "Lit", "nodes": [4, 1, 2]}],
"nodes": [{"name": "Square", "mesh": 0}, {"translation": [0, 0, 3], "camera": 0}, {"translation": [0, 0, 3], "camera": 1},
          {"mesh": 0, "scale": [0.25, 0.25, 0.25]}, {"mesh": 1}],
"cameras": [{"name": "Front", "type": "perspective", "perspective": {"yfov": 1.0, "znear": 0.1}},
            {"name": "Flat", "type": "orthographic",
             "orthographic": {"xmag": 4, "ymag": 4, "znear": 0.1, "zfar": 10}}],
"animations": [{"name": "Slide", "samplers": [{"input": 2, "output": 3}],
                "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}],
"materials": [
  {"name": "Red", "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}, "extensions": {"KHR_materials_unlit": {}}},
  {"name": "Blue", "pbrMetallicRoughness": {"baseColorFactor": [0, 0, 1, 1]}, "extensions": {"KHR_materials_unlit": {}}},
  {"name": "White", "doubleSided": true, "pbrMetallicRoughness": {"metallicFactor": 0}}],
"extensions": {"KHR_materials_variants": {"variants": [{"name": "Plain"}, {"name": "Blue"}]}},
"meshes": [
  {"name": "Unlit", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0,
    "extensions": {"KHR_materials_variants": {"mappings": [{"material": 1, "variants": [1]}]}}}]},
  {"name": "Lit", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 2}]}],
"accessors": [
  {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]},
  {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
  {"bufferView": 2, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]},
  {"bufferView": 3, "componentType": 5126, "count": 2, "type": "VEC3"}],
"bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12},
                {"buffer": 0, "byteOffset": 60, "byteLength": 8}, {"buffer": 0, "byteOffset": 68, "byteLength": 24}],
"buffers": [{"byteLength": )" +
         std::to_string(bytes.size()) + R"(, "uri": "data:application/octet-stream;base64,)" + Base64(bytes) +
         "\"}]}\n";
}

}  // namespace facet::test
