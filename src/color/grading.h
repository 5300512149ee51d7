// What colour grading computes once for a picture.
#pragma once

namespace facet {

// All that changes nothing by default.
struct GradingFactors {
  bool balances_white = false;
  float white_balance[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};  // of Rec. 709 light, rows first
  float contrast = 1.0f;                                 // the exponent around middle grey
  float saturation = 1.0f;
  bool has_curves = false;
  float gamma[3] = {1, 1, 1}, middle[3] = {1, 1, 1}, scale[3] = {1, 1, 1};  // by channel

  bool ChangesNothing() const { return !balances_white && contrast == 1.0f && saturation == 1.0f && !has_curves; }
};

// The matrix that makes the white of another light the white of the picture, by scaling the responses of cones (CAT16;
// Li et al., 2017, "Comprehensive color solutions: CAM16, CAT16, and CAM16-UCS"). `temperature` and `tint`: -1 to 1;
// they turn the picture from blue to yellow and from green to magenta, by taking a bluer or greener light for white,
// along the daylight locus and across it. 0 and 0 are D65.
void SetWhiteBalance(double temperature, double tint, float (&matrix)[9]);

}  // namespace facet
