// Writes glTF 2.0 binary files: the JSON is built by hand, buffers and accessors are added by these functions.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "shapes.h"

namespace facet::assets {

using Json = nlohmann::ordered_json;

class Glb {
 public:
  explicit Glb(const std::string& scene_name);

  // Each adds an element to the array of that name and returns its index.
  int Add(const char* array, Json element);
  int AddMaterial(Json material) { return Add("materials", std::move(material)); }
  int AddNode(Json node) { return Add("nodes", std::move(node)); }
  int AddRootNode(Json node);

  // Accessors of 32-bit floats; `width` numbers per element: 1, 2, 3, 4 or 16. `bounds` writes min and max.
  int AddFloats(const std::vector<float>& values, int width, bool bounds = false, int target = 0);
  int AddIndices(const std::vector<std::uint32_t>& indices);
  int AddJoints(const std::vector<std::array<std::uint8_t, 4>>& joints);
  // A PNG image, repeated and filtered trilinearly; returns the texture's index.
  int AddTexture(const std::string& name, const std::vector<std::uint8_t>& png);
  // A primitive of all attributes that `shape` has.
  Json MakePrimitive(const Shape& shape, int material);
  int AddMesh(const std::string& name, const Shape& shape, int material);
  void UseExtension(const std::string& name);

  Json& json() { return json_; }
  void Write(const std::filesystem::path& path);

 private:
  int AddView(const void* data, std::size_t size, int target);

  Json json_;
  std::vector<std::uint8_t> buffer_;
};

}  // namespace facet::assets
