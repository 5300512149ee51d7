// A picture of spheres in rows and columns, with labels.
#pragma once

#include <string>
#include <vector>

#include "facet/image.h"
#include "facet/scene.h"

namespace facet {

struct SheetCell {
  Material material;
  std::string label;  // below the sphere
};

struct SheetRow {
  std::string label;  // left of the row, may have several lines
  std::vector<SheetCell> cells;
};

// Pixels of the square that a cell's sphere is in, without its label.
inline constexpr int kCellSize = 96;

struct Sheet {
  Image picture;  // U8, sRGB, 3 channels
  // The top left pixel of a cell's square.
  static int Left(std::size_t column);
  static int Top(std::size_t row);
};

// Lit by the built-in studio. All cells see the same light from the same side: the camera is orthographic. Behind
// materials that light passes through, there is a checkerboard.
Sheet DrawSheet(const std::vector<SheetRow>& rows);

}  // namespace facet
