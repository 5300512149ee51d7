// What of the material model a given material uses: the rest costs nothing.
#pragma once

#include <cstdint>

#include "facet/scene.h"

namespace facet {

// Bits of a mask. A bit that is clear means that leaving the feature out gives the same picture, bit for bit.
enum MaterialFeature : std::uint32_t {
  kBaseColorTexture = 1u << 0,
  kMetallicRoughnessTexture = 1u << 1,
  kNormalTexture = 1u << 2,
  kOcclusionTexture = 1u << 3,
  kEmissiveTexture = 1u << 4,
  kEmission = 1u << 5,    // emissive factor and strength are not both zero
  kLit = 1u << 6,         // not KHR_materials_unlit, nor points and lines without normals
  kAlphaTest = 1u << 7,   // MASK
  kAlphaBlend = 1u << 8,  // BLEND
  kDoubleSided = 1u << 9,
};
using MaterialFeatures = std::uint32_t;

// Textures whose factor makes them invisible (an emissive texture with factor 0, occlusion of strength 0) are not
// counted, nor those that an unlit material ignores. A normal texture counts whatever its scale.
// `on_surface`: false for points and lines without normals, which show base colour and emission (glTF 2.0
// specification, 3.9.6).
MaterialFeatures FeaturesOf(const Material& material, bool on_surface = true);

}  // namespace facet
