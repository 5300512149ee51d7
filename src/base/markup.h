// Text inside HTML and XML.
#pragma once

#include <string>
#include <string_view>

namespace facet {

// `text` with the characters that mark up escaped, for content and for attributes in double quotes. Control characters,
// which XML 1.0 cannot hold, are left out, and what is no UTF-8 becomes U+FFFD.
std::string Escaped(std::string_view text);

// Seconds with two digits: "0.25".
std::string SecondsText(double seconds);

}  // namespace facet
