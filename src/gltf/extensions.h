// Which extensions facet has.
#pragma once

#include "gltf/context.h"

namespace facet::gltf {

// Fills the report's list from extensionsUsed and extensionsRequired; warns of those that are not supported.
// Throws Error(Unsupported) naming all required ones that are not, unless the options ignore them.
void ReadExtensions(Context& context);

// Supported, or free of any effect on the picture.
bool IsSupported(const std::string& extension);

}  // namespace facet::gltf
