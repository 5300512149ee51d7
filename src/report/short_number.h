// Numbers in messages.
#pragma once

#include <array>
#include <charconv>
#include <string>

namespace facet {

// Six significant digits, or as many as said, in any locale: "0.0312", "1e-07", "inf".
inline std::string ShortNumber(double value, int digits = 6) {
  std::array<char, 32> text;
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, digits);
  return std::string(text.data(), result.ptr);
}

}  // namespace facet
