// Light from all around, prepared for shading.
//
// Directions and pictures: an equirectangular picture's column u in [0, 1) and row v in [0, 1] (top row first) show the
// direction with  u = 0.5 + atan2(z, x) / (2 pi),  v = acos(y) / pi  (world axes, +Y up). Its centre lies towards +X,
// its left and right edges towards -X; +Z is at u = 0.75. Same as three.js's equirectUv.
//
// Maps are octahedral (Praun and Hoppe, 1999, Spherical Parametrization and Remeshing; Engelhardt and Dachsbacher,
// 2008, Octahedron Environment Maps): a direction d is divided by |x| + |y| + |z|; its x and z are the square's
// coordinates, and where y < 0 the corners are folded over. Texels stand at the nodes of a grid that reaches from edge
// to edge, not in the middle of its cells: the octahedron's edges, where the map has a crease, then run through texels,
// and bilinear reading is exact there (half a texel off, a 32 x 32 map of half a sky shows 1.6 % errors along them);
// nor are borders needed.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/pages.h"
#include "facet/image.h"
#include "facet/settings.h"

namespace facet {

struct EnvironmentMap {
  static constexpr int kLevels = 9;
  static constexpr int kIrradianceSize = 32;

  // One octahedral square of size x size cells: texel (i, j), both in [0, size], stands at
  // texels[offset + (j * (size + 1) + i) * 4].
  struct Level {
    std::int32_t size = 0;  // a power of two
    std::int32_t offset = 0;
  };

  // Level k is the radiance that a mirror of perceptual roughness k / (kLevels - 1) shows: GGX-prefiltered with view
  // and normal along the reflection (Karis, 2013, Real Shading in Unreal Engine 4). Level 0 is the picture itself.
  Level levels[kLevels];
  // The same for lanes, as they are gathered.
  std::int32_t level_offset[kLevels] = {};
  float level_size[kLevels] = {};
  // Irradiance divided by pi: the mean of radiance, weighted by the cosine.
  Level irradiance;

  PageVector<float> texels;        // RGB and one unused number
  // The picture itself, RGB and one unused number, for a sharp background; empty unless asked for.
  PageVector<float> picture;
  std::int32_t picture_width = 0, picture_height = 0;

  // Numbers of the input that were not finite, negative or absurdly large (see ToLinearRgb32F).
  std::size_t repaired_values = 0;

  // As kernels read it; into the vectors above.
  const float* texel_data = nullptr;
  const float* picture_data = nullptr;

  EnvironmentMap() = default;
  EnvironmentMap(const EnvironmentMap&) = delete;
  EnvironmentMap& operator=(const EnvironmentMap&) = delete;
};

struct EnvironmentOptions {
  bool keep_picture = false;  // for Background()
  int max_size = 1024;        // of level 0, a power of two of 64 at least; the default suits pictures of 2048 x 1024 and more
  int samples = 24;           // of the narrowest lobe
  IrradianceMethod irradiance = IrradianceMethod::Convolution;
  friend auto operator<=>(const EnvironmentOptions&, const EnvironmentOptions&) = default;
};

// Prepares an equirectangular picture (any type, encoding and channel count; alpha is ignored). Runs in parallel; the
// same bits on every instruction set and thread count. Numbers that are not finite or negative count as 0. Throws
// Error: InvalidUsage for an image that breaks its own rules, OutOfMemory for one beyond the limits of decoded pictures
// (image/codec.h).
std::shared_ptr<const EnvironmentMap> PrefilterEnvironment(const Image& equirectangular,
                                                           const EnvironmentOptions& options = {});

// What that takes from options.max_size for a picture: texels along level 0.
std::int32_t SharpestLevelSize(std::int32_t picture_width, std::int32_t max_size);

// The first step of that: where the levels stand, sharpest of `base` texels, one after the other, then the irradiance;
// all black.
void LayOutLevels(std::int32_t base, EnvironmentMap& map);

// The same without texels; returns how many floats they are.
std::size_t PlaceLevels(std::int32_t base, EnvironmentMap& map);

// To be raised with every change to PrefilterEnvironment(), the arithmetic below it, or a decoder of pictures that
// changes a bit of any map: what was kept by another number is not used. A test fails when the bits change that the
// preparation of a float picture has.
inline constexpr std::uint32_t kEnvironmentArithmetic = 1;

}  // namespace facet
