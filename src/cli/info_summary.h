// What is in a file, counted and named: the values behind both forms of `facet info`.
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

// What a number of primitives draw.
struct Geometry {
  std::uint64_t primitives = 0;
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;  // strips and fans counted by what they draw
  std::uint64_t lines = 0;
  std::uint64_t points = 0;

  Geometry& operator+=(const Geometry& other);
};

struct MeshSummary {
  std::string name;
  Geometry geometry;
  std::size_t morph_targets = 0;
  bool normals = false, tangents = false, colors = false;  // any primitive has them
  std::size_t tex_coord_sets = 0;                          // the most of any primitive
  std::size_t influences = 0;                              // joints a vertex, the most of any primitive
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
  std::uint64_t primitives = 0;  // that use it, by default or in a variant
};

struct ImageSummary {
  std::string name;          // the file's name for it, may be empty
  std::string source;        // where its bytes are
  std::size_t textures = 0;  // that use it
  std::optional<ImageHeader> header;
};

struct AnimationSummary {
  std::string name;
  double duration_seconds = 0;
  std::size_t channels = 0;
  std::size_t translations = 0, rotations = 0, scales = 0, weights = 0;  // channels by path
};

struct SceneSummary {
  std::string name;
  std::size_t nodes = 0;  // visible ones reached from its roots
  Geometry drawn;         // every mesh as often as a visible node or an instance of one draws it
  bool empty = true;      // no bounds
  glm::dvec3 low{0.0}, high{0.0};
};

struct FileSummary {
  const LoadedScene* file = nullptr;
  std::string input;
  Geometry geometry;  // each mesh once
  std::vector<MeshSummary> meshes;
  std::vector<MaterialSummary> materials;
  std::vector<ImageSummary> images;
  std::vector<AnimationSummary> animations;
  std::vector<SceneSummary> scenes;
  // That frames the default scene in a square picture, with the distance of what it looks at.
  FreeCamera camera;
  double camera_target_distance = 1.0;
};

// `file` must outlive the summary.
FileSummary Summarize(const LoadedScene& file, std::string input);

// For people, and as one JSON object with stable keys; both end in a line end.
std::string InfoText(const FileSummary& summary);
std::string InfoJson(const FileSummary& summary);

// "directional", "point" or "spot"; "OPAQUE", "MASK" or "BLEND".
const char* NameOf(LightType type);
const char* NameOf(AlphaMode mode);

}  // namespace facet::cli
