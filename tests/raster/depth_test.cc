// Depth, visibility, and that the ways to write a sample agree.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>

#include "raster/raster_helpers.h"

namespace facet::test {
namespace {

constexpr int kWidth = 60, kHeight = 45;

std::vector<ScreenTriangle> RandomRecords(Random& random, int count) {
  std::vector<ScreenTriangle> records;
  while (static_cast<int>(records.size()) < count) {
    const auto point = [&] { return PointFx8{random.Int(-3000, 18000), random.Int(-3000, 15000)}; };
    const auto depth = [&] { return static_cast<float>(random.Real(0.01, 3.0)); };
    const PointFx8 a = point(), b = point(),
                   c = random.Int(0, 3) == 0 ? PointFx8{a.x + random.Int(-200, 200), a.y + 3} : point();
    if (DoubleArea(a, b, c) != 0) records.push_back(MakeScreenTriangle(a, b, c, depth(), depth(), depth()));
  }
  return records;
}

template <class Visit>
void ForEachTile(int tile_size, int samples, const Visit& visit) {
  const TileGrid grid = MakeTileGrid(kWidth, kHeight, tile_size);
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      TileBuffers tile = MakeTile(grid, column, row, samples);
      visit(tile);
    }
  }
}

// Depth at a point by barycentric coordinates in extended precision, from the vertices' own depths.
long double AffineDepth(const PointFx8* v, const float* z, PointFx8 p) {
  const long double area = static_cast<long double>(DoubleArea(v[0], v[1], v[2]));
  return (static_cast<long double>(DoubleArea(v[1], v[2], p)) * z[0] +
          static_cast<long double>(DoubleArea(v[2], v[0], p)) * z[1] +
          static_cast<long double>(DoubleArea(v[0], v[1], p)) * z[2]) /
         area;
}

TEST(Depth, IsTheAffineFunctionThroughTheVertices) {
  Random random(21);
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE("seed 21, triangle " + std::to_string(i));
    const int reach = i % 2 == 0 ? 0 : 4000000;  // some reach far out of the image
    const auto coordinate = [&] { return random.Int(-reach, 15000 + reach); };
    const PointFx8 v[3] = {{coordinate(), coordinate()}, {coordinate(), coordinate()}, {coordinate(), coordinate()}};
    const float z[3] = {static_cast<float>(random.Real(0.1, 2.0)), static_cast<float>(random.Real(0.1, 2.0)),
                        static_cast<float>(random.Real(0.1, 2.0))};
    if (std::abs(DoubleArea(v[0], v[1], v[2])) < 1000000) continue;
    const std::vector<ScreenTriangle> records = {MakeScreenTriangle(v[0], v[1], v[2], z[0], z[1], z[2])};
    const Submission submission(records);
    const long double tolerance = 8.0L * 0x1p-24L * std::max({z[0], z[1], z[2]});
    // The gradient is rounded to float: slivers are steep.
    const long double steep = 0x1p-20L * (std::fabs(records[0].depth_dx) + std::fabs(records[0].depth_dy));
    ForEachTile(32, 4, [&](TileBuffers& tile) {
      RasterOpaque(submission.All(), tile);
      for (int y = 0; y < tile.height; ++y) {
        for (int x = 0; x < tile.width; ++x) {
          for (int s = 0; s < 4; ++s) {
            if (tile.record[tile.Index(x, y, s)] == kNoRecord) continue;
            const long double want = AffineDepth(v, z, SampleAt(tile.x0 + x, tile.y0 + y, 4, s));
            const float got = tile.depth[tile.Index(x, y, s)];
            ASSERT_NEAR(static_cast<double>(got - want), 0.0, static_cast<double>(tolerance + steep))
                << "pixel " << tile.x0 + x << ", " << tile.y0 + y;
            ASSERT_GE(got, records[0].depth_min);
            ASSERT_LE(got, records[0].depth_max);
          }
        }
      }
    });
  }
}

