// What the interpolation of one triangle needs, gathered once for all its fragments in a tile.
#pragma once

#include "frame/geometry.h"
#include "plan/frame_material.h"

namespace facet {

// Layout of a setup: numbers of float, which lanes read by fours (the fourth may be a neighbour's). Attributes stand
// vertex after vertex. World axes; positions relative to the eye. Normals, tangents and handedness are turned to the
// viewer's side.
struct SetupLayout {
  // Perspective weights e_i(x, y) = plane[3 i] * x + plane[3 i + 1] * y + plane[3 i + 2], x and y in pixels from the
  // anchor; barycentric weight i is e_i / (e_0 + e_1 + e_2).
  static constexpr int kPlanes = 0;
  static constexpr int kPositions = kPlanes + 9;
  static constexpr int kNormals = kPositions + 9;
  static constexpr int kTangents = kNormals + 9;   // x, y, z, handedness
  static constexpr int kColors = kTangents + 12;   // R, G, B, A
  static constexpr int kTexCoords = kColors + 12;  // of UV slot k: 6 numbers at kTexCoords + 6 k

  // Floats from one setup to the next where a material reads so many UV sets: a multiple of 16 bytes.
  static constexpr int Stride(int uv_slots) { return (kTexCoords + 6 * uv_slots + 3) / 4 * 4; }
  static constexpr int kMostStride = (kTexCoords + 6 * kMaxUvSlots + 3) / 4 * 4;
};

// Triangles, lines or points of one material, to be set up for the fragments of a tile.
struct SetupTask {
  const FrameView* view = nullptr;
  const FrameDrawable* drawables = nullptr;      // by TriangleRecord::drawable
  const Primitive* const* attributes = nullptr;  // likewise: the geometry, with what the material reads of it
  const FrameMaterial* material = nullptr;
  int anchor_x = 0, anchor_y = 0;  // pixels
  const TriangleRecord* const* records = nullptr;
  std::size_t count = 0;
  float* setups = nullptr;  // out: SetupLayout::Stride() floats each, in the order of the records
};

// Sets of the attributes only those that the material reads. What a primitive gets does not depend on its neighbours.
//
// The weights are the inverse of the matrix of the vertices in homogeneous screen space (Olano and Greer 1997,
// "Triangle Scan Conversion using 2D Homogeneous Coordinates"), so they need no clipping, and they are computed in
// double from the file's positions, so they do not suffer from snapping.
void SetUpTriangles(const SetupTask& task);

}  // namespace facet
