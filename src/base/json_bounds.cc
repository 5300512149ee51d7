#include "base/json_bounds.h"

#include <cstddef>
#include <string>

namespace facet {

bool IsJsonDeeperThan(std::string_view text, int levels) {
  std::int64_t depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      if (++depth > levels) return true;
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return false;
}

std::uint64_t JsonMemory(std::string_view text) {
  // A value has 16 bytes; the rest with the allocator's own bytes. An array grows by doubling, so that each value is there thrice for a moment. Of a
  // string, the parser has a copy while it reads it.
  constexpr std::uint64_t kValue = 3 * 16, kMember = 2 * sizeof(std::string) + 16 + 32;
  constexpr std::uint64_t kObject = 64, kArray = 48, kQuote = 32;
  std::uint64_t bytes = kValue + 2 * std::uint64_t(text.size());
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') bytes += kQuote;
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
      continue;
    }
    if (c == '"') in_string = true;
    if (c == ',') bytes += kValue;
    if (c == ':') bytes += kMember;
    if (c == '{') bytes += kObject + kValue;
    if (c == '[') bytes += kArray + kValue;
  }
  return bytes;
}

}  // namespace facet
