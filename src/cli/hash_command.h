// `facet hash`: fingerprints.
#pragma once

#include "cli/options.h"

namespace facet::cli {

// Prints the digests of the film, its planes, the encoded picture and each input. Throws Error.
void RunHash(const HashOptions& options);

}  // namespace facet::cli
