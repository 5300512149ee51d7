#include "gltf/json_text.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string>

#include "base/json_bounds.h"
#include "base/memory_budget.h"
#include "gltf/enterprise.h"
#include "gltf/extensions.h"

namespace facet::gltf {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";  // U+FFFD

// How many bytes the UTF-8 character at `at` has; 0 where there is none.
// Source: The Unicode Standard 15.0 (2022), table 3-7, "Well-Formed UTF-8 Byte Sequences".
std::size_t CharacterSize(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) -> unsigned {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0;
  };
  const unsigned lead = byte(at), second = byte(at + 1);
  const auto continues = [&](std::size_t i) { return (byte(i) & 0xC0) == 0x80; };
  if (lead < 0x80) return 1;
  if (lead >= 0xC2 && lead <= 0xDF) return continues(at + 1) ? 2 : 0;
  if (lead >= 0xE0 && lead <= 0xEF) {
    const bool fits = second >= (lead == 0xE0 ? 0xA0u : 0x80u) && second <= (lead == 0xED ? 0x9Fu : 0xBFu);
    return fits && continues(at + 2) ? 3 : 0;
  }
  if (lead >= 0xF0 && lead <= 0xF4) {
    const bool fits = second >= (lead == 0xF0 ? 0x90u : 0x80u) && second <= (lead == 0xF4 ? 0x8Fu : 0xBFu);
    return fits && continues(at + 2) && continues(at + 3) ? 4 : 0;
  }
  return 0;
}

// Where the first byte is that is no part of a UTF-8 character; text.size() where there is none.
std::size_t FirstBadByte(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t size = CharacterSize(text, at);
    if (size == 0) return at;
    at += size;
  }
  return text.size();
}

std::string WithValidUtf8(std::string_view text) {
  std::string valid;
  valid.reserve(text.size() + text.size() / 16);
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t size = CharacterSize(text, at);
    valid += size == 0 ? kReplacement : text.substr(at, size);
    at += std::max<std::size_t>(size, 1);
  }
  return valid;
}

// Warns of `what` at each value for which is_it(value). True if there is any.
template <class IsIt>
bool WarnWhere(const IsIt& is_it, const std::string& what, const Json& value, const Place& place) {
  bool any = is_it(value);
  if (any) place.Warn(what);
  if (value.is_object()) {
    for (const auto& item : value.items()) any |= WarnWhere(is_it, what, item.value(), Place(place, item.key()));
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) any |= WarnWhere(is_it, what, value[i], Place(place, i));
  }
  return any;
}

bool HasReplacement(const Json& value) {
  return value.is_string() && value.get_ref<const std::string&>().find(kReplacement) != std::string::npos;
}

bool IsLargest(const Json& value) {
  return value.is_number_float() && std::fabs(value.get<double>()) == std::numeric_limits<double>::max();
}

// `text` is JSON but for numbers that the parser calls too large.
// Escapes of surrogates that do not come in pairs, which stand for nothing, become U+FFFD.
std::string WithoutHalfCharacters(std::string_view text) {
  std::string whole(text);
  const auto half_at = [&](std::size_t at, char low, char high) {  // "\uD8.." to "\uDB..", or "\uDC.." to "\uDF.."
    if (at + 6 > text.size() || text[at] != '\\' || text[at + 1] != 'u' || (text[at + 2] | 0x20) != 'd') return false;
    const char digit = static_cast<char>(text[at + 3] | (text[at + 3] >= 'A' ? 0x20 : 0));
    return digit >= low && digit <= high;
  };
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] != '\\') continue;
    const bool first = half_at(at, '8', '9') || half_at(at, 'a', 'b'), second = half_at(at, 'c', 'f');
    const bool pair = first && half_at(at + 6, 'c', 'f');
    if ((first && !pair) || second) whole.replace(at + 2, 4, "FFFD");
    at += pair ? 11 : first || second ? 5 : 1;
  }
  return whole;
}

std::string WithFiniteNumbers(std::string_view text) {
  std::string finite;
  finite.reserve(text.size() + 32);
  bool in_string = false;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    const bool is_number = !in_string && (c == '-' || (c >= '0' && c <= '9'));
    if (!is_number) {
      if (c == '"') in_string = !in_string;
      const std::size_t size = in_string && c == '\\' && at + 1 < text.size() ? 2 : 1;
      finite += text.substr(at, size);
      at += size;
      continue;
    }
    const std::size_t end = std::min(text.find_first_not_of("+-.0123456789eE", at), text.size());
    const std::string number(text.substr(at, end - at));
    if (std::isfinite(std::strtod(number.c_str(), nullptr))) {
      finite += number;
    } else {
      finite += c == '-' ? "-1.7976931348623157e308" : "1.7976931348623157e308";
    }
    at = end;
  }
  return finite;
}

