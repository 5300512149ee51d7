// What the program may set of the shader Toon.
#pragma once

namespace facet {

struct ToonParameters {
  float shade_below = 0.25f, shine_above = 0.7f;  // cosines with the lamp
};

}  // namespace facet
