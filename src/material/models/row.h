// A row in the table of parameters of a model that is not glTF's. Each such model has a table in a file of its own
// (models/*_parameters.h): a row for each member of its parameter block.
#pragma once

#include <limits>
#include <span>
#include <type_traits>

#include "facet/models.h"
#include "facet/settings.h"
#include "material/features.h"
#include "material/parameters.h"

namespace facet {

struct RowOptions {
  ParameterRange range = {0.0f, 1.0f};      // of each number
  const char* unit = "";                    // "": none
  std::span<const char* const> words = {};  // of an enumeration, in the order of its values
  bool is_data = false;                     // the texture of a colour is linear
  // What charts of this parameter state besides, so that it shows: a JSON object, as in material files.
  const char* chart = "{}";
  bool is_coverage = false;     // a number that takes the place of the base colour's alpha
  Feature feature = Feature{};  // that disables the parameter: it has its default then
};

// A parameter. Value: bool, an enumeration, float, glm::vec3, Textured<...> or TangentSpaceNormal.
template <class Block, class Value>
struct ModelParameter : RowOptions {
  const char* name;  // as the model's own documentation writes it
  Value Block::*member;
  const char* meaning;  // a phrase
};

template <class Block, class Value>
constexpr ModelParameter<Block, Value> Row(const char* name, Value Block::*member, const char* meaning,
                                           RowOptions options = {}) {
  return {options, name, member, meaning};
}

inline constexpr ParameterRange kAnyNumber{-std::numeric_limits<float>::infinity(),
                                           std::numeric_limits<float>::infinity()};
inline constexpr ParameterRange kNotNegative{0.0f, std::numeric_limits<float>::infinity()};

template <class Value>
inline constexpr bool kHasTexture = requires(Value value) {
  value.texture;
};

}  // namespace facet
