#include "base/number_text.h"

#include <array>
#include <charconv>
#include <cmath>

namespace facet {
namespace {

constexpr const char* kNotKnown = "not known";

// Whole numbers keep their digits up to a million: 1024 KiB must not become 1.02e+03.
std::string ThreeDigits(double value) {
  return value >= 100.0 && value < 1e6 ? ShortNumber(std::round(value)) : ShortNumber(value, 3);
}

}  // namespace

std::string ShortNumber(double value, int digits) {
  std::array<char, 32> text;
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, digits);
  return std::string(text.data(), result.ptr);
}

std::string TimeWords(double seconds) {
  if (std::isnan(seconds)) return kNotKnown;
  if (seconds == 0.0 || seconds >= 1.0) return ThreeDigits(seconds) + " s";
  return seconds < 1e-3 ? ThreeDigits(seconds * 1e6) + " µs" : ThreeDigits(seconds * 1e3) + " ms";
}

std::string BytesWords(double bytes) {
  constexpr double kKi = 1024.0;
  if (bytes < kKi) return ThreeDigits(bytes) + " B";
  if (bytes < kKi * kKi) return ThreeDigits(bytes / kKi) + " KiB";
  if (bytes < kKi * kKi * kKi) return ThreeDigits(bytes / (kKi * kKi)) + " MiB";
  return ThreeDigits(bytes / (kKi * kKi * kKi)) + " GiB";
}

std::string ErrorWords(double error) {
  if (std::isnan(error)) return kNotKnown;
  const std::string text = ThreeDigits(error);
  const std::size_t e = text.find('e');
  return e == std::string::npos ? text : text.substr(0, e) + "·" + PowerOfTen(std::stoi(text.substr(e + 1)));
}

std::string PowerOfTen(int exponent) {
  static constexpr const char* kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string power = "10";
  for (const char c : std::to_string(exponent)) power += c == '-' ? "⁻" : kDigits[c - '0'];
  return power;
}

std::string Grouped(std::uint64_t value) {
  const std::string digits = std::to_string(value);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
    text += digits[i];
  }
  return text;
}

}  // namespace facet
