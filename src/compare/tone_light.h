// Conversions of light for display, as FLIP and SSIM need them.
#pragma once

#include <array>
#include <cmath>

namespace facet {

// A pixel of straight RGBA composited over grey, in double. A pixel that is not finite counts as black.
template <class T>
std::array<double, 3> OverBackdrop(const T* rgba, double backdrop) {
  for (int channel = 0; channel < 4; ++channel) {
    if (!std::isfinite(rgba[channel])) return {0.0, 0.0, 0.0};
  }
  const double alpha = rgba[3], behind = (1.0 - alpha) * backdrop;
  return {rgba[0] * alpha + behind, rgba[1] * alpha + behind, rgba[2] * alpha + behind};
}

// Luminance of linear Rec. 709 light, or luma of encoded colours.
inline double Rec709Luma(const std::array<double, 3>& rgb) {
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

// K. Narkowicz, 2015, "ACES Filmic Tone Mapping Curve", with its built-in exposure cancelled by the factor 0.6, as
// HDR-FLIP uses it: (a x^2 + b x) / (c x^2 + d x + e).
struct FlipToneCurveTerms {
  static constexpr double a = 0.36 * 2.51, b = 0.6 * 0.03, c = 0.36 * 2.43, d = 0.6 * 0.59, e = 0.14;
};
inline double FlipToneCurve(double x) {
  using T = FlipToneCurveTerms;
  return (x * (T::a * x + T::b)) / (x * (T::c * x + T::d) + T::e);
}

}  // namespace facet
