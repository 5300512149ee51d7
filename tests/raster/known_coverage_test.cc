// Triangles whose few covered samples are known are drawn and collected as they are when it is not known.
#include <gtest/gtest.h>

#include <cstring>
#include <tuple>

#include "clip/small_triangles.h"
#include "raster/raster_helpers.h"

namespace facet::test {
namespace {

constexpr int kWidth = 150, kHeight = 90;

// Triangles of a few pixels, more than one on many pixels, some at equal depth, across the borders of tiles and image.
std::vector<ScreenTriangle> Soup(Random& random, int samples, int& known) {
  std::vector<ScreenTriangle> records;
  for (int i = 0; i < 1500; ++i) {
    const int x = random.Int(-512, (kWidth + 2) * 256), y = random.Int(-512, (kHeight + 2) * 256);
    const int reach = i % 7 == 0 ? 1500 : 300;
    const auto corner = [&] { return PointFx8{x + random.Int(-reach, reach), y + random.Int(-reach, reach)}; };
    const PointFx8 a = corner(), b = corner(), c = corner();
    if (DoubleArea(a, b, c) == 0) continue;
    const auto depth = [&] { return i % 3 == 0 ? 0.5f : static_cast<float>(random.Real(0.1, 1.0)); };
    const float za = depth(), zb = depth(), zc = depth();
    ScreenTriangle r = MakeScreenTriangle(a, b, c, za, zb, zc);
    const SampleCoverage coverage = CoverageOf(r.x_fx8, r.y_fx8, samples);
    if (!coverage.some) continue;
    r.covered = coverage.covered;
    known += r.covered != 0;
    records.push_back(r);
  }
  return records;
}

using Fragment = std::tuple<std::int32_t, std::uint16_t, std::uint8_t>;  // record, pixel, samples

std::vector<Fragment> Sorted(const FragmentList& list) {
  std::vector<Fragment> out;
  for (std::size_t i = 0; i < list.Size(); ++i) out.emplace_back(list.record[i], list.pixel[i], list.samples[i]);
  std::sort(out.begin(), out.end());
  return out;
}

void ExpectSameTile(const TileBuffers& a, const TileBuffers& b) {
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      for (int s = 0; s < a.samples; ++s) {
        const std::size_t i = a.Index(x, y, s);
        ASSERT_EQ(std::memcmp(&a.depth[i], &b.depth[i], sizeof(float)), 0) << x << " " << y << " " << s;
        ASSERT_EQ(a.record[i], b.record[i]) << x << " " << y << " " << s;
      }
    }
  }
}

TEST(KnownCoverage, DrawsWhatUnknownCoverageDraws) {
  Random random(311);
  for (const Target target : AvailableTargets()) {
    const ScopedTarget scoped(target);
    for (const int samples : kSampleCounts) {
      int known_count = 0;
      const std::vector<ScreenTriangle> known = Soup(random, samples, known_count);
      EXPECT_GT(known_count, 300);
      std::vector<ScreenTriangle> unknown = known;
      for (ScreenTriangle& r : unknown) r.covered = 0;
      const Submission a(known), b(unknown);
      for (const int tile_size : kTileSizes) {
        SCOPED_TRACE(std::string(TargetName(target)) + ", " + std::to_string(samples) + " samples, tiles of " +
                     std::to_string(tile_size));
        const TileGrid grid = MakeTileGrid(kWidth, kHeight, tile_size);
        for (int t = 0; t < grid.Count(); ++t) {
          const TileBuffers empty = MakeTile(grid, t % grid.columns, t / grid.columns, samples);
          TileBuffers drawn = empty, expected = empty;
          RasterOpaque(a.All(), drawn);
          RasterOpaque(b.All(), expected);
          ExpectSameTile(drawn, expected);
          for (const CollectDepth test : {CollectDepth::Nearer, CollectDepth::NearerOrEqual}) {
            for (const TileBuffers* tile : {&empty, &std::as_const(expected)}) {
              FragmentList collected, all;
              RasterCollect(a.All(), *tile, collected, test);
              RasterCollect(b.All(), *tile, all, test);
              EXPECT_TRUE(std::is_sorted(collected.record.begin(), collected.record.end()));
              ASSERT_EQ(Sorted(collected), Sorted(all));
            }
          }
        }
        if (testing::Test::HasFailure()) return;
      }
    }
  }
}

}  // namespace
}  // namespace facet::test
