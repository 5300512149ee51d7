#include "gltf/uri.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <iterator>

#include "base/memory_budget.h"

namespace facet::gltf {
namespace {

constexpr const char* kDataUris = "data URIs";

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

// Whether a character is a blank or line break.
bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f'; }

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
  while (!uri.empty() && IsBlank(uri.front())) uri.remove_prefix(1);
  constexpr std::string_view kScheme = "data:";
  if (uri.size() < kScheme.size()) return false;
  for (std::size_t i = 0; i < kScheme.size(); ++i) {
    if (std::tolower(static_cast<unsigned char>(uri[i])) != kScheme[i]) return false;
  }
  return true;
}

std::optional<Bytes> DecodeBase64(std::string_view text) {
  while (!text.empty() && (text.back() == '=' || IsBlank(text.back()))) text.remove_suffix(1);
  const std::size_t size = text.size() * 3 / 4;  // at most
  MemoryBudget::Current().Charge(size, 1, kDataUris);
  MutableBytes bytes = AllocateBytes(size);
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
  if (!(bad & 0x80u) && text.size() % 4 != 1) return bytes.Freeze();
  bytes = {};
  MemoryBudget::Current().Release(size, kDataUris);
  if (std::none_of(text.begin(), text.end(), IsBlank)) return std::nullopt;
  const MemoryLease lease(text.size(), 1, kDataUris);
  std::string dense;
  dense.reserve(text.size());
  std::remove_copy_if(text.begin(), text.end(), std::back_inserter(dense), IsBlank);
  return DecodeBase64(dense);
}

std::optional<Bytes> DecodeDataUri(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (!IsDataUri(uri) || comma == std::string_view::npos) return std::nullopt;
  std::string header;
  for (const char c : uri.substr(0, comma)) {
    if (!IsBlank(c)) header += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  const std::string_view body = uri.substr(comma + 1);
  const bool is_base64 = header.ends_with(";base64");
  if (is_base64 && body.find('%') == std::string_view::npos) return DecodeBase64(body);
  const MemoryLease lease(body.size(), 1, kDataUris);
  const std::string text = PercentDecode(body);
  if (is_base64) return DecodeBase64(text);
  MemoryBudget::Current().Charge(text.size(), 1, kDataUris);
  MutableBytes bytes = AllocateBytes(text.size());
  std::memcpy(bytes.data(), text.data(), text.size());
  return bytes.Freeze();
}

bool IsMalformedDataUri(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos) return true;
  const std::string_view body = uri.substr(comma + 1);
  const auto is_stranger = [](char c) {
    return (kBase64Digits[static_cast<unsigned char>(c)] & 0x80u) != 0 && c != '=' && c != '%' && !IsBlank(c);
  };
  return uri.substr(0, comma).ends_with(";base64") && std::any_of(body.begin(), body.end(), is_stranger);
}

bool HasScheme(std::string_view uri) {
  std::size_t i = 0;
  while (i < uri.size() &&
         (std::isalnum(static_cast<unsigned char>(uri[i])) || uri[i] == '+' || uri[i] == '-' || uri[i] == '.')) {
    ++i;
  }
  return i >= 2 && i < uri.size() && uri[i] == ':' && std::isalpha(static_cast<unsigned char>(uri[0]));
}

}  // namespace facet::gltf
