// Parses the command line into the options of each command.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "cli/check_command.h"
#include "cli/diff_command.h"
#include "cli/models_command.h"
#include "facet/load.h"
#include "facet/report.h"
#include "settings/render_request.h"

namespace facet::cli {

// `facet render`.
struct RenderOptions {
  std::filesystem::path input, output;
  RenderRequest request;
  LoadOptions load;
  std::filesystem::path cache;  // folder of prepared environments; empty: none
  bool quiet = false;
  std::optional<bool> progress;  // none: only if standard error is a terminal
  bool strict = false;           // warnings are errors
  // If a bound is given, the approximations are chosen from a report: the stored one, or one that is made first.
  Bound bound;
  std::optional<std::filesystem::path> report;
  std::optional<double> budget_seconds;  // for making the report; none: 30
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
  std::optional<std::filesystem::path> environment;  // replaces the file next to the scene
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

// --help and --version: a text to print to standard output.
struct TextRequest {
  std::string text;
};

using Command = std::variant<TextRequest, RenderOptions, InfoOptions, ExplainOptions, HashOptions, VerifyOptions,
                             DiffOptions, CheckCommandOptions, ReportOptions, ModelsOptions>;

// --memory-limit in bytes, or 0 if it is not given.
std::uint64_t MemoryLimitOf(const Command& command);
// --threads, where 0 means one per core.
int ThreadsOf(const Command& command);

// Throws Error(InvalidUsage).
Command ParseCommandLine(int argc, const char* const* argv);

}  // namespace facet::cli
