// Names from files may hold anything: control characters never reach a terminal or a log.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace facet {

// `text` with every control character written as \xNN.
std::string Printable(std::string_view text);

// The same between single quotes.
std::string Quoted(std::string_view text);

// "red, green, blue".
std::string Joined(const std::vector<std::string>& parts, std::string_view separator = ", ");

}  // namespace facet
