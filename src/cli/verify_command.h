// `facet verify`: checks that a scene still renders to the image in a picture file.
#pragma once

#include "cli/options.h"

namespace facet::cli {

// Prints whether the rendering equals the stored image, and where not. Returns 0 if it does, 1 if not. Throws Error.
int RunVerify(const VerifyOptions& options);

}  // namespace facet::cli
