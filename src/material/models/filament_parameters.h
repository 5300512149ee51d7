// The parameters of the model "filament": one row each.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <type_traits>

#include "material/models/row.h"

namespace facet {

// Of enumerations, in their order.
namespace filament_words {
inline constexpr std::array kShadings = {"lit", "cloth", "subsurface", "specularGlossiness", "unlit"};
inline constexpr std::array kBlendings = {"alphaMode", "opaque", "masked",   "transparent",
                                          "fade",      "add",    "multiply", "screen"};
inline constexpr std::array kPostLighting = {"opaque", "transparent", "add", "multiply", "screen"};
inline constexpr std::array kModes = {"none", "screenspace"};
inline constexpr std::array kTypes = {"solid", "thin"};
inline constexpr std::array kOcclusions = {"none", "simple", "bentNormals"};
}  // namespace filament_words

template <class Visit>
constexpr void ForEachRow(std::type_identity<FilamentParameters>, const Visit& visit) {
  using P = FilamentParameters;
  constexpr auto kInfinity = std::numeric_limits<float>::infinity();
  constexpr ParameterRange kColor{0.0f, 1.0f, P::kNotStated};
  using namespace filament_words;

  visit(Row("baseColor", &P::base_color, "the colour of diffuse reflection, or of a metal; alpha is coverage"));
  visit(Row("shadingModel", &P::shading_model, "which of Filament's shading models",
            {.words = kShadings, .chart = R"({"baseColor": [0.6, 0.3, 0.1], "roughness": 0.5})"}));
  visit(Row("blending", &P::blending, "how the surface covers what is behind it",
            {.words = kBlendings, .chart = R"({"baseColor": [0.4, 0.3, 0.2, 0.5]})"}));
  visit(Row("metallic", &P::metallic, "from a dielectric to a metal",
            {.chart = R"({"baseColor": [0.9, 0.6, 0.2], "roughness": 0.3})"}));
  visit(Row("roughness", &P::roughness, "perceptual roughness",
            {.chart = R"({"metallic": 1, "baseColor": [0.9, 0.6, 0.5]})"}));
  visit(Row("reflectance", &P::reflectance, "of a dielectric: F0 is 0.16 times its square",
            {.chart = R"({"baseColor": [0.05, 0.1, 0.3], "roughness": 0.2})"}));
  visit(Row("specularFactor", &P::specular_factor, "a factor of a dielectric's F0 and F90",
            {.chart = R"({"baseColor": [0.05, 0.1, 0.3], "roughness": 0.2})", .feature = Feature::Specular}));
  visit(Row("specularColorFactor", &P::specular_color_factor, "a factor of a dielectric's F0",
            {.range = kNotNegative,
             .chart = R"({"baseColor": [0.05, 0.1, 0.3], "roughness": 0.2})",
             .feature = Feature::Specular}));
  visit(Row(
      "glossiness", &P::glossiness, "of specularGlossiness: 1 - perceptual roughness",
      {.chart =
           R"({"shadingModel": "specularGlossiness", "baseColor": [0.1, 0.1, 0.1], "specularColor": [0.9, 0.6, 0.3]})"}));
  visit(Row("specularColor", &P::specular_color, "of specularGlossiness: F0",
            {.chart = R"({"shadingModel": "specularGlossiness", "baseColor": [0.1, 0.1, 0.1], "glossiness": 0.8})"}));
  visit(Row("sheenColor", &P::sheen_color,
            "of the layer of fibres; not stated (-1): none, or for cloth the root of the base colour",
            {.range = kColor,
             .chart = R"({"baseColor": [0.05, 0.05, 0.2], "sheenRoughness": 0.4})",
             .feature = Feature::Sheen}));
  visit(Row("sheenRoughness", &P::sheen_roughness, "of that layer",
            {.chart = R"({"baseColor": [0.05, 0.05, 0.2], "sheenColor": [1, 1, 1]})", .feature = Feature::Sheen}));
  visit(Row("clearCoat", &P::clear_coat, "how much of the clear coat there is",
            {.chart = R"({"baseColor": [0.6, 0.02, 0.02], "roughness": 0.6})", .feature = Feature::Clearcoat}));
  visit(Row("clearCoatRoughness", &P::clear_coat_roughness, "of the clear coat",
            {.chart = R"({"baseColor": [0.6, 0.02, 0.02], "clearCoat": 1})", .feature = Feature::Clearcoat}));
  visit(Row("clearCoatNormal", &P::clear_coat_normal, "of the clear coat",
            {.range = kAnyNumber,
             .chart = R"({"baseColor": [0.6, 0.02, 0.02], "clearCoat": 1})",
             .feature = Feature::Clearcoat}));
  visit(Row("clearCoatIorChange", &P::clear_coat_ior_change, "whether the coat lowers the F0 of what is under it",
            {.chart = R"({"clearCoat": 1, "roughness": 0.5, "metallic": 1, "baseColor": [0.9, 0.6, 0.5]})",
             .feature = Feature::Clearcoat}));
  visit(Row("anisotropy", &P::anisotropy, "above 0: rougher along the direction; below 0: across it",
            {.range = {-1.0f, 1.0f},
             .chart = R"({"roughness": 0.4, "metallic": 1, "baseColor": [0.9, 0.6, 0.5]})",
             .feature = Feature::Anisotropy}));
  visit(Row("anisotropyDirection", &P::anisotropy_direction, "in tangent space; of a texture, 2 texel - 1",
            {.range = kAnyNumber,
             .is_data = true,
             .chart = R"({"anisotropy": 0.8, "roughness": 0.4, "metallic": 1, "baseColor": [0.9, 0.6, 0.5]})",
             .feature = Feature::Anisotropy}));
  visit(Row("iridescence", &P::iridescence, "how much of the thin film there is",
            {.chart = R"({"metallic": 1, "roughness": 0.1, "baseColor": [0.6, 0.6, 0.6]})",
             .feature = Feature::Iridescence}));
  visit(Row("iridescenceIor", &P::iridescence_ior, "of the thin film",
            {.range = {1.0f, kInfinity},
             .chart = R"({"iridescence": 1, "metallic": 1, "roughness": 0.1, "baseColor": [0.6, 0.6, 0.6]})",
             .feature = Feature::Iridescence}));
  visit(Row("iridescenceThickness", &P::iridescence_thickness, "of the thin film",
            {.range = kNotNegative,
             .unit = "nm",
             .chart = R"({"iridescence": 1, "metallic": 1, "roughness": 0.1, "baseColor": [0.6, 0.6, 0.6]})",
             .feature = Feature::Iridescence}));
  visit(Row("ambientOcclusion", &P::ambient_occlusion, "the share of ambient light that arrives",
            {.feature = Feature::Occlusion}));
  visit(Row("specularAmbientOcclusion", &P::specular_ambient_occlusion, "how occlusion dims reflections",
            {.words = kOcclusions,
             .chart = R"({"ambientOcclusion": 0.3, "roughness": 0.2, "metallic": 1, "baseColor": [0.9, 0.6, 0.5]})",
             .feature = Feature::Occlusion}));
  visit(Row("multiBounceAmbientOcclusion", &P::multi_bounce_ambient_occlusion,
            "whether occluded surfaces light one another",
            {.chart = R"({"ambientOcclusion": 0.3, "baseColor": [0.9, 0.4, 0.2]})", .feature = Feature::Occlusion}));
  visit(Row("normal", &P::normal, "of the surface",
            {.range = kAnyNumber,
             .chart = R"({"roughness": 0.2, "metallic": 1, "baseColor": [0.9, 0.6, 0.5]})",
             .feature = Feature::NormalTexture}));
  visit(Row(
      "bentNormal", &P::bent_normal, "the mean direction that is not occluded",
      {.range = kAnyNumber,
       .chart =
           R"({"specularAmbientOcclusion": "bentNormals", "ambientOcclusion": 0.4, "roughness": 0.3, "metallic": 1, "baseColor": [0.9, 0.6, 0.5]})",
       .feature = Feature::Occlusion}));
  visit(Row("subsurfaceColor", &P::subsurface_color,
            "of light that passes through; not stated (-1): white, or for cloth none",
            {.range = kColor,
             .chart = R"({"shadingModel": "subsurface", "baseColor": [0.3, 0.3, 0.3], "thickness": 0.2})",
             .feature = Feature::DiffuseTransmission}));
  visit(Row("subsurfacePower", &P::subsurface_power, "how narrow forward scattering is",
            {.range = kNotNegative,
             .chart = R"({"shadingModel": "subsurface", "baseColor": [0.3, 0.3, 0.3], "thickness": 0.2})",
             .feature = Feature::DiffuseTransmission}));
  visit(Row("refractionMode", &P::refraction_mode, "whether light passes through",
            {.words = kModes, .chart = R"({"roughness": 0.05})", .feature = Feature::Transmission}));
  visit(Row("refractionType", &P::refraction_type, "a solid, which refracts, or a thin wall",
            {.words = kTypes,
             .chart = R"({"refractionMode": "screenspace", "roughness": 0.05})",
             .feature = Feature::Volume}));
  visit(Row("ior", &P::ior, "index of refraction; 0: that of the reflectance",
            {.range = {1.0f, kInfinity, 0.0f},
             .chart = R"({"refractionMode": "screenspace", "roughness": 0.05})",
             .feature = Feature::Ior}));
  visit(Row("transmission", &P::transmission, "the share of diffuse light that passes through",
            {.chart = R"({"refractionMode": "screenspace", "roughness": 0.05})", .feature = Feature::Transmission}));
  visit(Row("absorption", &P::absorption, "of what is inside",
            {.range = kNotNegative,
             .unit = "1/m",
             .is_data = true,
             .chart = R"({"refractionMode": "screenspace", "roughness": 0.05})",
             .feature = Feature::Volume}));
  visit(Row("thickness", &P::thickness, "of a solid; for subsurface a share, from 0 to 1",
            {.range = kNotNegative,
             .unit = "m",
             .chart = R"({"refractionMode": "screenspace", "roughness": 0.05, "absorption": [0.1, 1, 2]})",
             .feature = Feature::Volume}));
  visit(Row(
      "microThickness", &P::micro_thickness, "of a thin wall",
      {.range = kNotNegative,
       .unit = "m",
       .chart =
           R"({"refractionMode": "screenspace", "roughness": 0.05, "refractionType": "thin", "absorption": [0.1, 1, 2]})",
       .feature = Feature::Volume}));
  visit(Row("dispersion", &P::dispersion, "20 divided by Abbe's number",
            {.range = kNotNegative,
             .chart = R"({"refractionMode": "screenspace", "roughness": 0.05, "ior": 1.7})",
             .feature = Feature::Dispersion}));
  visit(Row(
      "emissive", &P::emissive, "light that the surface emits; alpha is the weight of the exposure",
      {.range = kNotNegative, .unit = "cd/m2", .chart = R"({"baseColor": [0, 0, 0]})", .feature = Feature::Emission}));
  visit(Row("exposure", &P::exposure, "of the picture; emission of weight 0 is divided by it",
            {.range = {std::numeric_limits<float>::min(), kInfinity},
             .chart = R"({"emissive": [0.5, 0.3, 0.1, 0], "baseColor": [0, 0, 0]})",
             .feature = Feature::Emission}));
  visit(Row("postLightingColor", &P::post_lighting_color, "blended with the lit surface; premultiplied"));
  visit(Row("postLightingMixFactor", &P::post_lighting_mix_factor, "how much of that is mixed in",
            {.chart = R"({"postLightingColor": [0.8, 0.1, 0.1, 0.8]})"}));
  visit(Row("postLightingBlending", &P::post_lighting_blending, "how it is blended",
            {.words = kPostLighting,
             .chart = R"({"postLightingColor": [0.5, 0.1, 0.1, 0.5], "baseColor": [0.3, 0.3, 0.3]})"}));
}

// Whether the light behind the surface is refracted, or blended in a way that alpha cannot express.
inline bool IsSeenThrough(const FilamentParameters& p) {
  using Blending = FilamentParameters::Blending;
  return p.blending == Blending::Add || p.blending == Blending::Multiply || p.blending == Blending::Screen;
}
inline bool Refracts(const FilamentParameters& p) {
  using Shading = FilamentParameters::Shading;
  return p.refraction_mode != FilamentParameters::RefractionMode::None && p.transmission.value != 0.0f &&
         (p.shading_model == Shading::Lit || p.shading_model == Shading::SpecularGlossiness) && !IsSeenThrough(p);
}

// Whether it reads the albedo of cloth.
inline bool HasFibres(const FilamentParameters& p) {
  using Shading = FilamentParameters::Shading;
  if (p.shading_model == Shading::Cloth) return true;
  const bool layered = p.shading_model == Shading::Lit || p.shading_model == Shading::SpecularGlossiness;
  return layered && p.sheen_color.value.x >= 0.0f && p.sheen_color.value != glm::vec3(0.0f);
}

// Whether light passes through it diffusely. Subsurface does by default, cloth where a colour is stated.
inline bool PassesDiffusely(const FilamentParameters& p) {
  using Shading = FilamentParameters::Shading;
  if (p.shading_model == Shading::Subsurface) return p.subsurface_color.value != glm::vec3(0.0f);
  return p.shading_model == Shading::Cloth && p.subsurface_color.value.x >= 0.0f;
}

// The features that the parameters make visible, besides the textures.
inline MaterialFeatures FeaturesOf(const FilamentParameters& p) {
  using Shading = FilamentParameters::Shading;
  MaterialFeatures features = kDiffuseLobe;
  const auto set = [&features](bool condition, MaterialFeatures bits) {
    if (condition) features |= bits;
  };
  set(glm::vec3(p.emissive.value) != glm::vec3(0.0f), kEmission);
  set(IsSeenThrough(p), kTransmission);
  const bool layered = p.shading_model == Shading::Lit || p.shading_model == Shading::SpecularGlossiness;
  set(HasFibres(p), kSheen);
  set(PassesDiffusely(p), kDiffuseTransmission);
  if (!layered) return features;
  set(p.clear_coat.value != 0.0f, kClearcoat);
  set(p.anisotropy.value != 0.0f, kAnisotropy | kTangents);
  set(p.iridescence.value != 0.0f, kIridescence);
  set(p.ior != 0.0f, kIor);
  set(p.specular_factor != Textured<float>{1.0f} || p.specular_color_factor != Textured<glm::vec3>{glm::vec3(1.0f)},
      kSpecular);
  const bool solid = p.refraction_type == FilamentParameters::RefractionType::Solid;
  if (Refracts(p)) {
    features |= kTransmission;
    set(solid, kVolume);
    set(solid && p.dispersion != 0.0f, kDispersion);
  }
  return features;
}

// The alpha mode that a stated blending stands for.
inline std::optional<AlphaMode> AlphaModeOf(const FilamentParameters& p) {
  using Blending = FilamentParameters::Blending;
  switch (p.blending) {
    case Blending::AlphaMode: return std::nullopt;
    case Blending::Opaque: return AlphaMode::Opaque;
    case Blending::Masked: return AlphaMode::Mask;
    default: return AlphaMode::Blend;
  }
}

// What WithoutFeatures() does besides giving parameters their defaults: disabling a feature takes light away, but
// subsurface lets light pass by default, and blending does not depend on the alpha mode alone.
inline void RemoveMore(const FilamentParameters& stated_ones, const FeatureSet& disabled, FeatureSet& stated,
                       FilamentParameters& kept) {
  if (stated_ones.shading_model == FilamentParameters::Shading::Subsurface) {
    if (PassesDiffusely(stated_ones)) stated.Add(Feature::DiffuseTransmission);
    if (disabled.Has(Feature::DiffuseTransmission)) kept.subsurface_color = {glm::vec3(0.0f)};
    // The thicker, the less light passes.
    kept.thickness.value = std::max(kept.thickness.value, stated_ones.thickness.value);
  }
  if (disabled.Has(Feature::Blending) && AlphaModeOf(stated_ones) == AlphaMode::Blend) {
    kept.blending = FilamentParameters::Blending::Opaque;
  }
}

}  // namespace facet
