// The float functions of elementary-inl.h as plain function pointers, beside exact ones from the C library in double
// (whose own error, 2^-29 of a float's unit, does not show).
#pragma once

#include <cmath>
#include <vector>

namespace facet::testing {

struct FloatFunction {
  const char* name;
  float (*function)(float);
  double (*exact)(double);
  double bound_ulp;          // as documented
  float domain = HUGE_VALF;  // |x| up to this
};

std::vector<FloatFunction> FloatFunctions();
float FloatPow(float x, float y);
float FloatAtan2(float y, float x);

}  // namespace facet::testing
