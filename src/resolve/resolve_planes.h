// A tile's samples into the pixels of a film's planes besides colour. resolve/planes/ has a file for each plane.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "facet/planes.h"
#include "frame/geometry.h"
#include "frame/tile.h"

namespace facet {

// Who is seen in a tile. `records`: by their numbers in tile.record; `drawables`: by TriangleRecord::drawable.
struct VisibleTile {
  const TileBuffers& tile;
  bool nothing = false;  // the tile's depths and records are not set, and nobody is seen
  const TriangleRecord* const* records = nullptr;
  const FrameView& view;
  const FrameDrawable* drawables = nullptr;
};

// Keeps its working memory from tile to tile. Not thread-safe: one per worker.
class PlaneResolver {
 public:
  // Writes the tile's pixels into each plane. The planes are `width` pixels wide and large enough; the tile's top left
  // pixel is number `first` of them.
  void Run(const VisibleTile& seen, std::size_t first, std::size_t width, std::span<Plane> planes);

 private:
  std::vector<std::int32_t> nearest_;
};

}  // namespace facet
