#include "scene/bounds.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace facet {
namespace {

constexpr std::size_t kVerticesPerPiece = 8192;

void AddPoint(const glm::dvec3& point, Bounds& bounds) {
  if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z)) return;
  bounds.low = bounds.empty ? point : glm::min(bounds.low, point);
  bounds.high = bounds.empty ? point : glm::max(bounds.high, point);
  bounds.empty = false;
}

// The box of place(position) over all positions. Partial results are joined in order, so that even the sign of a zero
// is the same for any number of threads.
template <class Place>
Bounds BoundsOfPlaced(const std::vector<glm::vec3>& positions, const Place& place) {
  std::vector<Bounds> pieces((positions.size() + kVerticesPerPiece - 1) / kVerticesPerPiece);
  ParallelFor(positions.size(), kVerticesPerPiece, [&](std::size_t begin, std::size_t end) {
    Bounds piece;
    for (std::size_t i = begin; i < end; ++i) AddPoint(place(positions[i]), piece);
    pieces[begin / kVerticesPerPiece] = piece;
  });
  Bounds bounds;
  for (const Bounds& piece : pieces) AddBounds(piece, bounds);
  return bounds;
}

// Whether the matrix only scales, mirrors and permutes axes, so that it maps boxes to boxes.
bool KeepsBoxes(const glm::dmat4& m) {
  for (int r = 0; r < 3; ++r) {
    const int nonzero = (m[0][r] != 0.0) + (m[1][r] != 0.0) + (m[2][r] != 0.0);
    if (nonzero > 1) return false;
  }
  return true;
}

}  // namespace

void AddBounds(const Bounds& other, Bounds& bounds) {
  if (other.empty) return;
  AddPoint(other.low, bounds);
  AddPoint(other.high, bounds);
}

Bounds BoundsOf(const std::vector<glm::vec3>& positions) {
  return BoundsOfPlaced(positions, [](const glm::vec3& p) { return glm::dvec3(p); });
}

void AddPlaced(const std::vector<glm::vec3>& positions, const Bounds& local, const glm::dmat4& world_from_mesh,
               Bounds& bounds) {
  if (local.empty) return;
  Bounds corners;
  for (int i = 0; i < 8; ++i) {
    const glm::dvec4 corner(i & 1 ? local.high.x : local.low.x, i & 2 ? local.high.y : local.low.y,
                            i & 4 ? local.high.z : local.low.z, 1.0);
    AddPoint(glm::dvec3(world_from_mesh * corner), corners);
  }
  const bool inside = !bounds.empty && !corners.empty && glm::all(glm::lessThanEqual(bounds.low, corners.low)) &&
                      glm::all(glm::lessThanEqual(corners.high, bounds.high));
  if (inside) return;  // with many instances, most lie between the others
  if (KeepsBoxes(world_from_mesh)) {
    AddBounds(corners, bounds);
  } else {
    AddBounds(BoundsOfPlaced(positions,
                             [&](const glm::vec3& p) {
                               return glm::dvec3(world_from_mesh * glm::dvec4(glm::dvec3(p), 1.0));
                             }),
              bounds);
  }
}

void AddReach(const std::vector<glm::vec3>& positions, const Bounds& local, const glm::dmat4& world_from_mesh,
              const glm::dvec3& point, double& reach) {
  const auto distance2 = [&](const glm::dvec3& position) {
    const glm::dvec3 offset = glm::dvec3(world_from_mesh * glm::dvec4(position, 1.0)) - point;
    return glm::dot(offset, offset);
  };
  if (local.empty) return;
  double corners2 = 0.0;
  for (int i = 0; i < 8; ++i) {
    corners2 = std::max(corners2, distance2({i & 1 ? local.high.x : local.low.x, i & 2 ? local.high.y : local.low.y,
                                             i & 4 ? local.high.z : local.low.z}));
  }
  // A small margin, since rounding can make the farthest corner of the box nearer than a point in it.
  constexpr double kRounding = 1e-9;
  if (corners2 * (1.0 + kRounding) <= reach * reach) return;
  std::vector<double> pieces((positions.size() + kVerticesPerPiece - 1) / kVerticesPerPiece, 0.0);
  ParallelFor(positions.size(), kVerticesPerPiece, [&](std::size_t begin, std::size_t end) {
    double largest2 = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      const double d2 = distance2(glm::dvec3(positions[i]));
      if (std::isfinite(d2)) largest2 = std::max(largest2, d2);
    }
    pieces[begin / kVerticesPerPiece] = largest2;
  });
  for (const double largest2 : pieces) reach = std::max(reach, std::sqrt(largest2));
}

}  // namespace facet
