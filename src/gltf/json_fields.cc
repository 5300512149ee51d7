#include "gltf/json_fields.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "math/round_to_float.h"

namespace facet::gltf {
namespace {

constexpr std::size_t kMaxInteger = std::size_t(1) << 53;  // what JSON's numbers can say exactly

[[noreturn]] void FailMissing(const char* key, const Place& place) {
  Fail(place, '"' + std::string(key) + "\" is missing");
}

[[noreturn]] void FailType(const char* key, const char* expected, const Place& place) {
  Fail(Place(place, key), std::string("is not ") + expected);
}

// A kind of value, and what messages call it.
struct Kind {
  bool (*includes)(const Json& value);
  const char* name;
};
constexpr Kind kObject = {[](const Json& value) { return value.is_object(); }, "an object"};
constexpr Kind kArray = {[](const Json& value) { return value.is_array(); }, "an array"};
constexpr Kind kNumber = {[](const Json& value) { return value.is_number(); }, "a number"};
constexpr Kind kString = {[](const Json& value) { return value.is_string(); }, "a string"};
constexpr Kind kBool = {[](const Json& value) { return value.is_boolean(); }, "true or false"};
constexpr Kind kSize = {
    [](const Json& value) { return value.is_number_unsigned() && value.get<std::uint64_t>() < kMaxInteger; },
    "a sensible non-negative integer"};

// A member of that kind; null when absent.
const Json* Strict(const Kind& kind, const Json& object, const char* key, const Place& place) {
  const Json* value = Find(object, key);
  if (value && !kind.includes(*value)) FailType(key, kind.name, place);
  return value;
}

// Without an exception, which takes long where there are many.
const Json* Lenient(const Kind& kind, const Json& object, const char* key, const Place& place) {
  const Json* value = Find(object, key);
  if (!value || kind.includes(*value)) return value;
  Place(place, key).Warn(std::string("ignored (is not ") + kind.name + ")");
  return nullptr;
}

template <class T>
std::optional<T> Get(const Json* value) {
  return value ? std::optional(value->get<T>()) : std::nullopt;
}

// What `read` returns, or nothing where it throws.
template <class Read>
auto Leniently(const Read& read, const char* key, const Place& place) -> decltype(read()) {
  try {
    return read();
  } catch (const Error& error) {
    Place(place, key).Warn("ignored", error);
    return {};
  }
}

}  // namespace

const Json* Find(const Json& object, const char* key) {
  const auto it = object.find(key);
  return it == object.end() ? nullptr : &*it;
}

void CheckObject(const Json& value, const Place& place) {
  if (!value.is_object()) Fail(place, "is not an object");
}

const Json* ObjectAt(const Json& object, const char* key, const Place& place) {
  return Strict(kObject, object, key, place);
}

const Json* ArrayAt(const Json& object, const char* key, const Place& place) {
  return Strict(kArray, object, key, place);
}

std::optional<double> NumberAt(const Json& object, const char* key, const Place& place) {
  return Get<double>(Strict(kNumber, object, key, place));
}

std::optional<std::size_t> SizeAt(const Json& object, const char* key, const Place& place) {
  return Get<std::size_t>(Strict(kSize, object, key, place));
}

std::optional<std::string> StringAt(const Json& object, const char* key, const Place& place) {
  return Get<std::string>(Strict(kString, object, key, place));
}

std::optional<bool> BoolAt(const Json& object, const char* key, const Place& place) {
  return Get<bool>(Strict(kBool, object, key, place));
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

const Json& RequireArray(const Json& object, const char* key, const Place& place) {
  const Json* value = ArrayAt(object, key, place);
  if (!value) FailMissing(key, place);
  return *value;
}

const Json& RequireObject(const Json& object, const char* key, const Place& place) {
  const Json* value = ObjectAt(object, key, place);
  if (!value) FailMissing(key, place);
  return *value;
}

bool IsAbsent(const Json& index, const Place& place) {
  const bool is_minus_one = index.is_number_integer() && index.get<std::int64_t>() == -1;
  if (is_minus_one || index.is_null()) place.Warn(index.dump() + " is read as absent");
  return is_minus_one || index.is_null();
}

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
  if (!value || IsAbsent(*value, Place(place, key))) return -1;
  return AsIndex(*value, count, list, Place(place, key));
}

int RequireIndex(const Json& object, const char* key, std::size_t count, const char* list, const Place& place) {
  const int index = IndexAt(object, key, count, list, place);
  if (index < 0) FailMissing(key, place);
  return index;
}

std::vector<double> NumbersAt(const Json& object, const char* key, std::size_t size, const Place& place,
                              std::size_t least) {
  std::vector<double> numbers;
  const Json* array = ArrayAt(object, key, place);
  if (!array) return numbers;
  const Place array_place(place, key);
  if (array->size() != size) {
    const std::string what = "has " + std::to_string(array->size()) + " numbers instead of " + std::to_string(size);
    if (array->size() < (least > 0 ? least : size)) Fail(array_place, what);
    array_place.Warn(array->size() > size ? what + "; the first are read" : what);
  }
  for (std::size_t i = 0; i < array->size() && i < size; ++i) {
    if (!(*array)[i].is_number()) Fail(Place(array_place, i), "is not a number");
    numbers.push_back((*array)[i].get<double>());
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

const Json* LenientObject(const Json& object, const char* key, const Place& place) {
  return Lenient(kObject, object, key, place);
}

const Json* LenientArray(const Json& object, const char* key, const Place& place) {
  return Lenient(kArray, object, key, place);
}

std::optional<double> LenientNumber(const Json& object, const char* key, const Place& place) {
  return Get<double>(Lenient(kNumber, object, key, place));
}

std::optional<std::size_t> LenientSize(const Json& object, const char* key, const Place& place) {
  return Get<std::size_t>(Lenient(kSize, object, key, place));
}

std::optional<std::string> LenientString(const Json& object, const char* key, const Place& place) {
  return Get<std::string>(Lenient(kString, object, key, place));
}

std::optional<bool> LenientBool(const Json& object, const char* key, const Place& place) {
  return Get<bool>(Lenient(kBool, object, key, place));
}

int LenientIndex(const Json& object, const char* key, std::size_t count, const char* list, const Place& place) {
  const auto index = Leniently([&] { return std::optional(IndexAt(object, key, count, list, place)); }, key, place);
  return index.value_or(-1);
}

std::vector<double> LenientNumbers(const Json& object, const char* key, std::size_t size, const Place& place,
                                   std::size_t least) {
  return Leniently([&] { return NumbersAt(object, key, size, place, least); }, key, place);
}

std::vector<float> LenientFloats(const Json& object, const char* key, const Place& place) {
  const Json* array = LenientArray(object, key, place);
  if (!array) return {};
  std::vector<float> floats;
  for (const double number : LenientNumbers(object, key, array->size(), place))
    floats.push_back(RoundToFiniteFloat(number));
  return floats;
}

std::optional<int> LenientOneOf(const Json& object, const char* key, std::initializer_list<int> choices,
                                const Place& place) {
  return Leniently([&] { return OneOfAt(object, key, choices, place); }, key, place);
}

std::string NameOf(const Json& object, const Place& place) { return LenientString(object, "name", place).value_or(""); }

const Json* ExtensionOf(const Json& object, const char* name, const Place& place) {
  const Json* extensions = LenientObject(object, "extensions", place);
  return extensions ? LenientObject(*extensions, name, Place(place, "extensions")) : nullptr;
}

const Json& LenientElement(const Json& element, const Place& place) {
  static const Json empty = Json::object();
  if (element.is_object()) return element;
  place.Warn("is not an object; an empty one is read");
  return empty;
}

}  // namespace facet::gltf
