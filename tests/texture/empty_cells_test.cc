// Textures of emission: what is black takes no memory and is not read, and nothing shows that.
#include <gtest/gtest.h>

#include <random>

#include "texture/read_texel.h"
#include "texture/sample-inl.h"

namespace facet {
namespace {

namespace lanes = HWY_NAMESPACE;

struct Place {
  int x, y;
};

Image BlackBut(int width, int height, const std::vector<Place>& lit, int channels = 3) {
  Image image{width, height, channels, ChannelType::U8, Encoding::Srgb, {}};
  image.bytes.resize(image.PixelCount() * std::size_t(channels), std::byte(0));
  for (const Place& p : lit) {
    image.bytes[(std::size_t(p.y) * std::size_t(width) + std::size_t(p.x)) * std::size_t(channels) + 1] =
        std::byte(255);
  }
  return image;
}

TextureData Emission(const Image& image, bool emission, TexelBits bits = TexelBits::Mixed) {
  return BuildTexture(image, TextureRole::Color, true, bits, kRgb, emission);
}

// Whatever is sampled: a sample that is called dark is black to the last bit, however near the light is, and samples in
// the middle of nothing are called so.
TEST(EmptyCells, AreWhereSamplesAreBlack) {
  std::mt19937 random(3);
  const auto uniform = [&](double low, double high) {
    return static_cast<float>(std::uniform_real_distribution<double>(low, high)(random));
  };
  int dark = 0, lit = 0;
  for (const auto& [width, height] : {std::pair{1024, 512}, {301, 177}, {1000, 90}, {128, 2048}}) {
    const std::vector<Place> places = {{0, height - 1}, {width / 2, height / 3}, {width - 3, height / 2}};
    const TextureData data = Emission(BlackBut(width, height, places), true);
    for (const Wrap wrap : {Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge}) {
      for (const MipFilter mip : {MipFilter::None, MipFilter::Nearest, MipFilter::Linear}) {
        BoundTexture slot;
        slot.data = &data;
        slot.sampler.wrap_u = slot.sampler.wrap_v = wrap;
        slot.sampler.mip = mip;
        for (int i = 0; i < 4000; ++i) {
          const Place& p = places[random() % places.size()];
          const float near = random() % 4 == 0 ? 2.0f : 0.04f, size = uniform(0.0, random() % 8 == 0 ? 0.3 : 0.03);
          const lanes::Vec2<float> uv{(float(p.x) + 0.5f) / float(width) + uniform(-near, near),
                                      (float(p.y) + 0.5f) / float(height) + uniform(-near, near)},
              dx{uniform(-size, size), uniform(-size, size)}, dy{uniform(-size, size), uniform(-size, size)};
          lanes::TextureTaps<float> taps;
          lanes::MakeTextureTaps(slot, uv, dx, dy, taps);
          if (!lanes::IsEmpty(slot, taps)) {
            ++lit;
            continue;
          }
          ++dark;
          const lanes::Vec4<float> c = lanes::ReadTexture<kRgb>(slot, taps);
          ASSERT_EQ(c.x, 0.0f) << uv.x << " " << uv.y;
          ASSERT_EQ(c.y, 0.0f) << uv.x << " " << uv.y;
          ASSERT_EQ(c.z, 0.0f) << uv.x << " " << uv.y;
        }
      }
    }
  }
  EXPECT_GT(dark, 30000);
  EXPECT_GT(lit, 10000);
}

TEST(EmptyCells, AreNotLookedForInOtherTextures) {
  const TextureData data = Emission(BlackBut(256, 256, {{3, 4}}), false);
  EXPECT_EQ(data.empty_cells.width, 0);
  BoundTexture slot;
  slot.data = &data;
  lanes::TextureTaps<float> taps;
  lanes::MakeTextureTaps<float>(slot, {0.5f, 0.5f}, {0.001f, 0.0f}, {0.0f, 0.001f}, taps);
  EXPECT_FALSE(lanes::IsEmpty(slot, taps));
}

// Small images, large ones, whose memory is taken as it is written, and those whose rows begin with light.
TEST(SparseTextures, AreTheOthersTexelByTexel) {
  for (const auto& [width, height] : {std::pair{37, 22}, {300, 200}, {1030, 1100}}) {
    Image image = BlackBut(width, height, {{0, 5}, {0, height - 1}, {width - 1, 7}, {width / 2, height / 2}, {17, 9}});
    std::fill_n(image.bytes.begin() + 3 * 11 * width, 3 * width, std::byte(255));  // a row
    for (const TexelBits bits : {TexelBits::Eight, TexelBits::Mixed}) {
      const TextureData plain = Emission(image, false, bits), sparse = Emission(image, true, bits);
      for (int level = 0; level < plain.levels; ++level) {
        for (int y = 0; y < plain.level_height[level]; ++y) {
          for (int x = 0; x <= plain.level_width[level]; ++x) {  // the first texel stands at the end once more
            ASSERT_EQ(ReadTexel(sparse, level, x, y), ReadTexel(plain, level, x, y)) << level << " " << x << " " << y;
          }
        }
      }
    }
  }
}

TEST(SparseTextures, AreSampledLikeTheOthers) {
  std::mt19937 random(5);
  Image image = BlackBut(256, 256, {});
  for (std::byte& b : image.bytes) b = std::byte(random() % 3 == 0 ? random() : 0);
  const TextureData plain = Emission(image, false), sparse = Emission(image, true);
  EXPECT_TRUE(sparse.sparse);
  BoundTexture a, b;
  a.data = &plain, b.data = &sparse;
  for (int i = 0; i < 1000; ++i) {
    const auto any = [&](float size) { return (float(random() % 2001) / 1000.0f - 1.0f) * size; };
    const lanes::Vec2<float> uv{any(2.0f), any(2.0f)}, dx{any(0.1f), any(0.1f)}, dy{any(0.1f), any(0.1f)};
    const auto p = lanes::SampleTexture<kRgb>(a, uv, dx, dy), q = lanes::SampleTexture<kRgb>(b, uv, dx, dy);
    ASSERT_EQ(p.x, q.x);
    ASSERT_EQ(p.y, q.y);
    ASSERT_EQ(p.z, q.z);
    const auto in_lanes = [&](const BoundTexture& slot) {
      const auto c = lanes::SampleTexture<kRgb, lanes::Float>(slot, {uv.x, uv.y}, {dx.x, dx.y}, {dy.x, dy.y});
      float out[lanes::kMaxLanes];
      lanes::Store(c.y, out);
      return out[0];
    };
    ASSERT_EQ(in_lanes(a), p.y);
    ASSERT_EQ(in_lanes(b), p.y);
  }
}

}  // namespace
}  // namespace facet
