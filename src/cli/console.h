// What the program says, one line at a time, without control characters.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace facet::cli {

// "facet: TEXT", "facet: warning: TEXT" and "facet: note: TEXT" on standard error, as one line.
void PrintError(std::string_view text);
void PrintNote(std::string_view text);
void PrintWarning(std::string_view text);

// Prints warnings, one line each. `strict`: throws Error(InvalidInput) then where there were some; `where`: what they
// are about.
void PrintWarnings(const std::vector<std::string>& warnings, bool strict, const std::string& where);

// Writes to standard output and flushes. Throws Error(OutputFailed) when that is closed or full.
void PrintOutput(std::string_view text);

}  // namespace facet::cli
