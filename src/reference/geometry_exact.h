// Visibility for the reference: tests all primitives at a point of the image, in double and without snapping.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "base/memory_budget.h"
#include "reference/surface_exact.h"
#include "reference/view_exact.h"
#include "scene/pose.h"

namespace facet {

// A primitive of a drawable.
struct TriangleId {
  std::uint32_t drawable = 0, index = 0;
  bool operator==(const TriangleId&) const = default;
};

// All triangles, lines and points of a posed scene in front of a camera, without culled back faces. Refers to the posed
// scene.
class ExactGeometry {
 public:
  // `double_sided`: of each of the scene's drawables.
  ExactGeometry(const ExactView& view, const PosedScene& posed, const std::vector<bool>& double_sided);

  struct Hit {
    std::uint32_t primitive = 0;  // in the order of the scene
    float depth = 0.0f;           // see ExactView::DepthAt
    glm::dvec3 weight{0.0};       // barycentric
  };
  // All hits at a position in the image (pixels), in the order of the scene, among the primitives in `candidates`. A
  // position on an edge that two triangles share belongs to one of them.
  void HitsAt(const glm::dvec2& place, const std::vector<std::uint32_t>& candidates, std::vector<Hit>& hits) const;

  // The primitives whose bounds touch pixel (x, y), in order. Only an optimisation: HitsAt() of all primitives returns
  // the same.
  void CandidatesOf(int x, int y, std::vector<std::uint32_t>& candidates) const;
  std::size_t PrimitiveCount() const { return primitives_.size(); }

  std::size_t DrawableOf(const Hit& hit) const { return primitives_[hit.primitive].drawable; }
  TriangleId TriangleOf(const Hit& hit) const {
    return {primitives_[hit.primitive].drawable, primitives_[hit.primitive].index};
  }
  bool IsBack(const Hit& hit) const { return primitives_[hit.primitive].is_back; }
  SurfacePoint SurfaceAt(const Hit& hit) const;

  // All drawables of the scene, of which the camera may see only a part. Of triangles: `view` is unit, towards where
  // the point is seen from; `is_back` says whether that is behind the triangle.
  std::size_t DrawableCount() const { return placed_.size(); }
  const Primitive& PrimitiveOf(std::size_t drawable) const { return *placed_[drawable].geometry; }
  bool IsMirrored(std::size_t drawable) const { return placed_[drawable].mirrored; }
  std::array<glm::dvec3, 3> CornersOf(const TriangleId& triangle) const;  // world axes, origin at the eye
  SurfacePoint SurfaceOf(const TriangleId& triangle, const glm::dvec3& weight, bool is_back,
                         const glm::dvec3& view) const;

 private:
  struct Placed {
    const Primitive* geometry;
    glm::dmat3 eye_relative_from_mesh, normal_from_mesh;
    glm::dvec3 origin_eye;
    double metres_per_unit;
    bool mirrored;
  };
  // A line or point: its middle line in pixels, and depth there; half a pixel wide to each side.
  struct WideShape {
    glm::dvec2 from{0.0}, to{0.0};
    double from_depth = 0.0, to_depth = 0.0;
    bool is_line = false;
  };
  struct Shape {
    glm::dvec3 screen[3];
    double distance[3];
    float left, right, top, bottom;  // pixels
    std::uint32_t drawable, index;
    std::int32_t wide = -1;  // index into wide_; -1: a triangle
    bool is_back = false;
  };

  glm::dvec3 EyeRelative(const Placed& placed, std::uint32_t vertex) const;
  SurfacePoint Surface(const TriangleId& primitive, const glm::dvec3& weight, bool is_back,
                       const glm::dvec3* view) const;
  void AddTriangle(Shape& shape, bool double_sided);
  void AddLine(Shape& shape);
  void AddPoint(Shape& shape);
  void Add(Shape& shape, const glm::dvec2& low, const glm::dvec2& high);
  void Charge(std::size_t bytes);
  bool HitTriangle(const Shape& shape, const glm::dvec3& screen, Hit& hit) const;
  bool HitWide(const Shape& shape, const glm::dvec2& place, Hit& hit) const;

  const ExactView view_;
  std::vector<Placed> placed_;
  std::vector<Shape> primitives_;
  std::vector<WideShape> wide_;
  int columns_ = 0;
  std::vector<std::vector<std::uint32_t>> tiles_;
  // What the lists need and what has been charged for them, in bytes.
  std::size_t needed_ = 0, charged_ = 0;
  std::vector<MemoryLease> held_;
};

}  // namespace facet
