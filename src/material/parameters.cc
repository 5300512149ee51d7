#include "material/parameters.h"

#include <algorithm>
#include <string_view>
#include <type_traits>

#include "material/enterprise_factors.h"
#include "material/model_parameters.h"
#include "math/elementary.h"
#include "math/round_to_float.h"

namespace facet {
namespace {

template <int kLength>
void Copy(const glm::vec<kLength, float>& from, float (&to)[kLength]) {
  for (int i = 0; i < kLength; ++i) to[i] = from[i];
}

// Reflectance at normal incidence between air and a medium: 1 for an index of 0, by KHR_materials_ior.
float NormalReflectance(double ior) {
  const double root = (ior - 1.0) / (ior + 1.0);
  return RoundToFiniteFloat(root * root);
}

// Indices of refraction for red, green and blue (KHR_materials_dispersion): the file's index holds for green, and blue
// is refracted more than red. None is below 1. An index of 0 has no refraction.
void SetIndices(const Material& material, float (&ior)[3]) {
  const double middle = double(material.ior), spread = (middle - 1.0) * 0.025 * double(material.dispersion);
  for (int c = 0; c < 3; ++c) {
    ior[c] = material.ior == 0.0f ? 1.0f : RoundToFiniteFloat(std::max(middle + (c - 1) * spread, 1.0));
  }
}

}  // namespace

MaterialFactors FactorsOf(const Material& m) {
  MaterialFactors f;
  if (m.parameters != nullptr) {
    Copy(BaseColorOf(*m.parameters), f.base_color);
    f.alpha_cutoff = m.alpha_cutoff;
    // For MaterialView::Normal().
    ForEachParameterOf(*m.parameters, [&f]<class Value>(const auto& parameter, const Value& value) {
      if constexpr (std::is_same_v<Value, TangentSpaceNormal>) {
        if (parameter.name == std::string_view("normal")) f.normal_scale = value.scale;
      }
    });
    if (const auto* enterprise = std::get_if<EnterpriseParameters>(m.parameters.get())) {
      SetEnterpriseFactors(*enterprise, f);
    }
    return f;
  }
  Copy(m.base_color_factor, f.base_color);
  f.metallic = m.metallic_factor;
  f.perceptual_roughness = m.roughness_factor;
  f.normal_scale = m.normal_scale;
  f.occlusion_strength = m.occlusion_strength;
  for (int i = 0; i < 3; ++i) f.emissive[i] = m.emissive_factor[i] * m.emissive_strength;
  f.alpha_cutoff = m.alpha_cutoff;

  f.clearcoat = m.clearcoat_factor;
  f.clearcoat_perceptual_roughness = m.clearcoat_roughness_factor;
  f.clearcoat_normal_scale = m.clearcoat_normal_scale;
  Copy(m.sheen_color_factor, f.sheen_color);
  f.sheen_perceptual_roughness = m.sheen_roughness_factor;
  f.dielectric_f0 = NormalReflectance(double(m.ior));
  f.specular = m.specular_factor;
  Copy(m.specular_color_factor, f.specular_color);
  f.transmission = m.transmission_factor;
  SetIndices(m, f.ior);
  f.thickness = m.thickness_factor;
  for (int i = 0; i < 3; ++i) {
    // Where the attenuation colour is black, nothing is left after any distance.
    const double darkest = 1e-30, color = std::max(double(m.attenuation_color[i]), darkest);
    f.absorption[i] = RoundToFiniteFloat(-Log(color) / double(m.attenuation_distance));
  }
  f.diffuse_transmission = m.diffuse_transmission_factor;
  Copy(m.diffuse_transmission_color_factor, f.diffuse_transmission_color);
  f.iridescence = m.iridescence_factor;
  f.iridescence_ior = m.iridescence_ior;
  f.film_thickness_minimum_nm = m.iridescence_thickness_minimum;
  f.film_thickness_maximum_nm = m.iridescence_thickness_maximum;
  f.anisotropy = m.anisotropy_strength;
  f.anisotropy_direction[0] = static_cast<float>(Cos(double(m.anisotropy_rotation)));
  f.anisotropy_direction[1] = static_cast<float>(Sin(double(m.anisotropy_rotation)));
  Copy(m.specular_glossiness_specular_factor, f.specular_glossiness_specular);
  f.glossiness = m.glossiness_factor;
  return f;
}

}  // namespace facet
