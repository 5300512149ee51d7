#include <meshoptimizer.h>

#include <cmath>

#include "gltf_writer.h"
#include "sheet.h"

namespace facet::decoder_files {
namespace {

class MeshoptWriter : public GltfWriter {
 public:
  MeshoptWriter() {
    Require("EXT_meshopt_compression");
    Require("KHR_mesh_quantization");
    root["scenes"][0]["nodes"] = Json::array();
  }

  // A view of `count` elements that unpacks from `packed`. Its own bytes are zeros.
  int Packed(const std::string& packed, std::size_t count, std::size_t stride, const char* mode,
             const char* filter = "NONE", const Json& more = Json::object()) {
    const int source = View(packed);
    const Json extension = {{"buffer", 0},
                            {"byteOffset", root["bufferViews"][static_cast<std::size_t>(source)]["byteOffset"]},
                            {"byteLength", packed.size()},
                            {"byteStride", stride},
                            {"count", count},
                            {"mode", mode},
                            {"filter", filter}};
    Json members = {{"extensions", {{"EXT_meshopt_compression", extension}}}};
    members.update(more);
    return View(std::string(count * stride, '\0'), members);
  }

  // Elements of `stride` bytes, as vertices have them.
  int Vertices(const void* elements, std::size_t count, std::size_t stride, const char* filter = "NONE") {
    return Packed(PackElements(elements, count, stride), count, stride, "ATTRIBUTES", filter, {{"byteStride", stride}});
  }
  // The same where a stride is not allowed: animations.
  int Keys(const void* elements, std::size_t count, std::size_t stride, const char* filter) {
    return Packed(PackElements(elements, count, stride), count, stride, "ATTRIBUTES", filter);
  }

  // A mesh in a node of its own, beside those before it.
  int AddMesh(const Json& attributes, int indices, int mode = 4) {
    const Json primitive = {{"attributes", attributes}, {"indices", indices}, {"mode", mode}};
    const int mesh = Append("meshes", {{"primitives", Json::array({primitive})}});
    const int node = Append("nodes", {{"mesh", mesh}, {"translation", {mesh % 4 * 2.6, mesh / 4 * -2.6, 0.0}}});
    root["scenes"][0]["nodes"].push_back(node);
    return node;
  }

 private:
  static std::string PackElements(const void* elements, std::size_t count, std::size_t stride) {
    std::string packed(meshopt_encodeVertexBufferBound(count, stride), '\0');
    packed.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(packed.data()), packed.size(), elements,
                                             count, stride));
    return packed;
  }
};

constexpr std::size_t kCount = Sheet::kCount;

int PlainPositions(MeshoptWriter& file, const Sheet& sheet) {
  return file.Accessor(file.Vertices(sheet.positions.data(), kCount, 12), kFloat, kCount, "VEC3");
}

int PlainIndices(MeshoptWriter& file, const Sheet& sheet) {
  return file.Accessor(sheet.indices, kUnsignedInt, "SCALAR");
}

void WriteOctahedral(const std::filesystem::path& path) {
  const Sheet sheet;
  MeshoptWriter file;
  const int positions = PlainPositions(file, sheet), indices = PlainIndices(file, sheet);
  Values<float, 4> normals;
  for (const auto& n : sheet.normals) normals.push_back({n[0], n[1], n[2], 0.0f});
  const auto add = [&](int bits, bool wide) {
    std::string packed(kCount * (wide ? 8 : 4), '\0');
    const auto vectors = [&](const Values<float, 4>& values, const char* type) {
      const std::size_t stride = wide ? 8 : 4;
      meshopt_encodeFilterOct(packed.data(), kCount, stride, bits, values[0].data());
      return file.Accessor(file.Vertices(packed.data(), kCount, stride, "OCTAHEDRAL"), wide ? kShort : kByte, kCount,
                           type, {{"normalized", true}});
    };
    const int normal = vectors(normals, "VEC3"), tangent = vectors(sheet.tangents, "VEC4");
    file.AddMesh({{"POSITION", positions}, {"NORMAL", normal}, {"TANGENT", tangent}}, indices);
  };
  for (int bits = 3; bits <= 8; ++bits) add(bits, false);
  for (int bits = 5; bits <= 16; ++bits) add(bits, true);
  file.Write(path);
}

