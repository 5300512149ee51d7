// The table of texture slots: all that differs from one texture of a material to the next. Whatever does something with
// every texture (the loader, validation, the plan, decoding, the shaders, the reference, `explain` and `info`) loops
// over it, so that a new texture is a new row, the parameter that it scales, and the line of the model that reads it.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "facet/scene.h"
#include "facet/settings.h"
#include "image/channels.h"
#include "material/features.h"

namespace facet {

enum class Slot : std::uint8_t { BaseColor, MetallicRoughness, Normal, Occlusion, Emissive };

struct SlotInfo {
  Slot slot;
  const char* name;        // in messages
  const char* word;        // in the output of `facet explain`
  const char* key;         // in the output of `facet info`
  const char* gltf_group;  // the object within a glTF material that has the texture; null: the material itself
  const char* gltf_name;
  TextureRef Material::*ref;
  TextureRole role;
  int channels;            // that are read: ChannelMask
  bool alpha_is_coverage;  // opaque materials do not read alpha
  bool needs_light;        // only what is lit reads it
  bool tangent_space;
  // A white texture changes nothing: factors are multiplied by it. (No texel of 8 or 16 bits is exactly the normal that
  // changes nothing.)
  bool white_is_neutral;
  Feature feature;  // what switches it off
  // Whether the parameters that the texture scales let it be seen.
  bool (*is_visible)(const Material&);
};

inline bool Emits(const Material& m) { return m.emissive_strength != 0.0f && m.emissive_factor != glm::vec3(0.0f); }

inline constexpr auto kSlots = std::to_array<SlotInfo>({
    {Slot::BaseColor, "base colour texture", "base-color", "base_color", "pbrMetallicRoughness", "baseColorTexture",
     &Material::base_color_texture, TextureRole::Color, kRgba, /*alpha_is_coverage=*/true, /*needs_light=*/false,
     /*tangent_space=*/false, /*white_is_neutral=*/true, Feature::BaseColorTexture,
     [](const Material&) { return true; }},
    {Slot::MetallicRoughness, "metallic-roughness texture", "metallic-roughness", "metallic_roughness",
     "pbrMetallicRoughness", "metallicRoughnessTexture", &Material::metallic_roughness_texture, TextureRole::Data,
     kG | kB, /*alpha_is_coverage=*/false, /*needs_light=*/true, /*tangent_space=*/false, /*white_is_neutral=*/true,
     Feature::MetallicRoughnessTexture,
     [](const Material& m) { return m.metallic_factor != 0.0f || m.roughness_factor != 0.0f; }},
    {Slot::Normal, "normal texture", "normal", "normal", nullptr, "normalTexture", &Material::normal_texture,
     TextureRole::Data, kRgb, /*alpha_is_coverage=*/false, /*needs_light=*/true, /*tangent_space=*/true,
     /*white_is_neutral=*/false, Feature::NormalTexture, [](const Material&) { return true; }},
    {Slot::Occlusion, "occlusion texture", "occlusion", "occlusion", nullptr, "occlusionTexture",
     &Material::occlusion_texture, TextureRole::Data, kR, /*alpha_is_coverage=*/false, /*needs_light=*/true,
     /*tangent_space=*/false, /*white_is_neutral=*/true, Feature::Occlusion,
     [](const Material& m) { return m.occlusion_strength != 0.0f; }},
    {Slot::Emissive, "emissive texture", "emission", "emissive", nullptr, "emissiveTexture",
     &Material::emissive_texture, TextureRole::Color, kRgb, /*alpha_is_coverage=*/false, /*needs_light=*/false,
     /*tangent_space=*/false, /*white_is_neutral=*/true, Feature::Emission, Emits},
});
inline constexpr std::size_t kSlotCount = kSlots.size();

constexpr std::size_t IndexOf(Slot slot) { return static_cast<std::size_t>(slot); }
constexpr const SlotInfo& InfoOf(Slot slot) { return kSlots[IndexOf(slot)]; }

// Of MaterialFeatures: the texture is read.
constexpr MaterialFeatures BitOf(Slot slot) { return MaterialFeatures{1} << IndexOf(slot); }
inline constexpr MaterialFeatures kTextureBits = (MaterialFeatures{1} << kSlotCount) - 1;
static_assert(kTextureBits < kFirstFeature);
// Of those textures that are read in tangent space, for which surfaces need tangents.
inline constexpr MaterialFeatures kTangentSpaceBits = [] {
  MaterialFeatures bits = 0;
  for (const SlotInfo& slot : kSlots) bits |= slot.tangent_space ? BitOf(slot.slot) : 0;
  return bits;
}();
static_assert(
    [] {
      for (std::size_t i = 0; i < kSlotCount; ++i) {
        if (IndexOf(kSlots[i].slot) != i) return false;
      }
      return true;
    }(),
    "rows stand in the order of Slot");

// Calls body(Slot) for each texture whose bit is set, in the order of the table.
template <class Body>
constexpr void ForEachSlot(MaterialFeatures features, const Body& body) {
  for (MaterialFeatures left = features & kTextureBits; left != 0; left &= left - 1) {
    body(static_cast<Slot>(std::countr_zero(left)));
  }
}

}  // namespace facet
