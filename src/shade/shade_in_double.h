// Shading in double precision, to measure the rounding error of shading in float.
#pragma once

#include <memory>

#include "facet/shader.h"

namespace facet {

// A RenderSettings::shader that evaluates the materials' own models in double, one fragment at a time. It is compiled
// from the same source as the lanes' kernels (interpolation, textures, closure, light), and reads the same tables,
// prefiltered maps, texels and constants. Only its inputs (attribute setups and positions) and its outputs (one float
// per channel) are rounded to float. The difference between the two films is the rounding error of shading; visibility,
// the alpha test, the background and blending are computed in lanes for both.
//
// Where rounding decides a choice, such as the mip level, the number of anisotropic taps or the side of a horizon, the
// two may differ by more; that is part of the rounding error.
std::unique_ptr<const FragmentShader> MakeDoubleShader();

}  // namespace facet
