// Limits on JSON from unknown sources, checked before it is parsed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace facet {

// Calls take(i) for each byte of a text that is outside of strings, and for the opening quote of each string, until it
// returns false.
template <class Take>
void ForEachJsonByte(std::string_view text, const Take& take) {
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (in_string) {
      if (text[i] == '"') in_string = false;
      if (text[i] == '\\') ++i;  // an escaped quote does not end the string
      continue;
    }
    in_string = text[i] == '"';
    if (!take(i)) return;
  }
}

// Whether objects and arrays are nested more than `levels` deep. It is checked before values are visited recursively,
// because 20,000 brackets in a file would overflow the stack. Accepts any text.
bool IsJsonDeeperThan(std::string_view text, int levels);

// The largest depth of facet's own files, which is more than any glTF file needs.
inline constexpr int kMaxJsonDepth = 128;

// An upper bound on the bytes that nlohmann::json takes for the values of a text, during parsing and afterwards.
// nlohmann::ordered_json takes up to twice as many: its objects are arrays that are copied when they grow. Accepts any
// text.
std::uint64_t JsonMemory(std::string_view text);

}  // namespace facet
