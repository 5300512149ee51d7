#include "gltf/json_fields.h"

#include <cmath>
#include <limits>

namespace facet::gltf {
namespace {

constexpr std::size_t kMaxInteger = std::size_t(1) << 53;  // what JSON's numbers can say exactly

void CheckDepth(std::string_view text, const Place& place) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      if (++depth > kMaxDepth) Fail(place, "JSON is nested deeper than " + std::to_string(kMaxDepth) + " levels");
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
}

void Normalise(Json& value) {
  if (value.is_object()) {
    value.erase("extras");
    for (auto& member : value) Normalise(member);
  } else if (value.is_array()) {
    for (auto& element : value) Normalise(element);
  } else if (value.is_number_float()) {
    const double number = value.get<double>();
    if (number == std::floor(number) && std::fabs(number) < double(kMaxInteger)) {
      if (number >= 0) {
        value = static_cast<std::uint64_t>(number);
      } else {
        value = static_cast<std::int64_t>(number);
      }
    }
  }
}

std::string OneLine(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
  return text;
}

[[noreturn]] void FailMissing(const char* key, const Place& place) {
  Fail(place, "\"" + std::string(key) + "\" is missing");
}

[[noreturn]] void FailType(const char* key, const char* expected, const Place& place) {
  Fail(Place(place, key), std::string("is not ") + expected);
}

}  // namespace

Json ParseJson(std::string_view text, const Place& place) {
  CheckDepth(text, place);
  try {
    // GLB pads the chunk with spaces, and some exporters with zeros.
    while (!text.empty() && text.back() == '\0') text.remove_suffix(1);
    Json root = Json::parse(text.begin(), text.end());
    Normalise(root);
    return root;
  } catch (const Json::exception& error) {
    std::string message = error.what();
    constexpr std::size_t kEnough = 200;  // the parser quotes the offending text, which may be long
    if (message.size() > kEnough) message = message.substr(0, kEnough) + "...";
    for (char& c : message) {
      if (static_cast<unsigned char>(c) >= 0x80) c = '?';  // a sequence may have been cut, or be the very mistake
    }
    Fail(place, "not a glTF file: " + OneLine(message), "is it complete, and glTF 2.0?");
  }
}

const Json* Find(const Json& object, const char* key) {
  const auto it = object.find(key);
  return it == object.end() ? nullptr : &*it;
}

void RequireObject(const Json& value, const Place& place) {
  if (!value.is_object()) Fail(place, "is not an object");
}

void RequireMember(const Json& object, const char* key, const Place& place) {
  if (!Find(object, key)) FailMissing(key, place);
}

const Json* ObjectAt(const Json& object, const char* key, const Place& place) {
  const Json* value = Find(object, key);
  if (value && !value->is_object()) FailType(key, "an object", place);
  return value;
}

const Json* ArrayAt(const Json& object, const char* key, const Place& place) {
  const Json* value = Find(object, key);
  if (value && !value->is_array()) FailType(key, "an array", place);
  return value;
}

std::optional<double> NumberAt(const Json& object, const char* key, const Place& place) {
  const Json* value = Find(object, key);
  if (!value) return std::nullopt;
  if (!value->is_number()) FailType(key, "a number", place);
  return value->get<double>();
}

std::optional<std::size_t> SizeAt(const Json& object, const char* key, const Place& place) {
  const Json* value = Find(object, key);
  if (!value) return std::nullopt;
  if (!value->is_number_unsigned() || value->get<std::uint64_t>() >= kMaxInteger) {
    FailType(key, "a sensible non-negative integer", place);
  }
  return value->get<std::size_t>();
}

std::optional<std::string> StringAt(const Json& object, const char* key, const Place& place) {
  const Json* value = Find(object, key);
  if (!value) return std::nullopt;
  if (!value->is_string()) FailType(key, "a string", place);
  return value->get<std::string>();
}

std::optional<bool> BoolAt(const Json& object, const char* key, const Place& place) {
  const Json* value = Find(object, key);
  if (!value) return std::nullopt;
  if (!value->is_boolean()) FailType(key, "true or false", place);
  return value->get<bool>();
}

std::size_t RequireSize(const Json& object, const char* key, const Place& place) {
  const auto value = SizeAt(object, key, place);
  if (!value) FailMissing(key, place);
  return *value;
}

std::string RequireString(const Json& object, const char* key, const Place& place) {
  auto value = StringAt(object, key, place);
  if (!value) FailMissing(key, place);
  return *std::move(value);
}

std::string NameOf(const Json& object, const Place& place) { return StringAt(object, "name", place).value_or(""); }

int AsIndex(const Json& value, std::size_t count, const char* list, const Place& place) {
  if (!value.is_number_unsigned()) Fail(place, "is not an index");
  const auto index = value.get<std::uint64_t>();
  if (index >= count || index > std::uint64_t(std::numeric_limits<int>::max())) {
    Fail(place, std::to_string(index) + " is not one of the " + std::to_string(count) + " " + list);
  }
  return static_cast<int>(index);
}

int IndexAt(const Json& object, const char* key, std::size_t count, const char* list, const Place& place) {
  const Json* value = Find(object, key);
  return value ? AsIndex(*value, count, list, Place(place, key)) : -1;
}

int RequireIndex(const Json& object, const char* key, std::size_t count, const char* list, const Place& place) {
  RequireMember(object, key, place);
  return IndexAt(object, key, count, list, place);
}

std::vector<int> IndicesAt(const Json& object, const char* key, std::size_t count, const char* list,
                           const Place& place) {
  std::vector<int> indices;
  if (const Json* array = ArrayAt(object, key, place)) {
    const Place array_place(place, key);
    indices.reserve(array->size());
    for (const Json& value : *array) {
      indices.push_back(AsIndex(value, count, list, Place(array_place, indices.size())));
    }
  }
  return indices;
}

std::vector<double> NumbersAt(const Json& object, const char* key, std::size_t size, const Place& place) {
  std::vector<double> numbers;
  const Json* array = ArrayAt(object, key, place);
  if (!array) return numbers;
  if (size != 0 && array->size() != size) {
    Fail(Place(place, key), "has " + std::to_string(array->size()) + " numbers instead of " + std::to_string(size));
  }
  numbers.reserve(array->size());
  for (const Json& value : *array) {
    if (!value.is_number()) Fail(Place(Place(place, key), numbers.size()), "is not a number");
    numbers.push_back(value.get<double>());
  }
  return numbers;
}

std::optional<int> OneOfAt(const Json& object, const char* key, std::initializer_list<int> choices,
                           const Place& place) {
  const auto value = SizeAt(object, key, place);
  if (!value) return std::nullopt;
  for (const int choice : choices) {
    if (*value == static_cast<std::size_t>(choice)) return choice;
  }
  Fail(Place(place, key), std::to_string(*value) + " is not a value that glTF knows");
}

const Json* ExtensionOf(const Json& object, const char* name, const Place& place) {
  const Json* extensions = ObjectAt(object, "extensions", place);
  return extensions ? ObjectAt(*extensions, name, Place(place, "extensions")) : nullptr;
}

}  // namespace facet::gltf
