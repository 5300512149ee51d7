// Functors of a user's own, compiled by facet_add_shader(): what they see of a surface, and the models that they may
// ask.
#include <gtest/gtest.h>

#include "facet/film.h"
#include "facet/shader.h"
#include "render/hand_built.h"
#include "show_model.shader.h"
#include "show_texture_coordinates.shader.h"

namespace facet {
namespace {

TextureRef Checks(Scene& scene, int tex_coord) {
  TextureRef ref =
      Ref(AddTexture(scene, MakeImage(8, 8, [](int x, int y) {
                       return (x + y) % 2 ? glm::u8vec4(250, 200, 150, 255) : glm::u8vec4(60, 90, 120, 255);
                     })));
  ref.tex_coord = tex_coord;
  return ref;
}

Material Textured(Scene& scene) {
  Material material;
  material.base_color_texture = Checks(scene, 0);
  material.normal_texture = Checks(scene, 1);
  return material;
}

// Its texture coordinates are far from zero everywhere, whether its material reads them or not.
Primitive Card(float x0, float x1) {
  Primitive card = Rectangle(x0, -1, x1, 1);
  for (glm::vec2& uv : card.tex_coords[0]) uv = uv * 3.0f + 5.0f;
  card.tex_coords.push_back(card.tex_coords[0]);
  return card;
}

// A functor finds zero in what its material does not read, whatever was shaded before with the same memory.
TEST(OwnShader, SeesZeroWhereTheMaterialReadsNoTextureCoordinates) {
  Scene textured, both;
  Add(textured, Card(-1, 1), AddMaterial(textured, Textured(textured)));
  Add(both, Card(-1, 0), AddMaterial(both, Material()));
  Add(both, Card(0, 1), AddMaterial(both, Textured(both)));
  const auto shader = MakeShowTextureCoordinates();
  RenderSettings settings = Settings(40, 40, 1, Orthographic(1.0));
  settings.threads = 1;
  settings.environment = ConstantEnvironment(1.0f);
  std::optional<Digest> expected;
  for (const Target target : AvailableTargets()) {
    const ScopedTarget scoped(target);
    settings.shader = nullptr;
    Render(textured, settings);
    settings.shader = shader.get();
    Render(textured, settings);
    RenderStats stats;
    const Film film = Render(both, settings, &stats);
    EXPECT_EQ(stats.non_finite_fragments, 0u) << TargetName(target);
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
      const glm::vec4& pixel = film.pixels[i];
      if (i % 40 < 20) {
        ASSERT_EQ(pixel, glm::vec4(0.0f, 0.0f, 0.0f, 1.0f)) << TargetName(target) << ", pixel " << i;
      } else {
        ASSERT_GE(std::min(pixel.x, pixel.y), 5.0f) << TargetName(target) << ", pixel " << i;
        ASSERT_GE(pixel.z, 10.0f) << "the second set";
        ASSERT_LE(pixel.z, 17.0f) << "the second set, and derivatives, but no third";
      }
    }
    const Digest digest = HashFilm(film);
    EXPECT_EQ(expected.value_or(digest), digest) << TargetName(target);
    expected = digest;
  }
}

// A functor has no way to say what is seen through a surface, so it gets the material without transmission, and the
// surface hides what is behind it. The volume stays where light passes diffusely.
TEST(OwnShader, GetsMaterialsWithoutTransmission) {
  const auto shader = MakeShowModel();
  RenderSettings settings = Settings(40, 40, 1, Orthographic(1.0));
  settings.environment = ConstantEnvironment(1.0f);
  for (const float diffuse : {0.0f, 0.5f}) {
    Material glass;
    glass.base_color_factor = {0.2f, 0.5f, 0.9f, 1.0f};
    glass.metallic_factor = 0.0f;
    glass.diffuse_transmission_factor = diffuse;
    glass.thickness_factor = 0.5f;
    glass.attenuation_color = {0.5f, 0.25f, 1.0f};
    glass.attenuation_distance = 0.5f;
    Film films[2];
    for (const bool transmits : {false, true}) {
      glass.transmission_factor = transmits ? 0.75f : 0.0f;
      glass.dispersion = transmits ? 1.0f : 0.0f;
      Scene scene;
      Add(scene, Rectangle(-1, -1, 1, 1), AddMaterial(scene, glass));
      Add(scene, Rectangle(-1, -1, 1, 1, -1), AddMaterial(scene, Unlit({1.0f, 0.0f, 0.0f, 1.0f})));
      settings.shader = shader.get();
      films[transmits] = Render(scene, settings);
      settings.shader = nullptr;
      EXPECT_EQ(SameBytes(Render(scene, settings), films[transmits]), !transmits);
    }
    EXPECT_TRUE(SameBytes(films[0], films[1]));
    EXPECT_EQ(films[1].pixels[0].a, 1.0f);
  }
}

TEST(OwnShader, TheModelOfAMaterialIsWhatItShowsWithoutAShader) {
  Scene scene;
  Add(scene, Card(-1, 0), AddMaterial(scene, Textured(scene)));
  Add(scene, Card(0, 1), AddMaterial(scene, Unlit({0.25f, 0.5f, 0.75f, 1.0f})));
  const auto shader = MakeShowModel();
  RenderSettings settings = Settings(40, 40, 1, Orthographic(1.0));
  settings.environment = ConstantEnvironment(1.0f);
  const Film expected = Render(scene, settings);
  EXPECT_NE(expected.pixels[5], expected.pixels[35]);
  settings.shader = shader.get();
  for (const Target target : AvailableTargets()) {
    const ScopedTarget scoped(target);
    EXPECT_TRUE(SameBytes(Render(scene, settings), expected)) << TargetName(target);
  }
}

}  // namespace
}  // namespace facet