// Removes "extras". Those that state a material's parameters in the form of extensions become its extensions.
void RemoveExtras(Json& object) {
  const auto extras = object.find("extras");
  if (extras == object.end()) return;
  Json kept = Json::object();
  if (extras->is_object()) {
    for (auto& [name, value] : extras->get_ref<Json::object_t&>()) {
      if (IsEnterpriseExtension(name)) kept[name] = std::move(value);
    }
  }
  object.erase(extras);
  if (kept.empty()) return;
  Json& extensions = object.emplace("extensions", Json::object()).first.value();
  if (extensions.is_object()) extensions.insert(kept.begin(), kept.end());  // those that it has already stay
}

void Normalise(Json& value, const Place& place, bool are_extensions = false) {
  constexpr double kMaxInteger = 9007199254740992.0;  // 2^53: what JSON's numbers can say exactly
  if (value.is_object()) {
    RemoveExtras(value);
    auto& members = value.get_ref<Json::object_t&>();
    for (auto member = members.begin(); member != members.end();) {
      const Place member_place(place, member->first);
      // What facet does not read may hold anything.
      const bool is_strange = are_extensions && !IsSupported(member->first);
      if (member->second.is_null() && !is_strange) {
        member_place.Warn("null is read as absent");
        member = members.erase(member);
        continue;
      }
      if (!is_strange) Normalise(member->second, member_place, member->first == "extensions");
      ++member;
    }
  } else if (value.is_array()) {
    std::size_t i = 0;
    for (Json& element : value) Normalise(element, Place(place, i++));
  } else if (value.is_number_float()) {
    const double number = value.get<double>();
    if (number == std::floor(number) && std::fabs(number) < kMaxInteger) {
      if (number >= 0) {
        value = static_cast<std::uint64_t>(number);
      } else {
        value = static_cast<std::int64_t>(number);
      }
    }
  }
}

[[noreturn]] void FailToParse(const Json::exception& error, const Place& place) {
  std::string message = error.what();
  if (message.starts_with('[')) message.erase(0, std::min(message.find(']'), message.size() - 2) + 2);  // its number
  constexpr std::size_t kEnough = 200;  // the parser quotes the offending text, which may be long
  if (message.size() > kEnough) message = message.substr(0, kEnough) + "...";
  for (char& c : message) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80) c = '?';  // a sequence may have been cut
    if (byte < 0x20) c = ' ';
  }
  Fail(place, "its JSON is damaged: " + message, "is it complete?");
}

}  // namespace

Json ParseJson(std::string_view text, const Place& place) {
  if (IsJsonDeeperThan(text, kMaxJsonDepth)) {
    Fail(place, "JSON is nested deeper than " + std::to_string(kMaxJsonDepth) + " levels");
  }
  // GLB pads the chunk with spaces, and some exporters with zeros.
  while (!text.empty() && text.back() == '\0') text.remove_suffix(1);
  constexpr const char* kNotUtf8 = "is not UTF-8; what cannot be read of it became U+FFFD";
  constexpr const char* kTooLarge = "is beyond the range of numbers; the largest is read";
  std::string valid, finite, whole;
  MemoryLease for_valid, for_finite;
  const std::size_t bad_byte = FirstBadByte(text);
  if (bad_byte < text.size()) {
    for_valid = MemoryLease(text.size(), 7, "JSON");
    valid = WithValidUtf8(text);
    text = valid;
  }
  Json root;
  bool has_halves = false;
  try {
    try {
      root = Json::parse(text.begin(), text.end());
    } catch (const Json::parse_error&) {
      for_finite = MemoryLease(text.size(), 1, "JSON");
      whole = WithoutHalfCharacters(text);
      has_halves = whole != text;
      if (!has_halves) throw;
      root = Json::parse(whole.begin(), whole.end());
    } catch (const Json::out_of_range&) {
      for_finite = MemoryLease(text.size(), 12, "JSON");
      finite = WithFiniteNumbers(text);
      root = Json::parse(finite.begin(), finite.end());
    }
  } catch (const Json::exception& error) {
    FailToParse(error, place);
  }
  Normalise(root, place);
  if (has_halves && !WarnWhere(HasReplacement, "has half of a character; it became U+FFFD", root, place)) {
    place.Warn("halves of characters in its JSON were replaced");
  }
  if (!finite.empty()) WarnWhere(IsLargest, kTooLarge, root, place);
  if (!valid.empty() && !WarnWhere(HasReplacement, kNotUtf8, root, place)) {
    place.Warn("bytes that are not UTF-8 were replaced, from byte " + std::to_string(bad_byte) + " of the JSON on");
  }
  return root;
}

}  // namespace facet::gltf
