// The table of texture slots: everything in which the textures of a material differ. All code that handles every
// texture (the loader, validation, the plan, decoding, the shaders, the reference, `explain` and `info`) loops over it.
// A new texture is therefore a new row, the parameter that it scales, and the line of the shading model that reads it.
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
  int channels;            // those that are read: bits of ChannelMask
  bool alpha_is_coverage;  // alpha is not read for opaque materials
  bool needs_light;        // read for lit materials only
  bool tangent_space;
  // Whether a white texture has no effect because it is a factor. (For normal textures there is no such texel: none of
  // 8 or 16 bits is exactly the unperturbed normal.)
  bool white_is_neutral;
  Feature feature;  // the feature that disables it
  // Whether the parameters that the texture scales make it visible.
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

// The bit of MaterialFeatures that says that the texture is read.
constexpr MaterialFeatures BitOf(Slot slot) { return MaterialFeatures{1} << IndexOf(slot); }
inline constexpr MaterialFeatures kTextureBits = (MaterialFeatures{1} << kSlotCount) - 1;
static_assert(kTextureBits < kFirstFeature);
// The bits of the textures that are in tangent space, so that surfaces need tangents.
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

// Features that a factor states, with or without the texture that it scales.
struct FactorFeature {
  MaterialFeatures bit;
  Slot slot;         // its texture: its row says which feature it is, who reads it, and when it is visible
  const char* name;  // in messages, like the next
  const char* why_none;
  bool (*is_stated)(const Material&);
  void (*disable)(Material&);
};
inline constexpr auto kFactorFeatures = std::to_array<FactorFeature>({
    {kEmission, Slot::Emissive, "emission", "no drawn material emits",
     [](const Material& m) { return m.emissive_factor != glm::vec3(0.0f); },
     [](Material& m) { m.emissive_factor = glm::vec3(0.0f); }},
});

// Calls body(Slot) for each texture whose bit is set, in the order of the table.
template <class Body>
constexpr void ForEachSlot(MaterialFeatures features, const Body& body) {
  for (MaterialFeatures left = features & kTextureBits; left != 0; left &= left - 1) {
    body(static_cast<Slot>(std::countr_zero(left)));
  }
}

}  // namespace facet
