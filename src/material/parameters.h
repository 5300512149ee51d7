// The table of material parameters: each parameter of a material, its place in a glTF file, and its allowed values. The
// loader, validation and the hash of a scene loop over it.
#pragma once

#include <limits>
#include <string_view>

#include "facet/scene.h"
#include "material/slots.h"

namespace facet {

// An inclusive range; with an infinite end it has all finite numbers on that side.
struct ParameterRange {
  float low = 0.0f, high = 1.0f;
  float exception = std::numeric_limits<float>::quiet_NaN();  // one more value that is allowed; NaN: none
  bool zero_is_exception = false;  // loaders read 0 and less as the exception, and not as `low`
};

template <class Value>
struct Parameter {
  const char* name;  // in messages
  // The object in the glTF material that has it, an extension, or an object in that: "EXTENSION.OBJECT". Null: the
  // material itself.
  const char* gltf_group;
  const char* gltf_name;
  Value Material::*member;
  ParameterRange range = {};  // of numbers
  bool alternative = false;   // another name of a member that has a row of its own; only loaders read it
  const char* key = nullptr;  // in the output of `facet info`; null: by its name in glTF (KeyOf() in cli/info_json.cc)
};

// Whether a parameter's group is an extension. Only extensions have an underscore in their names.
constexpr bool IsExtension(std::string_view group) { return group.find('_') != group.npos; }

// Calls visit(Parameter<Value>) for each parameter, in the order in which they enter the hash of a scene. The rows
// after kCoreParameters enter it only where they are stated, so that scenes keep their hashes when extensions are
// added.
inline constexpr int kCoreParameters = 16;
template <class Visit>
constexpr void ForEachParameter(const Visit& visit) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity(), kSmallest = std::numeric_limits<float>::min();
  constexpr ParameterRange kShare{0.0f, 1.0f}, kPositive{0.0f, kInfinity}, kAny{-kInfinity, kInfinity};
  constexpr ParameterRange kIorRange{1.0f, kInfinity, 0.0f};
  // Exporters that write a distance of 0 mean that nothing is absorbed.
  constexpr ParameterRange kDistance{kSmallest, kInfinity, kInfinity, /*zero_is_exception=*/true};
  constexpr const char* kPbr = "pbrMetallicRoughness";
  const auto texture = [&](Slot slot) {
    const SlotInfo& info = InfoOf(slot);
    visit(Parameter<TextureRef>{info.name, info.gltf_group, info.gltf_name, info.ref});
  };
  visit(Parameter<glm::vec4>{"base colour factor", kPbr, "baseColorFactor", &Material::base_color_factor, kShare});
  texture(Slot::BaseColor);
  visit(Parameter<float>{"metallic factor", kPbr, "metallicFactor", &Material::metallic_factor, kShare});
  visit(Parameter<float>{"roughness factor", kPbr, "roughnessFactor", &Material::roughness_factor, kShare});
  texture(Slot::MetallicRoughness);
  texture(Slot::Normal);
  visit(Parameter<float>{"normal scale", "normalTexture", "scale", &Material::normal_scale, kAny});
  texture(Slot::Occlusion);
  visit(Parameter<float>{"occlusion strength", "occlusionTexture", "strength", &Material::occlusion_strength, kShare});
  // The core specification forbids values above 1, but exporters older than KHR_materials_emissive_strength write them.
  visit(Parameter<glm::vec3>{"emissive factor", nullptr, "emissiveFactor", &Material::emissive_factor, kPositive});
  texture(Slot::Emissive);
  visit(Parameter<float>{"emissive strength", "KHR_materials_emissive_strength", "emissiveStrength",
                         &Material::emissive_strength, kPositive});
  visit(Parameter<AlphaMode>{"alpha mode", nullptr, "alphaMode", &Material::alpha_mode});
  visit(Parameter<float>{"alpha cutoff", nullptr, "alphaCutoff", &Material::alpha_cutoff, kPositive});
  visit(Parameter<bool>{"double-sidedness", nullptr, "doubleSided", &Material::double_sided});
  visit(Parameter<ShadingModel>{"shading model", nullptr, nullptr, &Material::model});

