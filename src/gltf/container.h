// The two containers of glTF: a JSON text, or a GLB with a JSON chunk and perhaps a binary one.
#pragma once

#include <optional>
#include <string_view>

#include "base/input_file.h"
#include "gltf/place.h"

namespace facet::gltf {

struct Container {
  std::string_view json;     // points into the file's bytes
  std::optional<Bytes> bin;  // the GLB's BIN chunk, if there is one; empty if the file ends before it
};

// Finds the parts of a file. The first bytes tell the containers apart, not the name. A GLB with wrong lengths is read
// as far as its chunks can be recognised, with warnings that state the lengths. Source: glTF 2.0, section 4, "GLB File
// Format Specification". Throws Error(InvalidInput, Unsupported). For a file that is neither, the message names its
// kind if that is known.
Container OpenContainer(const Bytes& file, const Place& place);

}  // namespace facet::gltf
