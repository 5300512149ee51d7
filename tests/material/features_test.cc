// What a material uses, and what of it cannot show.
#include "material/features.h"

#include <gtest/gtest.h>

namespace facet {
namespace {

Material Textured() {
  Material m;
  for (TextureRef* ref : {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture, &m.occlusion_texture,
                          &m.emissive_texture}) {
    ref->texture = 0;
  }
  m.emissive_factor = glm::vec3(1.0f);
  return m;
}

TEST(MaterialFeatures, DefaultMaterialIsLitAlone) { EXPECT_EQ(FeaturesOf(Material{}), kLit); }

TEST(MaterialFeatures, EverythingIsSeen) {
  EXPECT_EQ(FeaturesOf(Textured()), kLit | kBaseColorTexture | kMetallicRoughnessTexture | kNormalTexture |
                                        kOcclusionTexture | kEmissiveTexture | kEmission);
}

TEST(MaterialFeatures, WhatCannotShowIsLeftOut) {
  Material m = Textured();
  m.emissive_strength = 0.0f;
  EXPECT_EQ(FeaturesOf(m) & (kEmission | kEmissiveTexture), 0u);
  m = Textured();
  m.occlusion_strength = 0.0f;
  EXPECT_EQ(FeaturesOf(m) & kOcclusionTexture, 0u);
  m = Textured();
  m.metallic_factor = m.roughness_factor = 0.0f;
  EXPECT_EQ(FeaturesOf(m) & kMetallicRoughnessTexture, 0u);
  m.roughness_factor = 0.1f;
  EXPECT_NE(FeaturesOf(m) & kMetallicRoughnessTexture, 0u);
}

TEST(MaterialFeatures, UnlitKeepsColourAndCoverageOnly) {
  Material m = Textured();
  m.unlit = true;
  m.double_sided = true;
  m.alpha_mode = AlphaMode::Mask;
  EXPECT_EQ(FeaturesOf(m), kBaseColorTexture | kAlphaTest | kDoubleSided);
  m.alpha_mode = AlphaMode::Blend;
  EXPECT_EQ(FeaturesOf(m), kBaseColorTexture | kAlphaBlend | kDoubleSided);
}

}  // namespace
}  // namespace facet
