// Frames of one Renderer are those of Render(), whatever stood before them.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <utility>

#include "facet/error.h"
#include "facet/film.h"
#include "facet/load.h"
#include "facet/render.h"
#include "render/hand_built.h"
#include "scene/pose.h"

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
  Image image;
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
    renderer.RenderImage(settings, {}, image);
    EXPECT_EQ(ToHex(HashImage(image)), ToHex(HashImage(EncodeFilm(alone, {})))) << what;
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
  settings.environment_samples = 6;
  expect_equal("samples of the environment");
  settings.irradiance = IrradianceMethod::SphericalHarmonics;
  expect_equal("irradiance");
  settings.specular_antialiasing = false;
  expect_equal("no specular antialiasing");
  settings.environment.rotation = 1.0;
  expect_equal("rotation");
  settings.environment.intensity = 0.5;
  expect_equal("intensity");
  settings.texels = TexelBits::Sixteen;
  settings.without = {Feature::EnvironmentLight};
  expect_equal("without light from the environment");
  settings.without = {};
  settings.samples = 1;
  expect_equal("samples");
  settings.height = 90;
  expect_equal("size");
  settings = first;
  expect_equal("back to the first");
}

// Of every kind, and of sizes that are no multiple of a tile or of the lanes.
TEST(Renderer, ImagesAreEncodedFilms) {
  const LoadedScene loaded = LoadGltf(std::string(FACET_SOURCE_DIR) + "/assets/scenes/animated.glb");
  Renderer renderer(loaded.scene);
  Image image;
  RenderSettings settings;
  for (const auto& [width, height] : {std::pair{101, 67}, {64, 64}, {3, 33}}) {
    settings.width = width, settings.height = height;
    for (const int tile_size : {8, 64}) {
      settings.tile_size = tile_size;
      RenderStats of_film, of_image;
      const Film film = Render(loaded.scene, settings, &of_film);
      for (const bool opaque : {false, true}) {
        DisplaySettings display;
        display.tone_map = ToneMap::Aces;
        display.exposure_ev = 0.5;
        if (opaque) display.background_srgb = glm::vec3(0.2f, 0.9f, 0.4f);
        for (const ChannelType type : {ChannelType::U8, ChannelType::U16, ChannelType::F32}) {
          renderer.RenderImage(settings, display, image, &of_image, type);
          const Image encoded = EncodeFilm(film, display, type);
          EXPECT_EQ(image.width, encoded.width);
          EXPECT_EQ(image.height, encoded.height);
          EXPECT_EQ(image.channels, encoded.channels);
          EXPECT_EQ(image.encoding, encoded.encoding);
          EXPECT_TRUE(image.bytes == encoded.bytes) << width << " " << tile_size << " " << opaque << " " << int(type);
          EXPECT_EQ(of_image.covered_pixels, of_film.covered_pixels);
        }
      }
    }
  }
  DisplaySettings wrong;
  wrong.background_srgb = glm::vec3(2.0f);
  EXPECT_THROW(renderer.RenderImage(settings, wrong, image), Error);
}

