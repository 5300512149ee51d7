#include <algorithm>
#include <cmath>
#include <cstddef>

#include "compare/flip.h"
#include "compare/tone_light.h"
#include "math/elementary.h"

namespace facet {
namespace {

// The light to which the tone curve gives 85 % of white.
double LightNearWhite() {
  using T = FlipToneCurveTerms;
  constexpr double kShare = 0.85;
  const double a = T::a - kShare * T::c, half_b = 0.5 * (T::b - kShare * T::d), c = -kShare * T::e;
  return (-half_b + std::sqrt(half_b * half_b - a * c)) / a;
}

double UpperMedian(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

std::vector<double> FlipExposures(const Image& reference, float backdrop) {
  std::vector<double> luminances(reference.PixelCount());
  const float* pixel = reference.As<float>();
  for (double& luminance : luminances) {
    luminance = Rec709Luma(OverBackdrop(pixel, backdrop));
    pixel += 4;
  }
  double median = UpperMedian(luminances);
  if (!(median > 0.0)) {
    std::erase_if(luminances, [](double luminance) { return !(luminance > 0.0); });
    if (luminances.empty()) return {0.0};
    median = UpperMedian(luminances);
  }
  const double near_white = LightNearWhite();
  const double start = Log2(near_white / *std::max_element(luminances.begin(), luminances.end()));
  const double stop = Log2(near_white / median);
  if (!(start < stop)) return {start};
  const int count = std::max(2, static_cast<int>(std::ceil(stop - start)));
  std::vector<double> exposures;
  for (int i = 0; i < count; ++i) exposures.push_back(start + i * (stop - start) / (count - 1));
  return exposures;
}

}  // namespace facet
