#include "gltf/document.h"

#include <limits>

#include "gltf/schema.h"

namespace facet::gltf {
namespace {

// What tinygltf 2.7 must not see. It would read buffers and pictures by itself, it recurses into extensions and narrows
// their numbers to int, and builds of it that have Draco index buffers without a check.
bool IsForTinygltf(const std::string& key, bool at_root) {
  if (key == "extensions") return false;
  return !at_root || (key != "buffers" && key != "images" && key != "extensionsUsed" && key != "extensionsRequired");
}

Json CopyCore(const Json& value, bool at_root) {
  if (value.is_object()) {
    Json copy = Json::object();
    for (const auto& item : value.items()) {
      if (IsForTinygltf(item.key(), at_root)) copy[item.key()] = CopyCore(item.value(), false);
    }
    return copy;
  }
  if (value.is_array()) {
    Json copy = Json::array();
    copy.get_ref<Json::array_t&>().reserve(value.size());
    for (const Json& element : value) copy.push_back(CopyCore(element, false));
    return copy;
  }
  return value;
}

std::string FirstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

Document ParseDocument(std::string_view json, const Place& place) {
  Document document;
  document.root = ParseJson(json, place);
  CheckSchema(document.root, place);

  Json core = CopyCore(document.root, true);
  // tinygltf refuses index accessors without a buffer view, which is what Draco's are. They get a view past the end.
  const std::size_t view_count = core.contains("bufferViews") ? core["bufferViews"].size() : 0;
  core["bufferViews"].push_back(Json{{"buffer", 0}, {"byteLength", 1}});
  if (core.contains("accessors")) {
    for (Json& accessor : core["accessors"]) {
      if (!accessor.contains("bufferView")) accessor["bufferView"] = view_count;
    }
  }
  const std::string text = core.dump();
  if (text.size() > std::numeric_limits<unsigned>::max()) {
    Fail(place, "the JSON is larger than 4 GiB", {}, ErrorCode::Unsupported);
  }
  tinygltf::TinyGLTF parser;
  parser.RemoveImageLoader();
  std::string error, warning;
  if (!parser.LoadASCIIFromString(&document.core, &error, &warning, text.data(), static_cast<unsigned>(text.size()),
                                  "")) {
    Fail(place, "not a valid glTF file: " + FirstLine(error));
  }
  document.core.bufferViews.pop_back();
  for (auto& accessor : document.core.accessors) {
    if (accessor.bufferView == static_cast<int>(view_count)) accessor.bufferView = -1;
  }
  // Whatever the parser drops without a word would shift the indices of what follows.
  const auto same = [&](const char* list, std::size_t count) {
    const Json* array = Find(document.root, list);
    if ((array ? array->size() : 0) != count) {
      Fail(Place(place, list), "the parser lost some of these", {}, ErrorCode::Internal);
    }
  };
  same("bufferViews", document.core.bufferViews.size());
  same("accessors", document.core.accessors.size());
  same("meshes", document.core.meshes.size());
  same("nodes", document.core.nodes.size());
  same("materials", document.core.materials.size());
  same("textures", document.core.textures.size());
  same("samplers", document.core.samplers.size());
  same("cameras", document.core.cameras.size());
  same("skins", document.core.skins.size());
  same("animations", document.core.animations.size());
  same("scenes", document.core.scenes.size());
  return document;
}

}  // namespace facet::gltf
