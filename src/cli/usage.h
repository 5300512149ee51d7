// Help pages and complaints of the command line.
#pragma once

#include <string>

#include "facet/error.h"

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace facet::cli {

// CLI11's help page, less its blank lines, beginning with `usage`.
void SetPage(CLI::App& app, const std::string& usage);

// CLI11's complaint as ours, naming the option and, where a name is misspelt, the nearest one there is.
Error UsageError(const CLI::App& app, const CLI::ParseError& complaint);

}  // namespace facet::cli
