#include "film/hash_film.h"
#include "image/hash_image.h"

#include <gtest/gtest.h>

#include <span>

#include "facet/film.h"

namespace facet {
namespace {

TEST(HashBands, AreTheDigestOfTheWhole) {
  Film film{5, 7, {}};
  for (int i = 0; i < 35; ++i) film.pixels.emplace_back(0.1f * float(i), -1.0f, 0.5f, 1.0f);
  Sha256 hash = BeginFilmHash(5, 7);
  hash.Add(std::as_bytes(std::span(film.pixels).first(15)));
  hash.Add(std::as_bytes(std::span(film.pixels).subspan(15)));
  EXPECT_EQ(hash.Finish(), HashFilm(film));

  film.planes.push_back({PlaneKind::Triangle, std::vector<std::byte>(35 * 4, std::byte(3))});
  Sha256 plane = BeginPlaneHash(InfoOf(PlaneKind::Triangle), 5, 7);
  plane.Add(std::span(film.planes[0].bytes).first(60));
  plane.Add(std::span(film.planes[0].bytes).subspan(60));
  EXPECT_EQ(plane.Finish(), HashPlane(film, 0));

  for (const ChannelType type : {ChannelType::U8, ChannelType::U16, ChannelType::F32}) {
    Image image = EncodeFilm(film, {}, type);
    Image form = image;
    form.bytes.clear();
    Sha256 pixels = BeginImageHash(form);
    const std::size_t row = image.bytes.size() / 7;
    for (std::size_t y = 0; y < 7; ++y) pixels.Add(std::span(image.bytes).subspan(y * row, row));
    EXPECT_EQ(pixels.Finish(), HashImage(image));
  }
}

}  // namespace
}  // namespace facet
