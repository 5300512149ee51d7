#include "settings/parse.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "base/bytes_text.h"
#include "base/printable.h"
#include "facet/error.h"
#include "settings/css_colors.h"

namespace facet {
namespace {

[[noreturn]] void Refuse(std::string_view option, std::string_view text, const std::string& is_not,
                         const std::string& hint) {
  throw Error(ErrorCode::InvalidUsage, Quoted(text) + " is not " + is_not, std::string(option), hint);
}

// The whole of `text` as a finite number, or none.
std::optional<double> WholeNumber(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);  // from_chars accepts no plus sign
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string Text(double value) {
  std::array<char, 32> buffer;
  const int length = std::snprintf(buffer.data(), buffer.size(), "%.10g", value);
  return std::string(buffer.data(), static_cast<std::size_t>(length));
}

std::vector<std::string_view> Split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t at = text.find(separator);
    parts.push_back(text.substr(0, at));
    if (at == std::string_view::npos) return parts;
    text.remove_prefix(at + 1);
  }
}

glm::vec3 FromHex(std::uint32_t rgb) {
  const auto channel = [rgb](int shift) { return static_cast<float>((rgb >> shift) & 0xffu) / 255.0f; };
  return {channel(16), channel(8), channel(0)};
}

bool DigitsOnly(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// Says what there is to choose from: "its cameras are 0 'Front', 1 'Top' and 7 more".
std::string Listing(const std::string& word, const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 12;
  std::string list = names.size() == 1 ? "its only " + word + " is " : "its " + word + "s are ";
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i) {
    if (i > 0) list += ", ";
    list += std::to_string(i);
    if (!names[i].empty()) list += " " + Quoted(names[i]);
  }
  if (names.size() > kMost) list += " and " + std::to_string(names.size() - kMost) + " more";
  return list;
}

}  // namespace

double ParseNumber(std::string_view option, std::string_view text, Range range) {
  const std::optional<double> value = WholeNumber(text);
  const std::string hint = "give a number from " + Text(range.low) + " to " + Text(range.high);
  if (!value) Refuse(option, text, "a number", hint);
  if (*value < range.low || *value > range.high) Refuse(option, text, "in range", hint);
  return *value;
}

double ParseDuration(std::string_view option, std::string_view text, Range range) {
  struct Unit {
    std::string_view name;
    double seconds;
  };
  static constexpr Unit kUnits[] = {{"ms", 1e-3}, {"min", 60.0}, {"s", 1.0}, {"h", 3600.0}, {"", 1.0}};
  const std::string hint =
      "give a time from " + Text(range.low) + " to " + Text(range.high) + " seconds, such as 200ms, 10s or 2min";
  for (const Unit& unit : kUnits) {
    if (!text.ends_with(unit.name)) continue;
    const std::optional<double> value = WholeNumber(text.substr(0, text.size() - unit.name.size()));
    if (!value) break;
    const double seconds = *value * unit.seconds;
    if (seconds < range.low || seconds > range.high) Refuse(option, text, "in range", hint);
    return seconds;
  }
  Refuse(option, text, "a time", hint);
}

std::uint64_t ParseBytes(std::string_view option, std::string_view text) {
  static constexpr std::string_view kUnits[] = {"MiB", "GiB", "TiB"};
  const std::string hint = "give an amount from 1MiB to 1024TiB, such as 512MiB or 2GiB";
  double unit_bytes = 1048576.0;
  for (const std::string_view unit : kUnits) {
    const std::optional<double> value =
        text.ends_with(unit) ? WholeNumber(text.substr(0, text.size() - unit.size())) : std::nullopt;
    if (value) {
      const double bytes = *value * unit_bytes;
      if (bytes < 0x1p20 || bytes > 0x1p50) Refuse(option, text, "in range", hint);
      return static_cast<std::uint64_t>(bytes);
    }
    unit_bytes *= 1024.0;
  }
  Refuse(option, text, "an amount of memory", hint);
}

int ParseInteger(std::string_view option, std::string_view text, int low, int high) {
  int value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  const std::string hint = "give a whole number from " + std::to_string(low) + " to " + std::to_string(high);
  if (stop != end || text.empty() || error == std::errc::invalid_argument) Refuse(option, text, "a whole number", hint);
  if (error != std::errc() || value < low || value > high) Refuse(option, text, "in range", hint);
  return value;
}

Size ParseSize(std::string_view option, std::string_view text) {
  constexpr std::int64_t kMost = 16384;
  std::vector<std::string_view> parts = Split(text, 'x');
  if (parts.size() == 1) parts.push_back(parts[0]);
  std::array<std::int64_t, 2> sides = {0, 0};
  bool good = parts.size() == 2;
  for (std::size_t i = 0; good && i < 2; ++i) {
    const char* end = parts[i].data() + parts[i].size();
    const auto [stop, error] = std::from_chars(parts[i].data(), end, sides[i]);
    good = error == std::errc() && stop == end && sides[i] >= 1;
  }
  const std::string hint =
      "give WIDTHxHEIGHT in pixels, each from 1 to 16384, such as 1280x720, or one number for a square";
  if (!good) Refuse(option, text, "a size", hint);
  if (sides[0] > kMost || sides[1] > kMost) {
    const double bytes_per_pixel = sizeof(glm::vec4);  // of linear light
    const double bytes = double(sides[0]) * double(sides[1]) * bytes_per_pixel;
    const double most = double(kMost * kMost) * bytes_per_pixel;
    throw Error(ErrorCode::InvalidUsage,
                Quoted(text) + " is too large" +
                    (bytes > most ? ": it needs " + BytesText(bytes) + ", and the limit is " + BytesText(most) : ""),
                std::string(option), hint);
  }
  return {static_cast<int>(sides[0]), static_cast<int>(sides[1])};
}

