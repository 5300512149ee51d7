#include <gtest/gtest.h>

#include <map>

#include "facet/load.h"
#include "image/codec.h"
#include "image/image_test_util.h"

namespace facet {
namespace {

const ImageText kBefore = {{"Software", "facet"}, {"facet:film", "0000"}},
                kAfter = {{"Software", "facet"}, {"facet:film", "beef"}};

Image Rows(const Image& image, int begin, int end) {
  const std::size_t row = image.bytes.size() / std::size_t(image.height);
  Image rows{image.width, end - begin, image.channels, image.type, image.encoding, {}};
  rows.bytes.assign(image.bytes.begin() + std::ptrdiff_t(row * std::size_t(begin)),
                    image.bytes.begin() + std::ptrdiff_t(row * std::size_t(end)));
  return rows;
}

// Writes `image` in bands of `rows` rows.
void Stream(const std::filesystem::path& path, const Image& image, int rows) {
  PngStream png(path, image, kBefore);
  int meanwhile = 0;
  for (int y = 0; y < image.height; y += rows) {
    png.Add(Rows(image, y, std::min(y + rows, image.height)), [&] { ++meanwhile; });
  }
  EXPECT_EQ(meanwhile, (image.height + rows - 1) / rows);
  png.Finish(kAfter);
}

TEST(PngStream, HoldsWhatWasAddedWhateverTheBands) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "picture.png";
  for (const ChannelType type : {ChannelType::U8, ChannelType::U16}) {
    for (int channels = 1; channels <= 4; ++channels) {
      const Encoding encoding = channels == 2 ? Encoding::Linear : Encoding::Srgb;
      const Image image = MakePattern(37, 200, channels, type, encoding);
      for (const int rows : {1, 63, 64, 130, 200}) {
        Stream(path, image, rows);
        const std::vector<std::byte> bytes = ReadBytes(path);
        const Image read = DecodeImage(bytes, "picture");  // every checksum is verified
        EXPECT_TRUE(read.bytes == image.bytes && read.channels == channels && read.type == type) << rows;
        EXPECT_EQ(ReadImageText(bytes, "picture"),
                  (std::map<std::string, std::string>{{"Software", "facet"}, {"facet:film", "beef"}}));
      }
    }
  }
}

// Whole pictures and streamed ones differ in how their pixels are packed, and in nothing else.
TEST(PngStream, BeginsLikeTheWholePicture) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "picture.png";
  const Image image = MakePattern(16, 16, 4, ChannelType::U8);
  Stream(path, image, 5);
  const auto head = [](const std::vector<std::byte>& bytes) {
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return text.substr(0, text.find("IDAT") - 4);
  };
  EXPECT_EQ(head(ReadBytes(path)), head(EncodePng(image, kAfter)));
}

TEST(PngStream, PacksWhatRepeats) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "picture.png";
  const Image flat{4096, 256, 4, ChannelType::U8, Encoding::Srgb, std::vector<std::byte>(4096 * 256 * 4)};
  Stream(path, flat, 64);
  EXPECT_LT(std::filesystem::file_size(path), flat.bytes.size() / 150);
}

TEST(PngStream, RefusesWhatDoesNotFit) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "picture.png";
  const Image image = MakePattern(8, 8, 3, ChannelType::U8);
  const auto nothing = [] {};
  EXPECT_EQ(CodeOf([&] { PngStream(path, MakePattern(8, 8, 3, ChannelType::F32), {}); }), ErrorCode::InvalidUsage);
  EXPECT_EQ(CodeOf([&] { PngStream(path, image, {{"", "no keyword"}}); }), ErrorCode::InvalidUsage);
  std::string what;
  EXPECT_EQ(CodeOf([&] { PngStream(folder / "none" / "picture.png", image, {}); }, &what), ErrorCode::OutputFailed);
  EXPECT_NE(what.find("none/picture.png: cannot be written: No such file"), std::string::npos) << what;
  PngStream png(path, image, kBefore);
  EXPECT_EQ(CodeOf([&] { png.Add(MakePattern(8, 1, 4, ChannelType::U8), nothing); }), ErrorCode::InvalidUsage);
  EXPECT_EQ(CodeOf([&] { png.Add(MakePattern(7, 1, 3, ChannelType::U8), nothing); }), ErrorCode::InvalidUsage);
  png.Add(Rows(image, 0, 5), nothing);
  EXPECT_EQ(CodeOf([&] { png.Finish(kAfter); }), ErrorCode::InvalidUsage) << "rows are missing";
  EXPECT_EQ(CodeOf([&] { png.Add(Rows(image, 0, 4), nothing); }), ErrorCode::InvalidUsage) << "too many";
  png.Add(Rows(image, 5, 8), nothing);
  EXPECT_EQ(CodeOf([&] { png.Finish({{"Software", "longer"}}); }), ErrorCode::InvalidUsage);
}

}  // namespace
}  // namespace facet
