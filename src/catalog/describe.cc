// DescribeModels() of facet/catalog.h: the tables of parameters as text.
#include <cmath>

#include "facet/catalog.h"
#include "material/model_parameters.h"
#include "material/models/models.h"

namespace facet {
namespace {

template <class Value>
const char* TypeOf() {
  if constexpr (requires(Value v) { v.value; } && !std::is_same_v<Value, TangentSpaceNormal>) {
    return TypeOf<decltype(Value::value)>();
  } else if constexpr (std::is_same_v<Value, float>) {
    return "number";
  } else if constexpr (std::is_same_v<Value, glm::vec3>) {
    return "colour";
  } else if constexpr (std::is_same_v<Value, glm::vec4>) {
    return "colour with alpha";
  } else if constexpr (std::is_same_v<Value, bool>) {
    return "true or false";
  } else if constexpr (std::is_enum_v<Value>) {
    return "choice";
  } else {
    return "direction";
  }
}

template <class Value>
std::vector<float> Numbers(const Value& value) {
  if constexpr (requires { value.value; }) {
    return Numbers(value.value);
  } else if constexpr (requires { value.x; }) {
    std::vector<float> numbers;
    for (int c = 0; c < Value::length(); ++c) numbers.push_back(value[c]);
    return numbers;
  } else {
    return {static_cast<float>(value)};
  }
}

}  // namespace

std::vector<ModelDescription> DescribeModels() {
  std::vector<ModelDescription> models;
  for (const ModelInfo& info : kModels) {
    if (!HasParameters(info.model)) continue;
    ModelDescription& model = models.emplace_back();
    model.model = info.model;
    model.name = info.word;
    model.summary = info.summary;
    model.source = info.source;
    ForEachParameterOf(DefaultsOf(info.model), [&]<class Value>(const auto& row, const Value& value) {
      ParameterDescription& parameter = model.parameters.emplace_back();
      parameter.name = row.name;
      parameter.type = TypeOf<Value>();
      parameter.choices.assign(row.words.begin(), row.words.end());
      parameter.initial = Numbers(value);
      parameter.low = row.range.low, parameter.high = row.range.high;
      if (!std::isnan(row.range.exception)) parameter.other = row.range.exception;
      parameter.unit = row.unit;
      parameter.meaning = row.meaning;
      parameter.textured = kHasTexture<Value>;
    });
    if (info.model != ShadingModel::Enterprise) continue;
    for (const std::string_view name : kEnterprisePresets) {
      PresetDescription& preset = model.presets.emplace_back(PresetDescription{std::string(name), {}});
      ForEachStatedParameter(EnterprisePreset(name), [&](const auto& row, const auto& value) {
        preset.stated.emplace_back(row.name, Numbers(value));
      });
    }
  }
  return models;
}

}  // namespace facet
