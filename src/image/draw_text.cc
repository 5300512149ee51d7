#include "image/draw_text.h"

#include <algorithm>

namespace facet {

void DrawText(Image& image, int x, int y, std::string_view text, unsigned char shade) {
  const int colors = std::min(image.channels, 3);
  for (const char c : text) {
    const auto& glyph = kFont[c >= 32 && c <= 126 ? c - 32 : '?' - 32];
    for (int row = 0; row < kFontHeight; ++row) {
      for (int column = 0; column < kFontWidth; ++column) {
        const int px = x + column, py = y + row;
        const bool inked = (glyph[row] >> (kFontWidth - 1 - column) & 1) != 0;
        if (!inked || px < 0 || py < 0 || px >= image.width || py >= image.height) continue;
        unsigned char* const pixel =
            image.As<unsigned char>() +
            (std::size_t(py) * std::size_t(image.width) + std::size_t(px)) * std::size_t(image.channels);
        std::fill_n(pixel, colors, shade);
      }
    }
    x += kFontWidth;
  }
}

}  // namespace facet
