#include "fuzz/json_mutator.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>
#include <vector>

#include "base/json_bounds.h"
#include "fuzz/fuzz.h"

namespace facet::fuzz {
namespace {

constexpr std::size_t kMostValues = 20000;  // of a text that is worth changing
constexpr std::size_t kMostText = 4096;     // of a string that is changed byte by byte

// Every value, the root first.
template <class AnyJson>
std::vector<AnyJson*> ValuesOf(AnyJson& root) {
  std::vector<AnyJson*> values = {&root};
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!values[i]->is_structured()) continue;
    for (auto& child : *values[i]) values.push_back(&child);
  }
  return values;
}

Json Boundary(Random& random) {
  static const std::vector<Json> values = {
      0, 1, 2, 3, 4, 5, 7, 8, 16, 255, 256, 4096, 32767, 65535, 65536, 1000000, -1, -2, -128, -2147483648LL, 2147483647,
      2147483648LL, 4294967295LL, 4294967296LL, 9007199254740993LL, 9223372036854775807LL, 18446744073709551615ULL,
      // Those that glTF has for types and filters.
      5120, 5121, 5122, 5123, 5124, 5125, 5126, 5127, 9728, 9729, 9984, 9987, 10497, 33071, 33648, 34962, 34963, 0.5,
      -0.5, -0.0, 1.5, 3.141592653589793, 1e-45, 1e-38, 1e-300, 1e20, 3e38, -3e38, 1e39, 1e300, -1e300, nullptr, true,
      false, "", "-1", "1", Json::array(), Json::object()};
  return values[Below(values.size(), random)];
}

void MutateNumber(Json& value, Random& random) {
  const std::size_t how = Below(6, random);
  if (how <= 1 || !value.is_number()) {
    value = Boundary(random);
  } else if (how == 2) {
    value = static_cast<int>(Below(16, random));
  } else if (value.is_number_float()) {
    const auto number = value.get<double>();
    value = how == 3 ? number * 2.0 : how == 4 ? -number : number + 1.0;
  } else {
    const auto number = value.get<std::uint64_t>();  // wraps around, as it should
    value = how == 3 ? number * 2 : how == 4 ? number - 1 : number + 1;
  }
}

std::string MutatedText(std::string text) {
  const std::size_t size = std::min(text.size(), kMostText);
  std::vector<std::uint8_t> bytes(size + 64);
  std::memcpy(bytes.data(), text.data(), size);
  const std::size_t changed = LLVMFuzzerMutate(bytes.data(), size, bytes.size());
  return std::string(reinterpret_cast<const char*>(bytes.data()), changed) + text.substr(size);
}

void MutateString(Json& value, const std::vector<Json*>& values, Random& random) {
  const std::size_t how = Below(4, random);
  if (how == 0) {
    value = Boundary(random);
  } else if (how == 1) {
    const Json& other = *values[Below(values.size(), random)];
    if (other.is_string()) value = std::string(other.get_ref<const std::string&>());
  } else {
    value = MutatedText(value.get<std::string>());
  }
}

// Objects keep their members in a vector.
void MutateChildren(Json& value, Random& random) {
  if (value.empty()) {
    if (value.is_array()) value.push_back(Boundary(random));
    return;
  }
  const std::size_t at = Below(value.size(), random), other = Below(value.size(), random);
  auto* const members = value.is_object() ? &value.get_ref<Json::object_t&>() : nullptr;
  const auto member = [members](std::size_t i) { return members->begin() + static_cast<std::ptrdiff_t>(i); };
  switch (Below(6, random)) {
    case 0:
    case 1:
      if (members != nullptr) {
        members->erase(member(at));
      } else {
        value.erase(at);
      }
      break;
    case 2:
    case 3:
      if (members != nullptr) {
        const Json copy = member(at)->second;
        value[MutatedText(member(at)->first)] = copy;
      } else {
        value.push_back(Json(value[at]));
      }
      break;
    case 4:
      if (members != nullptr) {
        std::swap(member(at)->second, member(other)->second);
      } else {
        std::swap(value[at], value[other]);
      }
      break;
    default: value.clear();
  }
}

}  // namespace

std::size_t Below(std::size_t count, Random& random) { return static_cast<std::size_t>(random()) % count; }

std::optional<Json> ParseJson(std::string_view text) {
  if (IsJsonDeeperThan(text, kMaxJsonDepth)) return std::nullopt;
  Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) return std::nullopt;
  return json;
}

void MutateJson(Json& root, Random& random) {
  const std::vector<Json*> values = ValuesOf(root);
  if (values.size() > kMostValues) return;
  Json& value = *values[Below(values.size(), random)];
  const std::size_t how = Below(12, random);
  if (how == 0) {
    value = Boundary(random);
  } else if (how == 1) {
    const Json copy = *values[Below(values.size(), random)];  // maybe of what it becomes a part of
    value = copy;
  } else if (value.is_structured()) {
    MutateChildren(value, random);
  } else if (value.is_string()) {
    MutateString(value, values, random);
  } else {
    MutateNumber(value, random);
  }
}

void SpliceJson(Json& root, const Json& other, Random& random) {
  std::vector<std::pair<const std::string*, const Json*>> members;
  for (const Json* value : ValuesOf(other)) {
    if (!value->is_object()) continue;
    for (const auto& [key, child] : value->get_ref<const Json::object_t&>()) members.emplace_back(&key, &child);
  }
  if (members.empty() || members.size() > kMostValues) return;
  const auto& [key, part] = members[Below(members.size(), random)];
  std::vector<Json*> objects, same;
  for (Json* value : ValuesOf(root)) {
    if (!value->is_object()) continue;
    objects.push_back(value);
    if (value->contains(*key)) same.push_back(value);
  }
  if (objects.empty()) return;
  Json& place = *(same.empty() ? objects[Below(objects.size(), random)] : same[Below(same.size(), random)]);
  Json& value = place[*key];
  if (value.is_array() && part->is_array() && Below(2, random) == 0) {
    for (const Json& element : *part) value.push_back(element);
  } else {
    value = *part;
  }
}

std::string DumpJson(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

std::size_t MutateJsonInput(std::uint8_t* data, std::size_t size, std::size_t max_size, unsigned seed) {
  Random random(seed);
  std::optional<Json> json = ParseJson({reinterpret_cast<const char*>(data), size});
  if (!json || Below(16, random) == 0) return LLVMFuzzerMutate(data, size, max_size);
  for (std::size_t i = 0, count = 1 + Below(4, random); i < count; ++i) MutateJson(*json, random);
  const std::string text = DumpJson(*json);
  if (text.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::memcpy(data, text.data(), text.size());
  return text.size();
}

std::size_t CrossJsonInputs(std::string_view a, std::string_view b, std::uint8_t* out, std::size_t max_size,
                            unsigned seed) {
  Random random(seed);
  std::optional<Json> json = ParseJson(a);
  const std::optional<Json> other = ParseJson(b);
  if (!json || !other) return 0;
  SpliceJson(*json, *other, random);
  const std::string text = DumpJson(*json);
  if (text.size() > max_size) return 0;
  std::memcpy(out, text.data(), text.size());
  return text.size();
}

}  // namespace facet::fuzz
