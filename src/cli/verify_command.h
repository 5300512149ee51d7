// `facet verify`: a picture against its scene.
#pragma once

#include "cli/options.h"

namespace facet::cli {

// Says whether the scene still gives the picture, and where not. Returns 0 if it does, 1 if not. Throws Error.
int RunVerify(const VerifyOptions& options);

}  // namespace facet::cli
