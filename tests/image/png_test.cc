#include <png.h>

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/memory_budget.h"
#include "facet/film.h"
#include "facet/load.h"
#include "image/codec.h"
#include "image/image_test_util.h"

namespace facet {
namespace {

TEST(Png, RoundTripsEveryFormThatItHolds) {
  for (const ChannelType type : {ChannelType::U8, ChannelType::U16}) {
    for (int channels = 1; channels <= 4; ++channels) {
      for (const int width : {1, 7, 64}) {
        const Image image = MakePattern(width, 33, channels, type);
        ExpectSame(DecodeImage(EncodePng(image), "picture"), image);
      }
    }
  }
}

TEST(Png, PiecesMakeTheWhole) {
  for (const ChannelType type : {ChannelType::U8, ChannelType::U16}) {
    for (int height : {1, 64, 65, 200}) {
      const Image image = MakePattern(9, height, 3, type);
      int pieces = 0;
      ExpectSame(Joined(EncodePng(image), &pieces), image);
      EXPECT_EQ(pieces, (height + 63) / 64);
    }
  }
}

TEST(Png, BytesAreDeterministicAndCarryText) {
  const Image image = MakePattern(20, 20, 4, ChannelType::U8);
  const std::vector<std::array<std::string, 2>> text = {{"Software", "facet"}, {"Author", "J\xC3\xBCrgen"}};
  const auto bytes = EncodePng(image, text);
  EXPECT_TRUE(bytes == EncodePng(image, text));
  const std::string file(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  EXPECT_NE(file.find(std::string("tEXtSoftware\0facet", 18)), std::string::npos);
  EXPECT_NE(file.find(std::string("iTXtAuthor\0\0\0\0\0J\xC3\xBCrgen", 22)), std::string::npos);
  EXPECT_NE(file.find("sRGB"), std::string::npos);
  ExpectSame(DecodeImage(bytes, "picture"), image);
  const std::map<std::string, std::string> read = ReadImageText(bytes, "picture");
  EXPECT_EQ(read, (std::map<std::string, std::string>{{"Software", "facet"}, {"Author", "J\xC3\xBCrgen"}}));
  for (const char* key : {"", " a", "a ", "a  b", "a\nb"}) {
    EXPECT_EQ(CodeOf([&] { EncodePng(image, {{key, "value"}}); }), ErrorCode::InvalidUsage) << key;
  }
}

TEST(Png, TextOfBrokenFilesIsRefused) {
  auto bytes = EncodePng(MakePattern(20, 20, 4, ChannelType::U8), {{"Software", "facet"}});
  EXPECT_EQ(CodeOf([&] { ReadImageText(std::span(bytes).first(0), "picture"); }), ErrorCode::InvalidInput);
  EXPECT_EQ(CodeOf([&] { ReadImageText(std::span(bytes).first(70), "picture"); }), ErrorCode::InvalidInput);
  const std::string_view file(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  bytes[file.find("facet")] = std::byte('F');  // the checksum no longer fits
  EXPECT_EQ(CodeOf([&] { ReadImageText(bytes, "picture"); }), ErrorCode::InvalidInput);
}

// Files that facet does not write, made by libpng itself.
struct RawPng {
  int color_type = PNG_COLOR_TYPE_GRAY, bit_depth = 8, interlace = PNG_INTERLACE_NONE;
  int width = 4, height = 1;
  std::vector<unsigned char> rows;  // packed
  std::vector<png_color> palette;
  std::vector<unsigned char> palette_alpha;
  png_color_16 transparent{};
  bool has_transparent = false;
  double gamma = 0.0;
  std::string packed_text;  // compressed
};

std::vector<std::byte> Make(const RawPng& raw) {
  std::vector<std::byte> out;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(
      png, &out,
      [](png_structp p, png_bytep data, std::size_t count) {
        auto* to = static_cast<std::vector<std::byte>*>(png_get_io_ptr(p));
        const auto* bytes = reinterpret_cast<const std::byte*>(data);
        to->insert(to->end(), bytes, bytes + count);
      },
      nullptr);
  png_set_IHDR(png, info, static_cast<png_uint_32>(raw.width), static_cast<png_uint_32>(raw.height), raw.bit_depth,
               raw.color_type, raw.interlace, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (!raw.palette.empty()) png_set_PLTE(png, info, raw.palette.data(), static_cast<int>(raw.palette.size()));
  if (!raw.palette_alpha.empty()) {
    png_set_tRNS(png, info, raw.palette_alpha.data(), static_cast<int>(raw.palette_alpha.size()), nullptr);
  }
  if (raw.has_transparent) png_set_tRNS(png, info, nullptr, 0, &raw.transparent);
  if (raw.gamma > 0.0) png_set_gAMA(png, info, raw.gamma);
  std::string text = raw.packed_text, key = "a";
  png_text chunk{};
  chunk.compression = PNG_TEXT_COMPRESSION_zTXt;
  chunk.key = key.data();
  chunk.text = text.data();
  chunk.text_length = text.size();
  if (!text.empty()) png_set_text(png, info, &chunk, 1);
  png_write_info(png, info);
  const std::size_t row_bytes = png_get_rowbytes(png, info);
  std::vector<unsigned char> data = raw.rows;
  std::vector<png_bytep> rows;
  for (std::size_t y = 0; y < static_cast<std::size_t>(raw.height); ++y) rows.push_back(data.data() + y * row_bytes);
  png_write_image(png, rows.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return out;
}

std::vector<int> Numbers(const Image& image) {
  std::vector<int> out;
  for (std::size_t i = 0; i < image.bytes.size() / SizeOf(image.type); ++i) {
    out.push_back(image.type == ChannelType::U8 ? image.As<std::uint8_t>()[i] : image.As<std::uint16_t>()[i]);
  }
  return out;
}

TEST(Png, GreyOfFewBitsBecomesEight) {
  RawPng raw;
  raw.bit_depth = 1;
  raw.rows = {0b01010000};
  EXPECT_EQ(Numbers(DecodeImage(Make(raw), "1 bit")), (std::vector<int>{0, 255, 0, 255}));
  raw.bit_depth = 2;
  raw.rows = {0b00011011};
  EXPECT_EQ(Numbers(DecodeImage(Make(raw), "2 bits")), (std::vector<int>{0, 85, 170, 255}));
  raw.bit_depth = 4;
  raw.rows = {0x01, 0xEF};
  EXPECT_EQ(Numbers(DecodeImage(Make(raw), "4 bits")), (std::vector<int>{0, 17, 238, 255}));
}

TEST(Png, PalettesAndTransparentColours) {
  RawPng raw;
  raw.color_type = PNG_COLOR_TYPE_PALETTE;
  raw.bit_depth = 2;
  raw.palette = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  raw.rows = {0b00011000};
  const Image opaque = DecodeImage(Make(raw), "palette");
  EXPECT_EQ(opaque.channels, 3);
  EXPECT_EQ(Numbers(opaque), (std::vector<int>{1, 2, 3, 4, 5, 6, 7, 8, 9, 1, 2, 3}));
  raw.palette_alpha = {128};
  const Image transparent = DecodeImage(Make(raw), "palette");
  EXPECT_EQ(transparent.channels, 4);
  EXPECT_EQ(Numbers(transparent), (std::vector<int>{1, 2, 3, 128, 4, 5, 6, 255, 7, 8, 9, 255, 1, 2, 3, 128}));

  RawPng key;
  key.color_type = PNG_COLOR_TYPE_GRAY;
  key.bit_depth = 16;
  key.width = 2;
  key.rows = {0x12, 0x34, 0x12, 0x35};
  key.has_transparent = true;
  key.transparent.gray = 0x1234;
  const Image grey = DecodeImage(Make(key), "key");
  EXPECT_EQ(grey.channels, 2);
  EXPECT_EQ(Numbers(grey), (std::vector<int>{0x1234, 0, 0x1235, 0xFFFF}));
}

TEST(Png, InterlacingAndGammaChangeNothing) {
  RawPng raw;
  raw.color_type = PNG_COLOR_TYPE_RGB;
  raw.width = 19;
  raw.height = 13;
  const Image pattern = MakePattern(19, 13, 3, ChannelType::U8);
  raw.rows.assign(pattern.As<unsigned char>(), pattern.As<unsigned char>() + pattern.bytes.size());
  raw.interlace = PNG_INTERLACE_ADAM7;
  raw.gamma = 1.0;
  ExpectSame(DecodeImage(Make(raw), "interlaced"), pattern);
}

// Says that the picture has another size.
void WithSize(std::vector<std::byte>& bytes, std::uint32_t width, std::uint32_t height) {
  const auto set = [&](std::size_t at, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<std::byte>(value >> (24 - 8 * i));
  };
  set(16, width);
  set(20, height);
  std::uint32_t crc = ~0u;
  for (std::size_t i = 12; i < 29; ++i) {
    crc ^= static_cast<std::uint32_t>(bytes[i]);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1u) ? 0xEDB88320u : 0u);
  }
  set(29, ~crc);
}

// What is broken is an error, or is told and has touched no pixel.
void ExpectErrorOrHarmless(std::span<const std::byte> bytes, const Image& image, bool must_fail, std::size_t at) {
  try {
    const Image decoded = DecodeImage(bytes, "broken");
    EXPECT_TRUE(decoded.bytes == image.bytes) << at;
    EXPECT_NE(decoded.damage, "") << at;
    EXPECT_FALSE(must_fail) << at;
  } catch (const Error& error) {
    // Bytes 16 to 23 are the size, which may become one beyond all limits.
    const bool is_size = at >= 16 && at < 24 && error.code() == ErrorCode::OutOfMemory;
    EXPECT_TRUE(is_size || error.code() == ErrorCode::InvalidInput) << at << error.what();
  }
}

TEST(Png, EveryTruncationAndEveryFlippedByteIsAnErrorOrHarmless) {
  const Image image = MakePattern(16, 16, 4, ChannelType::U8);
  const auto bytes = EncodePng(image, {{"Author", "nobody"}});
  EXPECT_EQ(DecodeImage(bytes, "whole").damage, "");
  const std::string_view file(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::size_t idat = file.find("IDAT") - 4, iend = file.find("IEND") - 4;
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    // Behind the last pixel there are a checksum of zlib's and one of the chunk.
    ExpectErrorOrHarmless(std::span(bytes).first(length), image, length < iend - 8, length);
  }
  // Every byte behind the signature is under a checksum or is one.
  for (std::size_t at = 8; at < bytes.size(); ++at) {
    auto broken = bytes;
    broken[at] ^= std::byte{0x10};
    constexpr std::size_t kEndOfHeader = 33;
    ExpectErrorOrHarmless(broken, image, at < kEndOfHeader || (at >= idat && at < iend), at);
  }
}

// 74 bytes that say they are an interlaced picture of 2 GiB.
TEST(Png, WhatCannotHoldItsPixelsTakesNoMemory) {
  RawPng raw;
  raw.color_type = PNG_COLOR_TYPE_RGB_ALPHA;
  raw.bit_depth = 16;
  raw.interlace = PNG_INTERLACE_ADAM7;
  raw.width = 4;
  raw.rows = std::vector<unsigned char>(32);
  auto bytes = Make(raw);
  WithSize(bytes, 16384, 16384);
  std::string what;
  EXPECT_EQ(CodeOf([&] { DecodeImage(bytes, "small.png"); }, &what), ErrorCode::InvalidInput);
  EXPECT_EQ(what, "small.png: broken PNG: the file is cut off");
}

TEST(Png, TheMemoryLimitHoldsBeforeThePixelsAreThere) {
  const auto bytes = EncodePng(MakePattern(1000, 1000, 3, ChannelType::U8));
  MemoryBudget budget(std::uint64_t{1} << 20);
  const MemoryBudget::Scope scope(budget);
  std::string what;
  EXPECT_EQ(CodeOf([&] { DecodeImage(bytes, "large.png"); }, &what), ErrorCode::OutOfMemory);
  EXPECT_NE(what.find("3.0 MiB for decoding an image of 1000 x 1000 pixels"), std::string::npos) << what;
  DecodeImageRows(bytes, "large.png", [](const Image&, int) {});  // some rows at a time fit
  EXPECT_EQ(budget.Left(), budget.limit());
}

// A megabyte of text is enough for anybody: of more, or of very many, none is unpacked.
TEST(Png, TextBombsAreLeftPacked) {
  RawPng raw;
  raw.rows = std::vector<unsigned char>(4);
  raw.packed_text = std::string(1 << 19, 'a');
  EXPECT_EQ(ReadImageText(Make(raw), "picture").at("a"), raw.packed_text);
  raw.packed_text = std::string(1 << 23, 'a');
  EXPECT_TRUE(ReadImageText(Make(raw), "picture").empty());
  const Image image = MakePattern(4, 4, 3, ChannelType::U8);
  ImageText many;
  for (int i = 0; i < 1000; ++i) many.push_back({"key " + std::to_string(i), "value"});
  EXPECT_LT(ReadImageText(EncodePng(image, many), "picture").size(), 100u);
}

TEST(Png, TextsThatTheFileDoesNotHoldTakeNoMemory) {
  // What libpng would go on with, where it does not get the memory, is no name of a chunk.
  auto bytes = EncodePng(MakePattern(4, 4, 3, ChannelType::U8), {{"Title", "facet"}});
  const std::string_view file(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  bytes[file.find("tEXt") - 4] = std::byte{0x68};  // 1.6 GiB
  std::string what;
  WithLittleMemory(std::size_t{256} << 20, [&] {
    EXPECT_EQ(CodeOf([&] { ReadImageText(bytes, "small.png"); }, &what), ErrorCode::InvalidInput);
  });
  EXPECT_EQ(what, "small.png: broken PNG: the file is cut off");
}

TEST(Png, RefusesBombsByTheirSize) {
  RawPng raw;
  raw.width = 8;
  raw.rows = std::vector<unsigned char>(8);
  auto bytes = Make(raw);
  std::string what;
  WithSize(bytes, 100000, 8);
  EXPECT_EQ(CodeOf([&] { DecodeImage(bytes, "bomb"); }, &what), ErrorCode::OutOfMemory);
  EXPECT_NE(what.find("100000 x 8"), std::string::npos) << what;
  WithSize(bytes, 32768, 32768);
  EXPECT_EQ(CodeOf([&] { DecodeImage(bytes, "bomb"); }, &what), ErrorCode::OutOfMemory);
  WithSize(bytes, 0, 32768);
  EXPECT_EQ(CodeOf([&] { DecodeImage(bytes, "empty"); }, &what), ErrorCode::InvalidInput);
}

// libpng reads chunks that stand before the header, and takes memory for a row before anybody asks for the row.
TEST(Png, RefusesLongRowsBeforeTheyTakeMemory) {
  RawPng raw;
  raw.color_type = PNG_COLOR_TYPE_RGB_ALPHA;
  raw.bit_depth = 16;
  raw.rows = std::vector<unsigned char>(32);
  auto bytes = Make(raw);
  WithSize(bytes, 0x10000000, 1);
  const std::string_view chunk("\0\0\0\0faCt\0\0\0\0", 12);  // its checksum is wrong, which is no matter
  const auto* const begin = reinterpret_cast<const std::byte*>(chunk.data());
  bytes.insert(bytes.begin() + 8, begin, begin + chunk.size());
  std::string what;
  ErrorCode code{};
  WithLittleMemory(std::size_t{256} << 20,
                   [&] { code = CodeOf([&] { DecodeImage(bytes, "bomb"); }, &what); });  // a row has 2 GiB
  EXPECT_EQ(code, ErrorCode::OutOfMemory) << what;
  EXPECT_NE(what.find("268435456 x 1"), std::string::npos) << what;
}

}  // namespace
}  // namespace facet
