// A texture that is built from pieces of an image is the one that is built from the whole.
#include <gtest/gtest.h>

#include <random>

#include "facet/error.h"
#include "texture/build_texture.h"

namespace facet {
namespace {

Image Noise(int width, int height, int channels, ChannelType type) {
  Image image{width, height, channels, type, Encoding::Srgb, {}};
  image.bytes.resize(image.PixelCount() * std::size_t(channels) * SizeOf(type));
  std::mt19937 random(7);
  if (type == ChannelType::F32) {
    for (std::size_t i = 0; i < image.PixelCount() * std::size_t(channels); ++i) {
      image.As<float>()[i] = static_cast<float>(random() % 1000) / 900.0f - 0.05f;
    }
  } else {
    for (std::byte& b : image.bytes) b = std::byte(random());
  }
  return image;
}

Image Rows(const Image& image, int first, int count) {
  Image rows = image;
  const std::size_t row = std::size_t(image.width) * std::size_t(image.channels) * SizeOf(image.type);
  rows.height = count;
  rows.bytes.assign(image.bytes.begin() + std::ptrdiff_t(row) * first,
                    image.bytes.begin() + std::ptrdiff_t(row) * (first + count));
  return rows;
}

TEST(TextureBuilder, PiecesMakeTheWhole) {
  for (const auto& [width, height] : {std::pair{64, 64}, {37, 53}, {1, 19}, {130, 3}, {5, 1}}) {
    for (int channels = 1; channels <= 4; ++channels) {
      for (ChannelType type : {ChannelType::U8, ChannelType::U16, ChannelType::F32}) {
        for (TextureRole role : {TextureRole::Color, TextureRole::Data}) {
          const Image image = Noise(width, height, channels, type);
          const TextureData whole = BuildTexture(image, role, true, TexelBits::Mixed);
          for (int piece : {1, 7, 64}) {
            TextureBuilder builder(Rows(image, 0, std::min(piece, height)), height, role, true, TexelBits::Mixed,
                                   kRgba);
            for (int y = 0; y < height; y += piece) builder.Add(Rows(image, y, std::min(piece, height - y)));
            const TextureData texture = builder.Finish();
            ASSERT_EQ(texture.levels, whole.levels);
            ASSERT_TRUE(texture.bytes == whole.bytes) << width << " " << height << " " << channels << " " << piece;
          }
        }
      }
    }
  }
}

TEST(TextureBuilder, MissingSurplusAndForeignRowsAreErrors) {
  const Image image = Noise(8, 6, 3, ChannelType::U8);
  TextureBuilder builder(Rows(image, 0, 4), 6, TextureRole::Data, true, TexelBits::Mixed, kRgba);
  builder.Add(Rows(image, 0, 4));
  EXPECT_THROW(builder.Finish(), Error);
  EXPECT_THROW(builder.Add(image), Error);
  EXPECT_THROW(builder.Add(Noise(8, 2, 4, ChannelType::U8)), Error);
  EXPECT_THROW(builder.Add(Noise(7, 2, 3, ChannelType::U8)), Error);
  builder.Add(Rows(image, 4, 2));
  EXPECT_EQ(builder.Finish().levels, 4);
  Image torn = image;
  torn.bytes.resize(10);
  EXPECT_THROW(TextureBuilder(torn, 6, TextureRole::Data, true, TexelBits::Mixed, kRgba), Error);
}

}  // namespace
}  // namespace facet
