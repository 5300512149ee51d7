#include "cli/explain_command.h"

#include <string>
#include <vector>

#include "base/memory_budget.h"
#include "base/parallel.h"
#include "cli/console.h"
#include "facet/explain.h"

namespace facet::cli {

void RunExplain(const ExplainOptions& options) {
  MemoryBudget budget(options.load.memory_limit);  // for work other than loading and rendering
  const MemoryBudget::Scope scope(budget);
  Explanation explanation;
  std::vector<std::string> warnings;
  RunWithThreads(options.request.settings.threads, [&] {
    const RenderInputs inputs = LoadInputs(options.input, options.request, options.load);
    warnings = inputs.loaded.report.warnings;
    explanation = Explain(inputs.loaded.scene, inputs.settings);
  });
  warnings.insert(warnings.end(), explanation.first.warnings.begin(), explanation.first.warnings.end());
  PrintWarnings(warnings, options.strict, options.input.string());
  const std::string scene = options.input.filename().string();
  PrintOutput(options.json ? ToJson(explanation, scene) : ToText(explanation, scene));
}

}  // namespace facet::cli
