// The directional albedo of the specular lobe: the second half of the split-sum approximation.
#pragma once

#include "facet/models/lecture.h"

namespace facet {

// Directional albedo of single-scattering GGX with height-correlated Smith: F0 * A + B where Fresnel is Schlick's with
// F0 (Karis, 2013, Real Shading in Unreal Engine 4). lighting-inl.h reads it with bilinear interpolation.
//
// Columns are evenly spaced in the fourth root of n_dot_v, rows in the square root of perceptual roughness, because the
// albedo of a smooth surface changes most where n_dot_v is near alpha, and samples must be dense there. The error of A
// + B, which bounds what a white furnace gains or loses, is below 0.007 everywhere (with even spacing in sqrt(n_dot_v)
// and in roughness, at the same size, 0.023).
struct DfgTable {
  static constexpr int kColumns = 48;
  static constexpr int kRows = 32;
  static constexpr float kFirstRow = 0.2f;  // square root of the first row's perceptual roughness
  float albedo[kRows * kColumns * 2];       // A, B at [row][column]
  // A, B averaged over the hemisphere, 2 * integral of A(mu) mu d mu, at [row]. The integral is that of the
  // interpolated table, so that multiple scattering returns exactly the energy that single scattering loses.
  float average[kRows * 2];
};

// The table that all renderers share, computed at the first call. Thread-safe.
const DfgTable& SharedDfgTable();

// The same with the masking and shadowing that lectures have for image-based light: Schlick's form of Smith's, k =
// roughness^2 / 2. Rows are those of GGX's perceptual roughness, the square root of alpha, all the same. With `alpha`
// the roughness itself, k is so small that A + B exceeds 1 at grazing views. Thread-safe.
const DfgTable& SharedSchlickDfgTable(LectureAlpha alpha);

// Computes a table, with the same bits on every instruction set and for any number of threads.
void ComputeDfgTable(DfgTable* table);

}  // namespace facet
