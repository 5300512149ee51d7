// What a material uses, and what of it cannot show.
#include "material/features.h"

#include <gtest/gtest.h>

#include <string_view>

#include "material/model_parameters.h"
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

// Every layer by the factor that shows it, and what hides it.
struct LayerCase {
  const char* name;
  MaterialFeatures bit;
  void (*show)(Material&);
  bool of_metals;  // and not of dielectrics alone
  bool of_older;   // the specular-glossiness model has it, too
};
const LayerCase kLayers[] = {
    {"clear coat", kClearcoat, [](Material& m) { m.clearcoat_factor = 0.1f; }, true, true},
    {"sheen", kSheen, [](Material& m) { m.sheen_color_factor.y = 0.1f; }, true, true},
    {"specular factor", kSpecular, [](Material& m) { m.specular_factor = 0.5f; }, false, false},
    {"specular colour", kSpecular, [](Material& m) { m.specular_color_factor.z = 0.5f; }, false, false},
    {"ior", kIor, [](Material& m) { m.ior = 1.4f; }, false, false},
    {"ior of 0", kIor, [](Material& m) { m.ior = 0.0f; }, false, false},
    {"transmission", kTransmission, [](Material& m) { m.transmission_factor = 0.1f; }, false, true},
    {"volume", kTransmission | kVolume, [](Material& m) { m.transmission_factor = 0.1f, m.thickness_factor = 1.0f; },
     false, true},
    {"dispersion", kTransmission | kVolume | kDispersion,
     [](Material& m) { m.transmission_factor = 0.1f, m.thickness_factor = 1.0f, m.dispersion = 1.0f; }, false, true},
    {"diffuse transmission", kDiffuseTransmission, [](Material& m) { m.diffuse_transmission_factor = 0.1f; }, false,
     true},
    {"volume behind diffuse transmission", kDiffuseTransmission | kVolume,
     [](Material& m) { m.diffuse_transmission_factor = 0.1f, m.thickness_factor = m.dispersion = 1.0f; }, false, true},
    {"thickness without transmission", 0, [](Material& m) { m.thickness_factor = 1.0f; }, true, true},
    {"iridescence", kIridescence, [](Material& m) { m.iridescence_factor = 0.1f; }, true, true},
    {"anisotropy", kAnisotropy, [](Material& m) { m.anisotropy_strength = 0.1f; }, true, true},
};

TEST(MaterialFeatures, LayersShowByTheirFactors) {
  for (const LayerCase& layer : kLayers) {
    SCOPED_TRACE(layer.name);
    Material m;
    m.metallic_factor = 0.5f;
    layer.show(m);
    EXPECT_EQ(FeaturesOf(m), kLit | kDiffuseLobe | layer.bit);
    EXPECT_EQ(FeaturesOf(m, /*on_surface=*/false), 0u) << "points and lines without normals show colour alone";
    m.metallic_factor = 1.0f;
    EXPECT_EQ(FeaturesOf(m), kLit | (layer.of_metals ? layer.bit : 0)) << "of a metal";
    m.model = ShadingModel::SpecularGlossiness;
    EXPECT_EQ(FeaturesOf(m) & kLayerFeatures, layer.of_older ? layer.bit : 0) << "of the older model";
    m.model = ShadingModel::Unlit;
    EXPECT_EQ(FeaturesOf(m), 0u);
  }
}

TEST(MaterialFeatures, TexturesOfHiddenLayersAreNotRead) {
  Material m;
  m.metallic_factor = 0.5f;
  for (const SlotInfo& slot : kSlots) {
    if (slot.gltf_group != nullptr && std::string_view(slot.gltf_group).starts_with("KHR_")) (m.*slot.ref).texture = 0;
  }
  // The specular factor and its colour are 1 by default, and so their textures show.
  const MaterialFeatures specular = kSpecular | BitOf(Slot::Specular) | BitOf(Slot::SpecularColor);
  EXPECT_EQ(FeaturesOf(m), kLit | kDiffuseLobe | specular);
  m.specular_factor = 0.0f;
  EXPECT_EQ(FeaturesOf(m), kLit | kDiffuseLobe | kSpecular);
  m.specular_factor = 1.0f;
  m.specular_color_factor = glm::vec3(0.0f);
  EXPECT_EQ(FeaturesOf(m), kLit | kDiffuseLobe | kSpecular | BitOf(Slot::Specular));
  m.specular_color_factor = glm::vec3(1.0f);
  // Roughness textures show where the layer does and their factor is not 0.
  m.clearcoat_factor = 1.0f;
  const MaterialFeatures coat = kClearcoat | BitOf(Slot::Clearcoat) | BitOf(Slot::ClearcoatNormal);
  EXPECT_EQ(FeaturesOf(m), kLit | kDiffuseLobe | specular | coat);
  m.clearcoat_roughness_factor = 0.5f;
  EXPECT_EQ(FeaturesOf(m), kLit | kDiffuseLobe | specular | coat | BitOf(Slot::ClearcoatRoughness));
  m.clearcoat_factor = 0.0f;
  // A film of one thickness reads none.
  m.iridescence_factor = 1.0f;
  const MaterialFeatures film = kIridescence | BitOf(Slot::Iridescence);
  EXPECT_EQ(FeaturesOf(m), kLit | kDiffuseLobe | specular | film | BitOf(Slot::IridescenceThickness));
  m.iridescence_thickness_minimum = m.iridescence_thickness_maximum;
  EXPECT_EQ(FeaturesOf(m), kLit | kDiffuseLobe | specular | film);
  // Nothing is behind a metal.
  m.metallic_factor = 1.0f;
  m.transmission_factor = m.diffuse_transmission_factor = m.thickness_factor = m.dispersion = 1.0f;
  EXPECT_EQ(FeaturesOf(m), kLit | film);
}

