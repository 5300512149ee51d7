// A material as the shading stage reads it: factors, texture slots, and which of them count.
#pragma once

#include "facet/scene.h"
#include "material/features.h"
#include "texture/texture.h"

namespace facet {

// A material has five textures, so it reads at most five UV sets.
inline constexpr int kMaxUvSlots = 5;

struct FrameMaterial {
  MaterialFeatures features = 0;
  bool vertex_colors = false;
  AlphaMode alpha_mode = AlphaMode::Opaque;
  float base_color[4] = {1, 1, 1, 1};
  float metallic = 1.0f;
  float perceptual_roughness = 1.0f;
  float normal_scale = 1.0f;
  float occlusion_strength = 1.0f;
  float emissive[3] = {0, 0, 0};  // factor times strength
  float alpha_cutoff = 0.5f;
  int uv_slots = 0;
  int uv_sets[kMaxUvSlots] = {};  // TEXCOORD_n of each slot
  TextureSlot base_color_texture, metallic_roughness_texture, normal_texture, occlusion_texture, emissive_texture;

  bool Has(MaterialFeature feature) const { return (features & feature) != 0; }
};

}  // namespace facet
