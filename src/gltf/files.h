// The files that a glTF file refers to by URIs. Each is read once.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "base/input_file.h"
#include "facet/load.h"
#include "gltf/place.h"

namespace facet::gltf {

class FileStore {
 public:
  // `path`: the glTF file. Files that are found and read are listed in `report`. All three must outlive the store.
  FileStore(const std::filesystem::path& path, const LoadOptions& options, LoadReport& report)
      : path_(path), options_(options), report_(report) {}

  // Resolves a relative reference by the rule for paths from data (DataPath): to the decoded name, or, if only these
  // exist, to the name as written or with slashes for backslashes (with a warning at `place`). The file need not exist.
  // Throws Error(InvalidInput) for anything but a relative reference, and for paths that lead out of the folder.
  std::filesystem::path Find(const std::string& uri, const Place& place);

  // The bytes of a file that Find() returned. Throws Error: NotFound, OutOfMemory.
  Bytes Read(const std::filesystem::path& path);

 private:
  std::filesystem::path Search(const std::string& uri, const Place& place) const;

  const std::filesystem::path& path_;
  const LoadOptions& options_;
  LoadReport& report_;
  std::map<std::string, std::filesystem::path> found_;  // by URI
  std::set<std::filesystem::path> listed_;
  std::map<std::filesystem::path, Bytes> read_;  // by canonical path
};

}  // namespace facet::gltf
