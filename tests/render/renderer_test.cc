// Frames of one Renderer are those of Render(), whatever stood before them.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "facet/digest.h"
#include "facet/error.h"
#include "facet/load.h"
#include "facet/render.h"
#include "render/hand_built.h"

namespace facet {
namespace {

Image Sky(float radiance) {
  Image image;
  image.width = 8;
  image.height = 4;
  image.channels = 3;
  image.type = ChannelType::F32;
  image.encoding = Encoding::Linear;
  image.bytes.resize(image.PixelCount() * 3 * sizeof(float));
  for (std::size_t i = 0; i < image.PixelCount() * 3; ++i) image.As<float>()[i] = radiance * float(i % 7);
  return image;
}

// Every step changes something that an earlier frame left behind; the last one goes back to the first.
TEST(Renderer, FramesEqualSingleRenderings) {
  const LoadedScene loaded = LoadGltf(std::string(FACET_SOURCE_DIR) + "/assets/scenes/animated.glb");
  RenderSettings settings;
  settings.width = 70;
  settings.height = 50;
  Renderer renderer(loaded.scene);
  Film film;
  const RenderSettings first = settings;
  Digest before{};
  const auto expect_equal = [&](const char* what) {
    renderer.Render(settings, film);
    const Film alone = Render(loaded.scene, settings);
    EXPECT_EQ(film.width, settings.width);
    EXPECT_EQ(film.height, settings.height);
    EXPECT_EQ(ToHex(HashFilm(film)), ToHex(HashFilm(alone))) << what;
    EXPECT_NE(HashFilm(film), before) << what << " changes nothing";
    before = HashFilm(film);
  };
  expect_equal("first");
  settings.camera = OrbitCamera{1.0, 1.2, {}, {}, {}};
  expect_equal("camera");
  settings.animation = 0;
  settings.time = 0.4;
  expect_equal("time");
  settings.environment.kind = EnvironmentSettings::Kind::Image;
  settings.environment.image = std::make_shared<const Image>(Sky(0.5f));
  expect_equal("environment");
  settings.environment.image = std::make_shared<const Image>(Sky(1.0f));
  expect_equal("another environment");
  settings.background = Background::Environment;
  expect_equal("background");
  settings.environment_size = 64;
  settings.environment_samples = 6;
  settings.irradiance = IrradianceMethod::SphericalHarmonics;
  expect_equal("environment's approximations");
  settings.samples = 1;
  settings.height = 90;
  expect_equal("size");
  settings = first;
  expect_equal("back to the first");
}

TEST(Renderer, DecodesOnceAndSaysEachTimeWhatFailed) {
  Scene scene;
  Material material;
  material.base_color_texture =
      Ref(AddTexture(scene, Picture(4, 4, [](int x, int y) { return glm::u8vec4(60 * x, 60 * y, 128, 255); }), {}));
  material.emissive_texture = Ref(AddTexture(
      scene, Picture(2, 2, [](int x, int y) { return glm::u8vec4(100 * x, 100 * y, 0, 255); }), {}));
  material.emissive_factor = {1.0f, 1.0f, 1.0f};
  class Broken final : public ImageSource {
   public:
    std::string Name() const override { return "broken.png"; }
    Image Decode() const override { throw Error(ErrorCode::InvalidInput, "no picture"); }
  };
  scene.images[1].source = std::make_shared<const Broken>();
  Add(scene, Rectangle(-1, -1, 1, 1), AddMaterial(scene, material));
  Renderer renderer(scene);
  Film film;
  for (int frame = 0; frame < 3; ++frame) {
    RenderStats stats;
    renderer.Render(Settings(16, 16, 1, Perspective(1.0, {0, 0, 3})), film, &stats);
    EXPECT_EQ(stats.images_decoded, frame == 0 ? 1u : 0u);
    EXPECT_GT(stats.texture_bytes, 0u);
    ASSERT_EQ(stats.warnings.size(), 1u);
    EXPECT_NE(stats.warnings[0].find("broken.png"), std::string::npos);
  }
  // Other texels are other textures.
  RenderSettings settings = Settings(16, 16, 1, Perspective(1.0, {0, 0, 3}));
  settings.texels = TexelBits::Eight;
  RenderStats stats;
  renderer.Render(settings, film, &stats);
  EXPECT_EQ(stats.images_decoded, 1u);
}

}  // namespace
}  // namespace facet
