// The parameters of the model "lecture": the terms of physically based shading as lectures teach them, each a choice.
// docs/models/lecture.md has the formulas.
#pragma once

#include <cstdint>

#include "facet/models/parameter.h"

namespace facet {

enum class LectureWorkflow : std::uint8_t { MetallicRoughness, SpecularGlossiness };
enum class LectureDiffuse : std::uint8_t { Lambert, None };
enum class LectureSpecular : std::uint8_t { CookTorrance, BlinnPhong, None };
enum class LectureDistribution : std::uint8_t { Ggx, BlinnPhong, Beckmann, Abc };
enum class LectureGeometry : std::uint8_t { SchlickGgx, Smith };
enum class LectureFresnel : std::uint8_t { Schlick, Exact };
enum class LectureAmbient : std::uint8_t { Image, Constant };
enum class LectureAlpha : std::uint8_t { RoughnessSquared, Roughness };
// Where the exponent of Blinn and Phong's terms comes from.
enum class LectureExponent : std::uint8_t { FromRoughness, AlphaP };

// Reflectances at normal incidence, of material/models/lecture_presets.h. Where that has a range, Low and High are its
// ends.
enum class LecturePreset : std::uint8_t {
  None,
  Water,
  LivingTissueLow,
  LivingTissueHigh,
  Skin,
  Eyes,
  Hair,
  Teeth,
  FabricLow,
  FabricHigh,
  StoneLow,
  StoneHigh,
  PlasticLow,
  PlasticHigh,
  GlassLow,
  GlassHigh,
  CrystalLow,
  CrystalHigh,
  GemsLow,
  GemsHigh,
  DiamondLikeLow,
  DiamondLikeHigh,
  Diamond,
  Silicon,
  Titanium,
  Chromium,
  Iron,
  Nickel,
  Platinum,
  Copper,
  Palladium,
  Mercury,
  Brass,
  Zinc,
  Gold,
  Aluminium,
  Silver,
};

struct LectureParameters {
  Textured<glm::vec4> albedo{glm::vec4(1.0f)};
  LectureWorkflow workflow = LectureWorkflow::MetallicRoughness;
  Textured<float> metalness{0.0f};
  Textured<float> roughness{0.5f};
  Textured<glm::vec3> specular_color{glm::vec3(0.04f)};
  Textured<float> glossiness{0.5f};
  TangentSpaceNormal normal;
  Textured<float> ambient_occlusion{1.0f};
  Textured<glm::vec3> emission{glm::vec3(0.0f)};

  LectureDiffuse diffuse = LectureDiffuse::Lambert;
  LectureSpecular specular = LectureSpecular::CookTorrance;
  LectureDistribution distribution = LectureDistribution::Ggx;
  LectureGeometry geometry = LectureGeometry::SchlickGgx;
  LectureFresnel fresnel = LectureFresnel::Schlick;
  LectureAmbient ambient = LectureAmbient::Image;
  LectureAlpha alpha = LectureAlpha::RoughnessSquared;

  float f0 = 0.04f;
  LecturePreset f0_preset = LecturePreset::None;
  float ior = 1.5f;
  // Gold's (Johnson and Christy, 1972, Optical Constants of the Noble Metals, for the colours of sRGB).
  glm::vec3 eta{0.143f, 0.375f, 1.442f};
  glm::vec3 k{3.983f, 2.386f, 1.603f};

  LectureExponent exponent = LectureExponent::FromRoughness;
  float alpha_p = 32.0f;
  float alpha1 = 100.0f;
  float alpha2 = 2.5f;
  float ambient_light = 0.03f;
};

}  // namespace facet
