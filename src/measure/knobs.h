// The approximations that a report turns, and what they can be turned to.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "facet/report.h"

namespace facet {

struct Knob {
  std::string option;
  std::vector<std::string> values;  // from cheap to exact
  std::size_t used = 0;             // index of the value that was asked for

  std::size_t Last() const { return values.size() - 1; }
};

// Every approximation, with the value in use put among those that are tried. `settings`: every option spelled out.
// `largest_environment`: texels of the environment beyond which there is no more.
std::vector<Knob> AllKnobs(SettingsText settings, int largest_environment);

// What differs from the settings asked for where each of `knobs` has the value that `choose` gives the index of.
template <class Choose>
SettingsText Turned(const std::vector<Knob>& knobs, const Choose& choose) {
  SettingsText changed;
  for (const Knob& knob : knobs) {
    const std::size_t value = choose(knob);
    if (value != knob.used) changed[knob.option] = knob.values[value];
  }
  return changed;
}

// One step from `changed`, in each of `knobs` and direction.
std::vector<SettingsText> NeighboursOf(const SettingsText& changed, const std::vector<Knob>& knobs);

// "max-anisotropy=1 samples=2"; "the settings asked for" where nothing is changed.
std::string SettingsWords(const SettingsText& changed);

}  // namespace facet
