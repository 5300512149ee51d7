// Light of the studio that reaches a surface past the things that stand on it, as an occlusion texture: a rasterizer
// has no other way to know what blocks an environment.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "shapes.h"

namespace facet::assets {

// A solid of revolution about a vertical axis, which blocks light.
struct Blocker {
  Vec3 place;                 // of its axis at height 0
  std::vector<Vec2> profile;  // (radius, height), from top to bottom
  double opacity = 1;         // the share of light that it blocks
};

struct SurfacePoint {
  Vec3 position, normal;
};

// A PNG of size x size pixels, which all hold, as grey, the share of the irradiance that is left at `surface`(u, v); u
// and v of the pixels' centres in [0, 1]. `itself`: the blocker whose surface this is, or -1; a convex solid blocks
// none of its own light.
std::vector<std::uint8_t> BakeOcclusion(int size, const std::function<SurfacePoint(double, double)>& surface,
                                        const std::vector<Blocker>& blockers, int itself);

}  // namespace facet::assets
