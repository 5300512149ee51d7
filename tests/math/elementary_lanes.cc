#include "math/elementary_lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "math/elementary_lanes.cc"
#include "hwy/foreach_target.h"

#include "facet/shader/dispatch.h"
#include "facet/shader/elementary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

template <class T>
FACET_INLINE T ApplyFunction(int function, T a, T b) {
  switch (function) {
    case 0: return Exp2(a);
    case 1: return Exp(a);
    case 2: return Log2(a);
    case 3: return Log(a);
    case 4: return Cbrt(a);
    case 5: return Sin(a);
    case 6: return Cos(a);
    case 7: return Asin(a);
    case 8: return Acos(a);
    case 9: return Pow(a, b);
    default: return Atan2(a, b);
  }
}

void ApplyLanes(int function, const float* a, const float* b, float* out, std::size_t count) {
  for (std::size_t i = 0; i < count; i += LaneCount()) {
    Store(ApplyFunction(function, LoadFloat(a + i), LoadFloat(b + i)), out + i);
  }
}

void ApplyFloats(int function, const float* a, const float* b, float* out, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) out[i] = ApplyFunction(function, a[i], b[i]);
}

// Shaders run in double too.
[[maybe_unused]] double InstantiateDouble(double a, double b) {
  double sum = 0.0;
  for (int function = 0; function < 11; ++function) sum += ApplyFunction(function, a, b);
  return sum;
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facet {
FACET_EXPORT(ApplyLanes);
FACET_EXPORT(ApplyFloats);
}  // namespace facet

namespace facet::testing {

const std::array<const char*, kLaneFunctionCount> kLaneFunctionNames = {"Exp2", "Exp",  "Log2", "Log", "Cbrt", "Sin",
                                                                        "Cos",  "Asin", "Acos", "Pow", "Atan2"};

void ApplyOnLanes(int function, const float* a, const float* b, float* out, std::size_t count) {
  ::facet::ApplyLanesForTarget(ActiveTarget())(function, a, b, out, count);
}
void ApplyOnFloats(int function, const float* a, const float* b, float* out, std::size_t count) {
  ::facet::ApplyFloatsForTarget(ActiveTarget())(function, a, b, out, count);
}

}  // namespace facet::testing
#endif