void WriteExponential(const std::filesystem::path& path) {
  const Sheet sheet;
  MeshoptWriter file;
  const int indices = PlainIndices(file, sheet);
  for (const int bits : {6, 12, 15, 24}) {
    std::vector<std::uint32_t> packed(kCount * 3);
    const auto vectors = [&](const float* values, std::size_t components, const char* type) {
      meshopt_encodeFilterExp(packed.data(), kCount, components * 4, bits, values);
      return file.Accessor(file.Vertices(packed.data(), kCount, components * 4, "EXPONENTIAL"), kFloat, kCount, type);
    };
    const int positions = vectors(sheet.positions[0].data(), 3, "VEC3"), uvs = vectors(sheet.uvs[0].data(), 2, "VEC2");
    file.AddMesh({{"POSITION", positions}, {"TEXCOORD_0", uvs}}, indices);
  }
  file.Write(path);
}

// Animated, as rotations are keys.
void WriteQuaternions(const std::filesystem::path& path) {
  const Sheet sheet;
  MeshoptWriter file;
  const int positions = PlainPositions(file, sheet), indices = PlainIndices(file, sheet);
  constexpr std::size_t kKeys = 32;
  std::vector<float> times;
  Values<float, 4> rotations;
  for (std::size_t i = 0; i < kKeys; ++i) {
    const float t = float(i) / 20.0f;
    times.push_back(t);
    rotations.push_back(
        Sheet::Unit(std::array{std::sin(t * 3.0f), std::cos(t * 5.0f), std::sin(t + 1.0f), std::cos(t * 7.0f)}));
  }
  const int input = file.Accessor(times, kFloat, "SCALAR");
  Json channels, samplers;
  for (int bits = 4; bits <= 16; ++bits) {
    Values<std::int16_t, 4> packed(kKeys);
    meshopt_encodeFilterQuat(packed.data(), kKeys, 8, bits, rotations[0].data());
    const int output =
        file.Accessor(file.Keys(packed.data(), kKeys, 8, "QUATERNION"), kShort, kKeys, "VEC4", {{"normalized", true}});
    const int node = file.AddMesh({{"POSITION", positions}}, indices);
    channels.push_back({{"sampler", samplers.size()}, {"target", {{"node", node}, {"path", "rotation"}}}});
    samplers.push_back({{"input", input}, {"output", output}});
  }
  file.Append("animations", {{"channels", channels}, {"samplers", samplers}});
  file.Write(path);
}

using Bound = std::size_t (*)(std::size_t, std::size_t);
using Encoder = std::size_t (*)(unsigned char*, std::size_t, const unsigned*, std::size_t);

std::string PackIndices(const std::vector<std::uint32_t>& indices, Bound bound, Encoder encode) {
  std::string packed(bound(indices.size(), kCount), '\0');
  packed.resize(encode(reinterpret_cast<unsigned char*>(packed.data()), packed.size(), indices.data(), indices.size()));
  return packed;
}

// Indices as triangles and as sequences, of two and of four bytes; attributes without a filter.
void WriteModes(const std::filesystem::path& path) {
  const Sheet sheet;
  MeshoptWriter file;
  const int colors = file.Accessor(file.Vertices(sheet.colors.data(), kCount, 4), kUnsignedByte, kCount, "VEC4",
                                   {{"normalized", true}});
  const Json attributes = {{"POSITION", PlainPositions(file, sheet)}, {"COLOR_0", colors}};
  std::vector<std::uint32_t> border;
  for (std::uint32_t i = 0; i < kCount; i += Sheet::kSide - 1) border.push_back(i);
  for (const std::size_t size : {std::size_t(2), std::size_t(4)}) {
    const auto add = [&](const std::string& packed, std::size_t count, const char* mode, int topology) {
      const int view = file.Packed(packed, count, size, mode);
      file.AddMesh(attributes, file.Accessor(view, size == 2 ? kUnsignedShort : kUnsignedInt, count, "SCALAR"),
                   topology);
    };
    constexpr int kLineStrip = 3, kTriangles = 4;
    add(PackIndices(sheet.indices, meshopt_encodeIndexBufferBound, meshopt_encodeIndexBuffer), sheet.indices.size(),
        "TRIANGLES", kTriangles);
    const auto sequence = [&](const std::vector<std::uint32_t>& indices) {
      return PackIndices(indices, meshopt_encodeIndexSequenceBound, meshopt_encodeIndexSequence);
    };
    add(sequence(sheet.indices), sheet.indices.size(), "INDICES", kTriangles);
    add(sequence(border), border.size(), "INDICES", kLineStrip);
  }
  file.Write(path);
}

}  // namespace

void WriteMeshopt(const Folder& folder) {
  WriteOctahedral(folder / "meshopt-octahedral.glb");
  WriteExponential(folder / "meshopt-exponential.glb");
  WriteQuaternions(folder / "meshopt-quaternion.glb");
  WriteModes(folder / "meshopt-modes.glb");
}

}  // namespace facet::decoder_files
