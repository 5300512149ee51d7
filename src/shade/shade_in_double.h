// The shading stage without rounding.
#pragma once

#include <memory>

#include "facet/shader.h"

namespace facet {

// The materials' models, shaded fragment by fragment in double: a RenderSettings::shader that draws what the same
// algorithm draws without rounding in between. One source (interpolation, textures, closure, light), the same tables,
// prefiltered maps, texels and constants as the lanes read; rounded are only what crosses into the stage, the triangle
// setups and positions, and what leaves it, one float a channel. The difference of the two films is the rounding error
// of shading; visibility, the alpha test, the background and blending are the lanes' in both.
//
// A fragment at the edge of a decision (a mip level, the number of anisotropic taps, which side of a horizon) may take
// the other side: that is rounding too.
std::unique_ptr<const FragmentShader> MakeDoubleShader();

}  // namespace facet
