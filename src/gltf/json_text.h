// Parses JSON into a normalised form that the rest of the loader relies on.
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

#include "gltf/place.h"

namespace facet::gltf {

using Json = nlohmann::json;

// Parses an object. In the result, numbers without a fraction are integers ("2.0" is the integer 2 in glTF), no member
// is called "extras" or is null, since both count as absent, and text is UTF-8. (Extras of the names of
// gltf/enterprise.h become extensions.) Repairs with a warning: null; bytes that are not UTF-8, which become U+FFFD;
// numbers beyond the range of double, which become the largest. Refuses nesting deeper than kMaxJsonDepth before a
// parser recurses into it. The caller must have charged JsonMemory() (base/json_bounds.h); copies of the text are
// charged here. Throws Error (InvalidInput, OutOfMemory).
Json ParseJson(std::string_view text, const Place& place);

}  // namespace facet::gltf
