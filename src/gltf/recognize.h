// Recognises files of other kinds, for helpful error messages.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace facet::gltf {

struct ForeignFile {
  std::string what;  // "a PNG picture"
  std::string hint;  // what to do about it, may be empty
  bool is_picture = false;
};

// Recognises a file by its content. Nothing for files that begin as JSON or GLB, and for unknown kinds.
std::optional<ForeignFile> RecognizeForeign(std::string_view file);

// Throws Error(InvalidInput) with a message about JSON for a file that is not JSON. `name`: of the file, for messages.
void RefuseForeignJson(std::string_view file, const std::string& name);

}  // namespace facet::gltf
