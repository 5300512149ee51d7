// KHR_draco_mesh_compression: a primitive packed by Draco.
#pragma once

#include <functional>
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

// `extension` is the object KHR_draco_mesh_compression of a primitive, `attributes` are the primitive's. What cannot be
// read of one for which `is_needed` is false is taken out of them, with a warning.
// Source: Khronos Group, extension KHR_draco_mesh_compression. Throws Error(InvalidInput, OutOfMemory).
DracoMesh DecodeDraco(Context& context, BufferStore& buffers, AccessorReader& reader, const Json& extension,
                      const std::function<bool(const std::string&)>& is_needed, std::map<std::string, int>& attributes,
                      const Place& place);

}  // namespace facet::gltf
