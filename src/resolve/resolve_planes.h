// Resolves the samples of a tile to the pixels of the planes besides colour. resolve/planes/ has a file for each plane.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "facet/planes.h"
#include "resolve/planes/plane_tile.h"

namespace facet {

// Keeps its working memory from tile to tile. Not thread-safe: one per worker.
class PlaneResolver {
 public:
  // Writes the tile's pixels into each plane. The planes are `width` pixels wide; the tile's top left pixel has the
  // index `first` in them.
  void Run(const VisibleTile& seen, std::size_t first, std::size_t width, std::span<Plane> planes);

 private:
  std::vector<std::int32_t> nearest_;
};

}  // namespace facet
