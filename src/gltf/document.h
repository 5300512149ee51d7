// A glTF file as text made into values: checked JSON, and tinygltf's model of its core.
#pragma once

#include <string>
#include <string_view>

// Of tinygltf only the parser is used: no picture decoding, no file access.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wconversion"
#include <tiny_gltf.h>
#pragma GCC diagnostic pop

#include "gltf/json_fields.h"

namespace facet::gltf {

struct Document {
  // Obeys CheckSchema. Extensions, buffers and pictures are read from here.
  Json root;
  // The core: the same objects under the same indices, without buffers, images and extensions.
  tinygltf::Model core;
};

// Throws Error(InvalidInput, Unsupported).
Document ParseDocument(std::string_view json, const Place& place);

}  // namespace facet::gltf
