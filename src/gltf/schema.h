// The rules of glTF 2.0's core schema that everything after relies on: types, required members, and every index.
#pragma once

#include "gltf/json_fields.h"

namespace facet::gltf {

// Throws Error(InvalidInput) at the first member that breaks a rule, Error(Unsupported) for another version of glTF.
// Unknown members are allowed. What is checked here need not be checked again. Extensions are checked where they are
// read. Source: Khronos Group, "glTF 2.0 Specification" (2021), section 5 and its JSON schemas.
void CheckSchema(const Json& root, const Place& place);

}  // namespace facet::gltf
