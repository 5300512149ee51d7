// The approximations that a report varies, and their values.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "facet/report.h"

namespace facet {

struct Knob {
  std::string option;
  std::vector<std::string> values;  // from cheap to exact
  std::size_t used = 0;             // index of the requested value

  std::size_t Last() const { return values.size() - 1; }
};

// All approximations, with the value in use among those to try. `settings`: every option spelled out.
// `largest_environment`: the size of the environment's map, in texels, beyond which it does not become sharper.
std::vector<Knob> AllKnobs(SettingsText settings, int largest_environment);

// The differences from the requested settings if each of `knobs` has the value whose index `choose` returns.
template <class Choose>
SettingsText Turned(const std::vector<Knob>& knobs, const Choose& choose) {
  SettingsText changed;
  for (const Knob& knob : knobs) {
    const std::size_t value = choose(knob);
    if (value != knob.used) changed[knob.option] = knob.values[value];
  }
  return changed;
}

// The settings one step away from `changed`, for each of `knobs` in both directions.
std::vector<SettingsText> NeighboursOf(const SettingsText& changed, const std::vector<Knob>& knobs);

// "max-anisotropy=1 samples=2"; "the settings asked for" where nothing is changed.
std::string SettingsWords(const SettingsText& changed);

}  // namespace facet
