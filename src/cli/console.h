// Messages and output of the program. Each message is one line without control characters.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace facet::cli {

// "facet: TEXT", "facet: warning: TEXT" and "facet: note: TEXT" on standard error, as one line.
void PrintError(std::string_view text);
void PrintNote(std::string_view text);
void PrintWarning(std::string_view text);

// Prints warnings, one line each. If `strict` is set and there are any, throws Error(InvalidInput) afterwards. `where`:
// the file that they concern.
void PrintWarnings(const std::vector<std::string>& warnings, bool strict, const std::string& where);

// Writes to standard output and flushes it. Throws Error(OutputFailed) if it is closed or full.
void PrintOutput(std::string_view text);

}  // namespace facet::cli
