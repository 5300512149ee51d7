// Typed access to JSON members that a hostile file wrote: each call either returns what it promises or throws
// Error(InvalidInput) with the place. A member that is absent is no error unless the name says Require.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "gltf/place.h"

namespace facet::gltf {

using Json = nlohmann::json;

// Parses; refuses nesting deeper than kMaxDepth before any parser recurses into it. Numbers without a fraction become
// integers ("2.0" is the integer 2 in glTF); members named "extras" are removed.
inline constexpr int kMaxDepth = 128;
Json ParseJson(std::string_view text, const Place& place);

const Json* Find(const Json& object, const char* key);  // null when absent

const Json* ObjectAt(const Json& object, const char* key, const Place& place);  // null when absent
const Json* ArrayAt(const Json& object, const char* key, const Place& place);   // null when absent
std::optional<double> NumberAt(const Json& object, const char* key, const Place& place);
std::optional<std::size_t> SizeAt(const Json& object, const char* key, const Place& place);  // below 2^53
std::optional<std::string> StringAt(const Json& object, const char* key, const Place& place);
std::optional<bool> BoolAt(const Json& object, const char* key, const Place& place);
std::size_t RequireSize(const Json& object, const char* key, const Place& place);
std::string RequireString(const Json& object, const char* key, const Place& place);
std::string NameOf(const Json& object, const Place& place);  // "name", or empty

// An index into a list of `count` things, called `list` in messages; -1 when absent.
int IndexAt(const Json& object, const char* key, std::size_t count, const char* list, const Place& place);
int RequireIndex(const Json& object, const char* key, std::size_t count, const char* list, const Place& place);
std::vector<int> IndicesAt(const Json& object, const char* key, std::size_t count, const char* list,
                           const Place& place);
int AsIndex(const Json& value, std::size_t count, const char* list, const Place& place);

// Exactly `size` numbers, or any number of them when `size` is 0; empty when absent.
std::vector<double> NumbersAt(const Json& object, const char* key, std::size_t size, const Place& place);

// One of the numbers listed; nothing when absent.
std::optional<int> OneOfAt(const Json& object, const char* key, std::initializer_list<int> choices, const Place& place);

void RequireObject(const Json& value, const Place& place);
void RequireMember(const Json& object, const char* key, const Place& place);

// object.extensions.NAME, which must be an object; null when absent.
const Json* ExtensionOf(const Json& object, const char* name, const Place& place);

}  // namespace facet::gltf
