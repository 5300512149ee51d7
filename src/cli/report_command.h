// `facet report`: error against run time.
#pragma once

#include "cli/options.h"

namespace facet::cli {

// Measures and writes every output. Throws Error.
void RunReport(const ReportOptions& options);

// Measures for a rendering that has a bound, or reads what was stored, and sets the approximations of `options.request`
// to those that keep the bound, or come nearest to it. Throws Error: InvalidUsage for a stored report of other
// settings.
Choice ChooseApproximations(RenderOptions& options);

}  // namespace facet::cli
