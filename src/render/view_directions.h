// Directions from the eye through the pixels of an image, as the sum of a column's part and a row's part.
#pragma once

#include <vector>

#include "frame/geometry.h"

namespace facet {

// DirectionThrough(view, x + 0.5, y + 0.5), to the bit, is (column[.][x] + row[.][y]) + whole. Columns are followed by
// kTaskPadding zeros.
struct ViewDirections {
  std::vector<double> column[3], row[3];
  double whole[3] = {};
};

ViewDirections MakeViewDirections(const FrameView& view);

}  // namespace facet
