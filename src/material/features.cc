#include "material/features.h"

namespace facet {

MaterialFeatures FeaturesOf(const Material& m, bool on_surface) {
  MaterialFeatures features = 0;
  const auto set = [&features](bool condition, MaterialFeature bit) {
    if (condition) features |= bit;
  };
  set(bool(m.base_color_texture), kBaseColorTexture);
  set(m.alpha_mode == AlphaMode::Mask, kAlphaTest);
  set(m.alpha_mode == AlphaMode::Blend, kAlphaBlend);
  set(m.double_sided, kDoubleSided);
  if (m.unlit) return features;
  const bool emits = m.emissive_strength != 0.0f && m.emissive_factor != glm::vec3(0.0f);
  set(emits, kEmission);
  set(emits && bool(m.emissive_texture), kEmissiveTexture);
  if (!on_surface) return features;
  set(true, kLit);
  set(bool(m.metallic_roughness_texture) && (m.metallic_factor != 0.0f || m.roughness_factor != 0.0f),
      kMetallicRoughnessTexture);
  set(bool(m.normal_texture), kNormalTexture);
  set(bool(m.occlusion_texture) && m.occlusion_strength != 0.0f, kOcclusionTexture);
  return features;
}

}  // namespace facet
