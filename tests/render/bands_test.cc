// Images in bands, and the limit of memory.
#include <gtest/gtest.h>

#include <cmath>

#include "base/bytes_text.h"
#include "facet/error.h"
#include "facet/film.h"
#include "facet/load.h"
#include "render/hand_built.h"

namespace facet {
namespace {

LoadedScene Bundled(const std::string& name) {
  return LoadGltf(std::string(FACET_SOURCE_DIR) + "/assets/scenes/" + name);
}

// The image put together from bands of at most `max_rows` rows, whose heights are checked.
Film Joined(const Scene& scene, const RenderSettings& settings, int max_rows, RenderStats* stats = nullptr) {
  const int tile = settings.tile_size;
  const int rows = max_rows >= settings.height ? settings.height : std::max(max_rows / tile, 1) * tile;
  Film whole{settings.width, 0, {}};
  RenderBands(
      scene, settings, max_rows,
      [&](const Film& band, int first_row) {
        EXPECT_EQ(first_row, whole.height);
        EXPECT_EQ(band.width, settings.width);
        EXPECT_EQ(band.height, std::min(rows, settings.height - first_row));
        EXPECT_EQ(band.pixels.size(), std::size_t(band.width) * std::size_t(band.height));
        whole.pixels.insert(whole.pixels.end(), band.pixels.begin(), band.pixels.end());
        whole.height += band.height;
        whole.planes.resize(band.planes.size());
        for (std::size_t i = 0; i < band.planes.size(); ++i) {
          const auto& [kind, bytes] = band.planes[i];
          EXPECT_EQ(bytes.size(), band.pixels.size() * InfoOf(kind).PixelBytes());
          whole.planes[i].kind = kind;
          whole.planes[i].bytes.insert(whole.planes[i].bytes.end(), bytes.begin(), bytes.end());
        }
      },
      stats);
  return whole;
}

TEST(Bands, AreTheImageBitForBit) {
  for (const char* name :
       {"showcase.glb", "material_grid.glb", "materials.glb", "gallery.glb", "room.glb", "animated.glb"}) {
    const LoadedScene loaded = Bundled(name);
    for (const int samples : {1, 4}) {
      RenderSettings settings;
      settings.width = 83;
      settings.height = 150;
      settings.samples = samples;
      if (samples == 4) settings.planes = {PlaneKind::Triangle, PlaneKind::Depth};
      settings.background = samples == 1 ? Background::Transparent : Background::Environment;
      RenderStats whole_stats;
      const Film whole = Render(loaded.scene, settings, &whole_stats);
      for (const int tile : {8, 64}) {
        settings.tile_size = tile;
        for (const int max_rows : {1, 8, 77, 149, 150, 1000}) {
          RenderStats stats;
          EXPECT_TRUE(SameBytes(Joined(loaded.scene, settings, max_rows, &stats), whole))
              << name << ", " << samples << " samples, tiles of " << tile << ", " << max_rows << " rows";
          EXPECT_EQ(stats.fragments_shaded, whole_stats.fragments_shaded);
          EXPECT_EQ(stats.fragments_blended, whole_stats.fragments_blended);
          EXPECT_EQ(stats.covered_pixels, whole_stats.covered_pixels);
          EXPECT_EQ(stats.tiles, std::uint64_t((83 + tile - 1) / tile * ((150 + tile - 1) / tile)));
        }
      }
    }
  }
}

TEST(Bands, ProgressOnlyGrows) {
  const LoadedScene loaded = Bundled("room.glb");
  RenderSettings settings;
  settings.width = settings.height = 256;
  settings.tile_size = 8;
  settings.threads = 1;
  std::vector<double> shares;
  settings.progress = [&](double share) { shares.push_back(share); };
  Joined(loaded.scene, settings, 64);
  ASSERT_GE(shares.size(), 16u);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_LT(shares.front(), 0.1);
  EXPECT_EQ(shares.back(), 1.0);
}

TEST(Bands, AReceiverCanStop) {
  const LoadedScene loaded = Bundled("room.glb");
  RenderSettings settings;
  settings.width = settings.height = 64;
  int calls = 0;
  const auto stop = [&](const Film&, int) {
    ++calls;
    throw Error(ErrorCode::OutputFailed, "the disk is full");
  };
  EXPECT_THROW(RenderBands(loaded.scene, settings, 32, stop), Error);
  EXPECT_EQ(calls, 1);
}

// --- The limit ------------------------------------------------------------------------------------------------------

// What Render() says; empty where it draws.
std::string Refusal(const Scene& scene, const RenderSettings& settings) {
  try {
    Render(scene, settings);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::OutOfMemory) << error.what();
    return error.what();
  }
  return {};
}

bool Has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(MemoryLimit, IsExactAboutTheFilm) {
  const LoadedScene loaded = Bundled("room.glb");
  RenderSettings settings;
  settings.width = settings.height = 16384;  // 4 GiB
  settings.memory_limit = (std::uint64_t{4} << 30) - 1;
  const std::string refusal = Refusal(loaded.scene, settings);
  EXPECT_TRUE(Has(refusal, "4.0 GiB for a film of 16384 x 16384 pixels, and the memory limit is 4.0 GiB")) << refusal;
  settings.memory_limit = 1 << 20;
  settings.width = 8192;
  settings.height = 8;  // 1 MiB: no room for the rest
  EXPECT_TRUE(Has(Refusal(loaded.scene, settings), "for the scene, 1.0 MiB for a film of 8192 x 8 pixels"));
  settings.width = settings.height = 64;
  settings.memory_limit = 512 << 20;
  EXPECT_EQ(Refusal(loaded.scene, settings), "");
}

// Says that it is large, and must not be asked for its pixels.
class Hollow final : public ImageSource {
 public:
  Hollow(int width, int height, int bits) : header_{"PNG", width, height, 3, bits, 1000} {}
  Image Decode() const override {
    ADD_FAILURE() << "was decoded";
    throw Error(ErrorCode::InvalidInput, "hollow");
  }
  std::string Name() const override { return "hollow.png"; }
  std::optional<ImageHeader> Header() const override { return header_; }

