// Files into scenes and pictures.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "facet/image.h"
#include "facet/scene.h"

namespace facet {

class EnvironmentSource;  // EnvironmentSettings::source of facet/render.h

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
  // What was ignored or repaired, one line for each mistake: "WHERE: WHAT", where it stands first, and in how many more
  // places. docs/conventions.md says what is repaired.
  std::vector<std::string> warnings;
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

// Loads a .gltf or .glb file (told apart by content). Pictures stay encoded until they are needed. What breaks glTF's
// rules is an error only where the default scene shows it and it cannot be guessed.
// Throws Error: NotFound, InvalidInput, Unsupported (a required extension, by name), OutOfMemory.
LoadedScene LoadGltf(const std::filesystem::path& path, const LoadOptions& options = {});

// Loads a picture of any format that facet or OpenImageIO reads. Throws Error.
Image LoadImage(const std::filesystem::path& path);

// A picture for EnvironmentSettings::source that is decoded and prepared only where the folder `cache` does not hold
// what an earlier frame, of any program, prepared from a file of the same bytes with the same settings: the same frame,
// bit for bit, in less time. The folder is made when something is kept in it; where that fails, RenderStats::warnings
// says so. What is kept is never removed; several programs may share it. Reads the file at once, and throws the Error
// NotFound; it must stay as it is: frames throw what LoadImage() does, and InvalidInput where it was changed.
std::shared_ptr<const EnvironmentSource> OpenEnvironment(const std::filesystem::path& picture,
                                                         const std::filesystem::path& cache);

}  // namespace facet
