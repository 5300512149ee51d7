#include "image/convert.h"

#include <cmath>
#include <limits>

#include "image/image_test_util.h"

namespace facet {
namespace {

Image Floats(int channels, std::vector<float> values, Encoding encoding = Encoding::Linear) {
  Image image;
  image.width = static_cast<int>(values.size()) / channels;
  image.height = 1;
  image.channels = channels;
  image.type = ChannelType::F32;
  image.encoding = encoding;
  image.bytes.resize(values.size() * sizeof(float));
  std::copy(values.begin(), values.end(), image.As<float>());
  return image;
}

double Srgb(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

TEST(Convert, DecodesSrgbButNotAlpha) {
  Image image = MakePattern(256, 1, 2, ChannelType::U8);
  for (int i = 0; i < 256; ++i) image.As<std::uint8_t>()[2 * i] = image.As<std::uint8_t>()[2 * i + 1] = std::uint8_t(i);
  const Image linear = ToLinear32F(image);
  EXPECT_EQ(linear.encoding, Encoding::Linear);
  for (int i = 0; i < 256; ++i) {
    EXPECT_FLOAT_EQ(linear.As<float>()[2 * i], float(Srgb(i / 255.0))) << i;
    EXPECT_FLOAT_EQ(linear.As<float>()[2 * i + 1], float(i) / 255.0f) << i;
  }
  Image wide = MakePattern(65536, 1, 1, ChannelType::U16);
  for (int i = 0; i < 65536; ++i) wide.As<std::uint16_t>()[i] = std::uint16_t(i);
  const Image wide_linear = ToLinear32F(wide);
  for (int i = 0; i < 65536; i += 7) EXPECT_FLOAT_EQ(wide_linear.As<float>()[i], float(Srgb(i / 65535.0))) << i;
  image.encoding = Encoding::Linear;
  EXPECT_FLOAT_EQ(ToLinear32F(image).As<float>()[2 * 51], 0.2f);
}

TEST(Convert, RepairsWhatIsNoLight) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  std::size_t repaired = 99;
  const Image out = ToLinearRgb32F(Floats(4, {nan, inf, -inf, 1, -1, 3e38f, 0.5f, 0}), &repaired);
  EXPECT_EQ(out.channels, 3);
  const std::vector<float> expected = {0, 0, 0, 0, kMaxRadiance, 0.5f};
  EXPECT_EQ(std::vector<float>(out.As<float>(), out.As<float>() + 6), expected);
  EXPECT_EQ(repaired, 5u);
  ToLinearRgb32F(Floats(1, {0, 1, 65504}), &repaired);
  EXPECT_EQ(repaired, 0u);
}

TEST(Convert, SpreadsChannels) {
  const Image grey_alpha = Floats(2, {1, 2, 3, 4});
  const Image rgba = WithChannels(grey_alpha, 4);
  EXPECT_EQ(std::vector<float>(rgba.As<float>(), rgba.As<float>() + 8), (std::vector<float>{1, 1, 1, 2, 3, 3, 3, 4}));
  const Image rgb = WithChannels(rgba, 3);
  EXPECT_EQ(std::vector<float>(rgb.As<float>(), rgb.As<float>() + 6), (std::vector<float>{1, 1, 1, 3, 3, 3}));
  EXPECT_EQ(WithChannels(rgb, 4).As<float>()[3], 1.0f);
  EXPECT_EQ(WithChannels(MakePattern(1, 1, 1, ChannelType::U8), 2).As<std::uint8_t>()[1], 255);
  EXPECT_EQ(WithChannels(MakePattern(1, 1, 3, ChannelType::U16), 4).As<std::uint16_t>()[3], 65535);
  EXPECT_EQ(CodeOf([&] { WithChannels(rgb, 1); }), ErrorCode::InvalidUsage);
}

TEST(Convert, DepthsRoundToNearest) {
  Image wide = MakePattern(65536, 1, 1, ChannelType::U16);
  for (int i = 0; i < 65536; ++i) wide.As<std::uint16_t>()[i] = std::uint16_t(i);
  const Image narrow = WithType(wide, ChannelType::U8);
  for (int i = 0; i < 65536; ++i) {
    ASSERT_EQ(narrow.As<std::uint8_t>()[i], static_cast<int>(std::floor(i / 257.0 + 0.5))) << i;
  }
  const Image bytes = MakePattern(300, 1, 3, ChannelType::U8);
  ExpectSame(WithType(WithType(bytes, ChannelType::U16), ChannelType::U8), bytes);
  const Image floats = Floats(1, {-1, 0, 0.5f, 1, 2, std::numeric_limits<float>::quiet_NaN()});
  const Image from_floats = WithType(floats, ChannelType::U8);
  EXPECT_EQ(std::vector<int>(from_floats.As<std::uint8_t>(), from_floats.As<std::uint8_t>() + 6),
            (std::vector<int>{0, 0, 128, 255, 255, 0}));
}

TEST(Convert, SourcesOverMemoryGiveThePictureBack) {
  const Image image = MakePattern(5, 4, 3, ChannelType::U8);
  const auto source = MakeImageSource(image, "image 3");
  EXPECT_EQ(source->Name(), "image 3");
  const auto header = source->Header();
  ASSERT_TRUE(header);
  EXPECT_EQ(header->format, "");
  EXPECT_EQ(header->width, 5);
  EXPECT_EQ(header->height, 4);
  EXPECT_EQ(header->channels, 3);
  EXPECT_EQ(header->bits, 8);
  EXPECT_EQ(header->bytes, 60u);
  ExpectSame(source->Decode(), image);
}

}  // namespace
}  // namespace facet
