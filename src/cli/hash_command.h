// `facet hash`: digests of inputs and outputs.
#pragma once

#include "cli/options.h"

namespace facet::cli {

// Prints the digests of the film, its planes, the encoded image and each input. Throws Error.
void RunHash(const HashOptions& options);

}  // namespace facet::cli
