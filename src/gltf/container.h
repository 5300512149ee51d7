// The two containers of glTF: a JSON text, or a GLB with a JSON chunk and perhaps a binary one.
#pragma once

#include <optional>
#include <string_view>

#include "base/input_file.h"
#include "gltf/place.h"

namespace facet::gltf {

struct Container {
  std::string_view json;     // in the file's bytes
  std::optional<Bytes> bin;  // the GLB's BIN chunk, if there is one; empty where the file ends before it
};

// Told apart by the first bytes, not by the name. A GLB whose lengths are wrong is read as far as its chunks can be
// made out, with warnings that name the numbers. Source: glTF 2.0, section 4, "GLB File Format Specification".
// Throws Error(InvalidInput, Unsupported): what is neither is called by its name where that is known.
Container OpenContainer(const Bytes& file, const Place& place);

}  // namespace facet::gltf
