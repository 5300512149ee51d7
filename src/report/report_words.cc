#include "report/report_words.h"

#include <cmath>

#include "report/short_number.h"

namespace facet {
namespace {

constexpr const char* kNotKnown = "not known";

// Whole numbers keep all their digits: 1024 KiB must not become 1.02e+03.
std::string ThreeDigits(double value) {
  return std::abs(value) < 100.0 ? ShortNumber(value, 3) : ShortNumber(std::round(value));
}

}  // namespace

std::string SettingsWords(const SettingsText& changed) {
  if (changed.empty()) return "the settings asked for";
  std::string words;
  for (const auto& [option, value] : changed) words += (words.empty() ? "" : " ") + option + "=" + value;
  return words;
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

std::string ErrorWords(double error) { return std::isnan(error) ? kNotKnown : ShortNumber(error, 3); }

}  // namespace facet
