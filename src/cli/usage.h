// Help pages and error messages of the command line.
#pragma once

#include <string>

#include "facet/error.h"

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace facet::cli {

// CLI11's help page without its blank lines, beginning with `usage`.
void SetPage(CLI::App& app, const std::string& usage);

// Converts CLI11's error to facet's, which names the option and, if a name is misspelt, suggests the nearest one.
Error UsageError(const CLI::App& app, const CLI::ParseError& complaint);

}  // namespace facet::cli
