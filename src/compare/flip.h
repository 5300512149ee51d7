// FLIP: the difference that a person sees who flips between two pictures.
#pragma once

#include <vector>

#include "facet/image.h"

namespace facet {

struct FlipSettings {
  double pixels_per_degree = 0.0;
  float backdrop = 0.0f;  // linear grey behind transparent pixels
  // Stops at which the light is looked at through a tone curve, the largest error of each pixel being taken (HDR-FLIP);
  // empty: it is cut to [0, 1] and looked at once (LDR-FLIP).
  std::vector<double> exposures_ev;
};

// The error of each pixel, 0 to 1. Both pictures: linear light, F32, straight RGBA, of one size. Pixels that are not
// finite count as black.
// P. Andersson and others, 2020, "FLIP: A Difference Evaluator for Alternating Images".
std::vector<float> FlipErrors(const Image& reference, const Image& test, const FlipSettings& settings);

// The exposures of HDR-FLIP for a reference: from the one that brings its brightest pixel to 85 % of the tone curve's
// white to the one that does so with its median, about one stop apart. Black pixels are left out where the median is
// black; a picture without light has exposure 0.
// P. Andersson and others, 2021, "Visualizing Errors in Rendered High Dynamic Range Images"; the exposures are chosen
// as there, of the reference alone.
std::vector<double> FlipExposures(const Image& reference, float backdrop);

}  // namespace facet
