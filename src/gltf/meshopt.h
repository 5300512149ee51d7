// EXT_meshopt_compression: buffer views that are compressed by meshoptimizer.
#pragma once

#include "base/input_file.h"
#include "gltf/json_fields.h"

namespace facet::gltf {

enum class MeshoptMode : std::uint8_t { Attributes, Triangles, Indices };
enum class MeshoptFilter : std::uint8_t { None, Octahedral, Quaternion, Exponential };

struct MeshoptView {
  int buffer = -1;
  std::size_t offset = 0, length = 0;  // of the packed bytes in `buffer`
  std::size_t stride = 0, count = 0;   // of the elements they unpack to
  MeshoptMode mode = MeshoptMode::Attributes;
  MeshoptFilter filter = MeshoptFilter::None;
};

// Source: Khronos Group, extension EXT_meshopt_compression. Throws Error(InvalidInput).
MeshoptView ReadMeshoptView(const Json& object, std::size_t buffer_count, const Place& place);

// Throws Error(InvalidInput) if the compressed bytes are too few for the number of elements. To be called before memory
// is allocated for them.
void CheckMeshoptSize(const MeshoptView& view, const Place& place);

// Decompresses to count * stride bytes. Throws Error(InvalidInput).
Bytes DecodeMeshopt(const MeshoptView& view, const Bytes& packed, const Place& place);

}  // namespace facet::gltf
