#include "measure/knobs.h"

#include <algorithm>
#include <sstream>
#include <string_view>
#include <utility>

#include "settings/render_request.h"

namespace facet {
namespace {

std::vector<std::string> Words(std::string_view text) {
  std::istringstream stream{std::string(text)};
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

}  // namespace

std::vector<Knob> AllKnobs(SettingsText settings, int largest_environment) {
  std::string& size = settings.at("environment-size");
  size = std::to_string(std::min(std::stoi(size), largest_environment));
  std::vector<Knob> knobs;
  for (const RequestOption& option : RequestOptions()) {
    if (option.sweep.empty()) continue;
    Knob knob{std::string(option.name), Words(option.sweep), 0};
    const std::string& used = settings.at(knob.option);
    auto place = std::find(knob.values.begin(), knob.values.end(), used);
    if (place == knob.values.end()) {  // only numeric options have values besides those to try
      place = std::find_if(knob.values.begin(), knob.values.end(),
                           [&](const std::string& value) { return std::stoi(value) > std::stoi(used); });
      place = knob.values.insert(place, used);
    }
    knob.used = std::size_t(place - knob.values.begin());
    if (knob.option == "environment-size") {  // larger sizes make no difference
      std::erase_if(knob.values, [&](const std::string& value) { return std::stoi(value) > largest_environment; });
    }
    knobs.push_back(std::move(knob));
  }
  return knobs;
}

std::vector<SettingsText> NeighboursOf(const SettingsText& changed, const std::vector<Knob>& knobs) {
  std::vector<SettingsText> neighbours;
  for (const Knob& knob : knobs) {
    const auto found = changed.find(knob.option);
    const std::string& value = found != changed.end() ? found->second : knob.values[knob.used];
    const auto place = std::size_t(std::find(knob.values.begin(), knob.values.end(), value) - knob.values.begin());
    for (const std::size_t step : {place - 1, place + 1}) {
      if (step >= knob.values.size()) continue;  // also true for place - 1 below 0, which wraps around
      SettingsText neighbour = changed;
      if (step == knob.used) {
        neighbour.erase(knob.option);
      } else {
        neighbour[knob.option] = knob.values[step];
      }
      neighbours.push_back(std::move(neighbour));
    }
  }
  return neighbours;
}

std::string SettingsWords(const SettingsText& changed) {
  if (changed.empty()) return "the settings asked for";
  std::string words;
  for (const auto& [option, value] : changed) words += (words.empty() ? "" : " ") + option + "=" + value;
  return words;
}

}  // namespace facet
