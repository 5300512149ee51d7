// What a user's shader sees of a material whose model is not glTF's: its slots have other meanings.
#include <gtest/gtest.h>

#include "facet/models.h"
#include "shade/material_view-inl.h"

namespace facet {
namespace {

namespace lanes = HWY_NAMESPACE;

TEST(MaterialView, OtherModelsAreTheirBaseColour) {
  const ModelParameters parameters = FilamentParameters();
  FrameMaterial material{};
  material.model = ShadingModel::Filament;
  material.parameters = &parameters;
  material.features = kLit | kEmission | lanes::kAllLobes | kTextureBits;  // textures that are not there
  material.features &= ~(BitOf(Slot::BaseColor) | BitOf(Slot::Normal));
  material.factors.base_color[0] = 0.25f;
  for (float& factor : material.factors.emissive) factor = 1.0f;
  lanes::Surface<float> surface{};
  surface.normal = {0.0f, 0.0f, 1.0f};
  surface.color = {1.0f, 0.5f, 1.0f, 0.5f};
  surface.footprint_alpha2 = 0.125f;
  const lanes::MaterialView<float> view(material);
  EXPECT_FALSE(view.Emits());
  EXPECT_EQ(view.Emissive(surface).x, 0.0f);
  EXPECT_EQ(view.Normal(surface).z, 1.0f);
  const lanes::MaterialInputs<float> in = view.Inputs(surface);
  EXPECT_EQ(in.lobes, kDiffuseLobe);
  EXPECT_EQ(in.base_color.x, 0.25f);
  EXPECT_EQ(in.base_color.y, 0.5f);
  EXPECT_EQ(in.alpha_coverage, 0.5f);
  EXPECT_EQ(in.metallic, 0.0f);
  EXPECT_EQ(in.perceptual_roughness, 1.0f);
  EXPECT_EQ(in.normal.z, 1.0f);
  EXPECT_EQ(in.occlusion, 1.0f);
  EXPECT_EQ(in.emissive.x, 0.0f);
  EXPECT_EQ(in.footprint_alpha2, 0.125f);
}

}  // namespace
}  // namespace facet
