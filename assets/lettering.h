// Lettering as geometry, so that labels stay sharp at every size and need no image.
#pragma once

#include <string>

#include "shapes.h"

namespace facet::assets {

// The letters of `text` as flat ribbons in the plane z = 0 that face +Z: positions and indices alone. The baseline
// starts at the origin and runs along +X; a small letter such as x is `x_height` tall. Knows a-z, 0-9, the full stop,
// the hyphen and the space; throws std::invalid_argument for others.
Shape Lettering(const std::string& text, double x_height);
// The distance from the start of `text` to the end of its last letter.
double LetteringWidth(const std::string& text, double x_height);

}  // namespace facet::assets
