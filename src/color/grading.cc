#include "color/grading.h"

#include <glm/glm.hpp>

namespace facet {
namespace {

glm::dmat3 Rows(const double (&m)[9]) {
  return glm::transpose(glm::dmat3(m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8]));
}

constexpr double kXyzFromRec709[9] = {0.4123908, 0.3575843, 0.1804808, 0.2126390, 0.7151687,
                                      0.0721923, 0.0193308, 0.1191948, 0.9505322};
constexpr double kConesFromXyz[9] = {0.401288, 0.650173,  -0.051461, -0.250268, 1.204414,
                                     0.045854, -0.002079, 0.048952,  0.953127};

glm::dvec3 XyzOfChromaticity(double x, double y) { return {x / y, 1.0, (1.0 - x - y) / y}; }

}  // namespace

void SetWhiteBalance(double temperature, double tint, float (&matrix)[9]) {
  // The daylight locus near D65 (Judd, MacAdam and Wyszecki, 1964): y as a function of x.
  const auto on_locus = [](double x) { return 2.87 * x - 3.0 * x * x - 0.27509507; };
  constexpr double kWhiteX = 0.31271, kBlueStep = 0.0214, kYellowStep = 0.066, kTintStep = 0.066;
  const double x = kWhiteX - temperature * (temperature < 0.0 ? kBlueStep : kYellowStep);
  const double y = on_locus(x) + tint * kTintStep;
  const glm::dmat3 cones_from_rec709 = Rows(kConesFromXyz) * Rows(kXyzFromRec709);
  const glm::dvec3 white = Rows(kConesFromXyz) * XyzOfChromaticity(kWhiteX, on_locus(kWhiteX));
  const glm::dvec3 light = Rows(kConesFromXyz) * XyzOfChromaticity(x, y);
  const glm::dvec3 gain = white / light;
  const glm::dmat3 balance =
      glm::inverse(cones_from_rec709) * glm::dmat3(gain.x, 0, 0, 0, gain.y, 0, 0, 0, gain.z) * cones_from_rec709;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) matrix[3 * row + column] = static_cast<float>(balance[column][row]);
  }
}

}  // namespace facet
