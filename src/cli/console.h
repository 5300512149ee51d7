// What the program says, one line at a time, without control characters.
#pragma once

#include <string_view>

namespace facet::cli {

// "facet: TEXT", "facet: warning: TEXT" and "facet: note: TEXT" on standard error, as one line.
void PrintError(std::string_view text);
void PrintNote(std::string_view text);
void PrintWarning(std::string_view text);

// Writes to standard output and flushes. Throws Error(OutputFailed) when that is closed or full.
void PrintOutput(std::string_view text);

}  // namespace facet::cli
