// What is looked up behind surfaces with transmission: means over parts of the picture that are not too near.
#include "blend/backdrop.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace facet {
namespace {

// A picture of 1 sample a pixel, in one tile: white at depth 1, or what `pixel(x, y)` says.
template <class Pixel>
Backdrop Fill(int width, int height, int tile_size, const Pixel& pixel) {
  Backdrop backdrop(width, height);
  for (int y0 = 0; y0 < height; y0 += tile_size) {
    for (int x0 = 0; x0 < width; x0 += tile_size) {
      TileBuffers tile;
      tile.x0 = x0, tile.y0 = y0, tile.tile_size = tile_size, tile.samples = 1;
      tile.width = std::min(tile_size, width - x0), tile.height = std::min(tile_size, height - y0);
      tile.depth.assign(std::size_t(tile_size) * std::size_t(tile_size), 1.0f);
      std::vector<glm::vec4> pixels(tile.depth.size());
      for (int y = 0; y < tile.height; ++y) {
        for (int x = 0; x < tile.width; ++x) {
          const auto [light, depth] = pixel(x0 + x, y0 + y);
          pixels[std::size_t(y * tile_size + x)] = glm::vec4(light, light, light, 1.0f);
          tile.depth[tile.Index(x, y, 0)] = depth;
        }
      }
      backdrop.SetTile(tile, false, pixels);
    }
  }
  backdrop.Finish();
  return backdrop;
}

struct Lit {
  float light, depth;
};

// The widest blur is the mean of the picture, whatever its size: texels that stick out of it count by their area.
TEST(Backdrop, TheWidestBlurIsTheMeanAtEverySize) {
  for (const int size : {64, 65, 96, 127, 128, 129, 720}) {
    const Backdrop backdrop = Fill(size, size, 64, [&](int, int y) { return Lit{y == size - 1 ? 1.0f : 0.0f, 1.0f}; });
    const float half = 0.5f * static_cast<float>(size);
    const Backdrop::Mean mean = backdrop.Around(half, half, 1e6f, 2.0f);
    EXPECT_GT(mean.accepted, 0.0f);
    EXPECT_NEAR(mean.light.r * static_cast<float>(size), 1.0f, 1e-3f) << size;
    EXPECT_NEAR(mean.light.a, 1.0f, 1e-6f);
  }
}

TEST(Backdrop, WithoutBlurItIsThePixel) {
  const Backdrop backdrop = Fill(65, 33, 32, [](int x, int y) { return Lit{float(x * 100 + y), 1.0f}; });
  EXPECT_NEAR(backdrop.Around(7.5f, 3.5f, 0.0f, 2.0f).light.r, 703.0f, 1e-2f);
  EXPECT_NEAR(backdrop.Around(8.0f, 3.5f, 0.0f, 2.0f).light.r, 753.0f, 1e-2f);
}

// Half of the picture is nearer than the surface: only the other half is seen, at every blur.
TEST(Backdrop, WhatIsNearerIsNotSeen) {
  const Backdrop backdrop = Fill(128, 96, 32, [](int x, int) { return x < 64 ? Lit{1000.0f, 3.0f} : Lit{1.0f, 1.0f}; });
  for (const float deviation : {0.0f, 0.5f, 2.0f, 10.0f, 60.0f, 1e4f}) {
    const Backdrop::Mean mean = backdrop.Around(66.0f, 40.0f, deviation, 2.0f);
    if (mean.accepted == 0.0f) continue;
    EXPECT_NEAR(mean.light.r, 1.0f, 1e-4f) << deviation;
  }
  EXPECT_EQ(backdrop.Around(20.0f, 40.0f, 0.0f, 2.0f).accepted, 0.0f);
}

// A thousandth of a pixel inside of the border is inside.
TEST(Backdrop, TheBorderIsSharp) {
  const Backdrop backdrop = Fill(64, 64, 64, [](int, int) { return Lit{1.0f, 1.0f}; });
  for (const float x : {-0.4999f, -0.499f, -0.25f, 63.0f, 64.25f, 64.499f}) {
    const Backdrop::Mean mean = backdrop.Around(x, 20.0f, 0.0f, 2.0f);
    EXPECT_GT(mean.inside, 0.0f) << x;
    EXPECT_NEAR(mean.accepted, mean.inside, 1e-6f) << x;
    EXPECT_NEAR(mean.light.r, 1.0f, 1e-4f) << x;
  }
  EXPECT_EQ(backdrop.Around(-2.0f, 20.0f, 0.0f, 2.0f).inside, 0.0f);
}

// Light that is nearly as large as floats are stays finite in the coarser levels.
TEST(Backdrop, MeansDoNotOverflow) {
  const Backdrop backdrop = Fill(64, 64, 64, [](int, int) { return Lit{3e38f, 1.0f}; });
  for (const float deviation : {1.0f, 8.0f, 1e4f}) {
    EXPECT_TRUE(std::isfinite(backdrop.Around(32.0f, 32.0f, deviation, 2.0f).light.r)) << deviation;
  }
}

}  // namespace
}  // namespace facet
