#include "gltf/files.h"

#include <algorithm>
#include <optional>
#include <system_error>
#include <vector>

#include "gltf/uri.h"

namespace facet::gltf {
namespace {

namespace fs = std::filesystem;

fs::path PathOfUtf8(const std::string& name) { return fs::path(std::u8string(name.begin(), name.end())); }

// The names that a URI may stand for, the likeliest first.
std::vector<std::string> NamesOf(const std::string& uri) {
  std::vector<std::string> names;
  const auto add = [&](std::string name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(std::move(name));
  };
  add(PercentDecode(uri));
  add(uri);
  for (std::size_t i = 0, count = names.size(); i < count; ++i) {
    std::string name = names[i];
    std::replace(name.begin(), name.end(), '\\', '/');
    add(std::move(name));
  }
  return names;
}

}  // namespace

fs::path FileStore::Search(const std::string& uri, const Place& place) const {
  const std::vector<std::string> names = uri.empty() || HasScheme(uri) ? std::vector<std::string>() : NamesOf(uri);
  if (names.empty()) Fail(place, "is not a relative path");
  std::optional<fs::path> first;
  std::optional<Error> outside;
  for (const std::string& name : names) {
    fs::path path;
    try {
      path = DataPath(path_, PathOfUtf8(name), options_.root);
    } catch (const Error& error) {
      if (!outside) outside = error;
      continue;
    }
    std::error_code ignored;
    if (fs::exists(path, ignored)) {
      if (name != names[0] && name != uri) place.Warn("backslashes are read as slashes");
      return path;
    }
    if (!first && name == names[0]) first = std::move(path);
  }
  if (first) return *first;
  Fail(place, outside->message(), outside->hint());
}

fs::path FileStore::Find(const std::string& uri, const Place& place) {
  const auto known = found_.find(uri);
  if (known != found_.end()) return known->second;
  fs::path path = Search(uri, place);
  found_.emplace(uri, path);
  if (listed_.insert(path).second) report_.files.push_back(path);
  return path;
}

Bytes FileStore::Read(const fs::path& path) {
  std::error_code ignored;
  const fs::path key = fs::weakly_canonical(path, ignored);  // one file may go by many names
  const auto known = read_.find(key);
  if (known != read_.end()) return known->second;
  Bytes bytes = ReadFile(path, {.regular_only = true, .map = options_.map_files});
  report_.file_bytes += bytes.size;
  return read_.emplace(key, std::move(bytes)).first->second;
}

}  // namespace facet::gltf