  visit(Parameter<float>{"clear coat factor", "KHR_materials_clearcoat", "clearcoatFactor", &Material::clearcoat_factor,
                         kShare});
  texture(Slot::Clearcoat);
  visit(Parameter<float>{"clear coat roughness factor", "KHR_materials_clearcoat", "clearcoatRoughnessFactor",
                         &Material::clearcoat_roughness_factor, kShare});
  texture(Slot::ClearcoatRoughness);
  texture(Slot::ClearcoatNormal);
  visit(Parameter<float>{"clear coat normal scale", "KHR_materials_clearcoat.clearcoatNormalTexture", "scale",
                         &Material::clearcoat_normal_scale, kAny});
  visit(Parameter<glm::vec3>{"sheen colour factor", "KHR_materials_sheen", "sheenColorFactor",
                             &Material::sheen_color_factor, kShare});
  texture(Slot::SheenColor);
  visit(Parameter<float>{"sheen roughness factor", "KHR_materials_sheen", "sheenRoughnessFactor",
                         &Material::sheen_roughness_factor, kShare});
  texture(Slot::SheenRoughness);
  visit(Parameter<float>{"specular factor", "KHR_materials_specular", "specularFactor", &Material::specular_factor,
                         kShare});
  texture(Slot::Specular);
  visit(Parameter<glm::vec3>{"specular colour factor", "KHR_materials_specular", "specularColorFactor",
                             &Material::specular_color_factor, kPositive});
  texture(Slot::SpecularColor);
  visit(Parameter<float>{"index of refraction", "KHR_materials_ior", "ior", &Material::ior, kIorRange});
  visit(Parameter<float>{"transmission factor", "KHR_materials_transmission", "transmissionFactor",
                         &Material::transmission_factor, kShare});
  texture(Slot::Transmission);
  visit(Parameter<float>{"thickness factor", "KHR_materials_volume", "thicknessFactor", &Material::thickness_factor,
                         kPositive});
  texture(Slot::Thickness);
  visit(Parameter<float>{"attenuation distance", "KHR_materials_volume", "attenuationDistance",
                         &Material::attenuation_distance, kDistance});
  visit(Parameter<glm::vec3>{"attenuation colour", "KHR_materials_volume", "attenuationColor",
                             &Material::attenuation_color, kShare});
  visit(Parameter<float>{"dispersion", "KHR_materials_dispersion", "dispersion", &Material::dispersion, kPositive});
  visit(Parameter<float>{"diffuse transmission factor", "KHR_materials_diffuse_transmission",
                         "diffuseTransmissionFactor", &Material::diffuse_transmission_factor, kShare});
  texture(Slot::DiffuseTransmission);
  visit(Parameter<glm::vec3>{"diffuse transmission colour factor", "KHR_materials_diffuse_transmission",
                             "diffuseTransmissionColorFactor", &Material::diffuse_transmission_color_factor, kShare});
  texture(Slot::DiffuseTransmissionColor);
  visit(Parameter<float>{"iridescence factor", "KHR_materials_iridescence", "iridescenceFactor",
                         &Material::iridescence_factor, kShare});
  texture(Slot::Iridescence);
  visit(Parameter<float>{"iridescence index of refraction", "KHR_materials_iridescence", "iridescenceIor",
                         &Material::iridescence_ior, ParameterRange{1.0f, kInfinity}});
  visit(Parameter<float>{"iridescence thickness minimum", "KHR_materials_iridescence", "iridescenceThicknessMinimum",
                         &Material::iridescence_thickness_minimum, kPositive});
  visit(Parameter<float>{"iridescence thickness maximum", "KHR_materials_iridescence", "iridescenceThicknessMaximum",
                         &Material::iridescence_thickness_maximum, kPositive});
  texture(Slot::IridescenceThickness);
  visit(Parameter<float>{"anisotropy strength", "KHR_materials_anisotropy", "anisotropyStrength",
                         &Material::anisotropy_strength, kShare});
  visit(Parameter<float>{"anisotropy rotation", "KHR_materials_anisotropy", "anisotropyRotation",
                         &Material::anisotropy_rotation, kAny});
  texture(Slot::Anisotropy);
  constexpr const char* kOld = "KHR_materials_pbrSpecularGlossiness";
  visit(Parameter<glm::vec4>{"base colour factor", kOld, "diffuseFactor", &Material::base_color_factor, kShare, true});
  visit(Parameter<TextureRef>{
      "base colour texture", kOld, "diffuseTexture", &Material::base_color_texture, {}, /*alternative=*/true});
  visit(Parameter<glm::vec3>{"specular-glossiness specular factor", kOld, "specularFactor",
                             &Material::specular_glossiness_specular_factor, kShare, /*alternative=*/false,
                             "specular_glossiness_specular_factor"});
  visit(Parameter<float>{"glossiness factor", kOld, "glossinessFactor", &Material::glossiness_factor, kShare});
  texture(Slot::SpecularGlossiness);
}

// The parameters in the form that the shading stage reads.
struct MaterialFactors {
  float base_color[4] = {1, 1, 1, 1};
  float metallic = 1.0f;
  float perceptual_roughness = 1.0f;
  float normal_scale = 1.0f;
  float occlusion_strength = 1.0f;
  float emissive[3] = {0, 0, 0};  // factor times strength
  float alpha_cutoff = 0.5f;

  float clearcoat = 0.0f;
  float clearcoat_perceptual_roughness = 0.0f;
  float clearcoat_normal_scale = 1.0f;
  float sheen_color[3] = {0, 0, 0};
  float sheen_perceptual_roughness = 0.0f;
  float dielectric_f0 = 0.04f;  // by the index of refraction
  float specular = 1.0f;
  float specular_color[3] = {1, 1, 1};
  float transmission = 0.0f;
  // What transmission through a volume refracts by, for red, green and blue: equal without dispersion.
  float ior[3] = {1.5f, 1.5f, 1.5f};
  float thickness = 0.0f;           // units of the mesh
  float absorption[3] = {0, 0, 0};  // per metre
  float diffuse_transmission = 0.0f;
  float diffuse_transmission_color[3] = {1, 1, 1};
  float iridescence = 0.0f;
  float iridescence_ior = 1.3f;
  float film_thickness_minimum_nm = 100.0f, film_thickness_maximum_nm = 400.0f;
  float anisotropy = 0.0f;
  float anisotropy_direction[2] = {1, 0};  // cosine and sine of the rotation
  float specular_glossiness_specular[3] = {1, 1, 1};
  float glossiness = 1.0f;
};
MaterialFactors FactorsOf(const Material& material);

}  // namespace facet
