// `facet report`: measures error against run time for many settings.
#pragma once

#include "cli/options.h"

namespace facet::cli {

// Measures, and writes all outputs. Throws Error.
void RunReport(const ReportOptions& options);

// For a rendering with a bound: makes a report or reads the stored one, and sets the approximations of
// `options.request` to those that keep the bound or come nearest to it. Throws Error; InvalidUsage if the stored report
// was made with other settings.
Choice ChooseApproximations(RenderOptions& options);

}  // namespace facet::cli
