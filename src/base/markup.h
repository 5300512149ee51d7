// Escaping of text for HTML and XML.
#pragma once

#include <string>
#include <string_view>

namespace facet {

// Escapes `text` for element content and for attributes in double quotes. Control characters that XML 1.0 does not
// allow are dropped, and bytes that are not UTF-8 become U+FFFD.
std::string Escaped(std::string_view text);

// Seconds with two digits: "0.25".
std::string SecondsText(double seconds);

}  // namespace facet
