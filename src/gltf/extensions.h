// The glTF extensions that facet supports.
#pragma once

#include "gltf/context.h"

namespace facet::gltf {

// Fills the report's list from extensionsUsed and extensionsRequired; warns of those that are not supported. Throws
// Error(Unsupported) that names all required extensions that are not supported, unless the options ignore them.
void ReadExtensions(Context& context);

// Warns of each extension that the document uses and does not list in extensionsUsed.
void WarnOfUnlistedExtensions(Context& context);

// Whether an extension is supported, or has no effect on the image.
bool IsSupported(const std::string& extension);

}  // namespace facet::gltf
