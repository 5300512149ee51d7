// A glTF file's JSON.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "base/memory_budget.h"
#include "gltf/json_fields.h"

namespace facet::gltf {

// The lists at the root hold objects; what these hold is checked where it is read.
struct Document {
  MemoryLease memory;  // for as long as the values live
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
