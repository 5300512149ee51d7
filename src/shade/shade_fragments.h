// The kernels of the shading stage.
#pragma once

#include "shade/shade_task.h"

namespace facet {

// Shades fragments by the material's shading model. Fills all outputs of `task`.
void ShadeFragments(const ShadeTask& task);

// The same for the models that are not glTF's: each has its kernel in a file of its own.
void ShadeLecture(const ShadeTask& task);
void ShadeFilament(const ShadeTask& task);
void ShadeEnterprise(const ShadeTask& task);

// Computes alpha only, for the alpha test. Fills task.alpha.
void ShadeAlpha(const ShadeTask& task);

// Composites the environment under a row of pixels, where their alpha is below 1. The direction from the eye through
// pixel x (world axes, of any length) is column[.][x] + row + whole; kTaskPadding entries beyond a column's end must be
// readable.
struct BackgroundTask {
  const double* column[3] = {};
  double row[3] = {}, whole[3] = {};
  int width = 0;
  const LightingData* lighting = nullptr;
  float* pixels = nullptr;  // RGBA: linear light premultiplied by alpha
};
void ShadeBackground(const BackgroundTask& task);

// Looks up the environment, as a background, in the directions from the eye through points of the image. The direction
// through (x, y), in pixels, is column * x + row * y + whole (world axes, of any length). Arrays are readable and
// writable up to a multiple of 16.
struct EnvironmentTask {
  float column[3] = {}, row[3] = {}, whole[3] = {};
  const float* x = nullptr;
  const float* y = nullptr;
  const float* roughness = nullptr;  // perceptual, of the blur; 0: none
  std::size_t count = 0;
  const LightingData* lighting = nullptr;
  float* red = nullptr;
  float* green = nullptr;
  float* blue = nullptr;
};
void LookUpEnvironment(const EnvironmentTask& task);

}  // namespace facet
