// The parameters of the model "enterprise": one row each. Names, order, ranges and defaults are those of DSPBR 2025x
// (DassaultSystemes-Technology, EnterprisePBRShadingModel, params-2025x.json); the last three rows are facet's.
#pragma once

#include <array>
#include <type_traits>

#include "material/models/row.h"

namespace facet {

inline constexpr std::array kEnterpriseEmissionModes = {"LUMINOUS_EMITTANCE", "LUMINOUS_POWER"};
inline constexpr std::array kEnterpriseProfiles = {"2025x", "2022x"};
// Of the rows, those that the specification has.
inline constexpr std::size_t kEnterpriseSpecifiedRows = 38;

template <class Visit>
constexpr void ForEachRow(std::type_identity<EnterpriseParameters>, const Visit& visit) {
  using P = EnterpriseParameters;
  constexpr ParameterRange kIor{1.0f, kNotNegative.high};
  visit(Row("albedo", &P::albedo, "the colour of diffuse reflection, of transmission, or of a metal"));
  visit(Row("metallic", &P::metallic, "from a dielectric to a metal",
            {.chart = R"({"albedo": [0.9, 0.7, 0.2], "roughness": 0.1})"}));
  visit(Row("roughness", &P::roughness, "perceptual roughness", {.chart = R"({"albedo": [0.5, 0.2, 0.7]})"}));
  visit(Row(
      "anisotropy", &P::anisotropy, "how much less rough the surface is across the tangent",
      {.chart = R"({"albedo": [0.8, 0.4, 0.4], "metallic": 1, "roughness": 0.5})", .feature = Feature::Anisotropy}));
  visit(Row("anisotropyRotation", &P::anisotropy_rotation, "of the tangent, as a share of a full turn",
            {.chart = R"({"albedo": [0.3, 0.5, 0.8], "metallic": 1, "roughness": 0.5, )"
                      R"("anisotropy": 0.7})",
             .feature = Feature::Anisotropy}));
  visit(Row("normal", &P::normal, "of the surface", {.range = kAnyNumber, .feature = Feature::NormalTexture}));
  visit(Row("displacement", &P::displacement, "along tangent, bitangent and normal; not drawn", {.range = kAnyNumber}));
  visit(Row("translucency", &P::translucency, "the share of diffuse light that passes the surface",
            {.chart = R"({"albedo": [0.2, 0.8, 0.6], "translucencyColor": [0.1, 0.6, 0.2]})",
             .feature = Feature::DiffuseTransmission}));
  visit(Row("translucencyColor", &P::translucency_color, "the colour of that light",
            {.chart = R"({"translucency": 1})", .feature = Feature::DiffuseTransmission}));
  visit(Row("transparency", &P::transparency, "from opaque to seen through", {.feature = Feature::Transmission}));
  visit(Row("cutoutOpacity", &P::cutout_opacity, "coverage", {.is_coverage = true}));
  visit(Row("specular", &P::specular, "the strength of a dielectric's reflection",
            {.chart = R"({"albedo": [0.1, 0.6, 0.6]})", .feature = Feature::Specular}));
  visit(Row("specularTint", &P::specular_tint, "its colour at normal incidence",
            {.chart = R"({"albedo": [0.02, 0.02, 0.02], "ior": 2.5})", .feature = Feature::Specular}));
  visit(Row(
      "thinFilm", &P::thin_film, "the strength of interference",
      {.chart = R"({"metallic": 1, "albedo": [0.6, 0.6, 0.6], "roughness": 0.2})", .feature = Feature::Iridescence}));
  visit(Row("thinFilmThickness", &P::thin_film_thickness, "of the film",
            {.unit = "um",
             .chart = R"({"metallic": 1, "albedo": [0.6, 0.6, 0.6], "roughness": 0.2, "thinFilm": 1})",
             .feature = Feature::Iridescence}));
  visit(Row("thinFilmIor", &P::thin_film_ior, "the film's index of refraction",
            {.range = {1.0f, 2.5f},
             .chart = R"({"metallic": 1, "albedo": [0.6, 0.6, 0.6], "roughness": 0.2, "thinFilm": 1})",
             .feature = Feature::Iridescence}));
  visit(Row("sheenColor", &P::sheen_color, "of fibres that stand on the surface; black: none",
            {.chart = R"({"albedo": [0.1, 0.1, 0.3], "roughness": 0.8})", .feature = Feature::Sheen}));
  visit(Row("sheenRoughness", &P::sheen_roughness, "of the fibres",
            {.chart = R"({"albedo": [0.1, 0.1, 0.3], "roughness": 0.8, "sheenColor": [0.8, 0.8, 0.8]})",
             .feature = Feature::Sheen}));
  visit(Row("flakeCoverage", &P::flake_coverage, "the share of the surface that flakes cover",
            {.chart = R"({"flakeColor": [0.8, 0.3, 0.3], "flakeSize": 60, "flakeRoughness": 0.3})"}));
  visit(Row("flakeColor", &P::flake_color, "of what flakes reflect",
            {.chart = R"({"flakeCoverage": 1, "flakeSize": 60, "flakeRoughness": 0.3})"}));
  visit(Row("flakeSize", &P::flake_size, "the diameter of a flake",
            {.range = kNotNegative,
             .unit = "mm",
             .chart = R"({"flakeCoverage": 1, "flakeRoughness": 0.3, "textureScale": 0.02})"}));
  visit(Row("flakeRoughness", &P::flake_roughness, "how much flakes are tilted and blur",
            {.chart = R"({"flakeCoverage": 1, "flakeColor": [0.1, 0.5, 0.5], "flakeSize": 60})"}));
  visit(Row("flipFlop", &P::flip_flop, "the strength of the flip-flop colour",
            {.chart = R"({"flakeCoverage": 1, "flakeSize": 60, "flakeRoughness": 0.3, )"
                      R"("flipFlopColor": [0.1, 0.7, 0.2]})"}));
  visit(Row("flipFlopColor", &P::flip_flop_color, "of what flakes reflect at normal incidence",
            {.chart = R"({"flakeCoverage": 1, "flakeSize": 60, "flakeRoughness": 0.3, "flipFlop": 0.6})"}));
  visit(Row("clearcoat", &P::clearcoat, "the strength of a clear coat",
            {.chart = R"({"albedo": [0.6, 0.1, 0.1], "roughness": 0.7})", .feature = Feature::Clearcoat}));
  visit(Row(
      "clearcoatRoughness", &P::clearcoat_roughness, "of the coat",
      {.chart = R"({"albedo": [0.6, 0.1, 0.1], "roughness": 0.7, "clearcoat": 1})", .feature = Feature::Clearcoat}));
  visit(Row("clearcoatNormal", &P::clearcoat_normal, "of the coat",
            {.range = kAnyNumber,
             .chart = R"({"albedo": [0.6, 0.1, 0.1], "roughness": 0.7, "clearcoat": 1})",
             .feature = Feature::Clearcoat}));
  visit(Row(
      "emissionColor", &P::emission_color, "of light that the surface emits",
      {.range = kNotNegative, .chart = R"({"albedo": [0, 0, 0], "emissionValue": 2})", .feature = Feature::Emission}));
  visit(Row("emissionValue", &P::emission_value, "of that light; lm/m2, or lm by the mode",
            {.range = kNotNegative,
             .unit = "lm/m2",
             .chart = R"({"albedo": [0, 0, 0], "emissionColor": [0.5, 0.442, 0.298]})",
             .feature = Feature::Emission}));
  visit(Row("emissionMode", &P::emission_mode, "what emissionValue states",
            {.words = kEnterpriseEmissionModes,
             .chart = R"({"albedo": [0, 0, 0], "emissionValue": 3})",
             .feature = Feature::Emission}));
  visit(Row("emissionEnergyNormalization", &P::emission_energy_normalization,
            "whether the colour is divided by its luminance",
            {.chart = R"({"albedo": [0, 0, 0], "emissionColor": [0.1, 0.05, 0.02], "emissionValue": 3})",
             .feature = Feature::Emission}));
  visit(Row("thinWalled", &P::thin_walled, "whether the surface is a wall without an interior",
            {.chart = R"({"transparency": 1})", .feature = Feature::Volume}));
  visit(Row("ior", &P::ior, "the index of refraction",
            {.range = kIor, .chart = R"({"albedo": [0.1, 0.15, 0.25]})", .feature = Feature::Ior}));
  visit(Row(
      "abbeNumber", &P::abbe_number, "of dispersion; 0: none",
      {.range = kNotNegative, .chart = R"({"transparency": 1, "thinWalled": false})", .feature = Feature::Dispersion}));
  visit(Row(
      "attenuationColor", &P::attenuation_color, "what the medium leaves of white light after attenuationDistance",
      {.chart = R"({"transparency": 1, "thinWalled": false, "attenuationDistance": 1})", .feature = Feature::Volume}));
  visit(Row("attenuationDistance", &P::attenuation_distance, "0: the medium is opaque",
            {.range = kNotNegative,
             .unit = "m",
             .chart = R"({"transparency": 1, "thinWalled": false, "attenuationColor": [0.8, 0.1, 0.1]})",
             .feature = Feature::Volume}));
  visit(Row("subsurfaceColor", &P::subsurface_color, "of light that the medium scatters many times; black: none",
            {.chart = R"({"transparency": 1, "thinWalled": false, "attenuationColor": [0.3, 0.3, 0.5], )"
                      R"("attenuationDistance": 1})",
             .feature = Feature::Volume}));
  visit(Row("subsurfaceAnisotropy", &P::subsurface_anisotropy, "whether the medium scatters backwards or forwards",
            {.range = {-1.0f, 1.0f},
             .chart = R"({"transparency": 1, "thinWalled": false, "attenuationColor": [0.3, 0.3, 0.5], )"
                      R"("attenuationDistance": 1, "subsurfaceColor": [0.4, 0.4, 0.9]})",
             .feature = Feature::Volume}));
  visit(Row("profile", &P::profile, "the version of the specification",
            {.words = kEnterpriseProfiles,
             .chart = R"({"metallic": 1, "albedo": [0.6, 0.6, 0.6], "roughness": 0.2, "thinFilm": 1})"}));
  visit(Row("thickness", &P::thickness, "of the volume, in units of the mesh; 0: the mean chord of the mesh",
            {.range = kNotNegative,
             .chart = R"({"transparency": 1, "thinWalled": false, "attenuationColor": [0.8, 0.1, 0.1], )"
                      R"("attenuationDistance": 1})",
             .feature = Feature::Volume}));
  visit(Row("textureScale", &P::texture_scale, "metres in a unit of TEXCOORD_0, for flakes; 0: measured on the mesh",
            {.range = kNotNegative,
             .unit = "m",
             .chart = R"({"flakeCoverage": 1, "flakeSize": 60, "flakeRoughness": 0.3})"}));
}

// The features that the parameters make visible, besides the textures.
inline MaterialFeatures FeaturesOf(const EnterpriseParameters& p) {
  MaterialFeatures features = 0;
  const auto set = [&features](bool condition, MaterialFeatures bit) {
    if (condition) features |= bit;
  };
  const bool is_metal = p.metallic.value == 1.0f && !p.metallic.texture;
  const bool is_new = p.profile == EnterpriseProfile::V2025x;
  const bool has_specular = p.specular.value != 1.0f || p.specular.texture ||
                            p.specular_tint.value != glm::vec3(1.0f) || p.specular_tint.texture;
  const bool transmits = !is_metal && p.transparency.value != 0.0f;
  set(!is_metal, kDiffuseLobe);
  set(p.emission_value != 0.0f && p.emission_color.value != glm::vec3(0.0f), kEmission);
  set(p.clearcoat.value != 0.0f, kClearcoat);
  set(p.sheen_color.value != glm::vec3(0.0f), kSheen);
  set(!is_metal && has_specular, kSpecular);
  set(!is_metal && p.ior != 1.5f, kIor);
  set(transmits, kTransmission);
  const bool translucent = !is_metal && p.translucency.value != 0.0f;
  set(!p.thin_walled && (transmits || translucent), kVolume);
  set(transmits && !p.thin_walled && p.abbe_number != 0.0f, kDispersion);
  // What a medium scatters leaves it in all directions, too.
  const bool scatters = !p.thin_walled && p.subsurface_color != glm::vec3(0.0f);
  set(translucent || (transmits && scatters), kDiffuseTransmission);
  set(is_new && p.thin_film.value != 0.0f, kIridescence);
  set(p.anisotropy.value != 0.0f, kAnisotropy);
  set(p.flake_coverage.value != 0.0f, kFlakes | kTangents);
  return features;
}

}  // namespace facet
