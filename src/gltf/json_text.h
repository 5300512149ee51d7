// JSON as text made into values, in the form that everything after relies on.
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

#include "gltf/place.h"

namespace facet::gltf {

using Json = nlohmann::json;

// Parses an object. In what it returns
// - numbers without a fraction are integers ("2.0" is the integer 2 in glTF);
// - no member is called "extras", and none is null: both are as good as absent;
// - text is UTF-8.
// Repairs, with a warning: null; bytes that are not UTF-8, which become U+FFFD; numbers beyond the range of double,
// which become the largest. Refuses nesting deeper than kMaxJsonDepth before any parser recurses into it.
// The caller has charged JsonMemory() (base/json_bounds.h); copies of the text are charged here. Throws Error
// (InvalidInput, OutOfMemory).
Json ParseJson(std::string_view text, const Place& place);

}  // namespace facet::gltf
