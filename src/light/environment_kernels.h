// The SIMD kernels of environment prefiltering. Each fills one row of an octahedral map, which has size + 1 texels as
// in EnvironmentMap::Level; `row` is in [0, size].
#pragma once

#include <cstdint>

namespace facet {

// Resamples an equirectangular image of 4-float pixels, with 2 x 2 samples per texel. The fourth component of each
// texel becomes the solid angle of a cell at that position.
struct OctahedronRowTask {
  const float* image;
  std::int32_t image_width, image_height;
  std::int32_t size, row;
  float* out;
};
void FillOctahedronRow(const OctahedronRowTask& task);

// One sample direction of a lobe about +Z, and the level of the chain to read it from.
struct LobeSample {
  float x, y, z;
  float weight;          // the weights of a lobe sum to 1
  // The level of the chain (see environment.cc) whose texels are about as large as the sample's share of the lobe: size
  // x size texels at cell centres, with a border of one texel.
  std::int32_t size;
  std::int32_t origin;  // the offset of its texel (0, 0), in floats
};

// Computes, for the direction of each texel, the weighted mean of the chain `texels` over the samples of a lobe.
struct LobeRowTask {
  const float* texels;
  const LobeSample* samples;
  std::int32_t sample_count;
  std::int32_t size, row;
  float* out;
};
void FilterLobeRow(const LobeRowTask& task);

// A cell of the small map that ConvolveRow() integrates over.
struct SourceTexel {
  float x, y, z;                    // unit: the direction of its light, the centroid weighted by radiance
  float center_x, center_y, center_z;  // unit: the centroid of its area
  float solid_angle;
  float r, g, b;  // radiance * solid angle
};

constexpr int kConvolvedLobes = 4;

// Computes the same row of five maps at once. They are means of the source, weighted by n_dot_l D(h; alpha[k]) with h
// half-way between n and l; the last is weighted by n_dot_l only, which is also the lobe of alpha 1.
struct ConvolveRowTask {
  const SourceTexel* source;
  std::int32_t source_count;
  float alpha[kConvolvedLobes];
  std::int32_t size, row;
  float* out[kConvolvedLobes + 1];
};
void ConvolveRow(const ConvolveRowTask& task);

}  // namespace facet
