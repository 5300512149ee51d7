#include "gltf/uri.h"

#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>

namespace facet::gltf {
namespace {

int HexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

constexpr std::uint8_t kNoDigit = 0xFF;

constexpr std::array<std::uint8_t, 256> MakeBase64Digits() {
  std::array<std::uint8_t, 256> digits{};
  for (auto& digit : digits) digit = kNoDigit;
  for (int i = 0; i < 26; ++i) {
    digits[static_cast<std::size_t>('A' + i)] = static_cast<std::uint8_t>(i);
    digits[static_cast<std::size_t>('a' + i)] = static_cast<std::uint8_t>(26 + i);
  }
  for (int i = 0; i < 10; ++i) digits[static_cast<std::size_t>('0' + i)] = static_cast<std::uint8_t>(52 + i);
  digits['+'] = digits['-'] = 62;
  digits['/'] = digits['_'] = 63;
  return digits;
}

constexpr auto kBase64Digits = MakeBase64Digits();

std::filesystem::path PathOfUtf8(const std::string& name) {
  return std::filesystem::path(std::u8string(name.begin(), name.end()));
}

}  // namespace

std::string PercentDecode(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size()) {
      const int high = HexDigit(text[i + 1]), low = HexDigit(text[i + 2]);
      if (high >= 0 && low >= 0) {
        out += static_cast<char>(high * 16 + low);
        i += 2;
        continue;
      }
    }
    out += text[i];
  }
  return out;
}

bool IsDataUri(std::string_view uri) {
  constexpr std::string_view kScheme = "data:";
  if (uri.size() < kScheme.size()) return false;
  for (std::size_t i = 0; i < kScheme.size(); ++i) {
    if (std::tolower(static_cast<unsigned char>(uri[i])) != kScheme[i]) return false;
  }
  return true;
}

std::optional<Bytes> DecodeBase64(std::string_view text) {
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  if (text.size() % 4 == 1) return std::nullopt;
  MutableBytes bytes = AllocateBytes(text.size() * 3 / 4);
  std::byte* out = bytes.data();
  std::uint32_t bits = 0, bad = 0;
  int held = 0;
  for (const char c : text) {
    const std::uint8_t digit = kBase64Digits[static_cast<unsigned char>(c)];
    bad |= digit;  // digits are below 64, so bit 7 remembers a stranger
    bits = (bits << 6) | (digit & 63u);
    held += 6;
    if (held >= 8) {
      held -= 8;
      *out++ = static_cast<std::byte>((bits >> held) & 0xFFu);
    }
  }
  if (bad & 0x80u) return std::nullopt;
  return bytes.Freeze();
}

std::optional<Bytes> DecodeDataUri(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (!IsDataUri(uri) || comma == std::string_view::npos) return std::nullopt;
  const std::string_view header = uri.substr(0, comma), body = uri.substr(comma + 1);
  constexpr std::string_view kBase64 = ";base64";
  const bool percent = body.find('%') != std::string_view::npos;
  if (header.size() >= kBase64.size() && header.substr(header.size() - kBase64.size()) == kBase64) {
    return percent ? DecodeBase64(PercentDecode(body)) : DecodeBase64(body);
  }
  const std::string text = PercentDecode(body);
  MutableBytes bytes = AllocateBytes(text.size());
  std::memcpy(bytes.data(), text.data(), text.size());
  return bytes.Freeze();
}

bool HasScheme(std::string_view uri) {
  std::size_t i = 0;
  while (i < uri.size() &&
         (std::isalnum(static_cast<unsigned char>(uri[i])) || uri[i] == '+' || uri[i] == '-' || uri[i] == '.')) {
    ++i;
  }
  return i >= 2 && i < uri.size() && uri[i] == ':' && std::isalpha(static_cast<unsigned char>(uri[0]));
}

std::optional<std::filesystem::path> ResolveRelative(const std::filesystem::path& folder, std::string_view uri) {
  if (uri.empty() || HasScheme(uri)) return std::nullopt;
  const std::string decoded = PercentDecode(uri);
  // A zero would end the name early for the operating system, and name another file than the message does.
  if (decoded.find('\0') != std::string::npos) return std::nullopt;
  const std::filesystem::path relative = PathOfUtf8(decoded);
  if (relative.is_absolute() || relative.has_root_path()) return std::nullopt;
  std::error_code ignored;
  if (!std::filesystem::exists(folder / relative, ignored)) {
    const std::filesystem::path as_written = PathOfUtf8(std::string(uri));
    if (std::filesystem::exists(folder / as_written, ignored)) return folder / as_written;
  }
  return folder / relative;
}

}  // namespace facet::gltf
