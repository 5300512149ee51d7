// Files into scenes and pictures.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "facet/image.h"
#include "facet/scene.h"

namespace facet {

// An extension that a file names, and what becomes of it.
struct ExtensionUse {
  std::string name;
  bool required = false;
  bool supported = false;
};

// What a loader noticed and the Scene does not say.
struct LoadReport {
  std::string generator, copyright, version;   // asset's
  std::vector<ExtensionUse> extensions;        // sorted by name
  std::vector<std::string> warnings;           // one line each: "WHERE: WHAT"; what was ignored or repaired
  std::size_t file_bytes = 0;                  // all files that were read
};

struct LoadedScene {
  Scene scene;
  LoadReport report;
};

struct LoadOptions {
  // The most memory that decoded geometry of one file may take; beyond it Error(OutOfMemory).
  std::size_t max_geometry_bytes = std::size_t(8) << 30;
  // Load in spite of required extensions that facet does not have; each becomes a warning.
  bool ignore_required_extensions = false;
};

// Loads a .gltf or .glb file (told apart by content). Pictures stay encoded until they are needed.
// Throws Error: NotFound, InvalidInput, Unsupported (a required extension, by name), OutOfMemory.
LoadedScene LoadGltf(const std::filesystem::path& path, const LoadOptions& options = {});

// Loads a picture of any format that facet or OpenImageIO reads. Throws Error.
Image LoadImage(const std::filesystem::path& path);

}  // namespace facet