// Against a plain loop over samples and triangles, with DepthAt.
TEST(Depth, NearestWinsAndFirstAtEqualDepth) {
  Random random(22);
  std::vector<ScreenTriangle> records = RandomRecords(random, 40);
  // Copies at the same depth, and flat ones that coincide.
  for (int i = 0; i < 10; ++i) records.push_back(records[std::size_t(i)]);
  for (int i = 0; i < 4; ++i)
    records.push_back(MakeScreenTriangle({0, 0}, {15000, 0}, {0, 11000}, 1.25f, 1.25f, 1.25f));
  const Submission submission(records);
  for (const Target target : AvailableTargets()) {
    const ScopedTarget scoped(target);
    for (const int samples : kSampleCounts) {
      ForEachTile(16, samples, [&](TileBuffers& tile) {
        RasterOpaque(submission.All(), tile);
        int wrong = 0;
        for (int y = 0; y < tile.height; ++y) {
          for (int x = 0; x < tile.width; ++x) {
            for (int s = 0; s < samples; ++s) {
              const int px = tile.x0 + x, py = tile.y0 + y, bx = px / 8 * 8, by = py / 8 * 8;
              const PointFx8 p = SampleAt(px, py, samples, s);
              float nearest = -std::numeric_limits<float>::infinity();
              std::int32_t winner = kNoRecord;
              for (std::size_t i = 0; i < records.size(); ++i) {
                if (!CoversExactly(records[i], p)) continue;
                const float z = DepthAt(MakeBlockDepth(records[i], bx, by), static_cast<float>(p.x - bx * 256) / 256.0f,
                                        static_cast<float>(p.y - by * 256) / 256.0f);
                if (z > nearest) nearest = z, winner = static_cast<std::int32_t>(i);
              }
              wrong += tile.record[tile.Index(x, y, s)] != winner || tile.depth[tile.Index(x, y, s)] != nearest;
            }
          }
        }
        EXPECT_EQ(wrong, 0) << TargetName(target) << ", seed 22, " << samples << " samples, tile " << tile.x0 << ", "
                            << tile.y0;
      });
    }
  }
}

TEST(Depth, OrderDoesNotMatterWhereDepthsDiffer) {
  Random random(23);
  const std::vector<ScreenTriangle> records = RandomRecords(random, 60);
  const Submission forward(records);
  Submission shuffled(records);
  for (std::size_t i = records.size() - 1; i > 0; --i) {
    const std::size_t j = random.Next() % (i + 1);
    std::swap(shuffled.pointers[i], shuffled.pointers[j]);
    std::swap(shuffled.ids[i], shuffled.ids[j]);
  }
  ForEachTile(64, 8, [&](TileBuffers& tile) {
    TileBuffers other = tile;
    RasterOpaque(forward.All(), tile);
    RasterOpaque(shuffled.All(), other);
    EXPECT_EQ(tile.depth, other.depth) << "seed 23";
    EXPECT_EQ(tile.record, other.record) << "seed 23";
  });
}

// The image's bits depend neither on the tile size nor on the target.
TEST(Depth, BitsDoNotDependOnTilesOrTarget) {
  Random random(24);
  const std::vector<ScreenTriangle> records = RandomRecords(random, 60);
  const Submission submission(records);
  std::vector<float> reference;
  std::vector<std::int32_t> reference_record;
  for (const Target target : AvailableTargets()) {
    const ScopedTarget scoped(target);
    for (const int tile_size : kTileSizes) {
      std::vector<float> depth(kWidth * kHeight * 8);
      std::vector<std::int32_t> record(depth.size());
      ForEachTile(tile_size, 8, [&](TileBuffers& tile) {
        RasterOpaque(submission.All(), tile);
        for (int y = 0; y < tile.height; ++y) {
          for (int x = 0; x < tile.width; ++x) {
            for (int s = 0; s < 8; ++s) {
              const std::size_t i = std::size_t(((tile.y0 + y) * kWidth + tile.x0 + x) * 8 + s);
              depth[i] = tile.depth[tile.Index(x, y, s)], record[i] = tile.record[tile.Index(x, y, s)];
            }
          }
        }
      });
      if (reference.empty()) reference = depth, reference_record = record;
      EXPECT_EQ(depth, reference) << TargetName(target) << ", tiles of " << tile_size << ", seed 24";
      EXPECT_EQ(record, reference_record) << TargetName(target) << ", tiles of " << tile_size << ", seed 24";
    }
  }
}

TEST(Fragments, WritingThemIsDrawing) {
  Random random(25);
  const std::vector<ScreenTriangle> records = RandomRecords(random, 50);
  const Submission submission(records);
  for (const Target target : AvailableTargets()) {
    const ScopedTarget scoped(target);
    for (const int samples : kSampleCounts) {
      ForEachTile(32, samples, [&](TileBuffers& drawn) {
        TileBuffers written = drawn;
        RasterOpaque(submission.All(), drawn);
        FragmentList fragments;
        for (std::size_t i = 0; i < records.size(); ++i) {
          fragments.Clear();
          RasterCollect(submission.One(i), written, fragments);
          for (std::size_t k = 0; k < fragments.Size(); ++k) {
            WriteFragment(records[i], fragments.record[k], fragments.pixel[k], fragments.samples[k], written);
          }
        }
        // Outside of the image a partial tile's contents mean nothing.
        int wrong = 0;
        for (int y = 0; y < drawn.height; ++y) {
          for (int x = 0; x < drawn.width; ++x) {
            for (int s = 0; s < samples; ++s) {
              const std::size_t i = drawn.Index(x, y, s);
              wrong += drawn.record[i] != written.record[i] || drawn.depth[i] != written.depth[i];
            }
          }
        }
        EXPECT_EQ(wrong, 0) << TargetName(target) << ", seed 25, " << samples << " samples";
      });
    }
  }
}