// --- Models with parameters of their own ----------------------------------------------------------------------------

TEST(ModelSlots, TheNormalTextureIsWhereGltfHasIt) {
  EXPECT_EQ(SlotOf(&LectureParameters::normal), Slot::Normal);
  EXPECT_EQ(SlotOf(&FilamentParameters::normal), Slot::Normal);
  EXPECT_EQ(SlotOf(&FilamentParameters::clear_coat_normal), Slot::ClearcoatNormal);
  EXPECT_EQ(SlotOf(&EnterpriseParameters::normal), Slot::Normal);
  EXPECT_EQ(SlotOf(&EnterpriseParameters::clearcoat_normal), Slot::ClearcoatNormal);
  FilamentParameters p;
  p.normal.scale = 0.25f;
  p.clear_coat_normal.scale = 0.5f;
  Material m;
  m.model = ShadingModel::Filament;
  m.parameters = std::make_shared<const ModelParameters>(p);
  EXPECT_EQ(FactorsOf(m).normal_scale, 0.25f);
}

FilamentParameters Without(const FilamentParameters& p, Feature feature, FeatureSet& stated) {
  return std::get<FilamentParameters>(WithoutFeatures(p, {feature}, stated));
}

// Subsurface lets light pass by default: the defaults in the place of what is disabled would add light.
TEST(ModelsWithout, SubsurfaceLetsNoMoreLightPass) {
  FilamentParameters p;
  FeatureSet stated;
  EXPECT_EQ(Without(p, Feature::DiffuseTransmission, stated).subsurface_color, p.subsurface_color) << "lit";
  EXPECT_FALSE(stated.Has(Feature::DiffuseTransmission));
  p.shading_model = FilamentParameters::Shading::Subsurface;
  for (const glm::vec3 color : {glm::vec3(FilamentParameters::kNotStated), glm::vec3(0.25f)}) {
    p.subsurface_color = {color, {.texture = 0}};
    EXPECT_NE(FeaturesOf(p) & kDiffuseTransmission, 0u);
    stated = {};
    const FilamentParameters without = Without(p, Feature::DiffuseTransmission, stated);
    EXPECT_EQ(without.subsurface_color, facet::Textured<glm::vec3>{glm::vec3(0.0f)});
    EXPECT_TRUE(stated.Has(Feature::DiffuseTransmission));
    EXPECT_EQ(FeaturesOf(without) & kDiffuseTransmission, 0u);
    EXPECT_EQ(Without(p, Feature::Volume, stated).subsurface_color, p.subsurface_color);
  }
  for (const float thickness : {0.0f, 0.25f, 0.5f, 0.75f, 1.0f}) {
    p.thickness = {thickness, {.texture = 0}};
    const FilamentParameters without = Without(p, Feature::Volume, stated);
    EXPECT_EQ(without.thickness, facet::Textured<float>{std::max(thickness, 0.5f)});
    EXPECT_EQ(Without(p, Feature::Sheen, stated).thickness, p.thickness);
  }
}

TEST(ModelsWithout, BlendingIsMoreThanTheAlphaMode) {
  using Blending = FilamentParameters::Blending;
  for (const Blending blending : {Blending::Transparent, Blending::Fade, Blending::Add, Blending::Multiply,
                                  Blending::Screen, Blending::Masked, Blending::AlphaMode}) {
    FilamentParameters p;
    p.blending = blending;
    FeatureSet stated;
    const bool stays = blending == Blending::Masked || blending == Blending::AlphaMode;
    const FilamentParameters without = Without(p, Feature::Blending, stated);
    EXPECT_EQ(without.blending, stays ? blending : Blending::Opaque);
    EXPECT_EQ(FeaturesOf(without) & kTransmission, 0u);
    EXPECT_EQ(Without(p, Feature::Sheen, stated).blending, blending);
  }
}

}  // namespace
}  // namespace facet
