// `facet info`.
#pragma once

#include "cli/options.h"

namespace facet::cli {

// Loads and describes on standard output. A file that requires what facet does not have is described all the same.
// Throws Error.
void RunInfo(const InfoOptions& options);

}  // namespace facet::cli
