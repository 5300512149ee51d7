#include "image/exr_text.h"

#include <cstdint>
#include <cstring>
#include <string_view>

#include "facet/error.h"

namespace facet {

bool LooksLikeExr(std::span<const std::byte> bytes) {
  return bytes.size() >= 8 && std::memcmp(bytes.data(), "\x76\x2F\x31\x01", 4) == 0;
}

std::map<std::string, std::string> ReadExrText(std::span<const std::byte> bytes, const std::string& name) {
  const auto cut_off = [&] { return Error(ErrorCode::InvalidInput, "broken EXR: its header is cut off", name); };
  std::string_view left(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  left.remove_prefix(8);  // magic number and version
  // Up to a zero.
  const auto word = [&] {
    const std::size_t end = left.find('\0');
    if (end == std::string_view::npos) throw cut_off();
    const std::string_view text = left.substr(0, end);
    left.remove_prefix(end + 1);
    return text;
  };
  std::map<std::string, std::string> texts;
  for (;;) {
    const std::string_view attribute = word();
    if (attribute.empty()) return texts;  // the header's end
    const std::string_view type = word();
    std::uint32_t size = 0;
    if (left.size() < sizeof size) throw cut_off();
    std::memcpy(&size, left.data(), sizeof size);
    left.remove_prefix(sizeof size);
    if (left.size() < size) throw cut_off();
    if (type == "string") texts.emplace(attribute, left.substr(0, size));
    left.remove_prefix(size);
  }
}

}  // namespace facet
