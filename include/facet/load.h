// Files into scenes and pictures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "facet/image.h"
#include "facet/scene.h"

namespace facet {

class EnvironmentSource;  // EnvironmentSettings::source of facet/settings.h

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
  // The scene's own file, and those that it names, of images also where they are not read yet.
  std::vector<std::filesystem::path> files;
};

struct LoadedScene {
  Scene scene;
  LoadReport report;
};

struct LoadOptions {
  // Bytes that loading may take, all in all: the files, their JSON while it is read, what the scene holds. 0: three
  // quarters of what the machine, or the control group of the process, has. What needs more is refused before it is
  // allocated, with Error(OutOfMemory).
  std::uint64_t memory_limit = 0;
  // The folder that all files named by the scene must lie in; empty: the folder of the scene's own file. Links that
  // lead out of it count as outside. "/" allows all.
  std::filesystem::path root;
  // Files of 64 MiB and more are mapped and not read: what is not used of them takes no time and no memory. They must
  // stay as they are for as long as the scene is in use: a mapped file that is cut short meanwhile ends the process
  // with SIGBUS. False: all files are read.
  bool map_files = true;
  // Load in spite of required extensions that facet does not have; each becomes a warning.
  bool ignore_required_extensions = false;
};

// Loads a .gltf or .glb file (told apart by content). Pictures stay encoded until they are needed. What breaks glTF's
// rules is an error only where the default scene shows it and it cannot be guessed.
// Throws Error: NotFound, InvalidInput, Unsupported (a required extension, by name), OutOfMemory.
LoadedScene LoadGltf(const std::filesystem::path& path, const LoadOptions& options = {});

// A picture for EnvironmentSettings::source that is decoded and prepared only where the folder `cache` does not hold
// what an earlier frame, of any program, prepared from a file of the same bytes with the same settings: the same frame,
// bit for bit, in less time. The folder is made when something is kept in it; where that fails, RenderStats::warnings
// says so. What is kept is never removed; several programs may share it. Reads the file at once, and throws the Error
// NotFound; it must stay as it is: frames throw what LoadImage() does, and InvalidInput where it was changed.
std::shared_ptr<const EnvironmentSource> OpenEnvironment(const std::filesystem::path& picture,
                                                         const std::filesystem::path& cache);

}  // namespace facet
