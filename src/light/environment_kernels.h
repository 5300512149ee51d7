// The lane work of preparing an environment. Layout of octahedral squares: see environment.h.
#pragma once

#include <cstdint>

namespace facet {

// Row `row` of a square of `size` texels, from an equirectangular picture of 4-float pixels; 2 x 2 samples a texel. The
// fourth number of each texel is its solid angle.
struct OctahedronRowTask {
  const float* picture;
  std::int32_t picture_width, picture_height;
  std::int32_t size, row;
  float* out;  // of texel (0, row)
};
void FillOctahedronRow(const OctahedronRowTask& task);

// One direction of a lobe about +Z, and where to read it.
struct LobeSample {
  float x, y, z;
  float weight;          // they add up to 1
  std::int32_t size;     // of the square that is read: a level whose texels are about as large as the sample's share
  std::int32_t origin;   // of its texel (0, 0), in floats
};

// Row `row` of a square of `size` texels: for each texel's direction the weighted mean of `texels` over the lobe.
struct LobeRowTask {
  const float* texels;
  const LobeSample* samples;
  std::int32_t sample_count;
  std::int32_t size, row;
  float* out;
};
void FilterLobeRow(const LobeRowTask& task);

// One texel of the source of ConvolveRow: direction and radiance, weighted by solid angle.
struct SourceTexel {
  float x, y, z;
  float solid_angle;
  float r, g, b;  // radiance * solid angle
};

constexpr int kMaxConvolutions = 5;

// Row `row` of up to five squares of `size` texels at once. Square k is the mean of the source, weighted by
// n_dot_l D(h; alpha[k]) with h between n and l, or by n_dot_l alone where alpha[k] is 0.
struct ConvolveRowTask {
  const SourceTexel* source;
  std::int32_t source_count;
  std::int32_t count;
  float alpha[kMaxConvolutions];
  std::int32_t size, row;
  float* out[kMaxConvolutions];
};
void ConvolveRow(const ConvolveRowTask& task);

}  // namespace facet
