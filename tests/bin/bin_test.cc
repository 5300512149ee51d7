// Bins: no tile that a triangle touches is left out, and order is kept.
#include "bin/bin_triangles.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <tuple>

#include "base/least_limit.h"
#include "raster/raster_helpers.h"

namespace facet::test {
namespace {

constexpr int kWidth = 150, kHeight = 90;

std::vector<ScreenTriangle> MixedRecords(Random& random) {
  std::vector<ScreenTriangle> records;
  const auto add = [&](PointFx8 a, PointFx8 b, PointFx8 c) {
    if (DoubleArea(a, b, c) != 0) records.push_back(MakeScreenTriangle(a, b, c));
  };
  const auto inside = [&] {
    return PointFx8{random.Int(-2000, kWidth * 256 + 2000), random.Int(-2000, kHeight * 256 + 2000)};
  };
  for (int i = 0; i < 60; ++i) add(inside(), inside(), inside());
  for (int i = 0; i < 60; ++i) {  // thin diagonals
    const PointFx8 a = inside(), b = inside();
    add(a, b, {a.x + random.Int(-40, 40), a.y + random.Int(-40, 40)});
  }
  for (int i = 0; i < 60; ++i) {  // small ones, many on tile corners
    const PointFx8 a = {random.Int(0, kWidth / 8) * 2048 + random.Int(-1, 1),
                        random.Int(0, kHeight / 8) * 2048 + random.Int(-1, 1)};
    add(a, {a.x + random.Int(-300, 300), a.y + random.Int(-300, 300)},
        {a.x + random.Int(-300, 300), a.y + random.Int(-300, 300)});
  }
  const int far = 4000000;
  add({-far, -far}, {far, -far}, {0, far});         // everything
  add({-far, -far}, {far, far}, {far, far - 700});  // a diagonal from end to end
  add({-far, kHeight * 128}, {far, kHeight * 128 + 60}, {far, kHeight * 128 + 200});
  add({kWidth * 256, 0}, {kWidth * 256 + 500, 0}, {kWidth * 256, 900});  // just outside
  add({-500, -500}, {0, -500}, {-500, 0});
  return records;
}

using Fragment = std::tuple<std::int32_t, int, int, int>;  // record, x, y, samples

TEST(Bin, TilesHoldAllThatBruteForceFinds) {
  for (std::uint64_t seed = 31; seed < 34; ++seed) {
    Random random(seed);
    TriangleChunk source;
    source.records = MixedRecords(random);
    for (std::uint32_t i = 0; i < source.records.size(); ++i) source.records[i].primitive = i;
    std::set<Fragment> expected;
    constexpr int kSamples = 4;
    for (std::size_t i = 0; i < source.records.size(); ++i) {
      for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
          int bits = 0;
          for (int s = 0; s < kSamples; ++s)
            bits |= int{CoversExactly(source.records[i], SampleAt(x, y, kSamples, s))} << s;
          if (bits != 0) expected.emplace(static_cast<std::int32_t>(i), x, y, bits);
        }
      }
    }
    for (const int tile_size : kTileSizes) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", tiles of " + std::to_string(tile_size));
      const TileGrid grid = MakeTileGrid(kWidth, kHeight, tile_size);
      TriangleChunk chunk = source;
      BinChunk(grid, chunk);
      ASSERT_EQ(chunk.begin.size(), chunk.tiles.size() + 1);
      ASSERT_EQ(chunk.begin.back(), chunk.entries.size());
      std::set<Fragment> got;
      std::set<std::uint32_t> tiles;
      for (std::size_t t = 0; t < chunk.tiles.size(); ++t) {
        EXPECT_TRUE(tiles.insert(chunk.tiles[t]).second) << "a tile comes twice";
        ASSERT_LT(chunk.tiles[t], static_cast<std::uint32_t>(grid.Count()));
        ASSERT_LT(chunk.begin[t], chunk.begin[t + 1]) << "an empty run";
        std::vector<const ScreenTriangle*> pointers;
        std::vector<std::int32_t> numbers;
        for (std::uint32_t e = chunk.begin[t]; e < chunk.begin[t + 1]; ++e) {
          const ScreenTriangle& record = chunk.records[chunk.entries[e]];
          if (e > chunk.begin[t]) {
            EXPECT_LT(pointers.back()->primitive, record.primitive) << "submission order";
          }
          pointers.push_back(&record);
          numbers.push_back(static_cast<std::int32_t>(record.primitive));
        }
        const int number = static_cast<int>(chunk.tiles[t]);
        const TileBuffers tile = MakeTile(grid, number % grid.columns, number / grid.columns, kSamples);
        FragmentList fragments;
        RasterCollect({pointers.data(), numbers.data(), pointers.size()}, tile, fragments);
        for (std::size_t i = 0; i < fragments.Size(); ++i) {
          got.emplace(fragments.record[i], tile.x0 + fragments.pixel[i] % tile_size,
                      tile.y0 + fragments.pixel[i] / tile_size, fragments.samples[i]);
        }
      }
      EXPECT_TRUE(got == expected) << got.size() << " fragments, not " << expected.size();
    }
  }
}

