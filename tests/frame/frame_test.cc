// Tiles, sample patterns and buffers.
#include <gtest/gtest.h>

#include <set>

#include "frame/tile.h"
#include "frame/tile_grid.h"

namespace facet {
namespace {

TEST(TileGrid, CoversTheImage) {
  for (const int size : {8, 16, 32, 64}) {
    for (const int width : {1, 7, 8, 63, 64, 65, 16384}) {
      const TileGrid grid = MakeTileGrid(width, 2 * width, size);
      EXPECT_GE(grid.columns * size, width);
      EXPECT_LT((grid.columns - 1) * size, width);
      EXPECT_GE(grid.rows * size, 2 * width);
      EXPECT_LT((grid.rows - 1) * size, 2 * width);
      EXPECT_EQ(grid.Count(), grid.columns * grid.rows);
    }
  }
}

TEST(SamplePattern, HasItsMeanAtThePixelsCentreAndOneSampleARowAndColumn) {
  for (const int samples : {1, 2, 4, 8}) {
    const SamplePosition* pattern = SamplePattern(samples);
    int sum_x = 0, sum_y = 0;
    std::set<int> xs, ys;
    for (int s = 0; s < samples; ++s) {
      sum_x += pattern[s].x, sum_y += pattern[s].y;
      xs.insert(pattern[s].x), ys.insert(pattern[s].y);
      EXPECT_GE(pattern[s].x, 0);
      EXPECT_LT(pattern[s].x, kSampleGrid);
    }
    EXPECT_EQ(sum_x, 8 * samples);
    EXPECT_EQ(sum_y, 8 * samples);
    EXPECT_EQ(xs.size(), std::size_t(samples));
    EXPECT_EQ(ys.size(), std::size_t(samples));
  }
}

TEST(TileBuffers, IndexIsOneToOne) {
  for (const int size : {8, 16, 32, 64}) {
    for (const int samples : {1, 2, 4, 8}) {
      TileBuffers tile;
      tile.tile_size = size, tile.samples = samples;
      std::vector<bool> used(std::size_t(size * size * samples));
      for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
          for (int s = 0; s < samples; ++s) {
            const std::size_t i = tile.Index(x, y, s);
            ASSERT_LT(i, used.size());
            ASSERT_FALSE(used[i]);
            used[i] = true;
          }
        }
      }
    }
  }
}

TEST(BlockDepth, StaysWithinItsBounds) {
  ScreenTriangle r{};
  r.x_fx8[0] = 100, r.y_fx8[0] = 200;
  r.depth_0 = 1.0f, r.depth_dx = 10.0f, r.depth_dy = -3.0f, r.depth_min = 0.5f, r.depth_max = 2.0f;
  const BlockDepth d = MakeBlockDepth(r, 8, 16);
  EXPECT_FLOAT_EQ(d.c, static_cast<float>(1.0 + 10.0 * (8.0 - 100.0 / 256) - 3.0 * (16.0 - 200.0 / 256)));
  EXPECT_EQ(DepthAt(d, 0.0f, 0.0f), 2.0f);
  EXPECT_EQ(DepthAt(d, 0.0f, 100.0f), 0.5f);
}

}  // namespace
}  // namespace facet
