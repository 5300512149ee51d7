#include "cli/models_command.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/number_text.h"
#include "base/printable.h"
#include "cli/console.h"
#include "facet/catalog.h"
#include "facet/error.h"

namespace facet::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string RangeOf(const ParameterDescription& p) {
  if (p.type == "choice") return Joined(p.choices, " | ");
  if (p.type == "true or false" || p.type == "direction") return "";
  if (std::isinf(p.high) && std::isinf(p.low)) return "";
  const std::string low = ShortNumber(double{p.low});
  std::string range = std::isinf(p.high) ? low + " or more" : low + " to " + ShortNumber(double{p.high});
  if (p.other) range += ", or " + ShortNumber(double{*p.other});
  return range;
}

// Infinity, which JSON does not have, is null.
Json NumberJson(float value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

// A value in words. `numbers`: as ParameterDescription::initial.
std::string ValueText(const ParameterDescription& p, const std::vector<float>& numbers) {
  if (p.type == "choice") return p.choices.at(static_cast<std::size_t>(numbers[0]));
  if (p.type == "true or false") return numbers[0] != 0.0f ? "true" : "false";
  std::vector<std::string> words;
  for (const float number : numbers) words.push_back(ShortNumber(double{number}));
  const bool all_same = std::ranges::all_of(words, [&](const std::string& n) { return n == words[0]; });
  return all_same && p.type == "colour" ? words[0] : Joined(words, " ");
}

// The same as in a material file.
Json ValueJson(const ParameterDescription& p, const std::vector<float>& numbers) {
  if (p.type == "choice") return ValueText(p, numbers);
  if (p.type == "true or false") return numbers[0] != 0.0f;
  if (numbers.size() == 1) return NumberJson(numbers[0]);
  Json list = Json::array();
  for (const float value : numbers) list.push_back(NumberJson(value));
  return list;
}

const ParameterDescription& ParameterNamed(const ModelDescription& model, const std::string& name) {
  return *std::ranges::find(model.parameters, name, &ParameterDescription::name);
}

std::string TextOf(const ModelDescription& model) {
  std::string text = model.name + ": " + model.summary + "\n" + model.source + ".\n\n";
  for (const ParameterDescription& p : model.parameters) {
    std::vector<std::string> facts = {p.type};
    if (const std::string range = RangeOf(p); !range.empty()) facts.push_back(range);
    if (!p.unit.empty()) facts.push_back(p.unit);
    facts.push_back("default " + ValueText(p, p.initial));
    if (p.textured) facts.emplace_back("textured");
    text += "  " + p.name + "\n      " + p.meaning + "\n      " + Joined(facts, "; ") + "\n";
  }
  if (!model.presets.empty()) text += "\nPresets:\n";
  for (const PresetDescription& preset : model.presets) {
    std::vector<std::string> facts;
    for (const auto& [name, numbers] : preset.stated) {
      facts.push_back(name + " " + ValueText(ParameterNamed(model, name), numbers));
    }
    text += "  " + preset.name + "\n      " + (facts.empty() ? "the defaults" : Joined(facts, "; ")) + "\n";
  }
  return text;
}

Json JsonOf(const ModelDescription& model) {
  Json parameters = Json::array();
  for (const ParameterDescription& p : model.parameters) {
    Json json = {
        {"name", p.name}, {"type", p.type}, {"meaning", p.meaning}, {"unit", p.unit}, {"textured", p.textured}};
    if (p.type == "choice") json["choices"] = p.choices;
    json["low"] = NumberJson(p.low), json["high"] = NumberJson(p.high);
    if (p.other) json["or"] = NumberJson(*p.other);
    json["default"] = ValueJson(p, p.initial);
    parameters.push_back(std::move(json));
  }
  Json presets = Json::object();
  for (const PresetDescription& preset : model.presets) {
    Json& stated = presets[preset.name] = Json::object();
    for (const auto& [name, numbers] : preset.stated) stated[name] = ValueJson(ParameterNamed(model, name), numbers);
  }
  return {{"name", model.name},
          {"summary", model.summary},
          {"source", model.source},
          {"parameters", parameters},
          {"presets", presets}};
}

Json JsonOf(const ModelComparison& comparison) {
  Json rows = Json::array();
  for (std::size_t r = 0; r < comparison.materials.size(); ++r) {
    Json row = {{"material", comparison.materials[r]}, {"flip", Json::object()}};
    for (std::size_t c = 1; c < comparison.models.size(); ++c)
      row["flip"][comparison.models[c]] = comparison.flip[r][c];
    rows.push_back(std::move(row));
  }
  return {{"against", comparison.models[0]}, {"materials", rows}};
}

std::string TableOf(const ModelComparison& comparison) {
  std::string text = "Mean FLIP against " + comparison.models[0] + ":\n\n";
  const auto padded = [](std::string cell, std::size_t width) {
    return cell.append(width - std::min(width, cell.size()), ' ');
  };
  text += padded("", 30);
  for (std::size_t c = 1; c < comparison.models.size(); ++c) text += padded(comparison.models[c], 12);
  for (std::size_t r = 0; r < comparison.materials.size(); ++r) {
    text += '\n';
    text += padded(comparison.materials[r], 30);
    for (std::size_t c = 1; c < comparison.models.size(); ++c)
      text += padded(ShortNumber(comparison.flip[r][c], 3), 12);
  }
  return text + "\n";
}

}  // namespace

void RunModels(const ModelsOptions& options) {
  if (options.schema) return PrintOutput(MaterialFileSchema());
  const std::vector<ModelDescription> models = DescribeModels();
  std::vector<ModelDescription> chosen;
  std::vector<std::string> names;
  for (const ModelDescription& model : models) {
    names.push_back(model.name);
    if (options.name.empty() || options.name == model.name) chosen.push_back(model);
  }
  if (chosen.empty()) {
    throw Error(ErrorCode::InvalidUsage, "there is no model " + Quoted(options.name), {},
                "use one of " + Joined(names));
  }
  if (options.chart) {
    if (options.name.empty())
      throw Error(ErrorCode::InvalidUsage, "a chart is of one model", "--chart",
                  "name it: facet models filament --chart OUT.png");
    WriteImage(*options.chart, ChartModel(chosen[0].model));
  } else if (options.compare) {
    const ModelComparison comparison = CompareModels();
    WriteImage(*options.compare, comparison.picture);
    PrintOutput(options.json ? JsonOf(comparison).dump(2) + "\n" : TableOf(comparison));
  } else if (options.json) {
    Json json = Json::array();
    for (const ModelDescription& model : chosen) json.push_back(JsonOf(model));
    PrintOutput(json.dump(2) + "\n");
  } else if (!options.name.empty()) {
    PrintOutput(TextOf(chosen[0]));
  } else {
    std::string text;
    for (const ModelDescription& model : models) {
      text += model.name + "  (" + std::to_string(model.parameters.size()) + " parameters)\n  " + model.summary +
              "\n  " + model.source + ".\n";
    }
    PrintOutput(text);
  }
}

}  // namespace facet::cli
