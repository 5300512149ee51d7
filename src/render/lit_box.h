// A bounding box of the positions at which the fragments of a tile are lit, to cull lights whose range ends before it.
#pragma once

#include <glm/glm.hpp>
#include <limits>

#include "frame/geometry.h"
#include "frame/tile.h"

namespace facet {

// For perspective views. The box is conservative: a light that does not reach it contributes exactly nothing to any of
// the fragments.
class LitBox {
 public:
  LitBox(const FrameView& view, const TileBuffers& tile) : view_(view), tile_(tile) {}

  // Extends the box by the fragments that a triangle has in the tile. False: they have no bound.
  bool Add(const ScreenTriangle& record, const FrameDrawable& drawable);

  // Relative to the eye, world axes; after the first Add().
  void Corners(glm::dvec3& low, glm::dvec3& high) const;

 private:
  bool AddPiece(const ScreenTriangle& record, const FrameDrawable& drawable);
  void AddDepths(double farthest, double nearest);

  const FrameView& view_;
  const TileBuffers& tile_;
  double nearest_ = 0.0, farthest_ = std::numeric_limits<double>::infinity();  // depth: 1 / distance
  double size_ = 0.0;  // how far from the eye corners of clipped triangles lie
};

}  // namespace facet
