// FLIP: the difference that a person perceives when flipping between two images.
#pragma once

#include <vector>

#include "facet/image.h"

namespace facet {

struct FlipSettings {
  double pixels_per_degree = 0.0;
  float backdrop = 0.0f;  // linear grey behind transparent pixels
  // Exposures, in stops, at which the images are tone-mapped; the largest error of each pixel counts (HDR-FLIP). Empty:
  // light is clamped to [0, 1] and compared once (LDR-FLIP).
  std::vector<double> exposures_ev;
};

// The error of each pixel, 0 to 1. Both images are linear light, F32, straight RGBA, of the same size. Pixels that are
// not finite count as black. P. Andersson and others, 2020, "FLIP: A Difference Evaluator for Alternating Images".
std::vector<float> FlipErrors(const Image& reference, const Image& test, const FlipSettings& settings);

// The exposures of HDR-FLIP for a reference: from the one that brings its brightest pixel to 85 % of the tone curve's
// white to the one that does so with its median, about one stop apart. If the median is black, black pixels are
// ignored; a black image has exposure 0. P. Andersson and others, 2021, "Visualizing Errors in Rendered High Dynamic
// Range Images"; the exposures are chosen as there, from the reference only.
std::vector<double> FlipExposures(const Image& reference, float backdrop);

}  // namespace facet
