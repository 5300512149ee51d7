// What a material uses, and what of it cannot show.
#include "material/features.h"

#include <gtest/gtest.h>

#include "material/slots.h"

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

TEST(MaterialFeatures, WhatIsNotAllMetalHasADiffuseLobe) {
  Material m;
  m.metallic_factor = 0.9f;
  EXPECT_EQ(FeaturesOf(m), kLit | kDiffuseLobe);
  m.metallic_factor = 1.0f;
  m.metallic_roughness_texture.texture = 0;
  EXPECT_NE(FeaturesOf(m) & kDiffuseLobe, 0u);
}

TEST(MaterialFeatures, EverythingIsSeen) {
  EXPECT_EQ(FeaturesOf(Textured()), kLit | BitOf(Slot::BaseColor) | BitOf(Slot::MetallicRoughness) |
                                        BitOf(Slot::Normal) | BitOf(Slot::Occlusion) | BitOf(Slot::Emissive) |
                                        kEmission | kDiffuseLobe);
}

TEST(MaterialFeatures, WhatCannotShowIsDisabled) {
  Material m = Textured();
  m.emissive_strength = 0.0f;
  EXPECT_EQ(FeaturesOf(m) & (kEmission | BitOf(Slot::Emissive)), 0u);
  m = Textured();
  m.occlusion_strength = 0.0f;
  EXPECT_EQ(FeaturesOf(m) & BitOf(Slot::Occlusion), 0u);
  m = Textured();
  m.metallic_factor = m.roughness_factor = 0.0f;
  EXPECT_EQ(FeaturesOf(m) & BitOf(Slot::MetallicRoughness), 0u);
  m.roughness_factor = 0.1f;
  EXPECT_NE(FeaturesOf(m) & BitOf(Slot::MetallicRoughness), 0u);
}

TEST(MaterialFeatures, UnlitKeepsColourAndCoverageOnly) {
  Material m = Textured();
  m.model = ShadingModel::Unlit;
  m.double_sided = true;
  m.alpha_mode = AlphaMode::Mask;
  EXPECT_EQ(FeaturesOf(m), BitOf(Slot::BaseColor) | kAlphaTest | kDoubleSided);
  m.alpha_mode = AlphaMode::Blend;
  EXPECT_EQ(FeaturesOf(m), BitOf(Slot::BaseColor) | kAlphaBlend | kDoubleSided);
}

}  // namespace
}  // namespace facet
