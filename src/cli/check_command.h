// `facet check`: golden tests.
#pragma once

#include <filesystem>
#include <optional>

#include "facet/check.h"

namespace facet::cli {

struct CheckCommandOptions {
  std::filesystem::path manifest;
  CheckOptions check;                                // less `pictures`, which follows from the others
  std::optional<std::filesystem::path> html, junit;  // reports to write
  std::optional<std::filesystem::path> output;       // a folder for the pictures of failed entries
  bool json = false;                                 // on standard output, in place of the table
};

// Prints a table of the entries on standard output, and errors on standard error, one line each. Returns the exit code:
// 0 when all entries passed, are within their thresholds or were updated, 1 when some failed, 2 when some could not be
// decided. Throws Error where none could.
int RunCheck(const CheckCommandOptions& options);

}  // namespace facet::cli