TEST(Renderer, DecodesOnceAndSaysEachTimeWhatFailed) {
  Scene scene;
  Material material;
  material.base_color_texture =
      Ref(AddTexture(scene, MakeImage(4, 4, [](int x, int y) { return glm::u8vec4(60 * x, 60 * y, 128, 255); }), {}));
  material.emissive_texture =
      Ref(AddTexture(scene, MakeImage(2, 2, [](int x, int y) { return glm::u8vec4(100 * x, 100 * y, 0, 255); }), {}));
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

// Fails until it is told that the image is there; counts how often it is asked.
class Late final : public ImageSource {
 public:
  explicit Late(bool may_change) : may_change_(may_change) {}
  std::string Name() const override { return "late.png"; }
  Image Decode() const override {
    ++asked;
    if (!is_there) throw Error(ErrorCode::NotFound, "no such file");
    return MakeImage(4, 4, [](int x, int y) { return glm::u8vec4(60 * x, 60 * y, 128, 255); });
  }
  bool MayChange() const override { return may_change_; }

  mutable int asked = 0;
  bool is_there = false;

 private:
  const bool may_change_;
};

TEST(Renderer, TriesAgainWhatMayHaveChanged) {
  for (const bool may_change : {true, false}) {
    SCOPED_TRACE(may_change);
    const auto late = std::make_shared<Late>(may_change);
    Scene scene;
    Material material = Unlit(glm::vec4(1));
    material.base_color_texture = Ref(AddTexture(scene, late));
    Add(scene, Rectangle(-1, -1, 1, 1), AddMaterial(scene, material));
    Renderer renderer(scene);
    const RenderSettings settings = Settings(16, 16, 1, Orthographic(1.0));
    Film film;
    const auto frame = [&] {
      RenderStats stats;
      renderer.Render(settings, film, &stats);
      return stats;
    };
    EXPECT_EQ(frame().warnings.size(), 1u);
    EXPECT_EQ(frame().warnings.size(), 1u);
    EXPECT_EQ(late->asked, may_change ? 2 : 1);
    const Film without = film;
    late->is_there = true;
    const RenderStats then = frame();
    EXPECT_EQ(then.images_decoded, may_change ? 1u : 0u);
    EXPECT_EQ(then.warnings.size(), may_change ? 0u : 1u);
    EXPECT_EQ(SameBytes(film, without), !may_change);
    EXPECT_EQ(frame().images_decoded, 0u);
    EXPECT_EQ(late->asked, may_change ? 3 : 1) << "what is decoded is not asked for again";
  }
}

TEST(Renderer, TriesAgainAFileThatIsThereLater) {
  const std::filesystem::path folder = testing::TempDir() + "facet_late_" + std::to_string(::getpid());
  std::filesystem::create_directory(folder);
  const std::filesystem::path file = folder / "t.png", away = folder / "away.png";
  WriteImage(file, MakeImage(4, 4, [](int x, int y) { return glm::u8vec4(60 * x, 60 * y, 128, 255); }));
  std::ofstream(folder / "s.gltf") << R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":0},"material":0}]}],
      "accessors":[{"componentType":5126,"count":3,"type":"VEC3"}],"images":[{"uri":"t.png"}],"textures":[{"source":0}],
      "materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}]})";
  LoadedScene loaded = LoadGltf(folder / "s.gltf");
  loaded.scene.materials.at(0).model = ShadingModel::Unlit;
  Primitive& p = loaded.scene.meshes.at(0).primitives.at(0);
  p.positions = {{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}};
  p.tex_coords = {{{0, 0}, {1, 0}, {0, 1}}};
  Renderer renderer(loaded.scene);
  std::filesystem::rename(file, away);
  Film film;
  RenderStats stats;
  const RenderSettings settings = Settings(16, 16, 1, Orthographic(1.0));
  renderer.Render(settings, film, &stats);
  EXPECT_EQ(stats.images_decoded, 0u);
  ASSERT_EQ(stats.warnings.size(), 1u);
  EXPECT_NE(stats.warnings[0].find("t.png"), std::string::npos) << stats.warnings[0];
  std::filesystem::rename(away, file);
  renderer.Render(settings, film, &stats);
  EXPECT_EQ(stats.images_decoded, 1u);
  EXPECT_TRUE(stats.warnings.empty());
  std::filesystem::remove_all(folder);
}

// Side by side: balls with normal maps and without tangents. A morph target deforms the third, the last has no normals.
Scene BumpyBalls() {
  Scene scene;
  Material bumpy;
  bumpy.normal_texture = Ref(
      AddTexture(scene, MakeImage(8, 8, [](int x, int y) { return glm::u8vec4(90 + 11 * x, 80 + 13 * y, 230, 255); })));
  for (int i = 0; i < 4; ++i) {
    Primitive ball = Sphere(0.8f, i == 1 ? 12 : 9, 12);
    if (i == 3) ball.normals.clear();
    if (i == 2) {
      ball.targets.emplace_back();
      for (const glm::vec3& p : ball.positions) ball.targets[0].positions.push_back(0.2f * p);
    }
    Transform place;
    place.translation = {10.0 * i, 0, 0};
    const int node = Add(scene, std::move(ball), AddMaterial(scene, bumpy), place);
    if (i == 2) scene.meshes[std::size_t(scene.nodes[std::size_t(node)].mesh)].weights = {0.5f};
  }
  return scene;
}

// Tangents are made when something visible needs them, and kept.
TEST(Renderer, MakesTangentsOfGeometryThatIsSeen) {
  const Scene scene = BumpyBalls();
  const auto settings_at = [](double x, double half) {
    RenderSettings settings = Settings(24, 24, 2, Orthographic(half, {x, 0, 10}));
    settings.environment.kind = EnvironmentSettings::Kind::Studio;
    return settings;
  };
  Scene with_tangents = scene;
  for (std::size_t m = 0; m < 2; ++m) {
    with_tangents.meshes[m].primitives[0] = WithTangents(scene.meshes[m].primitives[0], TextureRef());
    EXPECT_FALSE(with_tangents.meshes[m].primitives[0].tangents.empty());
  }
  Renderer renderer(scene);
  std::uint64_t bytes = 0;
  const auto expect_equal = [&](const RenderSettings& settings, const char* what) {
    Film film;
    RenderStats stats;
    renderer.Render(settings, film, &stats);
    EXPECT_TRUE(SameBytes(film, Render(scene, settings))) << what;
    EXPECT_TRUE(SameBytes(film, Render(with_tangents, settings))) << what << ", tangents in the file";
    RenderSettings smooth = settings;
    smooth.without = {Feature::NormalTexture};
    EXPECT_EQ(SameBytes(film, Render(scene, smooth)), stats.covered_pixels == 0) << what;
    return std::exchange(bytes, stats.pose_bytes);
  };
  expect_equal(settings_at(-10, 1), "nothing");
  const std::uint64_t copies = bytes;
  EXPECT_GT(copies, 0u);
  expect_equal(settings_at(20, 1), "the deformed one");
  expect_equal(settings_at(30, 1), "the one without normals");
  EXPECT_EQ(bytes, copies);
  expect_equal(settings_at(0, 1), "the first");
  const std::uint64_t first = bytes - copies;
  EXPECT_GT(first, 0u);
  expect_equal(settings_at(10, 1), "the second");
  const std::uint64_t second = bytes - copies - first;
  EXPECT_GT(second, first) << "it has more vertices";
  EXPECT_EQ(expect_equal(settings_at(15, 17), "all"), bytes);
  EXPECT_EQ(expect_equal(settings_at(0, 1), "the first again"), bytes);
  RenderSettings given_up = settings_at(0, 1);
  given_up.tangents = TangentSource::Generated;
  expect_equal(given_up, "another pose");
  EXPECT_EQ(bytes, copies + first) << "what was made for another pose is gone";
  RenderSettings everything = settings_at(-10, 1);
  everything.omit_unused = false;
  expect_equal(everything, "everything");
  EXPECT_EQ(bytes, copies + first + second);
}

Digest HashWithTiles(const Scene& scene, RenderSettings settings, int tile_size) {
  settings.tile_size = tile_size;
  return HashFilm(Render(scene, settings));
}

// Rows of the background end with the image, not with a packet of lanes.
TEST(Tiles, NeverChangeTheBackground) {
  const LoadedScene loaded = LoadGltf(std::string(FACET_SOURCE_DIR) + "/assets/scenes/animated.glb");
  RenderSettings settings;
  settings.environment.kind = EnvironmentSettings::Kind::Image;
  settings.environment.image = std::make_shared<const Image>(Sky(0.5f));
  settings.background = Background::Environment;
  settings.height = 24;
  for (int width : {57, 64, 128, 131}) {
    settings.width = width;
    const Digest expected = HashWithTiles(loaded.scene, settings, 64);
    for (int tile : {8, 16, 32})
      EXPECT_EQ(HashWithTiles(loaded.scene, settings, tile), expected) << width << " " << tile;
  }
}

// Which lights are left out differs from tile to tile; what they give does not. Slivers, that cover a pixel far from
// where they are lit, among the triangles.
TEST(Tiles, NeverChangeTheLights) {
  Scene scene;
  Material material;
  material.roughness_factor = 0.7f;
  material.double_sided = true;
  const int index = AddMaterial(scene, material);
  Add(scene, Sphere(1.0f, 24, 40), index);
  Uniform random(3);
  Primitive slivers;
  for (int i = 0; i < 60; ++i) {
    const glm::vec3 from(random(-1.5, 1.5), random(-1.5, 1.5), 1.2f), to(random(-1.5, 1.5), random(-1.5, 1.5), 1.2f);
    slivers.positions.insert(slivers.positions.end(), {from, from * 0.43f + to * 0.57f, to});
    for (int k = 0; k < 3; ++k) slivers.normals.emplace_back(0.0f, 0.0f, 1.0f);
  }
  Add(scene, slivers, index);
  for (int i = 0; i < 60; ++i) {
    Light light;
    light.type = LightType::Point;
    light.intensity = 1.0f;
    light.range = static_cast<float>(random(0.2, 0.8));
    light.color = {static_cast<float>(random()), 0.5f, 1.0f};
    scene.lights.push_back(light);
    Node node;
    node.light = i;
    node.transform.translation = {random(-1.5, 1.5), random(-1.5, 1.5), random(0.8, 1.6)};
    scene.nodes.push_back(node);
  }
  RenderSettings settings = Settings(150, 130, 4, Perspective(0.8, {0, 0, 4.5}));
  const Digest expected = HashWithTiles(scene, settings, 64);
  for (int tile : {8, 16, 32}) EXPECT_EQ(HashWithTiles(scene, settings, tile), expected) << tile;
  // The lights are seen at all, and not all of them everywhere.
  settings.without = {Feature::PunctualLights};
  EXPECT_NE(HashWithTiles(scene, settings, 64), expected);
}

}  // namespace
}  // namespace facet
