#include "math/float_functions.h"

#include "facet/shader/elementary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet::HWY_NAMESPACE {
namespace {
float Exp2OfFloat(float x) { return Exp2(x); }
float ExpOfFloat(float x) { return Exp(x); }
float Log2OfFloat(float x) { return Log2(x); }
float LogOfFloat(float x) { return Log(x); }
float CbrtOfFloat(float x) { return Cbrt(x); }
float SinOfFloat(float x) { return Sin(x); }
float CosOfFloat(float x) { return Cos(x); }
float AsinOfFloat(float x) { return Asin(x); }
float AcosOfFloat(float x) { return Acos(x); }
}  // namespace
}  // namespace facet::HWY_NAMESPACE

namespace facet::testing {
namespace hn = ::facet::HWY_NAMESPACE;

std::vector<FloatFunction> FloatFunctions() {
  return {
      {"Exp2", hn::Exp2OfFloat, [](double x) { return std::exp2(x); }, 1.1},
      {"Exp", hn::ExpOfFloat, [](double x) { return std::exp(x); }, 1.0},
      {"Log2", hn::Log2OfFloat, [](double x) { return std::log2(x); }, 1.1},
      {"Log", hn::LogOfFloat, [](double x) { return std::log(x); }, 1.0},
      {"Cbrt", hn::CbrtOfFloat, [](double x) { return std::cbrt(x); }, 1.0},
      {"Sin", hn::SinOfFloat, [](double x) { return std::sin(x); }, 1.0, 0x1p17f},
      {"Cos", hn::CosOfFloat, [](double x) { return std::cos(x); }, 1.0, 0x1p17f},
      {"Asin", hn::AsinOfFloat, [](double x) { return std::asin(x); }, 1.0},
      {"Acos", hn::AcosOfFloat, [](double x) { return std::acos(x); }, 1.5},
  };
}

float FloatPow(float x, float y) { return hn::Pow(x, y); }
float FloatAtan2(float y, float x) { return hn::Atan2(y, x); }

}  // namespace facet::testing
HWY_AFTER_NAMESPACE();
