// Attribute setup: gathers, once for all fragments of a triangle in a tile, what their interpolation needs.
#pragma once

#include "frame/geometry.h"
#include "plan/frame_material.h"

namespace facet {

// The layout of one triangle's attribute setup: indices of its floats. Each attribute has three vertices one after the
// other. Lanes read four floats at a time, of which the fourth may belong to the next item. World axes; positions are
// relative to the eye; normals, tangents and handedness are flipped to the viewer's side.
struct AttributeLayout {
  // Perspective-correct weights: e_i(x, y) = plane[3 i] * x + plane[3 i + 1] * y + plane[3 i + 2], with x and y in
  // pixels from the anchor; barycentric weight i is e_i / (e_0 + e_1 + e_2).
  static constexpr int kPlanes = 0;
  static constexpr int kPositions = kPlanes + 9;
  static constexpr int kNormals = kPositions + 9;
  // How the solid angle of normals within a pixel grows, if FrameMaterial::specular_antialiasing; see below. Lanes get
  // it with the last normal.
  static constexpr int kNormalSweep = kNormals + 9;
  static constexpr int kTangents = kNormalSweep + 1;  // x, y, z, handedness
  static constexpr int kColors = kTangents + 12;   // R, G, B, A
  static constexpr int kTexCoords = kColors + 12;  // UV slot k: 6 floats from kTexCoords + 6 k on

  // The size of a setup, in floats, for a material that reads this many UV sets: a multiple of 16 bytes.
  static constexpr int Stride(int uv_slots) { return (kTexCoords + 6 * uv_slots + 1 + 3) / 4 * 4; }
  // The last float, which no UV set takes: metres per unit of the mesh for fragments behind which a volume begins,
  // which are those of front faces, otherwise 0. Only of materials with a volume.
  static constexpr int MetresPerUnit(int uv_slots) { return Stride(uv_slots) - 1; }
  static constexpr int kMostStride = (kTexCoords + 6 * kMaxUvSlots + 1 + 3) / 4 * 4;
};

// Screen triangles of one material whose attributes are to be set up for the fragments of a tile.
struct AttributeSetupTask {
  const FrameView* view = nullptr;
  const FrameDrawable* drawables = nullptr;      // by ScreenTriangle::drawable
  const Primitive* const* attributes = nullptr;  // likewise: the geometry, with what the material reads of it
  const FrameMaterial* material = nullptr;
  int anchor_x = 0, anchor_y = 0;  // pixels
  const ScreenTriangle* const* records = nullptr;
  std::size_t count = 0;
  float* setups = nullptr;  // out: AttributeLayout::Stride() floats each, in the order of the records
};

// Sets up the attributes that the material reads. A triangle's setup does not depend on the other triangles.
//
// The weights come from the inverse of the matrix of the vertices in homogeneous screen space (Olano and Greer 1997,
// "Triangle Scan Conversion using 2D Homogeneous Coordinates"), so that triangles need not be clipped. They are
// computed in double from the unsnapped positions.
//
// The normal n(x, y) = N / |N|, N = sum b_i n_i, sweeps over the unit sphere as the pixel moves. The solid angle per
// pixel is N . (dN/dx x dN/dy) / |N|^3. Both factors of the triple product are simple: as b_0 = 1 - b_1 - b_2, it is
// n_0 . (n_1 x n_2) times the Jacobian of (b_1, b_2), which of a projective map with e_i = planes . (x, y, 1) is
// det(planes) / (e_0 + e_1 + e_2)^3. NormalSweep is the product of the two determinants, which all fragments share;
// dividing it by (|N| (e_0 + e_1 + e_2))^3 is left to them. It is exactly 0 where the vertices' normals are equal.
void SetUpTriangleAttributes(const AttributeSetupTask& task);

}  // namespace facet
