#include "gltf/draco_pack.h"
#include "gltf_writer.h"
#include "sheet.h"

namespace facet::decoder_files {
namespace {

using draco::GeometryAttribute;

struct Semantic {
  const char* name;
  ComponentType component;
  const char* type;
  testing::DracoAttribute packed;
};

// `bits` is how many the quantised attributes get; 0: as they are.
std::vector<Semantic> Semantics(const Sheet& sheet, int bits) {
  const auto floats = [&](const char* name, GeometryAttribute::Type type, const auto& values) {
    const auto components = static_cast<int>(values[0].size());
    const char* const types[] = {"VEC2", "VEC3", "VEC4"};
    return Semantic{name, kFloat, types[components - 2], {type, draco::DT_FLOAT32, components, values.data(), bits}};
  };
  const auto bytes = [&](const char* name, GeometryAttribute::Type type, const auto& values) {
    return Semantic{name, kUnsignedByte, "VEC4", {type, draco::DT_UINT8, 4, values.data()}};
  };
  return {floats("POSITION", GeometryAttribute::POSITION, sheet.positions),
          floats("NORMAL", GeometryAttribute::NORMAL, sheet.normals),
          floats("TANGENT", GeometryAttribute::GENERIC, sheet.tangents),
          floats("TEXCOORD_0", GeometryAttribute::TEX_COORD, sheet.uvs),
          floats("TEXCOORD_1", GeometryAttribute::GENERIC, sheet.uvs),
          bytes("COLOR_0", GeometryAttribute::COLOR, sheet.colors),
          bytes("JOINTS_0", GeometryAttribute::GENERIC, sheet.joints),
          floats("WEIGHTS_0", GeometryAttribute::GENERIC, sheet.weights)};
}

void WriteOne(const std::filesystem::path& path, const testing::DracoPacking& packing, int bits) {
  const Sheet sheet;
  GltfWriter file;
  file.Require("KHR_draco_mesh_compression");
  std::vector<testing::DracoAttribute> packed;
  Json attributes, ids;
  for (const Semantic& semantic : Semantics(sheet, bits)) {
    const bool is_color = std::string(semantic.name) == "COLOR_0";
    ids[semantic.name] = packed.size();
    attributes[semantic.name] =
        file.Accessor(-1, semantic.component, Sheet::kCount, semantic.type, {{"normalized", is_color}});
    packed.push_back(semantic.packed);
  }
  const int view = file.View(testing::PackDraco(Sheet::kCount, sheet.indices, packed, packing));
  const Json primitive = {
      {"attributes", attributes},
      {"indices", file.Accessor(-1, kUnsignedInt, sheet.indices.size(), "SCALAR")},
      {"extensions", {{"KHR_draco_mesh_compression", {{"bufferView", view}, {"attributes", ids}}}}}};
  file.Append("meshes", {{"primitives", Json::array({primitive})}});
  file.root["scenes"] = {{{"nodes", {0, 1, 2}}}};
  file.Append("nodes", {{"mesh", 0}, {"skin", 0}});
  file.Append("nodes", {{"translation", {0.1, 0.0, 0.0}}});
  file.Append("nodes", {{"translation", {0.0, 0.2, 0.3}}, {"rotation", {0.0, 0.6, 0.0, 0.8}}});
  file.Append("skins", {{"joints", {1, 2}}});
  file.Write(path);
}

}  // namespace

void WriteDraco(const Folder& folder) {
  for (const auto method : {draco::MESH_EDGEBREAKER_ENCODING, draco::MESH_SEQUENTIAL_ENCODING}) {
    for (const int speed : {0, 5, 10}) {
      for (const int bits : {0, 9, 13}) {
        std::string name = method == draco::MESH_EDGEBREAKER_ENCODING ? "draco-edgebreaker" : "draco-sequential";
        name += "-speed" + std::to_string(speed);
        name += bits ? "-bits" + std::to_string(bits) : std::string("-plain");
        WriteOne(folder / (name + ".glb"), {method, speed}, bits);
      }
    }
  }
}

}  // namespace facet::decoder_files
