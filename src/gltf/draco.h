// KHR_draco_mesh_compression: a primitive packed by Draco.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gltf/accessor.h"

namespace facet::gltf {

struct DracoMesh {
  std::size_t point_count = 0;
  std::vector<std::uint32_t> indices;              // of a triangle list, every one < point_count
  std::map<std::string, AccessorView> attributes;  // by attribute semantic; `normalized` is the accessor's
};

// `extension` is the object KHR_draco_mesh_compression of a primitive, `primitive` tinygltf's.
// Source: Khronos Group, extension KHR_draco_mesh_compression. Throws Error(InvalidInput, OutOfMemory).
DracoMesh DecodeDraco(Context& context, BufferStore& buffers, const Json& extension,
                      const tinygltf::Primitive& primitive, const Place& place);

}  // namespace facet::gltf
