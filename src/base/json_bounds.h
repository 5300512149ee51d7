// JSON from anybody, before a parser sees it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace facet {

// Calls take(i) for the bytes of a text that stand outside of its strings, and for the quote that each string begins
// with, until it returns false.
template <class Take>
void ForEachJsonByte(std::string_view text, const Take& take) {
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (in_string) {
      if (text[i] == '"') in_string = false;
      if (text[i] == '\\') ++i;  // what follows is no end
      continue;
    }
    in_string = text[i] == '"';
    if (!take(i)) return;
  }
}

// Whether objects and arrays lie in one another more than `levels` deep. Whoever walks through values by recursion asks
// before: 20,000 brackets in a file would overflow the stack. Takes any text.
bool IsJsonDeeperThan(std::string_view text, int levels);

// What facet's own files have at most, and more than anybody's glTF files need.
inline constexpr int kMaxJsonDepth = 128;

// Bytes that nlohmann::json takes for the values of a text, while it parses it and after, at most.
// nlohmann::ordered_json takes up to twice as many: its objects are lists, and one that grows is copied with all that
// is in it. Takes any text.
std::uint64_t JsonMemory(std::string_view text);

}  // namespace facet
