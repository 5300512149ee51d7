#include "glb.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace facet::assets {
namespace {

constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;
constexpr int kFloat = 5126, kUnsignedInt = 5125, kUnsignedShort = 5123, kUnsignedByte = 5121;

const char* TypeName(int width) {
  switch (width) {
    case 1: return "SCALAR";
    case 2: return "VEC2";
    case 3: return "VEC3";
    case 4: return "VEC4";
    default: return "MAT4";
  }
}

void AppendLittleEndian(std::vector<std::uint8_t>& out, std::uint32_t value) {
  for (int shift : {0, 8, 16, 24}) out.push_back(std::uint8_t(value >> shift));
}

std::vector<float> Flatten(const std::vector<Vec3>& values) {
  std::vector<float> flat;
  for (const Vec3& v : values) flat.insert(flat.end(), {float(v.x), float(v.y), float(v.z)});
  return flat;
}

}  // namespace

Glb::Glb(const std::string& scene_name) {
  json_["asset"] = {{"version", "2.0"}, {"generator", "facet's asset generator"}};
  json_["scene"] = 0;
  json_["scenes"] = Json::array({{{"name", scene_name}, {"nodes", Json::array()}}});
}

int Glb::Add(const char* array, Json element) {
  Json& list = json_[array];
  if (!list.is_array()) list = Json::array();
  list.push_back(std::move(element));
  return int(list.size()) - 1;
}

int Glb::AddRootNode(Json node) {
  const int index = AddNode(std::move(node));
  json_["scenes"][0]["nodes"].push_back(index);
  return index;
}

int Glb::AddView(const void* data, std::size_t size, int target) {
  while (buffer_.size() % 4 != 0) buffer_.push_back(0);
  Json view = {{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", size}};
  if (target != 0) view["target"] = target;
  const auto* bytes = static_cast<const std::uint8_t*>(data);
  buffer_.insert(buffer_.end(), bytes, bytes + size);
  return Add("bufferViews", view);
}

int Glb::AddFloats(const std::vector<float>& values, int width, bool bounds, int target) {
  Json accessor = {{"bufferView", AddView(values.data(), values.size() * sizeof(float), target)},
                   {"componentType", kFloat},
                   {"count", values.size() / std::size_t(width)},
                   {"type", TypeName(width)}};
  if (bounds) {
    std::vector<float> low(values.begin(), values.begin() + width), high = low;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::size_t c = i % std::size_t(width);
      low[c] = std::min(low[c], values[i]);
      high[c] = std::max(high[c], values[i]);
    }
    accessor["min"] = low;
    accessor["max"] = high;
  }
  return Add("accessors", accessor);
}

int Glb::AddIndices(const std::vector<std::uint32_t>& indices) {
  const std::uint32_t largest = *std::max_element(indices.begin(), indices.end());
  int view = -1;
  const bool is_short = largest < 65535;
  if (is_short) {
    const std::vector<std::uint16_t> narrow(indices.begin(), indices.end());
    view = AddView(narrow.data(), narrow.size() * sizeof(std::uint16_t), kElementArrayBuffer);
  } else {
    view = AddView(indices.data(), indices.size() * sizeof(std::uint32_t), kElementArrayBuffer);
  }
  return Add("accessors", {{"bufferView", view},
                           {"componentType", is_short ? kUnsignedShort : kUnsignedInt},
                           {"count", indices.size()},
                           {"type", "SCALAR"}});
}

int Glb::AddJoints(const std::vector<std::array<std::uint8_t, 4>>& joints) {
  return Add("accessors", {{"bufferView", AddView(joints.data(), joints.size() * 4, kArrayBuffer)},
                           {"componentType", kUnsignedByte},
                           {"count", joints.size()},
                           {"type", "VEC4"}});
}

int Glb::AddTexture(const std::string& name, const std::vector<std::uint8_t>& png) {
  if (!json_.contains("samplers")) {
    Add("samplers", {{"magFilter", 9729}, {"minFilter", 9987}, {"wrapS", 10497}, {"wrapT", 10497}});
  }
  const int image =
      Add("images", {{"name", name}, {"mimeType", "image/png"}, {"bufferView", AddView(png.data(), png.size(), 0)}});
  return Add("textures", {{"name", name}, {"sampler", 0}, {"source", image}});
}

Json Glb::MakePrimitive(const Shape& shape, int material) {
  Json attributes = {{"POSITION", AddFloats(Flatten(shape.positions), 3, true, kArrayBuffer)}};
  if (!shape.normals.empty()) attributes["NORMAL"] = AddFloats(Flatten(shape.normals), 3, false, kArrayBuffer);
  if (!shape.uvs.empty()) {
    std::vector<float> flat;
    for (const Vec2& uv : shape.uvs) flat.insert(flat.end(), {float(uv.x), float(uv.y)});
    attributes["TEXCOORD_0"] = AddFloats(flat, 2, false, kArrayBuffer);
  }
  const auto four_numbers = [&](const std::vector<std::array<float, 4>>& values) {
    std::vector<float> flat;
    for (const auto& value : values) flat.insert(flat.end(), value.begin(), value.end());
    return AddFloats(flat, 4, false, kArrayBuffer);
  };
  if (!shape.tangents.empty()) attributes["TANGENT"] = four_numbers(shape.tangents);
  if (!shape.joints.empty()) {
    attributes["JOINTS_0"] = AddJoints(shape.joints);
    attributes["WEIGHTS_0"] = four_numbers(shape.weights);
  }
  return {{"attributes", attributes}, {"indices", AddIndices(shape.indices)}, {"material", material}};
}

int Glb::AddMesh(const std::string& name, const Shape& shape, int material) {
  return Add("meshes", {{"name", name}, {"primitives", Json::array({MakePrimitive(shape, material)})}});
}

void Glb::UseExtension(const std::string& name) {
  Json& used = json_["extensionsUsed"];
  if (!used.is_array()) used = Json::array();
  if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
}

void Glb::Write(const std::filesystem::path& path) {
  while (buffer_.size() % 4 != 0) buffer_.push_back(0);
  json_["buffers"] = Json::array({{{"byteLength", buffer_.size()}}});
  std::string text = json_.dump();
  while (text.size() % 4 != 0) text += ' ';
  std::vector<std::uint8_t> out;
  const std::size_t total = 12 + 8 + text.size() + 8 + buffer_.size();
  for (std::uint32_t word : {0x46546C67u, 2u, std::uint32_t(total), std::uint32_t(text.size()), 0x4E4F534Au}) {
    AppendLittleEndian(out, word);
  }
  out.insert(out.end(), text.begin(), text.end());
  for (std::uint32_t word : {std::uint32_t(buffer_.size()), 0x004E4942u}) AppendLittleEndian(out, word);
  out.insert(out.end(), buffer_.begin(), buffer_.end());
  std::ofstream stream(path, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(out.data()), std::streamsize(out.size()));
  stream.close();
  if (!stream) throw std::runtime_error("cannot write " + path.string());
}

}  // namespace facet::assets
