// The directional albedo of the specular lobe where the surface is rougher along the tangent than across it.
#pragma once

namespace facet {

// Directional albedo of single-scattering anisotropic GGX with height-correlated Smith (KHR_materials_anisotropy:
// alpha_b is the square of perceptual roughness, alpha_t = mix(alpha_b, 1, strength^2)): F0 * A + F90 * B with
// Schlick's Fresnel, as in the DfgTable. lighting-inl.h reads it with linear interpolation in four variables:
//    perceptual roughness   rows, evenly spaced in its square root;
//    strength               layers, evenly spaced;
//    n_dot_v                columns, evenly spaced in its fourth root u;
//    azimuth of the view    turns, evenly spaced in y = (n_dot_v^2 + t_dot_v^2)^(1/8) between u, across the tangent,
//    and
//                           1, along it.
// The eighth power of y is the squared length of the view projected to the plane of the normal and the tangent. A very
// anisotropic surface is a set of grooves: it is seen as steeply as that projection says, so that at grazing views A
// and B change most where t_dot_v is about as small as n_dot_v. A parabola in the squared sine of the azimuth would be
// off by 0.25 there.
//
// The error of A + B is below 0.006 at 800 views, roughnesses from 0.1 on and strengths, and 0.0011 in the root mean
// square; that of B is below 0.01 (measured in tests/light off the samples, against integration over other variables).
// White metals and dielectrics reflect 0.9957 to 1.0041 of the light of a white hemisphere (tests/material). The table
// takes 480 KB, and about 50 ms on one core with AVX2 (100 ms with SSE4).
struct AnisotropicDfgTable {
  static constexpr int kRows = 16;
  static constexpr int kLayers = 12;
  static constexpr int kTurns = 16;
  static constexpr int kColumns = 20;
  static constexpr float kFirstRow = 0.212f;              // square root of its perceptual roughness
  float albedo[kRows * kLayers * kTurns * kColumns * 2];  // A, B at [row][layer][turn][column]
  // A, B averaged over the hemisphere, at [row][layer]. The integral is that of the interpolated table, so that
  // multiple scattering returns exactly the energy that single scattering loses.
  float average[kRows * kLayers * 2];
};

// The table that all renderers share, computed at the first call. Thread-safe.
const AnisotropicDfgTable& SharedAnisotropicDfgTable();

// Computes a table, with the same bits on every instruction set and for any number of threads.
void ComputeAnisotropicDfgTable(AnisotropicDfgTable* table);

}  // namespace facet
