#include "cli/console.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "base/printable.h"
#include "facet/error.h"

namespace facet::cli {
namespace {

void PrintLine(std::string_view prefix, std::string_view text) {
  std::string line(prefix);
  line += Printable(text);
  line += '\n';
  std::fwrite(line.data(), 1, line.size(), stderr);  // one call, so that lines of several processes do not mix
}

}  // namespace

void PrintError(std::string_view text) { PrintLine("facet: ", text); }

void PrintNote(std::string_view text) { PrintLine("facet: note: ", text); }

void PrintWarning(std::string_view text) { PrintLine("facet: warning: ", text); }

void PrintWarnings(const std::vector<std::string>& warnings, bool strict, const std::string& where) {
  for (const std::string& warning : warnings) PrintWarning(warning);
  if (!strict || warnings.empty()) return;
  throw Error(
      ErrorCode::InvalidInput,
      warnings.size() == 1 ? "there is a warning" : "there are " + std::to_string(warnings.size()) + " warnings", where,
      "without --strict it would be used all the same");
}

void PrintOutput(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    throw Error(ErrorCode::OutputFailed, std::strerror(errno), "standard output");
  }
}

}  // namespace facet::cli
