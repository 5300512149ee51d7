#include "reference/rays_exact.h"

#include <algorithm>
#include <cmath>

#include "scene/topology.h"

namespace facet {
namespace {

bool IsFiniteVector(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace

ExactRays::ExactRays(const ExactGeometry& geometry) {
  std::size_t most = 0;
  const auto is_of_triangles = [&](std::size_t d) {
    return ClassOf(geometry.PrimitiveOf(d).topology) == PrimitiveClass::Triangles;
  };
  for (std::size_t d = 0; d < geometry.DrawableCount(); ++d) {
    if (is_of_triangles(d)) most += PrimitiveCount(geometry.PrimitiveOf(d));
  }
  held_ = MemoryLease(most, sizeof(Triangle) + sizeof(Node), "the reference's rays");
  triangles_.reserve(most);
  double extent = 0.0;
  for (std::size_t d = 0; d < geometry.DrawableCount(); ++d) {
    if (!is_of_triangles(d)) continue;
    const std::uint32_t count = PrimitiveCount(geometry.PrimitiveOf(d));
    for (std::uint32_t i = 0; i < count; ++i) {
      const TriangleId id{std::uint32_t(d), i};
      const auto corners = geometry.CornersOf(id);
      const glm::dvec3 across = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
      if (!IsFiniteVector(corners[0]) || !IsFiniteVector(corners[1]) || !IsFiniteVector(corners[2])) continue;
      if (!(glm::dot(across, across) > 0.0)) continue;
      triangles_.push_back({{corners[0], corners[1], corners[2]}, id, geometry.IsMirrored(d)});
      for (const glm::dvec3& corner : corners) {
        extent = std::max({extent, std::fabs(corner.x), std::fabs(corner.y), std::fabs(corner.z)});
      }
    }
  }
  least_distance_ = 1e-9 * extent;
  nodes_.reserve(triangles_.size() + 1);
  if (!triangles_.empty()) Build(0, std::uint32_t(triangles_.size()));
}

// Splits at the median of the centres along the longest side of their box, so that there are few levels whatever the
// scene is like.
std::uint32_t ExactRays::Build(std::uint32_t first, std::uint32_t count) {
  const auto number = std::uint32_t(nodes_.size());
  nodes_.emplace_back();
  const auto centre = [](const Triangle& t) { return t.corner[0] + t.corner[1] + t.corner[2]; };
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low), low_centre(low), high_centre(high);
  for (std::uint32_t i = first; i < first + count; ++i) {
    for (const glm::dvec3& corner : triangles_[i].corner) {
      low = glm::min(low, corner);
      high = glm::max(high, corner);
    }
    low_centre = glm::min(low_centre, centre(triangles_[i]));
    high_centre = glm::max(high_centre, centre(triangles_[i]));
  }
  Node node;
  node.low = low - least_distance_;  // flat boxes are not missed by rounding
  node.high = high + least_distance_;
  if (count <= kLeafSize) {
    node.first = first;
    node.count = count;
  } else {
    const glm::dvec3 size = high_centre - low_centre;
    node.axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t half = count / 2;
    const auto begin = triangles_.begin() + first;
    std::nth_element(begin, begin + half, begin + count,
                     [&](const Triangle& a, const Triangle& b) { return centre(a)[node.axis] < centre(b)[node.axis]; });
    Build(first, half);
    node.first = Build(first + half, count - half);
  }
  nodes_[number] = node;
  return number;
}

bool ExactRays::MayHit(const Node& node, const ExactRay& ray, double most) {
  double from = 0.0, to = most;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = node.low[axis] - ray.origin[axis], high = node.high[axis] - ray.origin[axis];
    const double along = ray.direction[axis];
    if (std::fabs(along) < 1e-300) {
      if (low > 0.0 || high < 0.0) return false;
      continue;
    }
    const double a = low / along, b = high / along;
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  return from <= to;
}

ExactRays::Shear::Shear(const ExactRay& ray) {
  const glm::dvec3 size = glm::abs(ray.direction);
  z = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  x = (z + 1) % 3;
  y = (z + 2) % 3;
  along_z = 1.0 / ray.direction[z];
  along_x = ray.direction[x] * along_z;
  along_y = ray.direction[y] * along_z;
}

bool ExactRays::HitTriangle(const Triangle& triangle, const ExactRay& ray, const Shear& shear, Hit& hit) const {
  if (triangle.id == ray.from) return false;
  double x[3], y[3], z[3];
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 corner = triangle.corner[i] - ray.origin;
    x[i] = corner[shear.x] - shear.along_x * corner[shear.z];
    y[i] = corner[shear.y] - shear.along_y * corner[shear.z];
    z[i] = corner[shear.z] * shear.along_z;
  }
  // Twice the areas beside the corners. Negation is exact, so both triangles of an edge agree about it.
  glm::dvec3 area;
  for (int i = 0; i < 3; ++i) {
    const int a = (i + 1) % 3, b = (i + 2) % 3;
    area[i] = x[b] * y[a] - y[b] * x[a];
  }
  const bool some_below = area.x < 0.0 || area.y < 0.0 || area.z < 0.0;
  const bool some_above = area.x > 0.0 || area.y > 0.0 || area.z > 0.0;
  if (some_below == some_above) return false;  // outside, or seen from its edge
  const double sum = area.x + area.y + area.z;
  hit.weight = area / sum;
  hit.distance = hit.weight.x * z[0] + hit.weight.y * z[1] + hit.weight.z * z[2];
  if (!(hit.distance > least_distance_) || !std::isfinite(hit.distance)) return false;
  hit.triangle = triangle.id;
  const glm::dvec3 across =
      glm::cross(triangle.corner[1] - triangle.corner[0], triangle.corner[2] - triangle.corner[0]);
  hit.is_back = (glm::dot(across, ray.direction) > 0.0) != triangle.mirrored;
  return true;
}

}  // namespace facet
