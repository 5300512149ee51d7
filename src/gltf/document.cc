#include "gltf/document.h"

#include <cctype>

#include "base/json_bounds.h"

namespace facet::gltf {
namespace {

constexpr const char* kLists[] = {"accessors", "animations", "bufferViews", "buffers", "cameras",
                                  "images",    "materials",  "meshes",      "nodes",   "samplers",
                                  "scenes",    "skins",      "textures"};

[[noreturn]] void FailVersion(const Place& place, const std::string& version) {
  Fail(place, "glTF " + version + " is not supported", "convert it to glTF 2.0", ErrorCode::Unsupported);
}

// The version in asset[key], such as "2.0"; numbers, "2" and "2.0.1" are accepted too. Empty if absent.
std::string ReadVersion(const Json& asset, const char* key, const Place& asset_place) {
  const Json* value = Find(asset, key);
  if (!value) return {};
  const Place place(asset_place, key);
  const std::string text = value->is_string() ? value->get<std::string>() : value->is_number() ? value->dump() : "";
  const bool known = !text.empty() && std::isdigit(static_cast<unsigned char>(text[0])) && text.back() != '.' &&
                     text.find_first_not_of("0123456789.") == std::string::npos && text.find("..") == std::string::npos;
  if (!known) Fail(place, "is not a version such as \"2.0\"");
  const std::size_t dot = text.find('.');
  const std::string version = dot == std::string::npos ? text + ".0" : text.substr(0, text.find('.', dot + 1));
  if (!value->is_string() || version != text) {
    place.Warn("is not a version such as \"2.0\"; it is read as " + version);
  }
  return version;
}

std::string CheckVersion(const Json& root, const Place& place) {
  // glTF 1.0 had objects in place of lists, and "asset" was optional.
  const Json* meshes = Find(root, "meshes");
  const bool looks_like_first = meshes && meshes->is_object();
  const Json* asset = Find(root, "asset");
  if (!asset || !asset->is_object()) {
    if (looks_like_first) FailVersion(place, "1.0");
    Fail(place, "\"asset\" is missing: not a glTF 2.0 file", "convert it to glTF 2.0");
  }
  const Place asset_place(place, "asset");
  if (Find(root, "geometricError")) {
    Fail(place, "a 3D Tiles tileset, not a glTF file", "name one of the tiles that it lists");
  }
  const std::string version = ReadVersion(*asset, "version", asset_place);
  if (version.empty() && looks_like_first) FailVersion(place, "1.0");
  if (version.empty()) Fail(asset_place, "\"version\" is missing");
  if (version.substr(0, version.find('.')) != "2") FailVersion(Place(asset_place, "version"), version);
  std::string minimum;
  try {
    minimum = ReadVersion(*asset, "minVersion", asset_place);
  } catch (const Error& error) {
    Place(asset_place, "minVersion").Warn("ignored", error);
  }
  if (!minimum.empty() && minimum != "2.0") {
    Fail(Place(asset_place, "minVersion"), "glTF " + minimum + " is required", "convert it to glTF 2.0",
         ErrorCode::Unsupported);
  }
  return version;
}

}  // namespace

Document ParseDocument(std::string_view json, const Place& place) {
  Document document;
  document.memory = MemoryLease(JsonMemory(json), 1, "JSON", place.Full());
  document.root = ParseJson(json, place);
  CheckObject(document.root, place);
  document.version = CheckVersion(document.root, place);
  if (document.version != "2.0") {
    Place(Place(place, "asset"), "version").Warn("glTF " + document.version + " is read as 2.0");
  }
  for (const char* list : kLists) {
    const auto found = document.root.find(list);
    if (found == document.root.end()) continue;
    if (LenientArray(document.root, list, place) == nullptr) {
      document.root.erase(found);
      continue;
    }
    const Place list_place(place, list);
    for (std::size_t i = 0; i < found->size(); ++i) {
      if ((*found)[i].is_object()) continue;
      (*found)[i] = LenientElement((*found)[i], Place(list_place, i));
    }
  }
  return document;
}

}  // namespace facet::gltf
