// The shading stage's kernels.
#pragma once

#include "shade/shade_task.h"

namespace facet {

// glTF 2.0's material model. Fills all outputs of `task`.
void ShadeMetallicRoughnessFragments(const ShadeTask& task);

// Alpha alone, for the alpha test. Fills task.alpha.
void ShadeAlpha(const ShadeTask& task);

// The environment behind the picture. For each of `count` pixels the direction from the eye (world axes, any length).
// Inputs readable and outputs writable up to a multiple of 16.
struct BackgroundTask {
  const float* x = nullptr;
  const float* y = nullptr;
  const float* z = nullptr;
  std::size_t count = 0;
  const LightingData* lighting = nullptr;
  float* red = nullptr;
  float* green = nullptr;
  float* blue = nullptr;
};
void ShadeBackground(const BackgroundTask& task);

}  // namespace facet
