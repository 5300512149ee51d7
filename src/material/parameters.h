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
};

// Whether a parameter's group is an extension. Only extensions have an underscore in their names.
constexpr bool IsExtension(std::string_view group) { return group.find('_') != group.npos; }

// Calls visit(Parameter<Value>) for each parameter, in the order in which they enter the hash of a scene.
template <class Visit>
constexpr void ForEachParameter(const Visit& visit) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr ParameterRange kShare{0.0f, 1.0f}, kPositive{0.0f, kInfinity}, kAny{-kInfinity, kInfinity};
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
};
inline MaterialFactors FactorsOf(const Material& material) {
  MaterialFactors f;
  for (int i = 0; i < 4; ++i) f.base_color[i] = material.base_color_factor[i];
  f.metallic = material.metallic_factor;
  f.perceptual_roughness = material.roughness_factor;
  f.normal_scale = material.normal_scale;
  f.occlusion_strength = material.occlusion_strength;
  for (int i = 0; i < 3; ++i) f.emissive[i] = material.emissive_factor[i] * material.emissive_strength;
  f.alpha_cutoff = material.alpha_cutoff;
  return f;
}

}  // namespace facet
