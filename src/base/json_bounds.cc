#include "base/json_bounds.h"

#include <algorithm>
#include <cstddef>
#include <string>

namespace facet {

bool IsJsonDeeperThan(std::string_view text, int levels) {
  std::int64_t depth = 0, deepest = 0;
  ForEachJsonByte(text, [&](std::size_t i) {
    if (text[i] == '[' || text[i] == '{') deepest = std::max(deepest, ++depth);
    if (text[i] == ']' || text[i] == '}') --depth;
    return deepest <= levels;
  });
  return deepest > levels;
}

std::uint64_t JsonMemory(std::string_view text) {
  // A value has 16 bytes; the other sizes include the allocator's overhead. Arrays grow by doubling, so that for a
  // moment there is room for three times the values.
  constexpr std::uint64_t kValue = 3 * 16, kMember = 2 * sizeof(std::string) + 16 + 32;
  constexpr std::uint64_t kObject = 64, kArray = 48, kString = 64, kParser = 256;
  // The parser keeps the text of the current string or number, and the string with escapes resolved, in buffers that
  // grow by doubling as well: each takes up to twice the length, and three times while it grows.
  constexpr std::uint64_t kBuffers = 2 + 3;
  std::uint64_t bytes = kParser + kValue + std::uint64_t(text.size());
  std::size_t start = 0, longest = 0;  // of the text that is kept
  const auto keep_from = [&](std::size_t at) { longest = std::max(longest, at - start), start = at; };
  bool in_number = false;
  ForEachJsonByte(text, [&](std::size_t i) {
    const char c = text[i];
    const bool begins_number = !in_number && (c == '-' || (c >= '0' && c <= '9'));
    if (c == '"' || begins_number) keep_from(i);
    in_number = begins_number || (in_number && std::string_view("+-.0123456789eE").find(c) != std::string_view::npos);
    if (c == '"') bytes += kString;
    if (c == ',') bytes += kValue;
    if (c == ':') bytes += kMember;
    if (c == '{') bytes += kObject + kValue;
    if (c == '[') bytes += kArray + kValue;
    return true;
  });
  keep_from(text.size());
  return bytes + kBuffers * std::uint64_t(longest);
}

}  // namespace facet
