// WebP, by libwebp and without OpenImageIO.
#include "image/webp.h"

#include <webp/encode.h>
#include <webp/mux.h>

#include <string>
#include <vector>

#include "facet/film.h"
#include "facet/load.h"
#include "image/codec.h"
#include "image/convert.h"
#include "image/image_test_util.h"
#include "image/oiio_loader.h"

namespace facet {
namespace {

// Nothing of WebP needs OpenImageIO's module.
class WebP : public testing::Test {
 protected:
  WebP() { OverrideOiioSearch(&nowhere_); }
  ~WebP() override { OverrideOiioSearch(nullptr); }

 private:
  const std::vector<std::filesystem::path> nowhere_ = {"/nonexistent"};
};

TEST_F(WebP, ComesBackAsItWasWritten) {
  const TemporaryFolder folder;
  for (const int channels : {3, 4}) {
    // All alphas, and colours under alpha 0.
    const Image image = MakePattern(61, 37, channels, ChannelType::U8);
    WriteImage(folder / "a.webp", image);
    ExpectSame(LoadImage(folder / "a.webp"), image);
  }
  Image clear = MakePattern(8, 8, 4, ChannelType::U8);
  for (std::size_t i = 0; i < clear.PixelCount(); ++i) clear.As<std::uint8_t>()[4 * i + 3] = i % 2 == 0 ? 0 : 200;
  WriteImage(folder / "a.webp", clear);
  ExpectSame(LoadImage(folder / "a.webp"), clear);
  EXPECT_EQ(folder.Names(), std::vector<std::string>{"a.webp"});
}

TEST_F(WebP, GreyAndFinerPicturesAreWrittenAsBytes) {
  const TemporaryFolder folder;
  const Image grey = MakePattern(9, 5, 1, ChannelType::U8), fine = MakePattern(9, 5, 4, ChannelType::U16);
  WriteImage(folder / "a.webp", grey);
  EXPECT_TRUE(LoadImage(folder / "a.webp").bytes == WithChannels(grey, 3).bytes);
  WriteImage(folder / "a.webp", fine);
  EXPECT_TRUE(LoadImage(folder / "a.webp").bytes == WithType(fine, ChannelType::U8).bytes);
}

TEST_F(WebP, TooLargePicturesAreRefused) {
  const TemporaryFolder folder;
  std::string what;
  EXPECT_EQ(CodeOf([&] { WriteImage(folder / "a.webp", MakePattern(16384, 1, 3, ChannelType::U8)); }, &what),
            ErrorCode::InvalidUsage);
  EXPECT_NE(what.find("16383 pixels"), std::string::npos) << what;
  EXPECT_NE(what.find("a.webp"), std::string::npos) << what;
  EXPECT_TRUE(folder.Names().empty());
}

TEST_F(WebP, EveryTruncationIsAnError) {
  const std::vector<std::byte> bytes = EncodeWebP(MakePattern(61, 37, 4, ChannelType::U8));
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    ASSERT_THROW(DecodeImage(std::span(bytes).first(length), "cut"), Error) << length;
  }
}

TEST_F(WebP, OfAnAnimationTheFirstFrameIsRead) {
  WebPAnimEncoder* const encoder = WebPAnimEncoderNew(16, 16, nullptr);
  for (const int channels : {4, 3}) {
    const Image frame = MakePattern(16, 16, channels, ChannelType::U8);
    WebPConfig config;
    WebPPicture picture;
    ASSERT_NE(WebPConfigInit(&config), 0);
    ASSERT_NE(WebPPictureInit(&picture), 0);
    config.lossless = config.exact = picture.use_argb = 1;
    picture.width = picture.height = 16;
    ASSERT_NE((channels == 4 ? WebPPictureImportRGBA : WebPPictureImportRGB)(&picture, frame.As<std::uint8_t>(),
                                                                             16 * channels),
              0);
    EXPECT_NE(WebPAnimEncoderAdd(encoder, &picture, 100 * (4 - channels), &config), 0);
    WebPPictureFree(&picture);
  }
  WebPAnimEncoderAdd(encoder, nullptr, 200, nullptr);
  WebPData file{};
  ASSERT_NE(WebPAnimEncoderAssemble(encoder, &file), 0);
  WebPAnimEncoderDelete(encoder);
  const Image image = DecodeImage({reinterpret_cast<const std::byte*>(file.bytes), file.size}, "animation");
  WebPDataClear(&file);
  ExpectSame(image, MakePattern(16, 16, 4, ChannelType::U8));
}

// Lossy pictures are decoded by integers alone: these bits are the same everywhere.
TEST_F(WebP, OfTheCorpus) {
  FACET_NEEDS_CORPUS();
  const auto folder = Corpus() / "models" / "WebPQuads-derived";
  const Image red = LoadImage(folder / "VP8L_red.webp");
  EXPECT_EQ(red.type, ChannelType::U8);
  EXPECT_EQ(red.encoding, Encoding::Srgb);
  EXPECT_EQ(red.As<std::uint8_t>()[0], 255);
  EXPECT_EQ(red.As<std::uint8_t>()[1], 0);
  EXPECT_EQ(red.As<std::uint8_t>()[2], 0);
  for (const char* name : {"VP8L_red_transparent.webp", "VP8X_red_transparent.webp"}) {
    const Image image = LoadImage(folder / name);
    ASSERT_EQ(image.channels, 4) << name;
    EXPECT_EQ(image.As<std::uint8_t>()[3], 128) << name;
    EXPECT_EQ(image.As<std::uint8_t>()[0], 255) << name << ": the colour must not be multiplied by alpha";
  }
  const auto bytes = ReadBytes(folder / "lossy_1.webp");
  EXPECT_GT(DecodeImage(bytes, "picture").PixelCount(), 1000u);
}

}  // namespace
}  // namespace facet
