// The clock by which time budgets are measured.
#pragma once

#include <chrono>
#include <functional>

namespace facet {

// Returns seconds since some fixed time, never decreasing; thread-safe. Tests use clocks of their own, so that their
// results do not depend on how busy the machine is.
using Clock = std::function<double()>;

// The machine's monotonic clock.
inline double SteadySeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace facet
