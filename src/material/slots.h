// The table of texture slots: everything in which the textures of a material differ. All code that handles every
// texture (the loader, validation, the plan, decoding, the shaders, the reference, `explain` and `info`) loops over it.
// A new texture is therefore a new row, the parameter that it scales, and the line of the shading model that reads it.
// Models that are not glTF's have slots of their own (SlotsOf() in material/model_parameters.h).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "facet/scene.h"
#include "facet/settings.h"
#include "image/channels.h"
#include "material/features.h"

namespace facet {

enum class Slot : std::uint8_t {
  BaseColor,
  MetallicRoughness,
  Normal,
  Occlusion,
  Emissive,
  Clearcoat,
  ClearcoatRoughness,
  ClearcoatNormal,
  SheenColor,
  SheenRoughness,
  Specular,
  SpecularColor,
  Transmission,
  Thickness,
  DiffuseTransmission,
  DiffuseTransmissionColor,
  Iridescence,
  IridescenceThickness,
  Anisotropy,
  SpecularGlossiness,
};

struct SlotInfo {
  Slot slot;
  const char* name;        // in messages
  const char* word;        // in the output of `facet explain`
  const char* key;         // in the output of `facet info`
  const char* gltf_group;  // the object within a glTF material that has the texture; null: the material itself
  const char* gltf_name;
  TextureRef Material::*ref;  // null: of a model that is not glTF's
  TextureRole role;
  int channels;     // those that are read: bits of ChannelMask
  Feature feature;  // the feature that disables it
  // Whether the parameters that the texture scales make it visible.
  bool (*is_visible)(const Material&);
  bool alpha_is_coverage = false;  // alpha is not read for opaque materials
  bool needs_light = true;         // read for lit materials only
  bool tangent_space = false;
  // Whether a white texture has no effect because it is a factor. (For normal textures there is no such texel: none of
  // 8 or 16 bits is exactly the unperturbed normal.)
  bool white_is_neutral = true;
};

// --- Which parameters make a feature visible ------------------------------------------------------------------------

inline bool Emits(const Material& m) { return m.emissive_strength != 0.0f && m.emissive_factor != glm::vec3(0.0f); }
inline bool IsMetal(const Material& m) {
  return m.model == ShadingModel::MetallicRoughness && m.metallic_factor == 1.0f && !m.metallic_roughness_texture;
}
inline bool HasClearcoat(const Material& m) { return m.clearcoat_factor != 0.0f; }
inline bool HasSheen(const Material& m) { return m.sheen_color_factor != glm::vec3(0.0f); }
inline bool HasSpecular(const Material& m) {
  const bool is_default = m.specular_factor == 1.0f && m.specular_color_factor == glm::vec3(1.0f);
  return !IsMetal(m) && (!is_default || m.specular_texture || m.specular_color_texture);
}
inline bool HasIor(const Material& m) { return !IsMetal(m) && m.ior != 1.5f; }
inline bool Transmits(const Material& m) { return !IsMetal(m) && m.transmission_factor != 0.0f; }
inline bool TransmitsDiffusely(const Material& m) { return !IsMetal(m) && m.diffuse_transmission_factor != 0.0f; }
// Only light that passes the surface is absorbed, and only what is seen through it is refracted.
inline bool HasVolume(const Material& m) {
  return m.thickness_factor != 0.0f && (Transmits(m) || TransmitsDiffusely(m));
}
inline bool Disperses(const Material& m) { return m.thickness_factor != 0.0f && Transmits(m) && m.dispersion != 0.0f; }
inline bool IsIridescent(const Material& m) { return m.iridescence_factor != 0.0f; }
inline bool IsAnisotropic(const Material& m) { return m.anisotropy_strength != 0.0f; }

// --- The table ------------------------------------------------------------------------------------------------------

inline constexpr auto kSlots = std::to_array<SlotInfo>({
    {Slot::BaseColor, "base colour texture", "base-color", "base_color", "pbrMetallicRoughness", "baseColorTexture",
     &Material::base_color_texture, TextureRole::Color, kRgba, Feature::BaseColorTexture,
     [](const Material&) { return true; }, /*alpha_is_coverage=*/true, /*needs_light=*/false},
    {Slot::MetallicRoughness, "metallic-roughness texture", "metallic-roughness", "metallic_roughness",
     "pbrMetallicRoughness", "metallicRoughnessTexture", &Material::metallic_roughness_texture, TextureRole::Data,
     kG | kB, Feature::MetallicRoughnessTexture,
     [](const Material& m) { return m.metallic_factor != 0.0f || m.roughness_factor != 0.0f; }},
    {Slot::Normal, "normal texture", "normal", "normal", nullptr, "normalTexture", &Material::normal_texture,
     TextureRole::Data, kRgb, Feature::NormalTexture, [](const Material&) { return true; },
     /*alpha_is_coverage=*/false, /*needs_light=*/true, /*tangent_space=*/true, /*white_is_neutral=*/false},
    {Slot::Occlusion, "occlusion texture", "occlusion", "occlusion", nullptr, "occlusionTexture",
     &Material::occlusion_texture, TextureRole::Data, kR, Feature::Occlusion,
     [](const Material& m) { return m.occlusion_strength != 0.0f; }},
    {Slot::Emissive, "emissive texture", "emission", "emissive", nullptr, "emissiveTexture",
     &Material::emissive_texture, TextureRole::Color, kRgb, Feature::Emission, Emits, /*alpha_is_coverage=*/false,
     /*needs_light=*/false},
    {Slot::Clearcoat, "clear coat texture", "clearcoat", "clearcoat", "KHR_materials_clearcoat", "clearcoatTexture",
     &Material::clearcoat_texture, TextureRole::Data, kR, Feature::Clearcoat, HasClearcoat},
    {Slot::ClearcoatRoughness, "clear coat roughness texture", "clearcoat-roughness", "clearcoat_roughness",
     "KHR_materials_clearcoat", "clearcoatRoughnessTexture", &Material::clearcoat_roughness_texture, TextureRole::Data,
     kG, Feature::Clearcoat, [](const Material& m) { return HasClearcoat(m) && m.clearcoat_roughness_factor != 0.0f; }},
    {Slot::ClearcoatNormal, "clear coat normal texture", "clearcoat-normal", "clearcoat_normal",
     "KHR_materials_clearcoat", "clearcoatNormalTexture", &Material::clearcoat_normal_texture, TextureRole::Data, kRgb,
     Feature::Clearcoat, HasClearcoat, /*alpha_is_coverage=*/false, /*needs_light=*/true, /*tangent_space=*/true,
     /*white_is_neutral=*/false},
    {Slot::SheenColor, "sheen colour texture", "sheen-color", "sheen_color", "KHR_materials_sheen", "sheenColorTexture",
     &Material::sheen_color_texture, TextureRole::Color, kRgb, Feature::Sheen, HasSheen},
    {Slot::SheenRoughness, "sheen roughness texture", "sheen-roughness", "sheen_roughness", "KHR_materials_sheen",
     "sheenRoughnessTexture", &Material::sheen_roughness_texture, TextureRole::Data, kA, Feature::Sheen,
     [](const Material& m) { return HasSheen(m) && m.sheen_roughness_factor != 0.0f; }},
    {Slot::Specular, "specular texture", "specular", "specular", "KHR_materials_specular", "specularTexture",
     &Material::specular_texture, TextureRole::Data, kA, Feature::Specular,
     [](const Material& m) { return !IsMetal(m) && m.specular_factor != 0.0f; }},
    {Slot::SpecularColor, "specular colour texture", "specular-color", "specular_color", "KHR_materials_specular",
     "specularColorTexture", &Material::specular_color_texture, TextureRole::Color, kRgb, Feature::Specular,
     [](const Material& m) {
       return !IsMetal(m) && m.specular_factor != 0.0f && m.specular_color_factor != glm::vec3(0.0f);
     }},
    {Slot::Transmission, "transmission texture", "transmission", "transmission", "KHR_materials_transmission",
     "transmissionTexture", &Material::transmission_texture, TextureRole::Data, kR, Feature::Transmission, Transmits},
    {Slot::Thickness, "thickness texture", "thickness", "thickness", "KHR_materials_volume", "thicknessTexture",
     &Material::thickness_texture, TextureRole::Data, kG, Feature::Volume, HasVolume},
    {Slot::DiffuseTransmission, "diffuse transmission texture", "diffuse-transmission", "diffuse_transmission",
     "KHR_materials_diffuse_transmission", "diffuseTransmissionTexture", &Material::diffuse_transmission_texture,
     TextureRole::Data, kA, Feature::DiffuseTransmission, TransmitsDiffusely},
    {Slot::DiffuseTransmissionColor, "diffuse transmission colour texture", "diffuse-transmission-color",
     "diffuse_transmission_color", "KHR_materials_diffuse_transmission", "diffuseTransmissionColorTexture",
     &Material::diffuse_transmission_color_texture, TextureRole::Color, kRgb, Feature::DiffuseTransmission,
     [](const Material& m) { return TransmitsDiffusely(m) && m.diffuse_transmission_color_factor != glm::vec3(0.0f); }},
    {Slot::Iridescence, "iridescence texture", "iridescence", "iridescence", "KHR_materials_iridescence",
     "iridescenceTexture", &Material::iridescence_texture, TextureRole::Data, kR, Feature::Iridescence, IsIridescent},
    {Slot::IridescenceThickness, "iridescence thickness texture", "iridescence-thickness", "iridescence_thickness",
     "KHR_materials_iridescence", "iridescenceThicknessTexture", &Material::iridescence_thickness_texture,
     TextureRole::Data, kG, Feature::Iridescence,
     [](const Material&
            m) { return IsIridescent(m) && m.iridescence_thickness_minimum != m.iridescence_thickness_maximum; }},
    {Slot::Anisotropy, "anisotropy texture", "anisotropy", "anisotropy", "KHR_materials_anisotropy",
     "anisotropyTexture", &Material::anisotropy_texture, TextureRole::Data, kRgb, Feature::Anisotropy, IsAnisotropic,
     /*alpha_is_coverage=*/false, /*needs_light=*/true, /*tangent_space=*/true, /*white_is_neutral=*/false},
    {Slot::SpecularGlossiness, "specular-glossiness texture", "specular-glossiness", "specular_glossiness",
     "KHR_materials_pbrSpecularGlossiness", "specularGlossinessTexture", &Material::specular_glossiness_texture,
     TextureRole::Color, kRgba, Feature::SpecularGlossinessTexture,
     [](const Material&
            m) { return m.glossiness_factor != 0.0f || m.specular_glossiness_specular_factor != glm::vec3(0.0f); }},
});
// The most that a model has, for arrays.
inline constexpr std::size_t kMaxSlots = 32;
static_assert(kSlots.size() <= kMaxSlots);

constexpr std::size_t IndexOf(Slot slot) { return static_cast<std::size_t>(slot); }
constexpr const SlotInfo& InfoOf(Slot slot) { return kSlots[IndexOf(slot)]; }

// The bit of MaterialFeatures that says that the texture is read.
constexpr MaterialFeatures BitOf(Slot slot) { return MaterialFeatures{1} << IndexOf(slot); }
inline constexpr MaterialFeatures kTextureBits = (MaterialFeatures{1} << kMaxSlots) - 1;
static_assert(kTextureBits < kFirstFeature);
// The bits of the features for which surfaces need tangents: textures in tangent space, and anisotropy without one.
inline constexpr MaterialFeatures kTangentSpaceBits = [] {
  MaterialFeatures bits = kAnisotropy | kTangents;
  for (const SlotInfo& slot : kSlots) bits |= slot.tangent_space ? BitOf(slot.slot) : 0;
  return bits;
}();
static_assert(
    [] {
      for (std::size_t i = 0; i < kSlots.size(); ++i) {
        if (IndexOf(kSlots[i].slot) != i) return false;
      }
      return true;
    }(),
    "rows stand in the order of Slot");

// Features that factors state, with or without the textures that they scale.
struct FactorFeature {
  MaterialFeatures bit;
  Feature feature;   // by which it is disabled, its textures too
  const char* name;  // in messages, like the next
  const char* why_none;
  bool (*is_stated)(const Material&);
  void (*disable)(Material&);
  bool (*is_visible)(const Material&);
  bool needs_light = true;
  // Whether the image is the same, bit for bit, if the feature is computed with factors that make it invisible.
  bool is_neutral_at_zero = false;
};
inline constexpr auto kFactorFeatures = std::to_array<FactorFeature>({
    {kEmission, Feature::Emission, "emission", "no drawn material emits",
     [](const Material& m) { return m.emissive_factor != glm::vec3(0.0f); },
     [](Material& m) { m.emissive_factor = glm::vec3(0.0f); }, Emits, /*needs_light=*/false,
     /*is_neutral_at_zero=*/true},
    {kClearcoat, Feature::Clearcoat, "clear coat", "no drawn material has one", HasClearcoat,
     [](Material& m) { m.clearcoat_factor = 0.0f; }, HasClearcoat,
     /*needs_light=*/true, /*is_neutral_at_zero=*/true},
    {kSheen, Feature::Sheen, "sheen", "no drawn material has it", HasSheen,
     [](Material& m) { m.sheen_color_factor = glm::vec3(0.0f); }, HasSheen,
     /*needs_light=*/true, /*is_neutral_at_zero=*/true},
    {kSpecular, Feature::Specular, "specular factors", "no drawn material has them",
     [](const Material& m) { return m.specular_factor != 1.0f || m.specular_color_factor != glm::vec3(1.0f); },
     [](Material& m) { m.specular_factor = 1.0f, m.specular_color_factor = glm::vec3(1.0f); }, HasSpecular,
     /*needs_light=*/true, /*is_neutral_at_zero=*/true},
    {kIor, Feature::Ior, "index of refraction", "all drawn materials have 1.5",
     [](const Material& m) { return m.ior != 1.5f; }, [](Material& m) { m.ior = 1.5f; }, HasIor,
     /*needs_light=*/true, /*is_neutral_at_zero=*/true},
    {kTransmission, Feature::Transmission, "transmission", "no drawn material transmits light",
     [](const Material& m) { return m.transmission_factor != 0.0f; }, [](Material& m) { m.transmission_factor = 0.0f; },
     Transmits},
    {kVolume, Feature::Volume, "volume", "no drawn material has one",
     [](const Material& m) { return m.thickness_factor != 0.0f; }, [](Material& m) { m.thickness_factor = 0.0f; },
     HasVolume},
    {kDispersion, Feature::Dispersion, "dispersion", "no drawn material has it",
     [](const Material& m) { return m.dispersion != 0.0f; }, [](Material& m) { m.dispersion = 0.0f; }, Disperses},
    {kDiffuseTransmission, Feature::DiffuseTransmission, "diffuse transmission", "no drawn material has it",
     [](const Material& m) { return m.diffuse_transmission_factor != 0.0f; },
     [](Material& m) { m.diffuse_transmission_factor = 0.0f; }, TransmitsDiffusely,
     /*needs_light=*/true, /*is_neutral_at_zero=*/true},
    {kIridescence, Feature::Iridescence, "iridescence", "no drawn material has it", IsIridescent,
     [](Material& m) { m.iridescence_factor = 0.0f; }, IsIridescent,
     /*needs_light=*/true, /*is_neutral_at_zero=*/true},
    {kAnisotropy, Feature::Anisotropy, "anisotropy", "no drawn material has it", IsAnisotropic,
     [](Material& m) { m.anisotropy_strength = 0.0f; }, IsAnisotropic},
});

}  // namespace facet
