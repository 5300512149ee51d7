// The features of its shading model that a material uses. Others are disabled and cost nothing.
#pragma once

#include <cstdint>

#include "facet/scene.h"

namespace facet {

// Bits of a mask. A clear bit means that the image without the feature is the same, bit for bit. The low bits belong to
// the texture slots (BitOf() in material/slots.h).
enum MaterialFeature : std::uint64_t {
  kFirstFeature = std::uint64_t{1} << 40,
  kEmission = kFirstFeature << 0,    // emissive factor and strength are not both zero
  kLit = kFirstFeature << 1,         // the model reads light; never for points and lines without normals
  kAlphaTest = kFirstFeature << 2,   // MASK
  kAlphaBlend = kFirstFeature << 3,  // BLEND
  kDoubleSided = kFirstFeature << 4,
  kDiffuseLobe = kFirstFeature << 5,  // it is not purely metallic
  // Extensions whose factors make them visible.
  kClearcoat = kFirstFeature << 6,
  kSheen = kFirstFeature << 7,
  kSpecular = kFirstFeature << 8,
  kIor = kFirstFeature << 9,
  kTransmission = kFirstFeature << 10,
  kVolume = kFirstFeature << 11,
  kDispersion = kFirstFeature << 12,
  kDiffuseTransmission = kFirstFeature << 13,
  kIridescence = kFirstFeature << 14,
  kAnisotropy = kFirstFeature << 15,
  kTangents = kFirstFeature << 16,  // a model that is not glTF's needs tangents without a texture
  kFlakes = kFirstFeature << 17,    // of the model "enterprise": they lie where TEXCOORD_0 says
};
using MaterialFeatures = std::uint64_t;

// Those with which a material needs more than the closure of core glTF. Kernels without them are compiled on their own,
// so that simple materials do not pay for branches and registers of the others.
inline constexpr MaterialFeatures kLayerFeatures = kClearcoat | kSheen | kSpecular | kIor | kTransmission | kVolume |
                                                   kDispersion | kDiffuseTransmission | kIridescence | kAnisotropy;

// The features of a material. Textures whose factor makes them invisible (an emissive texture with factor 0, occlusion
// of strength 0) are not included, nor those that an unlit material ignores. A normal texture is included for any
// scale. `on_surface`: false for points and lines without normals, which show only base colour and emission (glTF 2.0
// specification, 3.9.6).
MaterialFeatures FeaturesOf(const Material& material, bool on_surface = true);

}  // namespace facet
