// Changes JSON as a tree: what comes out is JSON again, so that the code behind the parser is reached.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <string>
#include <string_view>

namespace facet::fuzz {

using Json = nlohmann::ordered_json;
using Random = std::minstd_rand;

// A number below `count`, which is not 0.
std::size_t Below(std::size_t count, Random& random);

// Nothing where the text is no JSON, or is nested too deeply to walk through.
std::optional<Json> ParseJson(std::string_view text);

// Changes one value: a number to one at a limit, a text by a few bytes; removes, doubles, swaps or clears members and
// elements; puts a copy of one part in another's place.
void MutateJson(Json& root, Random& random);

// Puts a part of another text into this one: in place of one of the same name, where there is one.
void SpliceJson(Json& root, const Json& other, Random& random);

// Any text comes out as UTF-8.
std::string DumpJson(const Json& json);

// As LLVMFuzzerCustomMutator and LLVMFuzzerCustomCrossOver for an input that is JSON and nothing else.
std::size_t MutateJsonInput(std::uint8_t* data, std::size_t size, std::size_t max_size, unsigned seed);
std::size_t CrossJsonInputs(std::string_view a, std::string_view b, std::uint8_t* out, std::size_t max_size,
                            unsigned seed);

}  // namespace facet::fuzz
