// MeasureErrors() of facet/report.h with a given clock, for tests.
#pragma once

#include <filesystem>

#include "base/clock.h"
#include "facet/report.h"

namespace facet {

ErrorReport MeasureErrorsBy(const Clock& clock, const std::filesystem::path& scene, const SettingsText& settings,
                            const ReportSettings& report, const LoadOptions& load = {});

// Throws Error(InvalidUsage) for a bound that is no finite number above 0.
void RefuseUnlessPositive(const Bound& bound);

}  // namespace facet
