// `facet explain`: which features a frame uses, which are disabled, and what they cost.
#pragma once

#include "cli/options.h"

namespace facet::cli {

// Throws Error.
void RunExplain(const ExplainOptions& options);

}  // namespace facet::cli
