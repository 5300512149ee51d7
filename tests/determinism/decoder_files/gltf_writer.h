// Binary glTF files put together from buffer views, accessors and whatever else their JSON says.
#pragma once

#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "decoder_files.h"

namespace facet::decoder_files {

using Json = nlohmann::ordered_json;

enum ComponentType { kByte = 5120, kUnsignedByte, kShort, kUnsignedShort, kUnsignedInt = 5125, kFloat };

template <class T>
std::string BytesOf(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

class GltfWriter {
 public:
  GltfWriter() {
    root["asset"] = {{"version", "2.0"}};
    root["scene"] = 0;
    root["scenes"] = {{{"nodes", {0}}}};
  }

  // The index of the new view. `more` are further members.
  int View(const std::string& bytes, const Json& more = Json::object()) {
    bin_.resize((bin_.size() + 3) / 4 * 4, '\0');
    Json view = {{"buffer", 0}, {"byteOffset", bin_.size()}, {"byteLength", bytes.size()}};
    view.update(more);
    bin_ += bytes;
    return Append("bufferViews", std::move(view));
  }

  // View -1: none.
  int Accessor(int view, ComponentType component, std::size_t count, const std::string& type,
               const Json& more = Json::object()) {
    Json accessor = {{"componentType", component}, {"count", count}, {"type", type}};
    if (view >= 0) accessor["bufferView"] = view;
    accessor.update(more);
    return Append("accessors", std::move(accessor));
  }

  template <class T>
  int Accessor(const std::vector<T>& values, ComponentType component, const std::string& type) {
    return Accessor(View(BytesOf(values)), component, values.size(), type);
  }

  int Append(const char* list, Json element) {
    root[list].push_back(std::move(element));
    return static_cast<int>(root[list].size()) - 1;
  }

  void Require(const char* extension) {
    root["extensionsUsed"].push_back(extension);
    root["extensionsRequired"].push_back(extension);
  }

  void Write(const std::filesystem::path& path) {
    bin_.resize((bin_.size() + 3) / 4 * 4, '\0');
    root["buffers"] = {{{"byteLength", bin_.size()}}};
    std::string json = root.dump();
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const auto word = [](std::size_t value) { return BytesOf(std::vector{static_cast<std::uint32_t>(value)}); };
    const std::string chunks = word(json.size()) + "JSON" + json + word(bin_.size()) + std::string("BIN\0", 4) + bin_;
    WriteWhole(path, "glTF" + word(2) + word(12 + chunks.size()) + chunks);
  }

  std::size_t Size() const { return bin_.size(); }

  Json root;

 private:
  std::string bin_;
};

// One unlit square for each picture, side by side, blended by alpha.
void WritePictures(const std::filesystem::path& path, const std::string& mime,
                   const std::vector<std::string>& pictures);

}  // namespace facet::decoder_files
