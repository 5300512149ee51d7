// Files as tinygltf reads them, and the numbers of their accessors as glTF 2.0 defines them (sections 3.6.2 and 3.11).
#pragma once

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <tiny_gltf.h>
#pragma GCC diagnostic pop

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace facet::testing {

// Nothing where tinygltf cannot read the file. Pictures are left alone.
inline std::optional<tinygltf::Model> ReadWithTinygltf(const std::filesystem::path& path) {
  tinygltf::TinyGLTF reader;
  reader.SetImageLoader([](tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*, int,
                           void*) { return true; },
                        nullptr);
  char magic[4] = {};
  std::ifstream(path, std::ios::binary).read(magic, sizeof magic);
  const bool is_binary = std::memcmp(magic, "glTF", sizeof magic) == 0;
  tinygltf::Model model;
  std::string error, warning;
  const bool is_read = is_binary ? reader.LoadBinaryFromFile(&model, &error, &warning, path.string())
                                 : reader.LoadASCIIFromFile(&model, &error, &warning, path.string());
  if (!is_read) return std::nullopt;
  return model;
}

// The numbers of `count` elements of `width`.
struct Table {
  std::size_t count = 0, width = 0;
  std::vector<double> numbers;
  double At(std::size_t element, std::size_t component) const { return numbers.at(element * width + component); }
};

inline double NumberAt(const std::vector<unsigned char>& data, std::size_t at, int type, bool normalized) {
  const auto as = [&](auto zero, double most) {
    auto value = zero;
    if (at + sizeof value > data.size()) throw std::out_of_range("an accessor reaches past its buffer");
    std::memcpy(&value, data.data() + at, sizeof value);
    return normalized ? std::max(static_cast<double>(value) / most, -1.0) : static_cast<double>(value);
  };
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: return as(std::int8_t{}, 127.0);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return as(std::uint8_t{}, 255.0);
    case TINYGLTF_COMPONENT_TYPE_SHORT: return as(std::int16_t{}, 32767.0);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return as(std::uint16_t{}, 65535.0);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return as(std::uint32_t{}, 4294967295.0);
    case TINYGLTF_COMPONENT_TYPE_FLOAT: return as(float{}, 1.0);
    default: throw std::invalid_argument("an accessor has a type that glTF does not have");
  }
}

// Vectors, and matrices of floats (whose columns need no padding).
inline Table ValuesOf(const tinygltf::Model& model, int index) {
  const tinygltf::Accessor& accessor = model.accessors.at(static_cast<std::size_t>(index));
  const auto type_size =
      static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType)));
  Table table;
  table.count = accessor.count;
  table.width = static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)));
  table.numbers.assign(table.count * table.width, 0.0);
  // `to(k)`: which element the k-th one of the view is.
  const auto read = [&](int view_index, std::size_t offset, std::size_t count, const auto& to) {
    const tinygltf::BufferView& view = model.bufferViews.at(static_cast<std::size_t>(view_index));
    const std::vector<unsigned char>& data = model.buffers.at(static_cast<std::size_t>(view.buffer)).data;
    const std::size_t stride = view.byteStride != 0 ? view.byteStride : table.width * type_size;
    for (std::size_t k = 0; k < count; ++k) {
      for (std::size_t c = 0; c < table.width; ++c) {
        const std::size_t at = view.byteOffset + offset + k * stride + c * type_size;
        table.numbers.at(to(k) * table.width + c) = NumberAt(data, at, accessor.componentType, accessor.normalized);
      }
    }
  };
  if (accessor.bufferView >= 0)
    read(accessor.bufferView, accessor.byteOffset, table.count, [](std::size_t k) { return k; });
  if (accessor.sparse.isSparse) {
    const auto& indices = accessor.sparse.indices;
    const tinygltf::BufferView& view = model.bufferViews.at(static_cast<std::size_t>(indices.bufferView));
    const auto index_size =
        static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(indices.componentType)));
    read(accessor.sparse.values.bufferView, static_cast<std::size_t>(accessor.sparse.values.byteOffset),
         static_cast<std::size_t>(accessor.sparse.count), [&](std::size_t k) {
           const std::size_t at = view.byteOffset + static_cast<std::size_t>(indices.byteOffset) + k * index_size;
           return static_cast<std::size_t>(NumberAt(model.buffers.at(static_cast<std::size_t>(view.buffer)).data, at,
                                                    indices.componentType, false));
         });
  }
  return table;
}

// Whether the numbers stand in the file as they are, not packed by meshopt.
inline bool IsPlain(const tinygltf::Model& model, int accessor) {
  const int view = model.accessors.at(static_cast<std::size_t>(accessor)).bufferView;
  return view < 0 ||
         !model.bufferViews.at(static_cast<std::size_t>(view)).extensions.contains("EXT_meshopt_compression");
}

inline bool IsPlain(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
  if (primitive.extensions.contains("KHR_draco_mesh_compression")) return false;
  if (primitive.indices >= 0 && !IsPlain(model, primitive.indices)) return false;
  for (const auto& [semantic, accessor] : primitive.attributes) {
    if (!IsPlain(model, accessor)) return false;
  }
  for (const auto& target : primitive.targets) {
    for (const auto& [semantic, accessor] : target) {
      if (!IsPlain(model, accessor)) return false;
    }
  }
  return true;
}

}  // namespace facet::testing
