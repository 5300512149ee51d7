#include "resolve/resolve_planes.h"

#include <limits>

#include "resolve/planes/depth.h"
#include "resolve/planes/triangle.h"

namespace facet {
namespace {

// Calls the function that writes the plane. The compiler warns of a plane without one.
void Write(PlaneKind kind, const PlaneTile& t) {
  switch (kind) {
    case PlaneKind::Depth: return WriteDepth(t);
    case PlaneKind::Triangle: return WriteTriangle(t);
  }
}

// Finds the nearest sample of each pixel in a row of a block, from (x, y) on: larger depths are nearer, and of equal
// ones the first sample stays. Uncovered samples are infinitely far away. Without branches, so that compilers vectorize
// it.
void FindNearest(const TileBuffers& tile, int x, int y, std::int32_t* nearest) {
  float depth[kBlockSize];
  for (int i = 0; i < kBlockSize; ++i) nearest[i] = kNoSample, depth[i] = -std::numeric_limits<float>::infinity();
  for (int s = 0; s < tile.samples; ++s) {
    const std::size_t first = tile.Index(x, y, s);
    const float* here = tile.depth.data() + first;
    for (int i = 0; i < kBlockSize; ++i) {
      const bool nearer = here[i] > depth[i];
      nearest[i] = nearer ? static_cast<std::int32_t>(first) + i : nearest[i];
      depth[i] = nearer ? here[i] : depth[i];
    }
  }
}

void FindNearest(const TileBuffers& tile, bool nothing, std::vector<std::int32_t>& nearest) {
  nearest.assign(std::size_t(tile.tile_size) * std::size_t(tile.tile_size), kNoSample);
  if (nothing) return;
  for (int y = 0; y < tile.height; ++y) {
    for (int x = 0; x < tile.width; x += kBlockSize)
      FindNearest(tile, x, y, &nearest[std::size_t(y * tile.tile_size + x)]);
  }
}

}  // namespace

void PlaneResolver::Run(const VisibleTile& seen, std::size_t first, std::size_t width, std::span<Plane> planes) {
  FindNearest(seen.tile, seen.nothing, nearest_);
  for (Plane& plane : planes) {
    const std::size_t pixel_bytes = InfoOf(plane.kind).PixelBytes();
    Write(plane.kind, {seen, nearest_.data(), plane.bytes.data() + first * pixel_bytes, width * pixel_bytes});
  }
}

}  // namespace facet
