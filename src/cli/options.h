// The command line as values.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "cli/check_command.h"
#include "cli/diff_command.h"
#include "facet/load.h"
#include "facet/report.h"
#include "settings/render_request.h"

namespace facet::cli {

// `facet render`.
struct RenderOptions {
  std::filesystem::path input, output;
  RenderRequest request;
  LoadOptions load;
  std::filesystem::path cache;  // of prepared environments; empty: none
  bool quiet = false;
  std::optional<bool> progress;  // none: when standard error is a terminal
  bool strict = false;           // warnings are failures
  // With either bound the approximations are chosen from a report: a stored one, or one that is made first.
  Bound bound;
  std::optional<std::filesystem::path> report;
  std::optional<double> budget_seconds;  // for making it; 30 if none
  bool stats_table = false;
  std::optional<std::string> stats_json;  // a path, or "-" for standard output
};

// `facet info`.
struct InfoOptions {
  std::filesystem::path input;
  LoadOptions load;
  bool strict = false;
  bool json = false;
};

// `facet explain`.
struct ExplainOptions {
  std::filesystem::path input;
  RenderRequest request;
  LoadOptions load;
  bool strict = false;
  bool json = false;
};

// `facet hash`.
struct HashOptions {
  std::filesystem::path input;
  RenderRequest request;
  LoadOptions load;
  bool strict = false;
  bool json = false;
};

// `facet verify`.
struct VerifyOptions {
  std::filesystem::path picture, input;
  std::optional<std::filesystem::path> environment;  // instead of the file beside the scene
  LoadOptions load;
  bool strict = false;
  int threads = 0;
  bool json = false;
};

// `facet report`.
struct ReportOptions {
  std::filesystem::path input;
  std::vector<std::filesystem::path> outputs;  // .html, .json or .csv
  RenderRequest request;
  LoadOptions load;
  bool strict = false;
  double budget_seconds = 60.0;
  bool quiet = false;
};

// --help and --version: a text for standard output.
struct TextRequest {
  std::string text;
};

using Command = std::variant<TextRequest, RenderOptions, InfoOptions, ExplainOptions, HashOptions, VerifyOptions,
                             DiffOptions, CheckCommandOptions, ReportOptions>;

// --memory-limit, in bytes; 0: none was given.
std::uint64_t MemoryLimitOf(const Command& command);
// --threads; 0: one per core.
int ThreadsOf(const Command& command);

// Throws Error(InvalidUsage).
Command ParseCommandLine(int argc, const char* const* argv);

}  // namespace facet::cli
