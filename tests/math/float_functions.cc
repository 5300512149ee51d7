#include "math/float_functions.h"

#include "facet/shader/elementary-inl.h"

namespace facet::testing {
namespace hn = ::facet::HWY_NAMESPACE;

std::vector<FloatFunction> FloatFunctions() {
  return {
      {"Exp2", [](float x) { return hn::Exp2(x); }, [](double x) { return std::exp2(x); }, 1.1},
      {"Exp", [](float x) { return hn::Exp(x); }, [](double x) { return std::exp(x); }, 1.0},
      {"Log2", [](float x) { return hn::Log2(x); }, [](double x) { return std::log2(x); }, 1.1},
      {"Log", [](float x) { return hn::Log(x); }, [](double x) { return std::log(x); }, 1.0},
      {"Cbrt", [](float x) { return hn::Cbrt(x); }, [](double x) { return std::cbrt(x); }, 1.0},
      {"Sin", [](float x) { return hn::Sin(x); }, [](double x) { return std::sin(x); }, 1.0, 0x1p17f},
      {"Cos", [](float x) { return hn::Cos(x); }, [](double x) { return std::cos(x); }, 1.0, 0x1p17f},
      {"Asin", [](float x) { return hn::Asin(x); }, [](double x) { return std::asin(x); }, 1.0},
      {"Acos", [](float x) { return hn::Acos(x); }, [](double x) { return std::acos(x); }, 1.5},
  };
}

float FloatPow(float x, float y) { return hn::Pow(x, y); }
float FloatAtan2(float y, float x) { return hn::Atan2(y, x); }

}  // namespace facet::testing
