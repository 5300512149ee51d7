#include "material/from_gltf.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "base/printable.h"
#include "facet/shader/elementary_double.h"
#include "material/features.h"
#include "material/models/models.h"
#include "math/round_to_float.h"

namespace facet {
namespace {

constexpr float kPi = 3.14159265358979324f;

Textured<float> Number(float value, const TextureRef& texture, int channel) {
  return {value, texture, static_cast<std::int8_t>(texture ? channel : 0)};
}
TangentSpaceNormal Normal(const TextureRef& texture, float scale) { return {.texture = texture, .scale = scale}; }

// Of models that light every surface.
constexpr const char* kUnlitIsLost = "unlit surfaces (they emit their colour)";

// The reflectance of a dielectric at normal incidence. glTF's index of 0 means a Fresnel term of 1.
float ReflectanceOf(float ior) {
  if (ior == 0.0f) return 1.0f;
  const float root = (std::max(ior, 1.0f) - 1.0f) / (std::max(ior, 1.0f) + 1.0f);
  return root * root;
}

// glTF's strength of occlusion mixes with 1.
Textured<float> Occlusion(const Material& m, std::vector<std::string>& lost) {
  if (!m.occlusion_texture || m.occlusion_strength == 0.0f) return {1.0f};
  if (m.occlusion_strength != 1.0f) lost.emplace_back("the strength of its occlusion");
  return Number(1.0f, m.occlusion_texture, 0);
}

// Names those of the features that the material shows.
void NameLost(const Material& m, MaterialFeatures features, std::vector<std::string>& lost) {
  static constexpr std::pair<MaterialFeature, const char*> kWords[] = {
      {kClearcoat, "clear coat"},
      {kSheen, "sheen"},
      {kSpecular, "specular factors"},
      {kTransmission, "transmission"},
      {kVolume, "volume"},
      {kDispersion, "dispersion"},
      {kDiffuseTransmission, "diffuse transmission"},
      {kIridescence, "iridescence"},
      {kAnisotropy, "anisotropy"},
  };
  const MaterialFeatures shown = FeaturesOf(m) & features;
  for (const auto& [bit, word] : kWords) {
    if ((shown & bit) != 0) lost.emplace_back(word);
  }
}

// Other models' textures of a film's thickness begin at 0.
void NameLostMinimumOfFilm(const Material& m, std::vector<std::string>& lost) {
  if (m.iridescence_factor != 0.0f && m.iridescence_thickness_texture && m.iridescence_thickness_minimum != 0.0f) {
    lost.emplace_back("the minimum of its film's thickness");
  }
}

LectureParameters ToLecture(const Material& m, std::vector<std::string>& lost) {
  LectureParameters p;
  p.albedo = {m.base_color_factor, m.base_color_texture};
  if (m.model == ShadingModel::Unlit) {
    p.diffuse = LectureDiffuse::None;
    p.specular = LectureSpecular::None;
    p.emission = {glm::vec3(m.base_color_factor), m.base_color_texture};
    lost.emplace_back(kUnlitIsLost);
    return p;
  }
  p.metalness = Number(m.metallic_factor, m.metallic_roughness_texture, 2);
  p.roughness = Number(m.roughness_factor, m.metallic_roughness_texture, 1);
  p.f0 = ReflectanceOf(m.ior);
  if (m.model == ShadingModel::SpecularGlossiness) {
    p.workflow = LectureWorkflow::SpecularGlossiness;
    p.specular_color = {m.specular_glossiness_specular_factor, m.specular_glossiness_texture};
    p.glossiness = Number(m.glossiness_factor, m.specular_glossiness_texture, 3);
  }
  p.normal = Normal(m.normal_texture, m.normal_scale);
  p.ambient_occlusion = Occlusion(m, lost);
  p.emission = {m.emissive_factor * m.emissive_strength, m.emissive_texture};
  NameLost(m, kLayerFeatures, lost);
  return p;
}

FilamentParameters ToFilament(const Material& m, std::vector<std::string>& lost) {
  using P = FilamentParameters;
  P p;
  p.base_color = {m.base_color_factor, m.base_color_texture};
  if (m.model == ShadingModel::Unlit) {
    p.shading_model = P::Shading::Unlit;
    return p;
  }
  p.metallic = Number(m.metallic_factor, m.metallic_roughness_texture, 2);
  p.roughness = Number(m.roughness_factor, m.metallic_roughness_texture, 1);
  const float f0 = ReflectanceOf(m.ior);
  p.reflectance.value = std::min(std::sqrt(f0 / 0.16f), 1.0f);
  if (m.model == ShadingModel::MetallicRoughness) {
    if (f0 > 0.16f) lost.emplace_back("a reflectance above 0.16");
  } else {
    p.shading_model = P::Shading::SpecularGlossiness;
    p.specular_color = {m.specular_glossiness_specular_factor, m.specular_glossiness_texture};
    p.glossiness = Number(m.glossiness_factor, m.specular_glossiness_texture, 3);
  }
  p.normal = Normal(m.normal_texture, m.normal_scale);
  p.ambient_occlusion = Occlusion(m, lost);
  p.specular_ambient_occlusion = P::SpecularOcclusion::None;
  p.multi_bounce_ambient_occlusion = false;
  p.emissive = {glm::vec4(m.emissive_factor * m.emissive_strength, 1.0f), m.emissive_texture};
  p.specular_factor = Number(m.specular_factor, m.specular_texture, 3);
  p.specular_color_factor = {m.specular_color_factor, m.specular_color_texture};
  p.clear_coat = Number(m.clearcoat_factor, m.clearcoat_texture, 0);
  p.clear_coat_roughness = Number(m.clearcoat_roughness_factor, m.clearcoat_roughness_texture, 1);
  p.clear_coat_normal = Normal(m.clearcoat_normal_texture, m.clearcoat_normal_scale);
  p.clear_coat_ior_change = false;
  p.sheen_color = {m.sheen_color_factor, m.sheen_color_texture};
  p.sheen_roughness = Number(m.sheen_roughness_factor, m.sheen_roughness_texture, 3);
  p.anisotropy = Number(m.anisotropy_strength, m.anisotropy_texture, 2);
  const double turn = double{m.anisotropy_rotation};
  p.anisotropy_direction = {{RoundToFiniteFloat(Cos(turn)), RoundToFiniteFloat(Sin(turn)), 0.0f}, m.anisotropy_texture};
  if (m.anisotropy_strength != 0.0f && m.anisotropy_texture && turn != 0.0)
    lost.emplace_back("the rotation of its anisotropy");
  p.iridescence = Number(m.iridescence_factor, m.iridescence_texture, 0);
  p.iridescence_ior = m.iridescence_ior;
  p.iridescence_thickness = Number(m.iridescence_thickness_maximum, m.iridescence_thickness_texture, 1);
  NameLostMinimumOfFilm(m, lost);
  NameLost(m, kDiffuseTransmission, lost);
  if (m.transmission_factor == 0.0f) return p;
  p.refraction_mode = P::RefractionMode::ScreenSpace;
  p.refraction_type = m.thickness_factor == 0.0f ? P::RefractionType::Thin : P::RefractionType::Solid;
  p.ior = m.ior;
  p.transmission = Number(m.transmission_factor, m.transmission_texture, 0);
  p.thickness = Number(m.thickness_factor, m.thickness_texture, 1);
  p.dispersion = m.dispersion;
  if (m.thickness_factor != 0.0f && !std::isinf(m.attenuation_distance)) {
    for (int c = 0; c < 3; ++c) {
      const double least = std::max(double{m.attenuation_color[c]}, 1e-30);
      p.absorption.value[c] = RoundToFiniteFloat(-Log(least) / std::max(double{m.attenuation_distance}, 1e-30));
    }
  }
  return p;
}

EnterpriseParameters ToEnterprise(const Material& m, std::vector<std::string>& lost) {
  EnterpriseParameters p;
  p.albedo = {glm::vec3(m.base_color_factor), m.base_color_texture};
  p.cutout_opacity = Number(m.base_color_factor.a, m.base_color_texture, 3);
  if (m.model == ShadingModel::Unlit) {
    p.albedo.value = glm::vec3(0.0f);
    p.specular.value = 0.0f;
    p.emission_color = {glm::vec3(m.base_color_factor), m.base_color_texture};
    p.emission_value = kPi;
    lost.emplace_back(kUnlitIsLost);
    return p;
  }
  p.metallic = Number(m.metallic_factor, m.metallic_roughness_texture, 2);
  p.roughness = Number(m.roughness_factor, m.metallic_roughness_texture, 1);
  if (m.model == ShadingModel::SpecularGlossiness) {
    p.metallic = {};
    p.roughness = {1.0f - m.glossiness_factor};
    lost.emplace_back("its specular colour");
    if (m.specular_glossiness_texture) lost.emplace_back("the texture of its glossiness");
  }
  p.normal = Normal(m.normal_texture, m.normal_scale);
  p.specular = Number(m.specular_factor, m.specular_texture, 3);
  p.specular_tint = {glm::min(m.specular_color_factor, glm::vec3(1.0f)), m.specular_color_texture};
  if (p.specular_tint.value != m.specular_color_factor) lost.emplace_back("a specular colour above 1");
  p.transparency = Number(m.transmission_factor, m.transmission_texture, 0);
  p.translucency = Number(m.diffuse_transmission_factor, m.diffuse_transmission_texture, 3);
  p.translucency_color = {m.diffuse_transmission_color_factor, m.diffuse_transmission_color_texture};
  p.clearcoat = Number(m.clearcoat_factor, m.clearcoat_texture, 0);
  p.clearcoat_roughness = Number(m.clearcoat_roughness_factor, m.clearcoat_roughness_texture, 1);
  p.clearcoat_normal = Normal(m.clearcoat_normal_texture, m.clearcoat_normal_scale);
  p.sheen_color = {m.sheen_color_factor, m.sheen_color_texture};
  p.sheen_roughness = Number(m.sheen_roughness_factor, m.sheen_roughness_texture, 3);
  p.thin_film = Number(m.iridescence_factor, m.iridescence_texture, 0);
  p.thin_film_ior = std::clamp(m.iridescence_ior, 1.0f, 2.5f);
  const float micrometres = m.iridescence_thickness_maximum / 1000.0f;
  p.thin_film_thickness = Number(std::min(micrometres, 1.0f), m.iridescence_thickness_texture, 1);
  if (m.iridescence_factor != 0.0f) {
    if (p.thin_film_ior != m.iridescence_ior) lost.emplace_back("films of an index above 2.5");
    if (micrometres > 1.0f) lost.emplace_back("films of more than 1 micrometre");
  }
  NameLostMinimumOfFilm(m, lost);
  constexpr float kReflectsAll = 1e9f;  // an index of 0 means F0 = 1
  p.ior = m.ior == 0.0f ? kReflectsAll : std::max(m.ior, 1.0f);
  p.thin_walled = m.thickness_factor == 0.0f;
  p.thickness = m.thickness_factor;
  if (m.thickness_factor != 0.0f && m.thickness_texture) lost.emplace_back("the texture of its thickness");
  p.attenuation_color = m.attenuation_color;
  p.attenuation_distance = m.attenuation_distance;
  p.abbe_number = m.dispersion > 0.0f ? RoundToFiniteFloat(20.0 / double{m.dispersion}) : 0.0f;
  // glTF states radiance.
  p.emission_color = {m.emissive_factor, m.emissive_texture};
  p.emission_value = m.emissive_factor == glm::vec3(0.0f) ? 0.0f : RoundToFiniteFloat(kPi * m.emissive_strength);
  if (m.occlusion_texture && m.occlusion_strength != 0.0f) lost.emplace_back("ambient occlusion");
  NameLost(m, kAnisotropy, lost);
  return p;
}

}  // namespace

FromGltf ConvertFromGltf(const Material& material, ShadingModel model) {
  FromGltf result;
  if (model == ShadingModel::Lecture) result.parameters = ToLecture(material, result.lost);
  if (model == ShadingModel::Filament) result.parameters = ToFilament(material, result.lost);
  if (model == ShadingModel::Enterprise) result.parameters = ToEnterprise(material, result.lost);
  return result;
}

std::string SentenceOf(const std::vector<std::string>& lost, ShadingModel model) {
  return std::string("the model \"") + InfoOf(model).word + "\" does not have " + Joined(lost);
}

void AddDefaultMaterial(const Scene& scene, std::vector<Material>& materials, int& index) {
  const auto lacks = [](const Mesh& mesh) {
    return std::ranges::any_of(mesh.primitives, [](const Primitive& p) { return p.material < 0; });
  };
  if (index >= 0 || std::ranges::none_of(scene.meshes, lacks)) return;
  index = static_cast<int>(materials.size());
  materials.emplace_back();
}

void UseDefaultMaterial(Scene& scene, int index) {
  if (index < 0) return;
  for (Mesh& mesh : scene.meshes) {
    for (Primitive& primitive : mesh.primitives) {
      if (primitive.material < 0) primitive.material = index;
    }
  }
}

std::vector<std::string> ConvertMaterials(Scene& scene, ShadingModel model) {
  int default_material = -1;
  AddDefaultMaterial(scene, scene.materials, default_material);
  UseDefaultMaterial(scene, default_material);
  struct Loss {
    std::string first;  // the material's name
    std::size_t others = 0;
  };
  std::map<std::string, Loss> losses;  // by what is lost: files repeat their materials
  for (Material& material : scene.materials) {
    if (material.parameters != nullptr) continue;
    if (material.model == ShadingModel::Unlit && model != ShadingModel::Filament) continue;  // exact as it is
    FromGltf converted = ConvertFromGltf(material, model);
    if (!converted.lost.empty()) {
      const auto [known, is_new] = losses.try_emplace(SentenceOf(converted.lost, model), Loss{material.name});
      if (!is_new) ++known->second.others;
    }
    Material out;
    out.name = material.name;
    out.alpha_mode = material.alpha_mode;
    out.alpha_cutoff = material.alpha_cutoff;
    out.double_sided = material.double_sided;
    out.model = model;
    out.parameters = std::make_shared<const ModelParameters>(std::move(converted.parameters));
    material = std::move(out);
  }
  std::vector<std::string> sentences;
  for (const auto& [sentence, loss] : losses) {
    const std::string others = loss.others == 0 ? "" : " and " + std::to_string(loss.others) + " more";
    sentences.push_back("material " + Quoted(loss.first) + others + ": " + sentence);
  }
  return sentences;
}

}  // namespace facet
