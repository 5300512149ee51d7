// What of its model a given material uses: the rest costs nothing.
#pragma once

#include <cstdint>

#include "facet/scene.h"

namespace facet {

// Bits of a mask. A bit that is clear means that leaving the feature out gives the same picture, bit for bit. The low
// bits belong to the texture slots (BitOf() in material/slots.h).
enum MaterialFeature : std::uint64_t {
  kFirstFeature = std::uint64_t{1} << 40,
  kEmission = kFirstFeature << 0,  // emissive factor and strength are not both zero
  kLit = kFirstFeature << 1,  // the model reads light, and there is a surface: not points and lines without normals
  kAlphaTest = kFirstFeature << 2,   // MASK
  kAlphaBlend = kFirstFeature << 3,  // BLEND
  kDoubleSided = kFirstFeature << 4,
  kDiffuseLobe = kFirstFeature << 5,  // not all of it is metal
  kLobes = kDiffuseLobe,              // all of a closure's that a material may lack
};
using MaterialFeatures = std::uint64_t;

// Textures whose factor makes them invisible (an emissive texture with factor 0, occlusion of strength 0) are not
// counted, nor those that an unlit material ignores. A normal texture counts whatever its scale.
// `on_surface`: false for points and lines without normals, which show base colour and emission (glTF 2.0
// specification, 3.9.6).
MaterialFeatures FeaturesOf(const Material& material, bool on_surface = true);

}  // namespace facet