// A thin diagonal is not put into every tile of its bounding box.
TEST(Bin, ThinDiagonalsTouchFewTiles) {
  const TileGrid grid = MakeTileGrid(1024, 1024, 32);
  TriangleChunk chunk;
  chunk.records = {MakeScreenTriangle({0, 0}, {1024 * 256, 1024 * 256}, {1024 * 256, 1024 * 256 - 100})};
  BinChunk(grid, chunk);
  EXPECT_GE(chunk.tiles.size(), 32u);
  EXPECT_LE(chunk.tiles.size(), 3u * 32u);
}

TEST(Bin, NothingForRecordsOutsideTheImage) {
  const TileGrid grid = MakeTileGrid(100, 100, 16);
  TriangleChunk chunk;
  chunk.records = {MakeScreenTriangle({-900, 0}, {-100, 0}, {-500, 900}),
                   MakeScreenTriangle({0, -900}, {900, -900}, {0, -10}),
                   MakeScreenTriangle({112 * 256, 0}, {120 * 256, 0}, {112 * 256, 2000}),
                   MakeScreenTriangle({0, 112 * 256}, {900, 112 * 256}, {0, 113 * 256})};
  BinChunk(grid, chunk);
  EXPECT_TRUE(chunk.entries.empty());
  EXPECT_TRUE(chunk.tiles.empty());
}

// As many tiles as there can be: their numbers have several digits in the sort.
TEST(Bin, TilesAscendWhereThereAreMillions) {
  Random random(35);
  const TileGrid grid = MakeTileGrid(16384, 16384, 8);
  for (const int count : {1, 3, 40, 5000}) {
    TriangleChunk chunk;
    for (int i = 0; i < count; ++i) {
      const int x = random.Int(0, 16380 * 256), y = random.Int(0, i % 2 == 0 ? 1 : 2047) * 2048 + 5;  // one row of tiles
      chunk.records.push_back(MakeScreenTriangle({x, y}, {x + 300, y}, {x, y + 300}));
      chunk.records.back().primitive = static_cast<std::uint32_t>(i);
    }
    const std::vector<ScreenTriangle> submitted = chunk.records;
    BinChunk(grid, chunk);
    ASSERT_EQ(chunk.records.size(), submitted.size());
    std::map<std::uint32_t, std::vector<std::uint32_t>> expected;
    for (std::uint32_t i = 0; i < submitted.size(); ++i) {
      const ScreenTriangle& r = submitted[i];
      for (int x = r.x_fx8[0] / 2048; x <= (r.x_fx8[0] + 300) / 2048; ++x) {
        expected[static_cast<std::uint32_t>(r.y_fx8[0] / 2048 * grid.columns + x)].push_back(i);
      }
    }
    std::map<std::uint32_t, std::vector<std::uint32_t>> got;
    for (std::size_t t = 0; t < chunk.tiles.size(); ++t) {
      if (t > 0) {
        EXPECT_LT(chunk.tiles[t - 1], chunk.tiles[t]);
      }
      for (std::uint32_t e = chunk.begin[t]; e < chunk.begin[t + 1]; ++e) {
        got[chunk.tiles[t]].push_back(chunk.records[chunk.entries[e]].primitive);
      }
    }
    EXPECT_TRUE(got == expected) << count;
  }
}

// What a chunk held before is forgotten.
TEST(Bin, ChunksAreFilledAnew) {
  const TileGrid grid = MakeTileGrid(100, 100, 16);
  TriangleChunk once, again;
  again.records = {MakeScreenTriangle({0, 0}, {9000, 0}, {0, 9000}), MakeScreenTriangle({0, 0}, {900, 0}, {0, 900})};
  BinChunk(grid, again);
  once.records = again.records = {MakeScreenTriangle({5000, 5000}, {5900, 5000}, {5000, 5900})};
  BinChunk(grid, once);
  BinChunk(grid, again);
  EXPECT_EQ(again.tiles, once.tiles);
  EXPECT_EQ(again.begin, once.begin);
  EXPECT_EQ(again.entries, once.entries);
}

TEST(Bin, EmptyChunk) {
  TriangleChunk chunk;
  BinChunk(MakeTileGrid(10, 10, 8), chunk);
  EXPECT_TRUE(chunk.entries.empty());
  EXPECT_EQ(chunk.begin, std::vector<std::uint32_t>{0});
}

// Few triangles over many tiles make long lists, which are counted while they grow; what is kept of them stays counted.
TEST(Bin, ListsAreCharged) {
  const TileGrid grid = MakeTileGrid(1024, 1024, 8);
  TriangleChunk source;
  for (int i = 0; i < 50; ++i) {
    source.records.push_back(MakeScreenTriangle({0, 0}, {1024 * 256, 0}, {1024 * 256, 1024 * 256}));
  }
  const std::string refusal = MemoryRefusalUnder(1 << 22, [&] {
    TriangleChunk chunk = source;
    BinChunk(grid, chunk);
  });
  EXPECT_NE(refusal.find(" for lists of triangles for tiles, and the memory limit is 4.0 MiB; use larger tiles"),
            std::string::npos)
      << refusal;
  MemoryBudget budget(1 << 26);
  const MemoryBudget::Scope scope(budget);
  TriangleChunk chunk = source;
  BinChunk(grid, chunk);
  ASSERT_GE(chunk.entries.size(), 50u * 128u * 64u);
  EXPECT_EQ(budget.limit() - budget.Left(),
            chunk.records.size() * sizeof(ScreenTriangle) +
                (chunk.entries.size() + chunk.tiles.size() + chunk.begin.size()) * sizeof(std::uint32_t));
}

}  // namespace
}  // namespace facet::test
