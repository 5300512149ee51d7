// The parameters of the model "lecture": one row each.
#pragma once

#include <array>
#include <type_traits>

#include "material/models/lecture_presets.h"
#include "material/models/row.h"

namespace facet {

// In the order of the enumerations' values.
namespace lecture_words {
inline constexpr std::array kWorkflows = {"metallic-roughness", "specular-glossiness"};
inline constexpr std::array kDiffuses = {"lambert", "none"};
inline constexpr std::array kSpeculars = {"cook-torrance", "blinn-phong", "none"};
inline constexpr std::array kDistributions = {"ggx", "blinn-phong", "beckmann", "abc"};
inline constexpr std::array kGeometries = {"schlick-ggx", "smith"};
inline constexpr std::array kFresnels = {"schlick", "exact"};
inline constexpr std::array kAmbients = {"image", "constant"};
inline constexpr std::array kAlphas = {"roughness-squared", "roughness"};
inline constexpr std::array kExponents = {"from-roughness", "alpha-p"};
}  // namespace lecture_words

template <class Visit>
constexpr void ForEachRow(std::type_identity<LectureParameters>, const Visit& visit) {
  using namespace lecture_words;
  using P = LectureParameters;
  constexpr ParameterRange kIndices{0.01f, 100.0f};
  // For charts. They have image-based light, where D counts by its peak alone.
  constexpr const char* kMetal = R"({"metalness": 1})";
  constexpr const char* kExactMetal = R"({"metalness": 1, "fresnel": "exact"})";
  constexpr const char* kGlossy = R"({"workflow": "specular-glossiness", "specularColor": [0.5, 0.5, 0.5]})";
  constexpr const char* kAbc = R"({"metalness": 1, "distribution": "abc"})";
  constexpr const char* kSharp = R"({"metalness": 1, "exponent": "alpha-p", "alphaP": 300})";
  visit(Row("albedo", &P::albedo, "the colour of diffuse reflection; a metal's F0; alpha is coverage"));
  visit(Row("workflow", &P::workflow, "what F0 and roughness are stated by",
            {.words = kWorkflows, .chart = R"({"specularColor": [0.9, 0.5, 0.2], "glossiness": 0.8})"}));
  visit(Row("metalness", &P::metalness, "from a dielectric to a metal (metallic-roughness)"));
  visit(Row("roughness", &P::roughness, "of the microfacets (metallic-roughness)"));
  visit(Row("specularColor", &P::specular_color, "F0 (specular-glossiness)", {.chart = kGlossy}));
  visit(Row("glossiness", &P::glossiness, "1 - roughness (specular-glossiness)", {.chart = kGlossy}));
  visit(Row("normal", &P::normal, "of the surface", {.range = kAnyNumber, .feature = Feature::NormalTexture}));
  visit(Row("ao", &P::ambient_occlusion, "the share of ambient light that arrives", {.feature = Feature::Occlusion}));
  visit(Row("emission", &P::emission, "light that the surface emits",
            {.range = kNotNegative, .unit = "cd/m2", .feature = Feature::Emission}));
  visit(Row("diffuse", &P::diffuse, "the diffuse term", {.words = kDiffuses}));
  visit(Row("specular", &P::specular, "the specular term", {.words = kSpeculars, .chart = kSharp}));
  visit(Row("distribution", &P::distribution, "D of Cook and Torrance's term",
            {.words = kDistributions, .chart = kSharp}));
  visit(Row("geometry", &P::geometry, "G of Cook and Torrance's term", {.words = kGeometries, .chart = kMetal}));
  visit(Row("fresnel", &P::fresnel, "F, and with it kS and kD", {.words = kFresnels, .chart = kMetal}));
  visit(Row("ambient", &P::ambient, "light that comes from no lamp", {.words = kAmbients}));
  visit(Row("alpha", &P::alpha, "the width of D", {.words = kAlphas}));
  visit(Row("f0", &P::f0, "the dielectric's F0 (schlick)"));
  visit(Row("f0Preset", &P::f0_preset, "takes the place of f0, of a metal's albedo, or of specularColor",
            {.words = kLecturePresetWords, .chart = R"({"albedo": [0, 0, 0], "roughness": 0.2})"}));
  visit(Row("ior", &P::ior, "the dielectric's index of refraction (exact)",
            {.range = {1.0f, 100.0f}, .chart = R"({"fresnel": "exact"})"}));
  visit(Row("eta", &P::eta, "real part of the metal's index of refraction (exact)",
            {.range = kIndices, .chart = kExactMetal}));
  visit(Row("k", &P::k, "imaginary part of the metal's index of refraction (exact)",
            {.range = {0.0f, 100.0f}, .chart = kExactMetal}));
  visit(Row("exponent", &P::exponent, "whether alphaP is 2 / alpha^2 - 2 or stated",
            {.words = kExponents, .chart = R"({"distribution": "blinn-phong", "metalness": 1, "alphaP": 300})"}));
  visit(Row(
      "alphaP", &P::alpha_p, "the exponent of Blinn and Phong's terms",
      {.range = kNotNegative, .chart = R"({"metalness": 1, "distribution": "blinn-phong", "exponent": "alpha-p"})"}));
  visit(Row("alpha1", &P::alpha1, "of the ABC distribution, B: how narrow it is",
            {.range = {0.0f, 1e6f}, .chart = kAbc}));
  visit(Row("alpha2", &P::alpha2, "of the ABC distribution, C: how fast it falls",
            {.range = {0.0f, 100.0f}, .chart = kAbc}));
  visit(Row("ambientLight", &P::ambient_light, "radiance of constant ambient light",
            {.range = kNotNegative, .unit = "cd/m2", .chart = R"({"ambient": "constant"})"}));
}

// The features that the parameters make visible, besides the textures.
inline MaterialFeatures FeaturesOf(const LectureParameters& p) {
  return p.emission.value != glm::vec3(0.0f) ? kEmission : MaterialFeatures{0};
}

}  // namespace facet
