#include "cli/info_command.h"

#include "base/memory_budget.h"
#include "cli/console.h"
#include "cli/info_summary.h"

namespace facet::cli {

void RunInfo(const InfoOptions& options) {
  MemoryBudget budget(options.load.memory_limit);
  const MemoryBudget::Scope scope(budget);
  const LoadedScene file = LoadGltf(options.input, options.load);
  const FileSummary summary = Summarize(file, options.input.string());
  PrintOutput(options.json ? InfoJson(summary) : InfoText(summary));
  if (options.strict) PrintWarnings(file.report.warnings, options.strict, options.input.string());
}

}  // namespace facet::cli
