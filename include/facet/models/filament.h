// The parameters of the model "filament", with the names, units and defaults of Filament's materials (docs/models/
// filament.md; Guy and Agopian, Filament Materials Guide).
#pragma once

#include "facet/models/parameter.h"

namespace facet {

struct FilamentParameters {
  enum class Shading : std::uint8_t { Lit, Cloth, Subsurface, SpecularGlossiness, Unlit };
  // AlphaMode: as the material's alpha mode says: OPAQUE, MASK, or BLEND, which is Fade.
  enum class Blending : std::uint8_t { AlphaMode, Opaque, Masked, Transparent, Fade, Add, Multiply, Screen };
  enum class PostLightingBlending : std::uint8_t { Opaque, Transparent, Add, Multiply, Screen };
  enum class RefractionMode : std::uint8_t { None, ScreenSpace };
  enum class RefractionType : std::uint8_t { Solid, Thin };
  enum class SpecularOcclusion : std::uint8_t { None, Simple, BentNormals };
  // A colour whose default depends on the shading model.
  static constexpr float kNotStated = -1.0f;

  Textured<glm::vec4> base_color{glm::vec4(1.0f)};
  Shading shading_model = Shading::Lit;
  Blending blending = Blending::AlphaMode;
  Textured<float> metallic{0.0f};
  Textured<float> roughness{1.0f};
  Textured<float> reflectance{0.5f};
  Textured<float> specular_factor{1.0f};
  Textured<glm::vec3> specular_color_factor{glm::vec3(1.0f)};
  Textured<float> glossiness{0.0f};
  Textured<glm::vec3> specular_color{glm::vec3(0.0f)};
  Textured<glm::vec3> sheen_color{glm::vec3(kNotStated)};
  Textured<float> sheen_roughness{0.0f};
  Textured<float> clear_coat{0.0f};
  Textured<float> clear_coat_roughness{0.0f};
  TangentSpaceNormal clear_coat_normal;
  bool clear_coat_ior_change = true;
  Textured<float> anisotropy{0.0f};
  Textured<glm::vec3> anisotropy_direction{glm::vec3(1.0f, 0.0f, 0.0f)};  // a texture's is 2 texel - 1
  Textured<float> iridescence{0.0f};
  float iridescence_ior = 1.3f;
  Textured<float> iridescence_thickness{400.0f};
  Textured<float> ambient_occlusion{1.0f};
  SpecularOcclusion specular_ambient_occlusion = SpecularOcclusion::Simple;
  bool multi_bounce_ambient_occlusion = true;
  TangentSpaceNormal normal;
  TangentSpaceNormal bent_normal;
  Textured<glm::vec3> subsurface_color{glm::vec3(kNotStated)};
  Textured<float> subsurface_power{12.234f};
  RefractionMode refraction_mode = RefractionMode::None;
  RefractionType refraction_type = RefractionType::Solid;
  float ior = 0.0f;  // 0: that of the reflectance
  Textured<float> transmission{1.0f};
  Textured<glm::vec3> absorption{glm::vec3(0.0f)};
  Textured<float> thickness{0.5f};
  Textured<float> micro_thickness{0.0f};
  float dispersion = 0.0f;
  Textured<glm::vec4> emissive{glm::vec4(0.0f, 0.0f, 0.0f, 1.0f)};
  float exposure = 1.0f;  // of the picture, which emission of weight 0 is divided by
  Textured<glm::vec4> post_lighting_color{glm::vec4(0.0f)};
  Textured<float> post_lighting_mix_factor{1.0f};
  PostLightingBlending post_lighting_blending = PostLightingBlending::Transparent;
};

}  // namespace facet
