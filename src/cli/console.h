// What the program says, one line at a time. Names from files may hold anything: control characters never reach the
// terminal.
#pragma once

#include <string>
#include <string_view>

namespace facet::cli {

// `text` with every control character written as \xNN.
std::string Printable(std::string_view text);

// The same between single quotes.
std::string Quoted(std::string_view text);

// "facet: TEXT" and "facet: warning: TEXT" on standard error, as one line.
void PrintError(std::string_view text);
void PrintWarning(std::string_view text);

// Writes to standard output and flushes. Throws Error(OutputFailed) when that is closed or full.
void PrintOutput(std::string_view text);

}  // namespace facet::cli
