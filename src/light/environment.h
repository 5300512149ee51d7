// Image-based lighting: environments, prefiltered for shading.
//
// An equirectangular image shows at column u in [0, 1) and row v in [0, 1] (top row first) the direction with u = 0.5 +
// atan2(z, x) / (2 pi),  v = acos(y) / pi  (world axes, +Y up). Its centre lies towards +X, its left and right edges
// towards -X; +Z is at u = 0.75. This is the same as three.js's equirectUv.
//
// Maps are octahedral (Praun and Hoppe, 1999, Spherical Parametrization and Remeshing; Engelhardt and Dachsbacher,
// 2008, Octahedron Environment Maps): a direction d is divided by |x| + |y| + |z|; its x and z are the square's
// coordinates, and where y < 0 the corners are folded over. Texels lie at the nodes of a grid that reaches from edge to
// edge, not at the centres of its cells. The octahedron's edges, where the map has a crease, then pass through texels,
// and bilinear filtering is exact on them (with texels at cell centres, a 32 x 32 map of half a sky has errors of 1.6 %
// along the edges); and no borders are needed.
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

  // One octahedral map of size x size cells: texel (i, j), both in [0, size], begins at texels[offset + (j * (size + 1)
  // + i) * 4].
  struct Level {
    std::int32_t size = 0;  // a power of two
    std::int32_t offset = 0;
  };

  // Level k is the radiance reflected by a surface of perceptual roughness k / (kLevels - 1): prefiltered with the GGX
  // lobe, with view and normal along the reflection (Karis, 2013, Real Shading in Unreal Engine 4). Level 0 is the
  // image itself.
  Level levels[kLevels];
  // Offsets and sizes of the levels once more, as arrays that lanes gather from.
  std::int32_t level_offset[kLevels] = {};
  float level_size[kLevels] = {};
  // Irradiance divided by pi, which is the cosine-weighted mean of the radiance.
  Level irradiance;

  PageVector<float> texels;        // RGB and one unused component
  // The image itself, RGB and one unused component, for a sharp background; empty unless it was asked for.
  PageVector<float> image;
  std::int32_t image_width = 0, image_height = 0;

  // How many components of the image were not finite, negative or absurdly large (see ToLinearRgb32F).
  std::size_t repaired_values = 0;

  // Pointers into the vectors above, for kernels.
  const float* texel_data = nullptr;
  const float* image_data = nullptr;

  EnvironmentMap() = default;
  EnvironmentMap(const EnvironmentMap&) = delete;
  EnvironmentMap& operator=(const EnvironmentMap&) = delete;
};

struct EnvironmentOptions {
  bool keep_image = false;    // for Background()
  int max_size = 1024;        // of level 0; a power of two, 64 at least
  int samples = 24;           // for the narrowest lobe
  IrradianceMethod irradiance = IrradianceMethod::Convolution;
  friend auto operator<=>(const EnvironmentOptions&, const EnvironmentOptions&) = default;
};

// Prefilters an equirectangular image (of any type, encoding and channel count; alpha is ignored). Runs in parallel,
// with the same bits on every instruction set and for any number of threads. Components that are negative or not finite
// count as 0. Throws Error: InvalidUsage for a broken Image, OutOfMemory for one beyond the limits of decoded images
// (image/codec.h).
std::shared_ptr<const EnvironmentMap> PrefilterEnvironment(const Image& equirectangular,
                                                           const EnvironmentOptions& options = {});

// The size of level 0, in cells, for an image of this width under the limit options.max_size.
std::int32_t SharpestLevelSize(std::int32_t image_width, std::int32_t max_size);

// Lays out the levels of a map one after the other, beginning with level 0 of size `base`, then the irradiance, and
// allocates black texels.
void LayOutLevels(std::int32_t base, EnvironmentMap& map);

// The same without the texels; returns their size in floats.
std::size_t AssignLevels(std::int32_t base, EnvironmentMap& map);

// The version of the prefiltering arithmetic, by which cached maps of other versions are ignored. It must be raised
// with every change of PrefilterEnvironment(), the arithmetic that it uses, or an image decoder that changes a bit of
// any map. A test fails if the prefiltered bits of a float image change.
inline constexpr std::uint32_t kEnvironmentArithmetic = 1;

}  // namespace facet
