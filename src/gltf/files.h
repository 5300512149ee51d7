// The files that a glTF file names: found by their URIs, read once each.
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
  // `path`: the glTF file. What is found and read is listed in `report`. All three must outlive it.
  FileStore(const std::filesystem::path& path, const LoadOptions& options, LoadReport& report)
      : path_(path), options_(options), report_(report) {}

  // The file that a relative reference names, by the rule for paths from data (DataPath): the decoded name, or where
  // only these exist the name as it is written, or with slashes in place of backslashes (a warning at `place`). It need
  // not exist. Throws Error(InvalidInput) for what is no relative reference and for what leads out of the folder.
  std::filesystem::path Find(const std::string& uri, const Place& place);

  // The bytes of a file that Find() gave. Throws Error: NotFound, OutOfMemory.
  Bytes Read(const std::filesystem::path& path);

 private:
  std::filesystem::path Search(const std::string& uri, const Place& place) const;

  const std::filesystem::path& path_;
  const LoadOptions& options_;
  LoadReport& report_;
  std::map<std::string, std::filesystem::path> found_;  // by URI
  std::set<std::filesystem::path> listed_;
  std::map<std::filesystem::path, Bytes> read_;  // by the name without links
};

}  // namespace facet::gltf
