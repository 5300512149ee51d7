// Stored textures: layout, decoding, and mip levels as exact means over areas, in linear light.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <random>

#include "facet/error.h"
#include "texture/read_texel.h"

namespace facet {
namespace {

double ToLinear(double s) { return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4); }

Image RandomImage(int width, int height, int channels, ChannelType type, unsigned seed) {
  std::mt19937 random(seed);
  Image image;
  image.width = width;
  image.height = height;
  image.channels = channels;
  image.type = type;
  image.bytes.resize(image.PixelCount() * std::size_t(channels) * SizeOf(type));
  for (std::size_t i = 0; i < image.PixelCount() * std::size_t(channels); ++i) {
    if (type == ChannelType::U8) image.As<std::uint8_t>()[i] = std::uint8_t(random());
    if (type == ChannelType::U16) image.As<std::uint16_t>()[i] = std::uint16_t(random());
    if (type == ChannelType::F32) image.As<float>()[i] = float(random() >> 8) / 16777216.0f;
  }
  return image;
}

// What a texel of the file means, in double: linear light for colours.
std::array<double, 4> Meaning(const Image& image, TextureRole role, int x, int y) {
  const auto number = [&](int c) {
    const std::size_t i =
        (std::size_t(y) * std::size_t(image.width) + std::size_t(x)) * std::size_t(image.channels) + std::size_t(c);
    return image.type == ChannelType::U8    ? image.As<std::uint8_t>()[i] / 255.0
           : image.type == ChannelType::U16 ? image.As<std::uint16_t>()[i] / 65535.0
                                            : double(image.As<float>()[i]);
  };
  const auto light = [&](int c) {
    return role == TextureRole::Color && image.type != ChannelType::F32 ? ToLinear(number(c)) : number(c);
  };
  switch (image.channels) {
    case 1: return {light(0), light(0), light(0), 1.0};
    case 2: return {light(0), light(0), light(0), number(1)};
    case 3: return {light(0), light(1), light(2), 1.0};
    default: return {light(0), light(1), light(2), number(3)};
  }
}

// The mean of the image over the area of texel (i, j) of a level of m x mh texels: the overlap of intervals, in
// double.
std::array<double, 4> AreaMean(const std::vector<std::array<double, 4>>& texels, int n, int nh, int m, int mh, int i,
                               int j) {
  std::array<double, 4> sum{};
  const double x0 = double(i) * n / m, x1 = double(i + 1) * n / m, y0 = double(j) * nh / mh,
               y1 = double(j + 1) * nh / mh;
  for (int y = int(y0); y < std::min(nh, int(std::ceil(y1))); ++y) {
    for (int x = int(x0); x < std::min(n, int(std::ceil(x1))); ++x) {
      const double w =
          (std::min(x1, x + 1.0) - std::max(x0, double(x))) * (std::min(y1, y + 1.0) - std::max(y0, double(y)));
      for (std::size_t c = 0; c < 4; ++c) sum[c] += w * texels[std::size_t(y * n + x)][c];
    }
  }
  for (double& s : sum) s /= (x1 - x0) * (y1 - y0);
  return sum;
}

struct Case {
  int width, height, channels;
  ChannelType type;
  TextureRole role;
};

std::vector<Case> Cases() {
  std::vector<Case> cases;
  const int sizes[][2] = {{8, 8},   {16, 4}, {1, 1},   {1, 13},  {17, 1}, {7, 5},
                          {15, 31}, {3, 3},  {12, 10}, {33, 64}, {1, 64}, {37, 22}};
  for (const auto& size : sizes) {
    for (int channels : {1, 2, 3, 4}) {
      for (ChannelType type : {ChannelType::U8, ChannelType::U16, ChannelType::F32}) {
        for (TextureRole role : {TextureRole::Color, TextureRole::Data}) {
          cases.push_back({size[0], size[1], channels, type, role});
        }
      }
    }
  }
  return cases;
}

TEST(BuildTexture, EveryTexelOfEveryLevelIsTheMeanOverItsArea) {
  unsigned seed = 1;
  for (const Case& c : Cases()) {
    const Image image = RandomImage(c.width, c.height, c.channels, c.type, seed++);
    const TextureData texture = BuildTexture(image, c.role, true);
    // Colour and what has more than eight bits keeps sixteen. Half a step, and float arithmetic: sums of up to 2^6
    // levels' taps, each correct to 2^-24; the table of sRGB itself is good to a few ULP.
    const double step = c.role == TextureRole::Color || c.type != ChannelType::U8 ? 1.0 / 65535.0 : 1.0 / 255.0;
    const double tolerance = 0.5 * step + 2e-6;
    std::vector<std::array<double, 4>> texels;
    for (int y = 0; y < c.height; ++y) {
      for (int x = 0; x < c.width; ++x) texels.push_back(Meaning(image, c.role, x, y));
    }
    std::vector<std::array<double, 4>> level_texels = texels;
    int n = c.width, nh = c.height;
    for (int level = 0; level < texture.levels; ++level) {
      const int m = std::max(c.width >> level, 1), mh = std::max(c.height >> level, 1);
      ASSERT_EQ(texture.level_width[level], m);
      ASSERT_EQ(texture.level_height[level], mh);
      // Level after level: at powers of two that is the mean over level 0 too; at odd sizes it is the mean over the
      // area of the level above, whose texels straddle (a polyphase box).
      std::vector<std::array<double, 4>> next;
      for (int j = 0; j < mh; ++j) {
        for (int i = 0; i < m; ++i) {
          next.push_back(AreaMean(level_texels, n, nh, m, mh, i, j));
          const std::array<double, 4> stored = ReadTexel(texture, level, i, j);
          for (std::size_t k = 0; k < 4; ++k) {
            ASSERT_NEAR(stored[k], next.back()[k], tolerance)
                << c.width << " x " << c.height << " x " << c.channels << " type " << int(c.type) << " role "
                << int(c.role) << " level " << level << " at " << i << ", " << j;
          }
        }
      }
      // The mean of the whole image stays: that of each level in double is that of level 0.
      std::array<double, 4> mean{}, mean0{};
      for (const auto& t : next)
        for (std::size_t k = 0; k < 4; ++k) mean[k] += t[k] / double(next.size());
      for (const auto& t : texels)
        for (std::size_t k = 0; k < 4; ++k) mean0[k] += t[k] / double(texels.size());
      for (std::size_t k = 0; k < 4; ++k) ASSERT_NEAR(mean[k], mean0[k], 1e-12);
      level_texels = next, n = m, nh = mh;
    }
    EXPECT_EQ(texture.level_width[texture.levels - 1] * texture.level_height[texture.levels - 1], 1);
  }
}

TEST(BuildTexture, WithoutMipsOnlyLevelZeroIsKept) {
  const Image image = RandomImage(20, 12, 4, ChannelType::U8, 9);
  const TextureData with = BuildTexture(image, TextureRole::Data, true),
                    without = BuildTexture(image, TextureRole::Data, false);
  EXPECT_EQ(without.levels, 1);
  EXPECT_EQ(without.bytes.size(), 21u * 12u * 4u + TextureData::kTexelSlack);
  EXPECT_LT(with.bytes.size(), 2 * without.bytes.size());
  for (std::size_t i = 0; i < 21u * 12u * 4u; ++i) ASSERT_EQ(without.bytes[i], with.bytes[i]);
}

TEST(BuildTexture, RowsEndWithTheirFirstTexel) {
  for (const TexelBits bits : {TexelBits::Eight, TexelBits::Sixteen}) {
    const TextureData t = BuildTexture(RandomImage(37, 5, 4, ChannelType::U8, 11), TextureRole::Data, true, bits);
    for (int level = 0; level < t.levels; ++level) {
      for (int y = 0; y < t.level_height[level]; ++y) {
        ASSERT_EQ(ReadTexel(t, level, t.level_width[level], y), ReadTexel(t, level, 0, y)) << level << " " << y;
      }
    }
  }
}

TEST(BuildTexture, EightBitDataIsKeptToTheBit) {
  const Image image = RandomImage(19, 23, 4, ChannelType::U8, 10);
  const TextureData texture = BuildTexture(image, TextureRole::Data, true);
  for (int y = 0; y < 23; ++y) {
    for (int x = 0; x < 19; ++x) {
      for (std::size_t c = 0; c < 4; ++c) {
        ASSERT_EQ(std::lround(ReadTexel(texture, 0, x, y)[c] * 255.0),
                  image.As<std::uint8_t>()[std::size_t(y * 19 + x) * 4 + c]);
      }
    }
  }
}

TEST(BuildTexture, BitsAreWhatIsAskedFor) {
  const Image image = RandomImage(32, 32, 4, ChannelType::U8, 10);
  for (const TextureRole role : {TextureRole::Color, TextureRole::Data}) {
    const TextureData eight = BuildTexture(image, role, true, TexelBits::Eight),
                      sixteen = BuildTexture(image, role, true, TexelBits::Sixteen);
    EXPECT_EQ(sixteen.TexelBytes(), 2 * eight.TexelBytes());
    for (int level = 0; level < eight.levels; ++level) {
      for (int y = 0; y < eight.level_height[level]; ++y) {
        for (int x = 0; x < eight.level_width[level]; ++x) {
          for (std::size_t c = 0; c < 4; ++c) {
            ASSERT_NEAR(ReadTexel(eight, level, x, y)[c], ReadTexel(sixteen, level, x, y)[c], 0.5 / 255 + 0.5 / 65535);
          }
        }
      }
    }
    const TextureData mixed = BuildTexture(image, role, true, TexelBits::Mixed);
    EXPECT_EQ(mixed.bytes, role == TextureRole::Color ? sixteen.bytes : eight.bytes);
  }
}

// Of all images and all that can be asked of them: what is kept is what it is in the whole texture, and takes no more
// room than that.
TEST(BuildTexture, ChannelsThatAreNotReadAreNotKept) {
  for (int image_channels = 1; image_channels <= 4; ++image_channels) {
    const Image image = RandomImage(21, 14, image_channels, ChannelType::U8, 12);
    const bool grey = image_channels < 3, has_alpha = image_channels % 2 == 0;
    for (const TextureRole role : {TextureRole::Color, TextureRole::Data}) {
      const TextureData whole = BuildTexture(image, role, true);
      EXPECT_EQ(whole.components, image_channels);
      for (int channels = 1; channels <= kRgba; ++channels) {
        const TextureData part = BuildTexture(image, role, true, TexelBits::Mixed, channels);
        const int colors = std::popcount(unsigned(channels) & kRgb);
        const int numbers = (grey ? std::min(colors, 1) : colors) + ((channels & kA) != 0 && has_alpha ? 1 : 0);
        ASSERT_EQ(part.components, std::max(numbers, 1)) << image_channels << " " << channels;
        for (int level = 0; level < part.levels; ++level) {
          for (int y = 0; y < part.level_height[level]; ++y) {
            for (int x = 0; x < part.level_width[level]; ++x) {
              const auto expected = ReadTexel(whole, level, x, y), kept = ReadTexel(part, level, x, y);
              for (std::size_t c = 0; c < 4; ++c) {
                if ((channels >> c & 1) == 0) continue;
                ASSERT_EQ(kept[c], expected[c]) << image_channels << " " << channels << " level " << level;
              }
            }
          }
        }
      }
    }
  }
}

TEST(BuildTexture, FloatsOutOfRangeAreClamped) {
  Image image = RandomImage(4, 1, 1, ChannelType::F32, 1);
  const float values[4] = {-3.0f, 7.0f, std::numeric_limits<float>::quiet_NaN(),
                           std::numeric_limits<float>::infinity()};
  std::copy(values, values + 4, image.As<float>());
  const TextureData texture = BuildTexture(image, TextureRole::Data, true);
  const double expected[4] = {0.0, 1.0, 0.0, 1.0};
  for (int x = 0; x < 4; ++x) EXPECT_EQ(ReadTexel(texture, 0, x, 0)[0], expected[x]) << x;
}

TEST(BuildTexture, WhiteStaysWhite) {
  for (ChannelType type : {ChannelType::U8, ChannelType::U16}) {
    for (TextureRole role : {TextureRole::Color, TextureRole::Data}) {
      Image image = RandomImage(37, 22, 4, type, 1);
      std::fill(image.bytes.begin(), image.bytes.end(), std::byte(255));
      const TextureData texture = BuildTexture(image, role, true);
      for (int level = 0; level < texture.levels; ++level) {
        for (int y = 0; y < texture.level_height[level]; ++y) {
          for (int x = 0; x < texture.level_width[level]; ++x) {
            for (double value : ReadTexel(texture, level, x, y)) ASSERT_EQ(value, 1.0);
          }
        }
      }
    }
  }
}

TEST(BuildTexture, PicturesThatAreTooLargeAreRefused) {
  Image image;
  image.width = 40000;
  image.height = 1;
  image.channels = 1;
  image.bytes.resize(40000);
  try {
    BuildTexture(image, TextureRole::Data, true);
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::OutOfMemory);
  }
}

}  // namespace
}  // namespace facet
