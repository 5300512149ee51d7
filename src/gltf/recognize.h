// What a file is that is no glTF file: people take one for the other.
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

// Told by the content. Nothing for what begins as JSON or GLB, and for what is none of the kinds that are known.
std::optional<ForeignFile> RecognizeForeign(std::string_view file);

// Throws Error(InvalidInput), in the words of JSON, for a file that is none: `name` is what messages call it.
void RefuseForeignJson(std::string_view file, const std::string& name);

}  // namespace facet::gltf
