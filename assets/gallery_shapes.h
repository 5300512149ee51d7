// Shapes of the gallery.
#pragma once

#include <vector>

#include "shapes.h"

namespace facet::assets {

// A smooth curve through `points` (Catmull and Rom), `pieces` straight ones between two of them.
std::vector<Vec2> SmoothProfile(const std::vector<Vec2>& points, int pieces);
// A smooth Lathe(); u times `around`, v the length along the profile in metres times `per_metre`.
Shape Turned(const std::vector<Vec2>& profile, int columns, double around, double per_metre);
// A brilliant of girdle radius 1 around +Y: table, stars, kites and girdle facets above, as many below.
Shape Brilliant();
// A teapot that stands on the origin, its spout towards +X, and the outline of its body from top to bottom.
struct TeapotShape {
  Shape shape;
  std::vector<Vec2> outline;
};
TeapotShape Teapot();

}  // namespace facet::assets
