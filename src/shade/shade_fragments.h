// The shading stage's kernels.
#pragma once

#include "shade/shade_task.h"

namespace facet {

// By the material's shading model. Fills all outputs of `task`.
void ShadeFragments(const ShadeTask& task);

// Alpha alone, for the alpha test. Fills task.alpha.
void ShadeAlpha(const ShadeTask& task);

// The environment behind a row of pixels: laid under those whose coverage is below 1. The direction from the eye
// through pixel x (world axes, any length) is column[.][x] + row + whole; columns can be read kTaskPadding further.
struct BackgroundTask {
  const double* column[3] = {};
  double row[3] = {}, whole[3] = {};
  int width = 0;
  const LightingData* lighting = nullptr;
  float* pixels = nullptr;  // linear light times coverage, and coverage: four numbers each
};
void ShadeBackground(const BackgroundTask& task);

}  // namespace facet
