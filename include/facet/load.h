// Loading of scenes, and of environments with a cache.
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

// A glTF extension that a file uses.
struct ExtensionUse {
  std::string name;
  bool required = false;
  bool supported = false;
};

// What a loader has to say besides the Scene.
struct LoadReport {
  std::string generator, copyright, version;   // of the glTF asset
  std::vector<ExtensionUse> extensions;        // sorted by name
  // What was ignored or repaired, one line for each kind of mistake: "WHERE: WHAT", with its first location and the
  // number of further ones. docs/conventions.md lists what is repaired.
  std::vector<std::string> warnings;
  std::size_t file_bytes = 0;                  // all files that were read
  // The scene's file and those that it refers to, including images that have not been read yet.
  std::vector<std::filesystem::path> files;
};

struct LoadedScene {
  Scene scene;
  LoadReport report;
};

struct LoadOptions {
  // Limit, in bytes, of all memory that loading takes: the files, their JSON while it is parsed, and the scene. 0:
  // three quarters of the memory of the machine, or of the process's control group. A file that needs more is refused
  // with Error(OutOfMemory) before the memory is allocated.
  std::uint64_t memory_limit = 0;
  // The folder in which all files that the scene refers to must lie; empty: the folder of the scene's file. A symbolic
  // link that leads out of it counts as outside. "/" allows all files.
  std::filesystem::path root;
  // Files of 64 MiB and more are mapped into memory, so that unused parts take neither time nor memory. They must not
  // change while the scene is in use: if a mapped file is truncated, the process ends with SIGBUS. False: all files are
  // read.
  bool map_files = true;
  // Load the file although it requires extensions that facet does not support; each becomes a warning.
  bool ignore_required_extensions = false;
};

// Loads a .gltf or .glb file (the content tells which). Images stay encoded until they are needed. A violation of
// glTF's rules is an error only if it affects the default scene and cannot be repaired; otherwise it is a warning.
// Throws Error: NotFound, InvalidInput, Unsupported (a required extension, by name), OutOfMemory.
LoadedScene LoadGltf(const std::filesystem::path& path, const LoadOptions& options = {});

// Gives materials of the scene other shading models (facet/models.h), as a material file says: docs/material-files.md.
// The textures that it names are added to the scene; they must lie in the file's folder, or in options.root. If it
// fails, the scene stays as it is. Throws Error: NotFound; InvalidInput, with the JSON pointer of what is wrong.
LoadReport ApplyMaterialFile(Scene& scene, const std::filesystem::path& file, const LoadOptions& options = {});

// Opens an environment image for EnvironmentSettings::source whose prefiltered maps are cached in the folder `cache`.
// The image is decoded and prefiltered only if the cache has no entry for a file of the same bytes and the same
// settings; frames are the same, bit for bit, with and without the cache. Several programs may share a cache; entries
// are never removed. The folder is created when the first entry is written; if that fails, RenderStats::warnings says
// so. Reads the file at once to compute its digest: throws Error(NotFound). The file must not change afterwards: frames
// throw what LoadImage() throws, and InvalidInput if it has changed.
std::shared_ptr<const EnvironmentSource> OpenEnvironment(const std::filesystem::path& picture,
                                                         const std::filesystem::path& cache);

}  // namespace facet
