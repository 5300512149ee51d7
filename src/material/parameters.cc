#include "material/parameters.h"

namespace facet {

MaterialFactors FactorsOf(const Material& material) {
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
