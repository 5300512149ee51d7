// The first bytes of a file, from which its format and header are read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

namespace facet {

// The bytes may end anywhere: reads beyond the end give 0, and Has() tells whether bytes are there.
class FileStart {
 public:
  explicit FileStart(std::span<const std::byte> bytes)
      : text_(bytes.empty() ? std::string_view()
                            : std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size())) {}

  std::size_t Size() const { return text_.size(); }
  bool Has(std::size_t at, std::size_t count) const { return at <= text_.size() && count <= text_.size() - at; }
  bool Is(std::size_t at, std::string_view what) const {
    return Has(at, what.size()) && text_.substr(at, what.size()) == what;
  }
  std::uint32_t Byte(std::size_t at) const { return at < text_.size() ? static_cast<unsigned char>(text_[at]) : 0u; }
  std::uint32_t Big16(std::size_t at) const { return Byte(at) << 8 | Byte(at + 1); }
  std::uint32_t Big32(std::size_t at) const { return Big16(at) << 16 | Big16(at + 2); }
  std::uint32_t Little16(std::size_t at) const { return Byte(at) | Byte(at + 1) << 8; }
  std::uint32_t Little24(std::size_t at) const { return Little16(at) | Byte(at + 2) << 16; }
  std::uint32_t Little32(std::size_t at) const { return Little16(at) | Little16(at + 2) << 16; }

  // Reads a line from `at` on, and moves `at` behind its line break. False: there is no line break.
  bool Line(std::size_t& at, std::string_view& line) const {
    const std::size_t end = text_.find('\n', at);
    if (end == std::string_view::npos) return false;
    line = text_.substr(at, end - at);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    at = end + 1;
    return true;
  }

 private:
  std::string_view text_;
};

// A side of an image, in pixels, from a header; 0 if it does not fit an int.
inline int SideOf(std::uint64_t value) {
  return value <= static_cast<std::uint64_t>(std::numeric_limits<int>::max()) ? static_cast<int>(value) : 0;
}

}  // namespace facet
