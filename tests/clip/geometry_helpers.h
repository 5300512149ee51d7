// Cameras and drawables made by hand, and the way from a primitive to triangle records.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <vector>

#include "clip/assemble.h"
#include "frame/constants.h"
#include "frame/geometry.h"
#include "scene/topology.h"
#include "vertex/transform_vertices.h"

namespace facet::test {

// A camera at the origin that looks along -Z, as facet's conventions have it.
inline FrameView PerspectiveView(int width, int height, double focal_px, double near_distance,
                                 double far_distance = std::numeric_limits<double>::infinity()) {
  FrameView view;
  view.width = width, view.height = height;
  view.near_distance = near_distance, view.far_distance = far_distance;
  view.screen_x = {focal_px, 0.0, -0.5 * width};
  view.screen_y = {0.0, -focal_px, -0.5 * height};
  return view;
}

// Orthographic: x and y of a position are its place in pixels (y down), -z its distance. With `y_up`, y is turned, so
// that counter-clockwise triangles are seen from the front.
inline FrameView PixelView(int width, int height, bool y_up = false) {
  FrameView view;
  view.width = width, view.height = height;
  view.perspective = false;
  view.near_distance = 0.0, view.far_distance = 1000.0;
  view.screen_x = {1.0, 0.0, 0.0};
  view.screen_y = {0.0, y_up ? -1.0 : 1.0, 0.0};
  view.offset_y = y_up ? height : 0.0;
  return view;
}

inline FrameDrawable PlaceDrawable(const FrameView& view, const Primitive& primitive,
                                   const glm::dmat4& camera_from_mesh = glm::dmat4(1.0), bool double_sided = false) {
  FrameDrawable out;
  out.geometry = &primitive;
  out.primitive_count = PrimitiveCount(primitive);
  out.double_sided = double_sided;
  out.mirrored = glm::determinant(glm::dmat3(camera_from_mesh)) < 0.0;
  const glm::dvec3 rows[3] = {view.screen_x, view.screen_y, {0.0, 0.0, -1.0}};
  const double offsets[3] = {view.offset_x, view.offset_y, 0.0};
  for (int i = 0; i < 3; ++i) {
    glm::dvec4 row;
    for (int k = 0; k < 4; ++k) row[k] = glm::dot(rows[i], glm::dvec3(camera_from_mesh[k]));
    row.w += offsets[i];
    out.screen_from_mesh[i] = row;
    out.screen_from_local[i] = glm::vec4(row);
  }
  return out;
}

struct Assembled {
  VertexBuffer vertices;
  TriangleChunk chunk;
};

inline Assembled Assemble(const FrameView& view, const FrameDrawable& drawable, int samples) {
  Assembled out;
  const std::size_t n = drawable.geometry->positions.size();
  out.vertices.resize(n);
  TransformVertices(view, drawable, 0, n, out.vertices);
  out.chunk.primitive_count = drawable.primitive_count;
  AssembleChunk(view, drawable, out.vertices, samples, out.chunk);
  return out;
}

inline glm::dvec3 HomogeneousOf(const FrameDrawable& drawable, const glm::vec3& position) {
  const glm::dvec4 p(glm::dvec3(position), 1.0);
  return {glm::dot(drawable.screen_from_mesh[0], p), glm::dot(drawable.screen_from_mesh[1], p),
          glm::dot(drawable.screen_from_mesh[2], p)};
}

// Whether the ray through a screen position meets the triangle between the near and the far plane: barycentric
// coordinates from homogeneous edge functions (Olano and Greer 1997, "Triangle Scan Conversion using 2D Homogeneous
// Coordinates"), without clipping or projecting a vertex. Perspective only.
class HomogeneousTriangle {
 public:
  HomogeneousTriangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) : h_{a, b, c} {
    for (int i = 0; i < 3; ++i) edge_[i] = glm::cross(h_[(i + 1) % 3], h_[(i + 2) % 3]);
    determinant_ = glm::dot(h_[0], edge_[0]);
    for (glm::dvec3& e : edge_) e /= determinant_;
  }

  bool Degenerate() const { return !(std::fabs(determinant_) > 1e-9); }
  // The sum of the edge functions is 1 / distance where the ray meets the plane.
  glm::dvec3 Inverse() const { return edge_[0] + edge_[1] + edge_[2]; }

  enum class Answer { Outside, Inside, Unsure };
  // Unsure within `margin_px` of an edge or of a plane's trace.
  Answer At(double x, double y, double near_distance, double far_distance, double margin_px) const {
    const glm::dvec3 s(x, y, 1.0);
    bool unsure = false;
    const auto outside = [&](const glm::dvec3& line) {  // negative: outside
      const double value = glm::dot(line, s), gradient = std::hypot(line.x, line.y);
      if (std::fabs(value) <= margin_px * gradient) {
        unsure = true;
        return false;
      }
      return value < 0.0;
    };
    if (outside(edge_[0]) || outside(edge_[1]) || outside(edge_[2])) return Answer::Outside;
    // near <= distance is 1 / near - inverse >= 0.
    if (outside(glm::dvec3(0.0, 0.0, 1.0 / near_distance) - Inverse())) return Answer::Outside;
    const double far_inverse = std::isinf(far_distance) ? 0.0 : 1.0 / far_distance;
    if (outside(Inverse() - glm::dvec3(0.0, 0.0, far_inverse))) return Answer::Outside;
    return unsure ? Answer::Unsure : Answer::Inside;
  }

 private:
  glm::dvec3 h_[3], edge_[3];
  double determinant_;
};

}  // namespace facet::test
