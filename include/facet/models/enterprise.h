// The parameters of the model "enterprise": DSPBR, the Dassault Systèmes Enterprise PBR Shading Model (version 2025x;
// 2022x lacks three parameters of the thin film and one colour). docs/models/enterprise.md says what of it is
// approximated.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

#include "facet/models/parameter.h"

namespace facet {

// What the owner of the specification asks products that implement it to say, in the form that it asks for.
inline constexpr const char* kEnterpriseAcknowledgement =
    "facet is implementing DSPBR, the Dassault Systèmes Enterprise PBR Shading Model";

// The version of the specification. In the 2022x profile light that is transmitted diffusely has the colour of the
// albedo, and there is no thin film.
enum class EnterpriseProfile : std::uint8_t { V2025x, V2022x };

// In lm/m2, or in lm for the whole surface of an object.
enum class EnterpriseEmissionMode : std::uint8_t { LuminousEmittance, LuminousPower };

// A texture's colours are encoded as sRGB; its numbers and directions are linear.
struct EnterpriseParameters {
  // Base
  Textured<glm::vec3> albedo{glm::vec3(1.0f)};
  Textured<float> metallic{0.0f};
  Textured<float> roughness{0.0f};
  Textured<float> anisotropy{0.0f};
  Textured<float> anisotropy_rotation{0.0f};
  TangentSpaceNormal normal;
  glm::vec3 displacement{0.0f};  // not drawn
  Textured<float> translucency{0.0f};
  Textured<glm::vec3> translucency_color{glm::vec3(1.0f)};
  Textured<float> transparency{0.0f};
  Textured<float> cutout_opacity{1.0f};
  Textured<float> specular{1.0f};
  Textured<glm::vec3> specular_tint{glm::vec3(1.0f)};
  // Iridescence
  Textured<float> thin_film{0.0f};
  Textured<float> thin_film_thickness{0.4f};
  float thin_film_ior = 1.3f;
  // Sheen
  Textured<glm::vec3> sheen_color{glm::vec3(0.0f)};
  Textured<float> sheen_roughness{0.5f};
  // Flakes
  Textured<float> flake_coverage{0.0f};
  Textured<glm::vec3> flake_color{glm::vec3(1.0f)};
  Textured<float> flake_size{0.0f};
  Textured<float> flake_roughness{0.0f};
  Textured<float> flip_flop{0.0f};
  Textured<glm::vec3> flip_flop_color{glm::vec3(1.0f)};
  // Coating
  Textured<float> clearcoat{0.0f};
  Textured<float> clearcoat_roughness{0.0f};
  TangentSpaceNormal clearcoat_normal;
  // Emission
  Textured<glm::vec3> emission_color{glm::vec3(1.0f)};
  float emission_value = 0.0f;
  EnterpriseEmissionMode emission_mode = EnterpriseEmissionMode::LuminousEmittance;
  bool emission_energy_normalization = false;
  // Volume
  bool thin_walled = true;
  float ior = 1.5f;
  float abbe_number = 0.0f;
  glm::vec3 attenuation_color{1.0f};
  float attenuation_distance = std::numeric_limits<float>::infinity();
  glm::vec3 subsurface_color{0.0f};
  float subsurface_anisotropy = 0.0f;

  // facet's own: what a renderer that does not trace rays through volumes needs besides, and the version.
  EnterpriseProfile profile = EnterpriseProfile::V2025x;
  float thickness = 0.0f;      // 0: the mean chord of the mesh
  float texture_scale = 0.0f;  // 0: measured on the mesh
};

// The specification's subtypes of the material: parameters that differ from the defaults.
inline constexpr std::array<std::string_view, 9> kEnterprisePresets = {
    "basic", "metal", "plastic", "glass", "textile", "leather", "wood", "carpaint", "emissive"};

// The parameters of a preset. Throws Error(InvalidUsage) if there is none of that name.
EnterpriseParameters EnterprisePreset(std::string_view name);

}  // namespace facet
