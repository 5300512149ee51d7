// Typed access to members of JSON from unknown sources. An absent member is an error only for functions named Require.
// If a member has the wrong type or value,
// - XAt and RequireX throw Error(InvalidInput) with its place;
// - LenientX gives a warning and treats it as absent.
// The former are used for positions and transforms, the latter for appearance.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "gltf/json_text.h"

namespace facet::gltf {

const Json* Find(const Json& object, const char* key);  // null when absent

const Json* ObjectAt(const Json& object, const char* key, const Place& place);  // null when absent
const Json* ArrayAt(const Json& object, const char* key, const Place& place);   // null when absent
std::optional<double> NumberAt(const Json& object, const char* key, const Place& place);
std::optional<std::size_t> SizeAt(const Json& object, const char* key, const Place& place);  // below 2^53
std::optional<std::string> StringAt(const Json& object, const char* key, const Place& place);
std::optional<bool> BoolAt(const Json& object, const char* key, const Place& place);
std::size_t RequireSize(const Json& object, const char* key, const Place& place);
std::string RequireString(const Json& object, const char* key, const Place& place);
const Json& RequireArray(const Json& object, const char* key, const Place& place);
const Json& RequireObject(const Json& object, const char* key, const Place& place);
void CheckObject(const Json& value, const Place& place);

// True for null and -1, which exporters write for an index that there is not; with a warning.
bool IsAbsent(const Json& index, const Place& place);

// An index into a list of `count` things, called `list` in messages; -1 when absent, or -1 in the file (a warning).
int IndexAt(const Json& object, const char* key, std::size_t count, const char* list, const Place& place);
int RequireIndex(const Json& object, const char* key, std::size_t count, const char* list, const Place& place);
int AsIndex(const Json& value, std::size_t count, const char* list, const Place& place);

// `size` numbers; empty when absent. Too many are cut off with a warning; too few are an error, unless there are at
// least `least`: then a warning.
std::vector<double> NumbersAt(const Json& object, const char* key, std::size_t size, const Place& place,
                              std::size_t least = 0);

// One of the numbers listed; nothing when absent.
std::optional<int> OneOfAt(const Json& object, const char* key, std::initializer_list<int> choices, const Place& place);

const Json* LenientObject(const Json& object, const char* key, const Place& place);
const Json* LenientArray(const Json& object, const char* key, const Place& place);
std::optional<double> LenientNumber(const Json& object, const char* key, const Place& place);
std::optional<std::size_t> LenientSize(const Json& object, const char* key, const Place& place);
std::optional<std::string> LenientString(const Json& object, const char* key, const Place& place);
std::optional<bool> LenientBool(const Json& object, const char* key, const Place& place);
int LenientIndex(const Json& object, const char* key, std::size_t count, const char* list, const Place& place);
std::vector<double> LenientNumbers(const Json& object, const char* key, std::size_t size, const Place& place,
                                   std::size_t least = 0);
std::vector<float> LenientFloats(const Json& object, const char* key, const Place& place);  // any number of them
std::optional<int> LenientOneOf(const Json& object, const char* key, std::initializer_list<int> choices,
                                const Place& place);
std::string NameOf(const Json& object, const Place& place);  // "name", or empty

// object.extensions.NAME, an object; null when absent. Lenient.
const Json* ExtensionOf(const Json& object, const char* name, const Place& place);

// As an object to read: what is none is an empty one, with a warning.
const Json& LenientElement(const Json& element, const Place& place);

}  // namespace facet::gltf