glm::dvec3 ParseVec3(std::string_view option, std::string_view text) {
  const std::vector<std::string_view> parts = Split(text, ',');
  glm::dvec3 vector{0.0};
  bool good = parts.size() == 3;
  for (int i = 0; good && i < 3; ++i) {
    const std::optional<double> value = WholeNumber(parts[static_cast<std::size_t>(i)]);
    good = value.has_value() && std::abs(*value) <= 1e12;
    if (good) vector[i] = *value;
  }
  if (!good) Refuse(option, text, "a point", "give X,Y,Z: three finite numbers without spaces, such as 0,1.5,-2");
  return vector;
}

Orbit ParseOrbit(std::string_view option, std::string_view text) {
  const std::vector<std::string_view> parts = Split(text, ',');
  std::array<double, 3> numbers = {0.0, 0.0, 0.0};
  bool good = parts.size() == 2 || parts.size() == 3;
  for (std::size_t i = 0; good && i < parts.size(); ++i) {
    const std::optional<double> value = WholeNumber(parts[i]);
    good = value.has_value() && std::abs(*value) <= (i < 2 ? 36000.0 : 1e12);
    if (good) numbers[i] = *value;
  }
  if (!good || numbers[2] < 0.0) {
    Refuse(
        option, text, "an orbit",
        "give THETA,PHI or THETA,PHI,RADIUS: two angles from -36000 to 36000 degrees, and a distance of at most 1e12 "
        "(0, or none: the distance that shows the scene from every side), such as 30,75 or 30,75,4");
  }
  Orbit orbit{numbers[0], numbers[1], std::nullopt};
  if (numbers[2] > 0.0) orbit.radius = numbers[2];
  return orbit;
}

std::string LowerCase(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

glm::vec3 ParseColor(std::string_view option, std::string_view text) {
  if (text.size() == 4 || text.size() == 7) {
    std::uint32_t value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data() + 1, end, value, 16);
    if (text[0] == '#' && error == std::errc() && stop == end) {
      if (text.size() == 4) {  // #rgb stands for #rrggbb
        value = ((value & 0xf00u) << 8 | (value & 0x0f0u) << 4 | (value & 0x00fu)) * 0x11u;
      }
      return FromHex(value);
    }
  }
  const std::string name = LowerCase(text);
  for (const NamedColor& color : kCssColors) {
    if (color.name == name) return FromHex(color.rgb);
  }
  Refuse(option, text, "a colour", "give #rgb, #rrggbb or a name of CSS such as white, black or grey");
}

int ParseChoice(std::string_view option, std::string_view text, const std::vector<std::string_view>& choices) {
  std::string list;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (choices[i] == text) return static_cast<int>(i);
    list += i == 0 ? "" : i + 1 == choices.size() ? " or " : ", ";
    list += choices[i];
  }
  throw Error(ErrorCode::InvalidUsage, Quoted(text) + " is no choice", std::string(option), "give " + list);
}

std::vector<int> ParseChoices(std::string_view option, std::string_view text,
                              const std::vector<std::string_view>& choices) {
  std::vector<int> chosen;
  if (text == "none") return chosen;
  for (const std::string_view word : Split(text, ',')) chosen.push_back(ParseChoice(option, word, choices));
  return chosen;
}

std::vector<PlaneKind> ParsePlanes(std::string_view option, std::string_view text) {
  std::vector<std::string_view> names;
  for (const PlaneInfo& info : kPlanes) names.push_back(info.name);
  std::vector<PlaneKind> planes;
  for (const int i : ParseChoices(option, text, names)) {
    const PlaneInfo& info = kPlanes[i];
    if (std::find(planes.begin(), planes.end(), info.kind) != planes.end()) {
      Refuse(option, text, "a list of planes: " + std::string(info.name) + " is named twice", "name each plane once");
    }
    planes.push_back(info.kind);
  }
  return planes;
}

int Choose(std::string_view option, std::string_view kind, const std::string& text,
           const std::vector<std::string>& names) {
  const std::string word(kind);
  if (names.empty()) {
    throw Error(ErrorCode::InvalidUsage, "the file has no " + word + "s", std::string(option), "leave the option out");
  }
  if (DigitsOnly(text)) {
    std::size_t index = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), index);
    if (error == std::errc() && index < names.size()) return static_cast<int>(index);
    throw Error(ErrorCode::InvalidUsage, "there is no " + word + " " + text, std::string(option), Listing(word, names));
  }
  const auto first = std::find(names.begin(), names.end(), text);
  if (first == names.end()) {
    throw Error(ErrorCode::InvalidUsage, "no " + word + " is called " + Quoted(text), std::string(option),
                Listing(word, names));
  }
  if (std::find(first + 1, names.end(), text) != names.end()) {
    throw Error(ErrorCode::InvalidUsage, "more than one " + word + " is called " + Quoted(text), std::string(option),
                "give an index; " + Listing(word, names));
  }
  return static_cast<int>(first - names.begin());
}

}  // namespace facet
