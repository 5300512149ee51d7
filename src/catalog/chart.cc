// ChartModel() of facet/catalog.h.
#include <algorithm>
#include <cmath>
#include <memory>

#include "base/number_text.h"
#include "catalog/sphere_sheet.h"
#include "facet/catalog.h"
#include "facet/error.h"
#include "material/model_parameters.h"
#include "material/models/models.h"
#include "material_file/material_file.h"

namespace facet {
namespace {

constexpr int kSteps = 6;
constexpr std::size_t kMostCells = 8;  // of a row; what is more goes on in the next

// A step of a parameter's way from one end of its range to the other.
struct Step {
  std::string label;
  ModelParameters parameters;
};

// From the lowest value to the highest; where there is no highest, in doubling steps.
std::vector<float> Values(const RowOptions& row) {
  const ParameterRange& range = row.range;
  const float unit = std::string_view(row.unit) == "nm" ? 200.0f : 1.0f;  // films show from half a wavelength on
  std::vector<float> values;
  if (!std::isnan(range.exception) && std::isfinite(range.exception)) values.push_back(range.exception);
  const float low = std::isfinite(range.low) ? range.low : -1.0f;
  for (int i = 0; i < kSteps; ++i) {
    const float share = float(i) / (kSteps - 1);
    values.push_back(std::isfinite(range.high) || !std::isfinite(range.low)
                         ? low + share * ((std::isfinite(range.high) ? range.high : 1.0f) - low)
                         : low + (i == 0 ? 0.0f : unit * std::ldexp(0.25f, i - 1)));
  }
  return values;
}

class Stepper {
 public:
  explicit Stepper(ModelParameters base) : base_(std::move(base)) {}

  // All steps of the parameter with this index among the model's rows.
  std::vector<Step> StepsOf(std::size_t row) {
    std::visit(
        [&](const auto& block) {
          std::size_t r = 0;
          ForEachParameterOf(block, [&](const auto& parameter, const auto& value) {
            if (r++ == row) Add(parameter, value);
          });
        },
        base_);
    return std::move(steps_);
  }

 private:
  template <class Row, class Value>
  void Add(const Row& row, const Value& value) {
    if constexpr (requires { value.texture; }) {
      const auto whole = [&](const auto& bare) {
        Value changed = value;
        changed.value = bare;
        return changed;
      };
      AddValues(row, value.value, whole);
    } else {
      AddValues(row, value, [](const Value& bare) { return bare; });
    }
  }

  template <class Row, class Value, class Whole>
  void AddValues(const Row& row, const Value& initial, const Whole& whole) {
    const auto add = [&](const std::string& label, const Value& bare) { Set(row, label, whole(bare)); };
    if constexpr (std::is_enum_v<Value>) {
      for (std::size_t i = 0; i < row.words.size(); ++i) add(row.words[i], static_cast<Value>(i));
    } else if constexpr (std::is_same_v<Value, bool>) {
      add("false", false), add("true", true);
    } else {
      for (const float number : Values(row)) {
        if constexpr (std::is_same_v<Value, float>) {
          add(ShortNumber(double{number}, 3), number);
        } else if (IsDirection(initial)) {
          add("x " + ShortNumber(double{number}, 3), WithX(initial, number));
        } else {
          add(ShortNumber(double{number}, 3), Tinted(initial, number, row.range));
        }
      }
    }
  }

  static bool IsDirection(const glm::vec3& value) { return value == glm::vec3(0.0f, 0.0f, 1.0f); }
  static bool IsDirection(const glm::vec4&) { return false; }
  static glm::vec3 WithX(const glm::vec3& direction, float x) { return {x, direction.y, direction.z}; }
  static glm::vec4 WithX(const glm::vec4& direction, float) { return direction; }
  // A reddish colour whose brightest channel is `most`.
  static glm::vec3 Tinted(const glm::vec3&, float most, ParameterRange range) {
    if (most == range.exception) return glm::vec3(most);
    if (std::isinf(range.low)) return {most, 1.0f - std::fabs(most), 0.0f};  // a vector, and no colour
    return {most, std::max(most * 0.5f, range.low), std::max(most * 0.2f, range.low)};
  }
  static glm::vec4 Tinted(const glm::vec4& initial, float most, ParameterRange range) {
    return {Tinted(glm::vec3(), most, range), initial.a};
  }

  template <class Row, class Value>
  void Set(const Row& row, const std::string& label, const Value& value) {
    Step& step = steps_.emplace_back(Step{label, base_});
    std::visit(
        [&]<class Block>(Block& block) {
          if constexpr (requires { block.*row.member; }) block.*row.member = value;
        },
        step.parameters);
  }

  ModelParameters base_;
  std::vector<Step> steps_;
};

}  // namespace

Image ChartModel(ShadingModel model) {
  if (!HasParameters(model)) {
    throw Error(ErrorCode::InvalidUsage, "glTF's models have no chart", InfoOf(model).word,
                "name a model with parameters of its own");
  }
  std::vector<SheetRow> rows;
  std::size_t index = 0;
  ForEachParameterOf(DefaultsOf(model), [&](const auto& row, const auto&) {
    ModelParameters base = DefaultsOf(model);
    StateParameters(row.chart, row.name, base);
    rows.emplace_back().label = row.name;
    if (*row.unit != '\0') rows.back().label += std::string("\n(") + row.unit + ")";
    for (Step& step : Stepper(base).StepsOf(index++)) {
      if (rows.back().cells.size() == kMostCells) rows.emplace_back();
      Material material;
      material.model = model;
      if (BaseColorOf(step.parameters).a < 1.0f || row.is_coverage) material.alpha_mode = AlphaMode::Blend;
      material.alpha_mode = AlphaModeOf(step.parameters).value_or(material.alpha_mode);
      material.parameters = std::make_shared<const ModelParameters>(std::move(step.parameters));
      rows.back().cells.push_back({material, step.label});
    }
  });
  return DrawSheet(rows).picture;
}

}  // namespace facet
