// What budgets go by.
#pragma once

#include <chrono>
#include <functional>

namespace facet {

// Seconds since some moment, never fewer than before; any thread may ask. Tests have clocks of their own, so that what
// they find does not depend on how busy the machine is.
using Clock = std::function<double()>;

// The machine's.
inline double SteadySeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace facet
