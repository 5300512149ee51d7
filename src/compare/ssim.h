// Structural similarity.
#pragma once

#include <cstdint>
#include <vector>

namespace facet {

// One number a pixel, top row first, in [0, 1].
struct LumaPlane {
  int width = 0, height = 0;
  std::vector<double> values;
};

// The mean of SSIM over the windows that lie within the pictures; see ImageDifference::ssim. `broken`, which may be
// empty, is 1 for each pixel around which windows count 0.
double MeanSsim(const LumaPlane& a, const LumaPlane& b, const std::vector<std::uint8_t>& broken);

}  // namespace facet
