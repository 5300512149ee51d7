// `facet explain`: what a frame uses, leaves out and spends.
#pragma once

#include "cli/options.h"

namespace facet::cli {

// Throws Error.
void RunExplain(const ExplainOptions& options);

}  // namespace facet::cli
