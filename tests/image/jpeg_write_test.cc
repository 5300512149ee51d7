// JPEG as it is written: into memory that grows with the file.
#include <cstdlib>
#include <string>
#include <vector>

#include "image/codec.h"
#include "image/image_test_util.h"
#include "image/jpeg.h"

namespace facet {
namespace {

// Noise, which hardly packs: a grey pixel takes more than half a byte.
Image Noise(int side) { return MakePattern(side, side, 1, ChannelType::U8); }

// What is encoded at quality 95 comes back as nearly the same; one byte lost would spoil all that follows it.
void ExpectNearlyTheSame(const Image& image, const std::vector<std::byte>& file) {
  const Image back = DecodeImage(file, "noise.jpg");
  EXPECT_EQ(back.damage, "");
  ASSERT_EQ(back.bytes.size(), image.bytes.size());
  int largest = 0;
  for (std::size_t i = 0; i < image.bytes.size(); ++i) {
    largest = std::max(largest, std::abs(static_cast<int>(image.bytes[i]) - static_cast<int>(back.bytes[i])));
  }
  EXPECT_LE(largest, 40);
}

// The memory begins with 64 KiB and doubles.
TEST(JpegWrite, FilesLargerThanTheMemoryThatTheyBeginWith) {
  constexpr std::size_t kFirst = std::size_t{1} << 16;
  struct Case {
    int side;
    std::size_t above, below;  // bytes of the file
  };
  for (const auto& [side, above, below] : {Case{64, 0, kFirst}, Case{300, kFirst, 2 * kFirst},
                                           Case{420, 2 * kFirst, 4 * kFirst}, Case{1500, 16 * kFirst, 64 * kFirst}}) {
    const Image image = Noise(side);
    const std::vector<std::byte> file = EncodeJpeg(image);
    EXPECT_GT(file.size(), above) << side;
    EXPECT_LT(file.size(), below) << side;
    ExpectNearlyTheSame(image, file);
  }
}

TEST(JpegWrite, NoMemoryForTheFileIsAnError) {
#if defined(FACET_SANITIZED)
  GTEST_SKIP() << "a sanitizer ends the program where there is no memory";
#endif
  const Image image = Noise(4096);
  std::string what;
  WithLittleMemory(std::size_t{4} << 20,
                   [&] { EXPECT_EQ(CodeOf([&] { EncodeJpeg(image); }, &what), ErrorCode::OutOfMemory); });
  EXPECT_NE(what.find("libjpeg: Insufficient memory"), std::string::npos) << what;
  EXPECT_GT(EncodeJpeg(image).size(), std::size_t{8} << 20);
}

}  // namespace
}  // namespace facet
