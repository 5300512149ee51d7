// Textures of one size, sampled alike, share the places of their texels.
#include <gtest/gtest.h>

#include <cmath>

#include "texture/sample-inl.h"

namespace facet {
namespace {

namespace lanes = HWY_NAMESPACE;

Image Pattern(int width, int height, unsigned seed) {
  Image image;
  image.width = width, image.height = height, image.channels = 4;
  image.bytes.resize(image.PixelCount() * 4);
  for (std::size_t i = 0; i < image.bytes.size(); ++i) image.bytes[i] = std::byte((i * i / 3 + seed * i) % 251);
  return image;
}

TEST(SharedTaps, ServeTexturesThatAreSampledAlike) {
  const TextureData first = BuildTexture(Pattern(64, 32, 5), TextureRole::Data, true);
  const TextureData second = BuildTexture(Pattern(64, 32, 6), TextureRole::Color, true);
  BoundTexture a, b;
  a.data = &first, b.data = &second;
  ASSERT_TRUE(lanes::HaveSameTaps(a, b));
  const lanes::Vec2<float> uv{0.3f, 0.8f}, dx{0.2f, 0.01f}, dy{-0.01f, 0.1f};
  lanes::TextureTaps<float> taps;
  lanes::MakeTextureTaps(a, uv, dx, dy, taps);
  EXPECT_GT(taps.count, 1);
  EXPECT_TRUE(taps.two_levels);
  const lanes::Vec4<float> shared = lanes::ReadTexture<kRgba>(b, taps);
  const lanes::Vec4<float> own = lanes::SampleTexture<kRgba>(b, uv, dx, dy);
  EXPECT_EQ(shared.x, own.x);
  EXPECT_EQ(shared.y, own.y);
  EXPECT_EQ(shared.z, own.z);
  EXPECT_EQ(shared.w, own.w);
}

TEST(SharedTaps, TexturesThatAreReadTogetherAreThoseThatAreReadAlone) {
  const TextureData textures[5] = {
      BuildTexture(Pattern(64, 32, 5), TextureRole::Data, true),
      BuildTexture(Pattern(64, 32, 6), TextureRole::Color, true),
      BuildTexture(Pattern(64, 32, 7), TextureRole::Data, true, TexelBits::Mixed, kR),
      BuildTexture(Pattern(64, 32, 8), TextureRole::Data, true, TexelBits::Mixed, kG | kB),
      BuildTexture(Pattern(64, 32, 9), TextureRole::Color, true, TexelBits::Mixed, kRgb)};
  const TextureData* together[5];
  for (int k = 0; k < 5; ++k) together[k] = &textures[k];
  BoundTexture slot;
  slot.data = together[0];
  lanes::TextureTaps<float> taps;
  lanes::MakeTextureTaps<float>(slot, {0.3f, 0.8f}, {0.2f, 0.01f}, {-0.01f, 0.1f}, taps);
  for (int count = 1; count <= 5; ++count) {
    lanes::TexelSums<float> all[5];
    lanes::SumTexels(count, together, taps, all);
    for (int k = 0; k < count; ++k) {
      lanes::TexelSums<float> alone;
      lanes::SumTexels(1, together + k, taps, &alone);
      for (int c = 0; c < 4; ++c) EXPECT_EQ(all[k].of_channel[c], alone.of_channel[c]) << count << " " << k << " " << c;
    }
  }
}

// However many places are weighed: each bilinear share is right to 1/16384, and so are the three weights split off it.
TEST(WholeWeights, AreTheExactOnesButForTheirRounding) {
  const TextureData data = BuildTexture(Pattern(64, 32, 11), TextureRole::Data, true);
  BoundTexture slot;
  slot.data = &data;
  slot.max_anisotropy = 16.0f;
  int most_taps = 0;
  double bias = 0.0;
  const int kCount = 4000;
  for (int i = 0; i < kCount; ++i) {
    const float u = float(i % 97) / 97.0f, v = float(i % 61) / 61.0f, length = 0.02f + float(i % 50) * 0.02f,
                width = 0.02f + float(i % 7) * 0.004f;
    lanes::TextureTaps<float> taps;
    lanes::MakeTextureTaps<float>(slot, {u, v}, {length, 0.3f * length}, {-0.1f * width, width}, taps);
    most_taps = std::max(most_taps, taps.count);
    const lanes::Vec4<float> whole = lanes::ReadTexture<kRgba>(slot, taps);
    const auto wide = [](lanes::Vec2<float> a) { return lanes::Vec2<double>{a.x, a.y}; };
    lanes::TextureTaps<double> exact_taps;
    lanes::MakeTextureTaps<double>(slot, wide({u, v}), wide({length, 0.3f * length}), wide({-0.1f * width, width}),
                                   exact_taps);
    if (exact_taps.count != taps.count) continue;  // rounding decided for another number of taps
    const lanes::Vec4<double> exact = lanes::ReadTexture<kRgba>(slot, exact_taps);
    EXPECT_NEAR(whole.x, exact.x, (2.5 * taps.count + 1.0) / 16384) << i << " " << taps.count;
    bias += (whole.x - exact.x) / kCount;
  }
  EXPECT_GE(most_taps, 30);
  EXPECT_LT(std::fabs(bias), 2e-5);
}

TEST(SharedTaps, AreRefusedWhereAnythingDiffersThatPlacesTexels) {
  const TextureData first = BuildTexture(Pattern(64, 32, 5), TextureRole::Data, true);
  const TextureData narrow = BuildTexture(Pattern(32, 32, 5), TextureRole::Data, true);
  const TextureData low = BuildTexture(Pattern(64, 16, 5), TextureRole::Data, true);
  const TextureData one_level = BuildTexture(Pattern(64, 32, 5), TextureRole::Data, false);
  BoundTexture a;
  a.data = &first;
  const auto differs = [&](auto change) {
    BoundTexture b = a;
    change(b);
    return !lanes::HaveSameTaps(a, b) && !lanes::HaveSameTaps(b, a);
  };
  EXPECT_TRUE(differs([&](BoundTexture& b) { b.data = &narrow; }));
  EXPECT_TRUE(differs([&](BoundTexture& b) { b.data = &low; }));
  EXPECT_TRUE(differs([&](BoundTexture& b) { b.data = &one_level; }));
  EXPECT_TRUE(differs([](BoundTexture& b) { b.uv_slot = 1; }));
  for (int i = 0; i < 6; ++i) {
    EXPECT_TRUE(differs([&](BoundTexture& b) { b.transform[i] += 0.5f; })) << i;
  }
  EXPECT_TRUE(differs([](BoundTexture& b) { b.max_anisotropy = 4.0f; }));
  EXPECT_TRUE(differs([](BoundTexture& b) { b.sampler.wrap_u = Wrap::ClampToEdge; }));
  EXPECT_TRUE(differs([](BoundTexture& b) { b.sampler.wrap_v = Wrap::MirroredRepeat; }));
  EXPECT_TRUE(differs([](BoundTexture& b) { b.sampler.mip = MipFilter::Nearest; }));
  EXPECT_TRUE(differs([](BoundTexture& b) { b.sampler.minification = Filter::Nearest; }));
  EXPECT_TRUE(differs([](BoundTexture& b) { b.sampler.magnification = Filter::Nearest; }));
}

}  // namespace
}  // namespace facet
