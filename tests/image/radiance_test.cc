#include <initializer_list>
#include <string>
#include <vector>

#include "facet/film.h"
#include "facet/load.h"
#include "image/codec.h"
#include "image/oiio_loader.h"
#include "image/image_test_util.h"

namespace facet {
namespace {

std::vector<std::byte> File(const std::string& size, std::initializer_list<int> data,
                            const std::string& format = "FORMAT=32-bit_rle_rgbe\n") {
  const std::string head = "#?RADIANCE\n# a comment\n" + format + "\n" + size + "\n";
  std::vector<std::byte> out;
  for (const char c : head) out.push_back(static_cast<std::byte>(c));
  for (const int v : data) out.push_back(static_cast<std::byte>(v));
  return out;
}

std::vector<float> Floats(const Image& image) {
  return {image.As<float>(), image.As<float>() + image.bytes.size() / sizeof(float)};
}

TEST(Radiance, NumbersAreMantissaTimesPowerOfTwo) {
  // Exponent 136 is a factor 1; 0 is black whatever the mantissas are; 128 + 1 makes 128 a half times two.
  const auto file = File("-Y 1 +X 4", {200, 100, 7, 136, 9, 9, 9, 0, 128, 64, 0, 129, 255, 1, 2, 255});
  const Image image = DecodeImage(file, "picture");
  EXPECT_EQ(image.type, ChannelType::F32);
  EXPECT_EQ(image.encoding, Encoding::Linear);
  EXPECT_EQ(Floats(image),
            (std::vector<float>{200, 100, 7, 0, 0, 0, 1.0f, 0.5f, 0, 255 * 0x1p119f, 0x1p119f, 0x1p120f}));
}

TEST(Radiance, OldRunLengths) {
  const auto file = File("-Y 2 +X 3", {10, 20, 30, 136, 1, 1, 1, 2, 1, 2, 3, 136, 4, 5, 6, 136, 7, 8, 9, 136});
  EXPECT_EQ(Floats(DecodeImage(file, "picture")),
            (std::vector<float>{10, 20, 30, 10, 20, 30, 10, 20, 30, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(CodeOf([] { DecodeImage(File("-Y 1 +X 3", {1, 1, 1, 2, 1, 2, 3, 4}), "run of nothing"); }),
            ErrorCode::InvalidInput);
  EXPECT_EQ(CodeOf([] { DecodeImage(File("-Y 1 +X 3", {9, 9, 9, 136, 1, 1, 1, 3}), "too long"); }),
            ErrorCode::InvalidInput);
}

TEST(Radiance, NewRunLengths) {
  const auto file = File("-Y 1 +X 8", {2, 2, 0, 8, 128 + 8, 5, 3, 1, 2, 3, 128 + 5, 4, 8, 1, 2, 3, 4, 5, 6, 7, 8,
                                       128 + 8, 136});
  const Image image = DecodeImage(file, "picture");
  for (int x = 0; x < 8; ++x) {
    EXPECT_EQ(image.As<float>()[3 * x], 5.0f);
    EXPECT_EQ(image.As<float>()[3 * x + 1], x < 3 ? float(x + 1) : 4.0f);
    EXPECT_EQ(image.As<float>()[3 * x + 2], float(x + 1));
  }
  EXPECT_EQ(CodeOf([] { DecodeImage(File("-Y 1 +X 8", {2, 2, 0, 8, 128 + 9, 5}), "too long"); }),
            ErrorCode::InvalidInput);
  EXPECT_EQ(CodeOf([] { DecodeImage(File("-Y 1 +X 8", {2, 2, 0, 9, 128 + 8, 5}), "other width"); }),
            ErrorCode::InvalidInput);
}

TEST(Radiance, RowsRunInAnyDirection) {
  const auto file = File("+Y 2 -X 2", {1, 1, 1, 136, 2, 2, 2, 136, 3, 3, 3, 136, 4, 4, 4, 136});
  // The first pixel of such a file would be a run in the old packing: use other numbers.
  EXPECT_THROW(DecodeImage(file, "run"), Error);
  const auto good = File("+Y 2 -X 2", {5, 0, 0, 136, 2, 0, 0, 136, 3, 0, 0, 136, 4, 0, 0, 136});
  EXPECT_EQ(Floats(DecodeImage(good, "picture")), (std::vector<float>{4, 0, 0, 3, 0, 0, 2, 0, 0, 5, 0, 0}));
}

TEST(Radiance, RefusesWhatItCannotRead) {
  EXPECT_EQ(CodeOf([] { DecodeImage(File("+X 1 -Y 1", {1, 2, 3, 4}), "columns"); }), ErrorCode::Unsupported);
  EXPECT_EQ(CodeOf([] { DecodeImage(File("-Y 1 +X 1", {1, 2, 3, 4}, "FORMAT=32-bit_rle_xyze\n"), "xyz"); }),
            ErrorCode::Unsupported);
  for (const char* size : {"", "-Y", "-Y 1", "-Y a +X 1", "-Y 0 +X 4", "-Y -1 +X 4", "-Y 1 +X 99999999999999999999"}) {
    EXPECT_EQ(CodeOf([&] { DecodeImage(File(size, {1, 2, 3, 4}), "size"); }), ErrorCode::InvalidInput) << size;
  }
  EXPECT_EQ(CodeOf([] { DecodeImage(File("-Y 100000 +X 4", {1, 2, 3, 4}), "bomb"); }), ErrorCode::OutOfMemory);
  EXPECT_EQ(CodeOf([] { DecodeImage(File("-Y 16384 +X 16384", {1, 2, 3, 4}), "hollow"); }), ErrorCode::InvalidInput);
}

TEST(Radiance, EveryTruncationIsAnError) {
  const auto file = File("-Y 2 +X 8", {2, 2, 0, 8, 136, 5, 136, 4, 8, 1, 2, 3, 4, 5, 6, 7, 8, 136, 136,
                                       2, 2, 0, 8, 136, 5, 136, 4, 8, 1, 2, 3, 4, 5, 6, 7, 8, 136, 136});
  EXPECT_NO_THROW(DecodeImage(file, "whole"));
  for (std::size_t length = 0; length < file.size(); ++length) {
    const std::vector<std::byte> cut(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(length));
    if (length < 10) {  // too short to be told for a Radiance picture
      EXPECT_THROW(DecodeImage(cut, "cut"), Error) << length;
    } else {
      EXPECT_EQ(CodeOf([&] { DecodeImage(cut, "cut"); }), ErrorCode::InvalidInput) << length;
    }
  }
}

TEST(Radiance, AgreesWithOpenImageIoOnRealEnvironments) {
  FACET_NEEDS_CORPUS();
  for (const auto& entry : std::filesystem::directory_iterator(Corpus() / "environments")) {
    if (entry.path().extension() != ".hdr") continue;
    const auto bytes = ReadBytes(entry.path());
    ExpectSame(DecodeImage(bytes, "ours"), DecodeWithOiio(bytes, "hdr", "theirs"));
    for (std::size_t i = 1; i < 40; ++i) {
      EXPECT_EQ(CodeOf([&] { DecodeImage(std::span(bytes).first(bytes.size() * i / 40), "cut"); }),
                ErrorCode::InvalidInput);
    }
  }
}

}  // namespace
}  // namespace facet
