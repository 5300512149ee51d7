// How much of the light from all around the specular lobe reflects: the second half of the split sum.
#pragma once

namespace facet {

// Directional albedo of single-scattering GGX with height-correlated Smith: F0 * A + B where Fresnel is Schlick's with
// F0 (Karis, 2013, Real Shading in Unreal Engine 4). Bilinear between samples; read by lighting-inl.h.
//
// Columns are even in the fourth root of n_dot_v, rows in the square root of perceptual roughness: a smooth surface
// changes at n_dot_v near alpha, so samples must crowd there. The error of A + B is then below 0.007 anywhere (even
// spacing in sqrt(n_dot_v) and in roughness, at the same size: 0.023), which bounds what a white furnace gains or loses.
struct DfgTable {
  static constexpr int kColumns = 48;
  static constexpr int kRows = 32;
  static constexpr float kFirstRow = 0.2f;  // square root of the first row's perceptual roughness; smoother counts as it
  float albedo[kRows * kColumns * 2];       // A, B at [row][column]
  // A, B averaged over the hemisphere: 2 * integral of A(mu) mu d mu, at [row]. Of the interpolated table, so that
  // what multiple scattering distributes is exactly what single scattering lost.
  float average[kRows * 2];
};

// The table that every renderer uses; made at the first call. Thread-safe.
const DfgTable& SharedDfgTable();

// Makes one. The same bits on every instruction set and thread count.
void ComputeDfgTable(DfgTable* table);

}  // namespace facet
