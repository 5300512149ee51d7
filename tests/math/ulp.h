// Distance to an exact result in units in the last place.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace facet::testing {

// |result - exact| in units of the last place that T has at `exact`; infinity where one of them is NaN or infinite and
// the other neither is nor rounds to it.
template <class T, class Exact>
double UlpError(T result, Exact exact) {
  using Limits = std::numeric_limits<T>;
  if (std::isnan(exact) || std::isnan(result)) {
    return std::isnan(exact) && std::isnan(result) ? 0.0 : std::numeric_limits<double>::infinity();
  }
  // The first value that rounds to infinity.
  const Exact overflow = std::ldexp(Exact(2) - std::ldexp(Exact(1), -Limits::digits), Limits::max_exponent - 1);
  if (std::isinf(result) || std::fabs(exact) >= overflow) {
    if (result == static_cast<T>(exact)) return 0.0;
    // One unit beside the border of overflow is as good as one unit elsewhere.
    if (std::isinf(exact) || std::signbit(exact) != std::signbit(result)) {
      return std::numeric_limits<double>::infinity();
    }
    const Exact unit = std::ldexp(Exact(1), Limits::max_exponent - Limits::digits);
    const Exact bounded = std::isinf(result) ? std::copysign(overflow, exact) : Exact(result);
    return static_cast<double>(std::fabs(bounded - exact) / unit);
  }
  const int exponent = exact == 0 ? Limits::min_exponent - 1 : std::max(std::ilogb(exact), Limits::min_exponent - 1);
  return static_cast<double>(std::fabs(Exact(result) - exact) / std::ldexp(Exact(1), exponent - (Limits::digits - 1)));
}

}  // namespace facet::testing
