#include "resolve/resolve_planes.h"

#include "resolve/planes/depth.h"
#include "resolve/planes/plane_tile.h"
#include "resolve/planes/triangle.h"

namespace facet {
namespace {

// Every plane and the function that writes it: the compiler asks for the one that is missing.
void Write(PlaneKind kind, const PlaneTile& t) {
  switch (kind) {
    case PlaneKind::Depth: return WriteDepth(t);
    case PlaneKind::Triangle: return WriteTriangle(t);
  }
}

// Larger depths are nearer; of equal ones the first sample's stays.
std::int32_t NearestSample(const TileBuffers& tile, int x, int y) {
  std::int32_t nearest = kNoSample;
  float depth = 0.0f;
  for (int s = 0; s < tile.samples; ++s) {
    const std::size_t i = tile.Index(x, y, s);
    if (tile.record[i] == kNoRecord || (nearest != kNoSample && !(tile.depth[i] > depth))) continue;
    nearest = static_cast<std::int32_t>(i);
    depth = tile.depth[i];
  }
  return nearest;
}

void FindNearest(const TileBuffers& tile, bool nothing, std::vector<std::int32_t>& nearest) {
  nearest.assign(std::size_t(tile.tile_size) * std::size_t(tile.tile_size), kNoSample);
  if (nothing) return;
  for (int y = 0; y < tile.height; ++y) {
    for (int x = 0; x < tile.width; ++x) {
      nearest[std::size_t(y) * std::size_t(tile.tile_size) + std::size_t(x)] = NearestSample(tile, x, y);
    }
  }
}

}  // namespace

void PlaneResolver::Run(const TileVisibility& seen, std::size_t first, std::size_t width, std::span<Plane> planes) {
  FindNearest(seen.tile, seen.nothing, nearest_);
  for (Plane& plane : planes) {
    const std::size_t pixel_bytes = InfoOf(plane.kind).PixelBytes();
    Write(plane.kind, {seen.tile, seen.records, seen.view, seen.drawables, nearest_.data(),
                       plane.bytes.data() + first * pixel_bytes, width * pixel_bytes});
  }
}

}  // namespace facet
