#include <gtest/gtest.h>

#include <cstring>

#include "base/sha256.h"
#include "facet/error.h"
#include "facet/film.h"

namespace facet {
namespace {

Film TwoPixels() { return {2, 1, {{1.0f, -2.0f, 0.5f, 1.0f}, {0.0f, 0.0f, 0.0f, 0.0f}}}; }

// The layout is a promise: whoever dumps the film elsewhere gets the same digest with any SHA-256.
TEST(HashFilm, IsTheDigestOfTheDocumentedBytes) {
  const unsigned char bytes[] = {0x00, 0x00, 0x80, 0x3f, 0x00, 0x00, 0x00, 0xc0, 0x00, 0x00, 0x00, 0x3f,
                                 0x00, 0x00, 0x80, 0x3f, 0,    0,    0,    0,    0,    0,    0,    0,
                                 0,    0,    0,    0,    0,    0,    0,    0};
  Sha256 hash;
  hash.Add("facet film 2 1\n");
  hash.Add(std::as_bytes(std::span(bytes)));
  EXPECT_EQ(HashFilm(TwoPixels()), hash.Finish());
}

TEST(HashFilm, SeesOneBitAndTheShape) {
  const Digest digest = HashFilm(TwoPixels());
  for (int bit = 0; bit < 32; ++bit) {
    Film film = TwoPixels();
    std::uint32_t bits;
    std::memcpy(&bits, &film.pixels[1].w, 4);
    bits ^= 1u << bit;
    std::memcpy(&film.pixels[1].w, &bits, 4);
    EXPECT_NE(HashFilm(film), digest) << bit;
  }
  Film column = TwoPixels();
  std::swap(column.width, column.height);
  EXPECT_NE(HashFilm(column), digest);
}

TEST(HashPlane, IsTheDigestOfTheDocumentedBytes) {
  Film film = TwoPixels();
  const Digest colour = HashFilm(film);
  const std::string_view numbers("\x00\x00\x80\x3f\x00\x00\x80\x7f", 8);
  const auto bytes = std::as_bytes(std::span(numbers));
  film.planes = {{PlaneKind::Depth, {bytes.begin(), bytes.end()}}, {PlaneKind::Triangle, {bytes.begin(), bytes.end()}}};
  Sha256 depth, triangle;
  depth.Add("facet plane depth 2 1 1 f32\n");
  depth.Add(bytes);
  triangle.Add("facet plane triangle 2 1 1 u32\n");
  triangle.Add(bytes);
  EXPECT_EQ(HashPlane(film, 0), depth.Finish());
  EXPECT_EQ(HashPlane(film, 1), triangle.Finish());
  EXPECT_EQ(HashFilm(film), colour);
  EXPECT_THROW(HashPlane(film, 2), Error);
  film.planes[1].bytes.pop_back();
  EXPECT_THROW(HashPlane(film, 1), Error);
  film.planes[0].kind = PlaneKind(200);
  EXPECT_THROW(HashPlane(film, 0), Error) << "an unknown kind";
}

TEST(HashImage, SeesThePixelsAndTheirKind) {
  const Image image{2, 1, 2, ChannelType::U8, Encoding::Srgb, {std::byte(1), std::byte(2), std::byte(3), std::byte(4)}};
  Sha256 hash;
  hash.Add("facet image 2 1 2 8 srgb\n");
  hash.Add(std::string_view("\1\2\3\4"));
  EXPECT_EQ(HashImage(image), hash.Finish());
  Image wider = image;
  wider.type = ChannelType::U16;
  wider.width = 1;
  EXPECT_NE(HashImage(wider), HashImage(image));
  Image linear = image;
  linear.encoding = Encoding::Linear;
  EXPECT_NE(HashImage(linear), HashImage(image));
}

}  // namespace
}  // namespace facet
