// Numbers in messages.
#pragma once

#include <array>
#include <charconv>
#include <string>

namespace facet {

// Six significant digits, in any locale: "0.0312", "1e-07", "inf".
inline std::string ShortNumber(double value) {
  std::array<char, 32> text;
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 6);
  return std::string(text.data(), result.ptr);
}

}  // namespace facet
