// `facet info`: describes the content of a scene file.
#pragma once

#include "cli/options.h"

namespace facet::cli {

// Loads the file and prints its description. A file that requires extensions unknown to facet is described too.
// Throws Error.
void RunInfo(const InfoOptions& options);

}  // namespace facet::cli
