// The lane work of preparing an environment. Rows of octahedral squares are those of EnvironmentMap::Level: size + 1
// texels; `row` is in [0, size].
#pragma once

#include <cstdint>

namespace facet {

// A row from an equirectangular picture of 4-float pixels; 2 x 2 samples a texel. The fourth number of each texel is
// the solid angle that a cell has there.
struct OctahedronRowTask {
  const float* picture;
  std::int32_t picture_width, picture_height;
  std::int32_t size, row;
  float* out;
};
void FillOctahedronRow(const OctahedronRowTask& task);

// One direction of a lobe about +Z, and where to read it.
struct LobeSample {
  float x, y, z;
  float weight;          // they add up to 1
  // The square that is read, of cells about as large as the sample's share. Of the chain that environment.cc describes:
  // size x size texels in the middle of cells, and a border of one texel.
  std::int32_t size;
  std::int32_t origin;  // of its texel (0, 0), in floats
};

// A row: for each texel's direction the weighted mean of the chain `texels` over the lobe.
struct LobeRowTask {
  const float* texels;
  const LobeSample* samples;
  std::int32_t sample_count;
  std::int32_t size, row;
  float* out;
};
void FilterLobeRow(const LobeRowTask& task);

// A cell of the source of ConvolveRow.
struct SourceTexel {
  float x, y, z;                    // unit: where its light comes from, the centroid of what it shines
  float center_x, center_y, center_z;  // unit: the centroid of its area
  float solid_angle;
  float r, g, b;  // radiance * solid angle
};

constexpr int kConvolvedLobes = 4;

// The same row of five squares at once: means of the source weighted by n_dot_l D(h; alpha[k]), with h between n and l,
// and, as the last of them, by n_dot_l alone, which is a lobe of alpha 1 as well.
struct ConvolveRowTask {
  const SourceTexel* source;
  std::int32_t source_count;
  float alpha[kConvolvedLobes];
  std::int32_t size, row;
  float* out[kConvolvedLobes + 1];
};
void ConvolveRow(const ConvolveRowTask& task);

}  // namespace facet
