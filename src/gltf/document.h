// The JSON of a glTF file.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "base/memory_budget.h"
#include "gltf/json_fields.h"

namespace facet::gltf {

// The parsed JSON. The lists at the root are known to contain objects, whose members are checked where they are read.
struct Document {
  MemoryLease memory;  // of the JSON values
  Json root;
  std::string version;  // asset.version, "2.0" or a later one that can be read as 2.0

  std::size_t Count(const char* list) const {
    const Json* array = Find(root, list);
    return array ? array->size() : 0;
  }
};

// Throws Error: InvalidInput, Unsupported (another version of glTF), OutOfMemory.
Document ParseDocument(std::string_view json, const Place& place);

}  // namespace facet::gltf
