// A summary of the content of a scene file, from which `facet info` writes text and JSON.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "facet/load.h"
#include "facet/settings.h"

namespace facet::cli {

// The geometry of one or more primitives.
struct Geometry {
  std::uint64_t primitives = 0;
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;  // including those of strips and fans
  std::uint64_t lines = 0;
  std::uint64_t points = 0;

  Geometry& operator+=(const Geometry& other);
};

struct MeshSummary {
  std::string name;
  Geometry geometry;
  std::size_t morph_targets = 0;
  bool normals = false, tangents = false, colors = false;  // whether any primitive has them
  std::size_t tex_coord_sets = 0;                          // the maximum over the primitives
  std::size_t influences = 0;                              // joints per vertex, the maximum over the primitives
};

// One use of a texture by a material.
struct TextureUse {
  const char* slot;  // "base_color", "metallic_roughness", "normal", "occlusion" or "emissive"
  TextureRef ref;
  bool transformed = false;
};

struct MaterialSummary {
  const Material* material = nullptr;
  std::vector<TextureUse> textures;
  std::vector<std::string> ignored;  // extensions' features that it states, and that its shading model does not read
  std::uint64_t primitives = 0;  // primitives that use it, by default or in a variant
};

struct ImageSummary {
  std::string name;          // its name in the glTF file; may be empty
  std::string source;        // a URI or a description of where the bytes are
  std::size_t textures = 0;  // textures that use it
  std::optional<ImageHeader> header;
};

struct AnimationSummary {
  std::string name;
  double duration_seconds = 0;
  std::size_t channels = 0;
  std::size_t translations = 0, rotations = 0, scales = 0, weights = 0;  // number of channels by path
};

struct SceneSummary {
  std::string name;
  std::size_t nodes = 0;  // visible nodes that are reachable from its roots
  Geometry drawn;         // each mesh once for every visible node or instance that draws it
  bool empty = true;      // the scene has no bounds
  glm::dvec3 low{0.0}, high{0.0};
};

struct FileSummary {
  const LoadedScene* file = nullptr;
  std::string input;
  Geometry geometry;  // of all meshes, each counted once
  std::vector<MeshSummary> meshes;
  std::vector<MaterialSummary> materials;
  std::vector<ImageSummary> images;
  std::vector<AnimationSummary> animations;
  std::vector<SceneSummary> scenes;
  // The camera that frames the default scene in a square image, and the distance from its eye to its target.
  FreeCamera camera;
  double camera_target_distance = 1.0;
};

// `file` must outlive the summary.
FileSummary Summarize(const LoadedScene& file, std::string input);

// The summary as readable text, and as one JSON object with stable keys. Both end in a newline.
std::string InfoText(const FileSummary& summary);
std::string InfoJson(const FileSummary& summary);

// "directional", "point" or "spot"; "OPAQUE", "MASK" or "BLEND".
const char* NameOf(LightType type);
const char* NameOf(AlphaMode mode);

}  // namespace facet::cli
