#include "cli/info_command.h"

#include "cli/console.h"
#include "cli/info_summary.h"

namespace facet::cli {

void RunInfo(const InfoOptions& options) {
  LoadOptions load;
  load.ignore_required_extensions = true;  // whoever asks what is in a file wants to be told just that
  const LoadedScene file = LoadGltf(options.input, load);
  const FileSummary summary = Summarize(file, options.input.string());
  PrintOutput(options.json ? InfoJson(summary) : InfoText(summary));
}

}  // namespace facet::cli
