// Structural similarity.
#pragma once

#include <cstdint>
#include <vector>

namespace facet {

// One value per pixel, top row first, in [0, 1].
struct LumaPlane {
  int width = 0, height = 0;
  std::vector<double> values;
};

// The mean of SSIM over the windows that lie within the images; see ImageDifference::ssim. `broken`, which may be
// empty, is 1 for each pixel whose windows count as 0.
double MeanSsim(const LumaPlane& a, const LumaPlane& b, const std::vector<std::uint8_t>& broken);

}  // namespace facet
