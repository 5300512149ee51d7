// Small glTF files made by tests: buffers of numbers, JSON around them, a folder that disappears.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "facet/error.h"
#include "facet/load.h"

namespace facet::testing {

// A folder of its own for each test; removed with everything in it.
class TempFolder {
 public:
  TempFolder() {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    std::string pattern =
        (std::filesystem::temp_directory_path() / (std::string("facet_") + info->test_suite_name() + "_XXXXXX"))
            .string();
    path_ = mkdtemp(pattern.data());
  }
  ~TempFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::filesystem::path Write(const std::string& name, const std::string& bytes) const {
    const auto path = path_ / name;
    std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return path;
  }
  const std::filesystem::path& Path() const { return path_; }

 private:
  std::filesystem::path path_;
};

// The bytes of numbers, one after the other.
template <class T>
std::string Pack(std::initializer_list<T> values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), values.begin(), bytes.size());
  return bytes;
}

inline std::string Base64(const std::string& bytes) {
  static const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      out += i + k <= bytes.size() ? digits[(bits >> (18 - 6 * k)) & 63] : '=';
    }
  }
  return out;
}

inline std::string U32(std::size_t value) { return Pack({static_cast<std::uint32_t>(value)}); }

inline std::string Glb(std::string json, std::string bin = {}) {
  while (json.size() % 4) json += ' ';
  while (bin.size() % 4) bin += '\0';
  std::string chunks = U32(json.size()) + "JSON" + json;
  if (!bin.empty()) chunks += U32(bin.size()) + std::string("BIN\0", 4) + bin;
  return "glTF" + U32(2) + U32(12 + chunks.size()) + chunks;
}

// Collects buffer views and accessors around one buffer; Json() is a file with one mesh of one primitive.
class FileMaker {
 public:
  // Returns the view's index.
  int View(const std::string& bytes, int stride = 0, const std::string& more = {}) {
    while (bin_.size() % 4) bin_ += '\0';
    Append(views_, {"{\"buffer\":0,\"byteOffset\":", std::to_string(bin_.size()),
                    ",\"byteLength\":", std::to_string(bytes.size()), stride ? ",\"byteStride\":" : "",
                    stride ? std::to_string(stride) : "", more, "}"});
    bin_ += bytes;
    return view_count_++;
  }
  // Returns the accessor's index; view -1: none.
  int Accessor(int view, int component_type, std::size_t count, const std::string& type, const std::string& more = {}) {
    Append(accessors_, {"{\"componentType\":", std::to_string(component_type), ",\"count\":", std::to_string(count),
                        view >= 0 ? ",\"bufferView\":" : "", view >= 0 ? std::to_string(view) : "", ",\"type\":\"",
                        type, "\"", more, "}"});
    return accessor_count_++;
  }
  int Floats(const std::vector<float>& values, const std::string& type, int components) {
    std::string bytes(values.size() * sizeof(float), '\0');
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return Accessor(View(bytes), 5126, values.size() / static_cast<std::size_t>(components), type);
  }
  // Three vertices.
  int Triangle() { return Floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3); }

  void Attribute(const std::string& semantic, int accessor) {
    Append(attributes_, {"\"", semantic, "\":", std::to_string(accessor)});
  }
  std::string& PrimitiveMore() { return primitive_more_; }  // ",\"mode\":4"
  std::string& MeshMore() { return mesh_more_; }
  std::string& NodeMore() { return node_more_; }
  std::string& RootMore() { return root_more_; }
  const std::string& Bin() const { return bin_; }

  std::string Json(const std::string& uri = {}) const {
    std::string json =
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0" +
        node_more_ + "}" + nodes_more_ + "],\"meshes\":[{\"primitives\":[{\"attributes\":{" + attributes_ + "}" +
        primitive_more_ + "}]" + mesh_more_ + "}]";
    if (view_count_) json += ",\"bufferViews\":[" + views_ + "]";
    if (accessor_count_) json += ",\"accessors\":[" + accessors_ + "]";
    if (!bin_.empty()) {
      json += ",\"buffers\":[{\"byteLength\":" + std::to_string(bin_.size()) +
              (uri.empty() ? "" : ",\"uri\":\"" + uri + "\"") + "}]";
    }
    return json + root_more_ + "}";
  }
  std::string& NodesMore() { return nodes_more_; }  // ",{...}": further nodes
  std::string AsGlb() const { return Glb(Json(), bin_); }

 private:
  // One more element of a JSON list.
  static void Append(std::string& list, std::initializer_list<std::string> parts) {
    if (!list.empty()) list += ',';
    for (const std::string& part : parts) list += part;
  }

  std::string bin_, views_, accessors_, attributes_, primitive_more_, mesh_more_, node_more_, nodes_more_, root_more_;
  int view_count_ = 0, accessor_count_ = 0;
};

inline LoadOptions WithinMemory(std::uint64_t limit) {
  LoadOptions options;
  options.memory_limit = limit;
  return options;
}

inline LoadedScene LoadBytes(const std::string& bytes, const LoadOptions& options = {}) {
  const TempFolder folder;
  return LoadGltf(folder.Write("test.glb", bytes), options);
}

// The message of the Error that loading must throw, its code checked.
inline std::string LoadError(const std::string& bytes, ErrorCode code, const LoadOptions& options = {}) {
  try {
    LoadBytes(bytes, options);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return {};
}

inline std::filesystem::path CorpusPath() {
  if (const char* path = std::getenv("FACET_CORPUS")) return path;
  return std::filesystem::path(FACET_SOURCE_DIR) / "../shared/corpus";
}

}  // namespace facet::testing

#define FACET_NEED_CORPUS()                                                             \
  if (!std::filesystem::is_directory(::facet::testing::CorpusPath() / "models")) {      \
    GTEST_SKIP() << "the corpus is not at " << ::facet::testing::CorpusPath().string(); \
  }
