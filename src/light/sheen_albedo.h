// The directional albedo of the sheen lobe (material/lobes/sheen-inl.h) of colour 1.
#pragma once

namespace facet {

// E(n_dot_v, perceptual roughness): the share of the light of a white hemisphere that D V reflects to the viewer. It
// exceeds 1 at grazing views of smooth sheen; the lobe bounds it. lighting-inl.h reads it with bilinear interpolation.
//
// Columns are evenly spaced in the fourth root of n_dot_v, from kMinNDotV on, and rows in the fourth root of perceptual
// roughness, from kMinSheenRoughness on, because E changes most at grazing views and on smooth sheen. The error of E,
// relative where E is above 1, is below 0.0021 everywhere, and 0.0004 in the root mean square (measured in tests/light
// halfway between the samples, against quadrature).
struct SheenTable {
  static constexpr int kColumns = 48;
  static constexpr int kRows = 48;
  static constexpr float kFirstColumn = 0.1f;  // fourth root of the first column's n_dot_v
  static constexpr float kFirstRow = 0.514f;   // fourth root of the first row's perceptual roughness
  // E at [row][column] and at [row + 1][column], so that all four samples around a point are adjacent in memory.
  float albedo[(kRows - 1) * kColumns * 2];
};

// The table that all renderers share, computed at the first call. Thread-safe.
const SheenTable& SharedSheenTable();

// The same for the fibres of the model "filament" (material/models/filament/terms-inl.h).
const SheenTable& SharedClothTable();

// Computes a table, with the same bits on every instruction set and for any number of threads.
void ComputeSheenTable(SheenTable* table);

// E by quadrature, to 2e-5. `n_dot_v`: in (0, 1]; `perceptual_roughness`: in [kMinSheenRoughness, 1], to which it is
// not clamped.
double IntegrateSheenAlbedo(double n_dot_v, double perceptual_roughness);
double IntegrateClothAlbedo(double n_dot_v, double perceptual_roughness);

}  // namespace facet
