// Rays through the scene of the reference: the nearest triangle, in double.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "base/memory_budget.h"
#include "reference/geometry_exact.h"

namespace facet {

inline constexpr TriangleId kNoTriangle{std::numeric_limits<std::uint32_t>::max(),
                                        std::numeric_limits<std::uint32_t>::max()};

// World axes, origin at the eye.
struct ExactRay {
  glm::dvec3 origin{0.0};
  glm::dvec3 direction{0.0, 0.0, -1.0};  // unit
  TriangleId from = kNoTriangle;         // on which it starts, so that it does not meet this one
};

// All triangles of the posed scene, outside the image and beyond the near and far planes, too, in a hierarchy of boxes.
// Points and lines, whose width is one of the image's pixels, do not have a place in space and are not there.
// Immutable.
class ExactRays {
 public:
  explicit ExactRays(const ExactGeometry& geometry);

  struct Hit {
    TriangleId triangle;
    double distance = std::numeric_limits<double>::infinity();
    glm::dvec3 weight{0.0};  // barycentric
    bool is_back = false;    // the ray meets the triangle from behind
  };

  // The nearest triangle for which accept(Hit) holds. Of triangles at the same distance, the first in the order of the
  // scene. A ray along an edge or through a corner that triangles share does not slip through (Woop, Benthin and Wald,
  // 2013, Watertight Ray/Triangle Intersection). Triangles nearer than LeastDistance() are not met.
  template <class Accept>
  std::optional<Hit> Nearest(const ExactRay& ray, const Accept& accept) const {
    Hit best;
    if (nodes_.empty()) return std::nullopt;
    const Shear shear(ray);
    std::uint32_t waiting[kMostLevels];
    int count = 0;
    waiting[count++] = 0;
    while (count > 0) {
      const std::uint32_t n = waiting[--count];
      const Node& node = nodes_[n];
      if (!MayHit(node, ray, best.distance)) continue;
      if (node.count == 0) {
        // The half that is nearer by the order along the axis comes first.
        const bool is_backward = ray.direction[node.axis] < 0.0;
        waiting[count++] = is_backward ? n + 1 : node.first;
        waiting[count++] = is_backward ? node.first : n + 1;
        continue;
      }
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        Hit hit;
        if (!HitTriangle(triangles_[i], ray, shear, hit) || !IsBefore(hit, best)) continue;
        if (accept(std::as_const(hit))) best = hit;
      }
    }
    if (best.distance == std::numeric_limits<double>::infinity()) return std::nullopt;
    return best;
  }

  // A billionth of the scene's extent: more than rounding, less than what is modelled.
  double LeastDistance() const { return least_distance_; }
  std::size_t TriangleCount() const { return triangles_.size(); }

 private:
  static constexpr int kMostLevels = 64;
  static constexpr std::uint32_t kLeafSize = 4;
  struct Triangle {
    glm::dvec3 corner[3];
    TriangleId id;
    bool mirrored = false;
  };
  // An inner node's halves are the next node and node `first`.
  struct Node {
    glm::dvec3 low, high;
    std::uint32_t first = 0, count = 0;  // of a leaf's triangles; count 0: an inner node
    int axis = 0;
  };
  // The axes in such an order that the ray runs along the last one, and what shears it onto that.
  struct Shear {
    explicit Shear(const ExactRay& ray);
    int x, y, z;
    double along_x, along_y, along_z;
  };

  std::uint32_t Build(std::uint32_t first, std::uint32_t count);
  static bool IsBefore(const Hit& a, const Hit& b) {
    if (a.distance != b.distance) return a.distance < b.distance;
    return std::pair(a.triangle.drawable, a.triangle.index) < std::pair(b.triangle.drawable, b.triangle.index);
  }
  static bool MayHit(const Node& node, const ExactRay& ray, double most);
  bool HitTriangle(const Triangle& triangle, const ExactRay& ray, const Shear& shear, Hit& hit) const;

  MemoryLease held_;
  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
  double least_distance_ = 0.0;
};

}  // namespace facet
