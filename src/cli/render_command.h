// `facet render`.
#pragma once

#include "cli/options.h"

namespace facet::cli {

// Loads, renders, encodes, writes. Warnings go to standard error. Throws Error.
void RunRender(RenderOptions options);

}  // namespace facet::cli
