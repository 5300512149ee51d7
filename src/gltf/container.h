// The two containers of glTF: a JSON text, or a GLB with a JSON chunk and perhaps a binary one.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gltf/bytes.h"

namespace facet::gltf {

struct Container {
  std::string_view json;     // in the file's bytes
  std::optional<Bytes> bin;  // the GLB's BIN chunk, if there is one
};

// Told apart by the first bytes, not by the name. Source: glTF 2.0, section 4, "GLB File Format Specification".
// Throws Error(InvalidInput, Unsupported) naming `file`; appends to `warnings`.
Container OpenContainer(const Bytes& file, const std::string& file_name, std::vector<std::string>& warnings);

}  // namespace facet::gltf