// Fragments that were collected before any of them was written: the nearest stays, the first at equal depth.
TEST(Fragments, WritingKeepsTheNearestAndTheFirst) {
  Random random(27);
  std::vector<ScreenTriangle> records = RandomRecords(random, 20);
  for (std::size_t i = 0; i < 20; ++i) records.push_back(records[i]);
  const Submission submission(records);
  ForEachTile(64, 4, [&](TileBuffers& drawn) {
    TileBuffers written = drawn;
    RasterOpaque(submission.All(), drawn);
    FragmentList fragments;
    RasterCollect(submission.All(), written, fragments);
    for (std::size_t k = 0; k < fragments.Size(); ++k) {
      WriteFragment(records[std::size_t(fragments.record[k])], fragments.record[k], fragments.pixel[k],
                    fragments.samples[k], written);
    }
    int wrong = 0;
    for (int y = 0; y < drawn.height; ++y) {
      for (int x = 0; x < drawn.width; ++x) {
        for (int s = 0; s < 4; ++s) wrong += drawn.record[drawn.Index(x, y, s)] != written.record[drawn.Index(x, y, s)];
      }
    }
    EXPECT_EQ(wrong, 0) << "seed 27";
  });
}

TEST(Fragments, CollectingLeavesOutWhatIsHidden) {
  // A near rectangle hides the left half; what is collected behind it lies to the right, at every sample.
  const std::vector<ScreenTriangle> near_half = {MakeScreenTriangle({0, 0}, {2048, 0}, {2048, 4096}, 2, 2, 2),
                                                 MakeScreenTriangle({0, 0}, {2048, 4096}, {0, 4096}, 2, 2, 2)};
  const std::vector<ScreenTriangle> behind = {MakeScreenTriangle({0, 0}, {4096, 0}, {4096, 4096}, 1, 1, 1),
                                              MakeScreenTriangle({0, 0}, {4096, 4096}, {0, 4096}, 1, 1, 1)};
  for (const Target target : AvailableTargets()) {
    const ScopedTarget scoped(target);
    TileBuffers tile = MakeTile(MakeTileGrid(16, 16, 16), 0, 0, 4);
    RasterOpaque(Submission(near_half).All(), tile);
    const TileBuffers before = tile;
    FragmentList fragments;
    RasterCollect(Submission(behind).All(), tile, fragments);
    std::vector<int> bits(256);
    for (std::size_t i = 0; i < fragments.Size(); ++i) bits[fragments.pixel[i]] += fragments.samples[i];
    for (int i = 0; i < 256; ++i)
      EXPECT_EQ(bits[std::size_t(i)], i % 16 < 8 ? 0 : 15) << "pixel " << i << ", " << TargetName(target);
    EXPECT_EQ(tile.depth, before.depth);
    EXPECT_EQ(tile.record, before.record);
    // Triangle order.
    EXPECT_TRUE(std::is_sorted(fragments.record.begin(), fragments.record.end()));
  }
}

TEST(Fragments, VisibleOnesPartitionTheSamples) {
  Random random(26);
  const std::vector<ScreenTriangle> records = RandomRecords(random, 60);
  const Submission submission(records);
  for (const int samples : kSampleCounts) {
    for (const int tile_size : kTileSizes) {
      ForEachTile(tile_size, samples, [&](TileBuffers& tile) {
        RasterOpaque(submission.All(), tile);
        FragmentList fragments;
        VisibleFragments(tile, fragments);
        std::vector<std::int32_t> seen(tile.record.size(), kNoRecord);
        for (std::size_t i = 0; i < fragments.Size(); ++i) {
          const int x = fragments.pixel[i] % tile_size, y = fragments.pixel[i] / tile_size;
          ASSERT_LT(x, tile.width);
          ASSERT_LT(y, tile.height);
          ASSERT_NE(fragments.samples[i], 0);
          if (i > 0) {
            const auto place = [&](std::size_t k) {  // by squares of 4 x 4 pixels
              const int px = fragments.pixel[k] % tile_size, py = fragments.pixel[k] / tile_size;
              return std::array{py / 4, px / 4, py % 4, px % 4};
            };
            ASSERT_GE(place(i), place(i - 1));
          }
          for (std::size_t k = i; k-- > 0 && fragments.pixel[k] == fragments.pixel[i];) {
            ASSERT_NE(fragments.record[k], fragments.record[i]) << "one fragment for each pixel and triangle";
          }
          for (int s = 0; s < samples; ++s) {
            if ((fragments.samples[i] >> s & 1) == 0) continue;
            ASSERT_EQ(seen[tile.Index(x, y, s)], kNoRecord) << "a sample in two fragments";
            seen[tile.Index(x, y, s)] = fragments.record[i];
          }
        }
        for (int y = 0; y < tile.height; ++y) {
          for (int x = 0; x < tile.width; ++x) {
            for (int s = 0; s < samples; ++s) ASSERT_EQ(seen[tile.Index(x, y, s)], tile.record[tile.Index(x, y, s)]);
          }
        }
      });
    }
  }
}

}  // namespace
}  // namespace facet::test
