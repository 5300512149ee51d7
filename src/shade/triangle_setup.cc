#include "shade/triangle_setup.h"

#include <algorithm>
#include <cmath>

#include "scene/topology.h"

namespace facet {
namespace {

// Rows of the inverse of the matrix with columns h[0], h[1], h[2], times any positive number (weights are divided by
// their sum). A degenerate triangle takes everything from its first vertex.
void WritePlanes(const glm::dvec3 (&h)[3], RecordKind kind, float* planes) {
  glm::dvec3 row[3] = {glm::cross(h[1], h[2]), glm::cross(h[2], h[0]), glm::cross(h[0], h[1])};
  const double determinant = glm::dot(row[0], h[0]);
  double largest = 0.0;
  for (glm::dvec3& r : row) {
    r *= determinant < 0.0 ? -1.0 : 1.0;
    // Weights within a tile's reach decide the scale.
    largest = std::max({largest, std::fabs(r.x) * 64.0, std::fabs(r.y) * 64.0, std::fabs(r.z)});
  }
  if (kind == RecordKind::Line) row[2] = glm::dvec3(0.0);  // the third vertex stands for the line's width
  if (!(largest > 0.0) || !std::isfinite(largest) || kind == RecordKind::Point || determinant == 0.0) {
    std::fill(planes, planes + 9, 0.0f);
    planes[2] = 1.0f;
    return;
  }
  for (int i = 0; i < 3; ++i) {
    for (int c = 0; c < 3; ++c) planes[3 * i + c] = static_cast<float>(row[i][c] / largest);
  }
}

void Write(float* out, const glm::dvec3& v) {
  out[0] = static_cast<float>(v.x), out[1] = static_cast<float>(v.y), out[2] = static_cast<float>(v.z);
}

glm::dvec3 UnitOr(const glm::dvec3& v, const glm::dvec3& fallback) {
  const double length = glm::length(v);
  return length > 0.0 && std::isfinite(length) ? v / length : fallback;
}

}  // namespace

void PrefetchIndices(const FrameDrawable& drawable, const TriangleRecord& record) {
  const auto& indices = drawable.geometry->indices;
  const std::size_t first = std::size_t(record.primitive) * 3;  // of a strip it is elsewhere: no harm
  if (first + 2 < indices.size()) __builtin_prefetch(&indices[first]);
}

void PrefetchVertices(const FrameDrawable& drawable, const TriangleRecord& record) {
  const Primitive& geometry = *drawable.geometry;
  for (const std::size_t v : PrimitiveVertices(geometry, record.primitive)) {
    __builtin_prefetch(&geometry.positions[v]);
    if (!geometry.normals.empty()) __builtin_prefetch(&geometry.normals[v]);
  }
}

void SetUpTriangle(const FrameView& view, const FrameDrawable& drawable, const FrameMaterial& material,
                   const TriangleRecord& record, int anchor_x, int anchor_y, float* setup) {
  const Primitive& geometry = *drawable.geometry;
  const auto vertex = PrimitiveVertices(geometry, record.primitive);
  glm::dvec3 h[3], position[3];
  for (int i = 0; i < 3; ++i) {
    const glm::dvec4 p(glm::dvec3(geometry.positions[vertex[std::size_t(i)]]), 1.0);
    const double w = view.perspective ? glm::dot(drawable.screen_from_mesh[2], p) : 1.0;
    h[i] = {glm::dot(drawable.screen_from_mesh[0], p) - anchor_x * w,
            glm::dot(drawable.screen_from_mesh[1], p) - anchor_y * w, w};
    position[i] = p * drawable.eye_relative_from_mesh;
    Write(setup + SetupLayout::kPositions + 3 * i, position[i]);
  }
  if (record.kind == RecordKind::Line) {
    const glm::dvec3 line = glm::cross(h[0], h[1]);  // its first two numbers point across the line on the screen
    h[2] = glm::dvec3(line.x, line.y, 0.0);
  }
  WritePlanes(h, record.kind, setup + SetupLayout::kPlanes);

  const double side = record.back_facing ? -1.0 : 1.0;
  if (material.Has(kLit)) {
    const glm::dvec3 toward_eye = UnitOr(-position[0], {0.0, 0.0, 1.0});
    const glm::dvec3 flat = UnitOr(glm::cross(position[1] - position[0], position[2] - position[0]) *
                                       (drawable.mirrored ? -side : side), toward_eye);
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 normal =
          geometry.normals.empty()
              ? flat
              : UnitOr(drawable.normal_from_mesh * glm::dvec3(geometry.normals[vertex[std::size_t(i)]]) * side, flat);
      Write(setup + SetupLayout::kNormals + 3 * i, normal);
    }
  }
  if (material.Has(kNormalTexture)) {
    for (int i = 0; i < 3; ++i) {
      const glm::vec4 t = geometry.tangents.empty() ? glm::vec4(1, 0, 0, 1) : geometry.tangents[vertex[std::size_t(i)]];
      float* out = setup + SetupLayout::kTangents + 4 * i;
      const glm::dvec3 turned = glm::dvec4(glm::dvec3(t), 0.0) * drawable.eye_relative_from_mesh;
      Write(out, UnitOr(turned, {1.0, 0.0, 0.0}) * side);
      out[3] = t.w * static_cast<float>(drawable.mirrored ? -side : side);
    }
  }
  if (material.vertex_colors) {
    for (int i = 0; i < 3; ++i) {
      const glm::vec4 c = geometry.colors[vertex[std::size_t(i)]];
      std::copy(&c.x, &c.x + 4, setup + SetupLayout::kColors + 4 * i);
    }
  }
  for (int slot = 0; slot < material.uv_slots; ++slot) {
    const std::size_t set = std::size_t(material.uv_sets[slot]);
    const bool present = set < geometry.tex_coords.size() && !geometry.tex_coords[set].empty();
    for (int i = 0; i < 3; ++i) {
      const glm::vec2 uv = present ? geometry.tex_coords[set][vertex[std::size_t(i)]] : glm::vec2(0.0f);
      float* out = setup + SetupLayout::kTexCoords + 6 * slot + 2 * i;
      out[0] = uv.x, out[1] = uv.y;
    }
  }
}

}  // namespace facet
