// `facet check`: golden tests.
#pragma once

#include <filesystem>
#include <optional>

#include "facet/check.h"

namespace facet::cli {

struct CheckCommandOptions {
  std::filesystem::path manifest;
  CheckOptions check;                                // `pictures` is derived from `html` and `output`
  std::optional<std::filesystem::path> html, junit;  // reports to write
  std::optional<std::filesystem::path> output;       // a folder for the images of failed entries
  bool json = false;                                 // prints JSON instead of the table
};

// Prints a table of the entries to standard output, and errors to standard error, one line each. Returns the exit code:
// 0 if all entries passed, are within their thresholds or were updated, 1 if some failed, 2 if some could not be
// checked because of errors. Throws Error if no entry could be checked.
int RunCheck(const CheckCommandOptions& options);

}  // namespace facet::cli
