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
  std::vector<std::uint32_t> indices;              // of a triangle list; each is less than point_count
  std::map<std::string, AccessorView> attributes;  // by attribute semantic; `normalized` is the accessor's
};

// Decodes a primitive. `extension`: its object KHR_draco_mesh_compression; `attributes`: its attributes. Those that
// cannot be read are removed from `attributes` with a warning, unless `is_needed` is true for them. Source: Khronos
// Group, extension KHR_draco_mesh_compression. Throws Error(InvalidInput, OutOfMemory).
DracoMesh DecodeDraco(Context& context, BufferStore& buffers, AccessorReader& reader, const Json& extension,
                      const std::function<bool(const std::string&)>& is_needed, std::map<std::string, int>& attributes,
                      const Place& place);

}  // namespace facet::gltf
