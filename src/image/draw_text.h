// Text in pictures, such as the labels of charts.
#pragma once

#include <string_view>

#include "facet/image.h"
#include "image/font_6x13.h"

namespace facet {

// Draws printable ASCII; anything else becomes "?". (x, y): the top left pixel. `shade`: of each colour, 0 to 255. What
// is outside of the picture is left out. The image is U8.
void DrawText(Image& image, int x, int y, std::string_view text, unsigned char shade);

}  // namespace facet