 private:
  ImageHeader header_;
};

Scene WithTexture(int width, int height, int bits, bool color) {
  Scene scene;
  Material material;
  const int texture = AddTexture(scene, std::make_shared<const Hollow>(width, height, bits), {});
  (color ? material.base_color_texture : material.metallic_roughness_texture) = Ref(texture);
  Add(scene, Rectangle(-1, -1, 1, 1), AddMaterial(scene, material));
  return scene;
}

TEST(MemoryLimit, TexturesAreRefusedBeforeTheyAreDecoded) {
  RenderSettings settings = Settings(16, 16, 1, Perspective(1.0, {0, 0, 3}));
  settings.memory_limit = 5 << 19;
  struct Case {
    int bits;
    bool color;
    const char* bytes;
  };
  // With all levels a third more than 2^20 texels of two channels of a byte (metalness and roughness), or of two bytes
  // where they are finer, or of three of two bytes (colour).
  for (const Case& c : {Case{8, true, "8.0 MiB"}, Case{16, false, "5.3 MiB"}, Case{8, false, "2.7 MiB"}}) {
    const std::string refusal = Refusal(WithTexture(1024, 1024, c.bits, c.color), settings);
    EXPECT_TRUE(Has(refusal, std::string(c.bytes) + " for textures (the largest: hollow.png, 1024 x 1024, "))
        << refusal;
    EXPECT_TRUE(Has(refusal, "4.0 KiB for a film of 16 x 16 pixels, and the memory limit is 2.5 MiB")) << refusal;
  }
}

TEST(MemoryLimit, TexturesBeyondAllLimitsAreRefusedByTheirSize) {
  const RenderSettings settings = Settings(16, 16, 1, Perspective(1.0, {0, 0, 3}));
  const std::string refusal = Refusal(WithTexture(100000, 100000, 8, true), settings);
  EXPECT_TRUE(Has(refusal,
                  "hollow.png: a texture of 100000 x 100000 texels needs 74.5 GiB, and the limit is 32768 a "
                  "side and 2^27 texels in all"))
      << refusal;
}

TEST(MemoryLimit, CountsTheEnvironment) {
  Scene scene;
  Add(scene, Rectangle(-1, -1, 1, 1), AddMaterial(scene, Material()));
  RenderSettings settings = Settings(16, 16, 1, Perspective(1.0, {0, 0, 3}));
  settings.environment.kind = EnvironmentSettings::Kind::Image;
  settings.environment.image = std::make_shared<const Image>(
      Image{1024, 512, 3, ChannelType::U8, Encoding::Srgb, std::vector<std::byte>(1024 * 512 * 3)});
  settings.environment_size = 64;
  settings.memory_limit = 8 << 20;  // 1.5 MiB as it is, 8 MiB in linear light
  const std::string refusal = Refusal(scene, settings);
  EXPECT_TRUE(Has(refusal, "9.7 MiB for an environment of 1024 x 512 pixels")) << refusal;
  settings.memory_limit = 12 << 20;
  EXPECT_EQ(Refusal(scene, settings), "");
  settings.background = Background::Environment;
  EXPECT_TRUE(Has(Refusal(scene, settings), "17.7 MiB for an environment")) << "the picture is kept as well";
  // A small image makes small maps, however large they may be.
  settings.environment.image = std::make_shared<const Image>(
      Image{64, 32, 3, ChannelType::U8, Encoding::Srgb, std::vector<std::byte>(64 * 32 * 3)});
  settings.environment_size = RenderSettings().environment_size;
  settings.memory_limit = 1 << 20;
  EXPECT_EQ(Refusal(scene, settings), "");
}

TEST(MemoryLimit, NeverChangesTheImage) {
  const LoadedScene loaded = Bundled("showcase.glb");
  RenderSettings settings;
  settings.width = settings.height = 64;
  const Film film = Render(loaded.scene, settings);
  settings.memory_limit = std::uint64_t{1} << 40;
  EXPECT_TRUE(SameBytes(Render(loaded.scene, settings), film));
}

TEST(MemoryLimit, PicturesBeyondAllLimitsAreRefusedByTheirSize) {
  Scene scene;
  RenderSettings settings;
  settings.width = settings.height = 1000000;
  try {
    Render(scene, settings);
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_TRUE(
        Has(error.what(), "1000000 x 1000000 pixels needs 14901.2 GiB; each side is 1 to 16384, 4.0 GiB in all"))
        << error.what();
  }
}

}  // namespace
}  // namespace facet
