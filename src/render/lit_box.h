// Where the fragments of a tile are lit: lights that end before it can be left out.
#pragma once

#include <glm/glm.hpp>
#include <limits>

#include "frame/geometry.h"
#include "frame/tile.h"

namespace facet {

// The box around the places at which fragments of triangles are lit, of a perspective view. It errs on the large side
// only: a light that reaches no part of it gives nothing to any of them.
class LitBox {
 public:
  LitBox(const FrameView& view, const TileBuffers& tile) : view_(view), tile_(tile) {}

  // Widens it by the fragments that a triangle has in the tile. False: nothing bounds them.
  bool Add(const TriangleRecord& record, const FrameDrawable& drawable);

  // Relative to the eye, world axes; after the first Add().
  void Corners(glm::dvec3& low, glm::dvec3& high) const;

 private:
  bool AddPiece(const TriangleRecord& record, const FrameDrawable& drawable);
  void AddDepths(double farthest, double nearest);

  const FrameView& view_;
  const TileBuffers& tile_;
  double nearest_ = 0.0, farthest_ = std::numeric_limits<double>::infinity();  // depth: 1 / distance
  double size_ = 0.0;  // how far from the eye corners of clipped triangles lie
};

}  // namespace facet
