// Coverage is exact: triangulations are watertight, and each triangle covers what integer arithmetic says.
#include <gtest/gtest.h>

#include "raster/raster_helpers.h"

namespace facet::test {
namespace {

// Every sample of the half-open rectangle is covered once and no other sample at all, whatever the target, the number
// of samples and the tile size.
void ExpectWatertight(const std::vector<ScreenTriangle>& records, PointFx8 low, PointFx8 high, int width, int height) {
  for (const Target target : AvailableTargets()) {
    const ScopedTarget scoped(target);
    for (const int samples : kSampleCounts) {
      for (const int tile_size : kTileSizes) {
        CoverageCount got = CountCoverage(records, width, height, tile_size, samples);
        const std::string differences = Differences(got, [&](int x, int y, int s) {
          const PointFx8 p = SampleAt(x, y, samples, s);
          return p.x >= low.x && p.x < high.x && p.y >= low.y && p.y < high.y ? 1 : 0;
        });
        EXPECT_EQ(differences, "") << TargetName(target) << ", " << samples << " samples, tiles of " << tile_size;
      }
    }
  }
}

int MultipleWithin(Random& random, int step, int offset, int low, int high) {
  return std::clamp((random.Int(low, high) / step) * step + offset, low, high);
}

// Kinds of places where a rasteriser errs.
PointFx8 AwkwardPoint(Random& random, const Triangulation& mesh, PointFx8 low, PointFx8 high) {
  const auto on_grid = [&](int step, int offset) {
    return PointFx8{MultipleWithin(random, step, offset, low.x, high.x),
                    MultipleWithin(random, step, offset, low.y, high.y)};
  };
  const PointFx8 a = mesh.points[random.Next() % mesh.points.size()],
                 b = mesh.points[random.Next() % mesh.points.size()];
  switch (random.Int(0, 7)) {
    case 0: return on_grid(16, 0);     // where samples may stand
    case 1: return on_grid(256, 128);  // pixel centres
    case 2: return on_grid(256, 0);    // pixel corners
    case 3: return on_grid(2048, 0);   // block corners
    case 4:
      return {std::clamp(a.x + random.Int(-2, 2), low.x, high.x), std::clamp(a.y + random.Int(-2, 2), low.y, high.y)};
    case 5: return {a.x, b.y};  // in line with others
    case 6: return {a.x + (b.x - a.x) / 2, a.y + (b.y - a.y) / 2};
    default: return on_grid(1, 0);
  }
}

Triangulation RandomTriangulation(Random& random, PointFx8 low, PointFx8 high, int point_count) {
  Triangulation mesh(low, high);
  for (int i = 0; i < point_count; ++i) {
    mesh.Insert(AwkwardPoint(random, mesh, low, high));
    if (i % 2 == 0) mesh.Flip(random);
  }
  for (int i = 0; i < point_count; ++i) mesh.Flip(random);
  return mesh;
}

TEST(Watertight, RandomTriangulations) {
  constexpr int kWidth = 75, kHeight = 66;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const PointFx8 low = {random.Int(0, 2500), random.Int(0, 2500)};
    const PointFx8 high = {random.Int(15000, kWidth * 256), random.Int(13000, kHeight * 256)};
    ExpectWatertight(RandomTriangulation(random, low, high, 150).Records(), low, high, kWidth, kHeight);
  }
}

TEST(Watertight, TrianglesSmallerThanPixels) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const PointFx8 low = {random.Int(1500, 2500), random.Int(1500, 2500)};
    const PointFx8 high = {low.x + random.Int(100, 900), low.y + random.Int(100, 900)};
    ExpectWatertight(RandomTriangulation(random, low, high, 250).Records(), low, high, 17, 19);
  }
}

TEST(Watertight, RectanglesOfTheGuardBand) {
  constexpr int kWidth = 40, kHeight = 33;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const PointFx8 low = {(kWidth / 2 - kGuardBand) * 256, kHeight * 128 - kGuardBand * 256};
    const PointFx8 high = {(kWidth / 2 + kGuardBand) * 256, kHeight * 128 + kGuardBand * 256};
    Triangulation mesh(low, high);
    for (int i = 0; i < 120; ++i) {
      // Half of the points within the image, half anywhere: slivers of thousands of pixels run through it.
      if (i % 2 == 0) {
        mesh.Insert({random.Int(0, kWidth * 16) * 16, random.Int(0, kHeight * 256)});
      } else {
        mesh.Insert(AwkwardPoint(random, mesh, low, high));
      }
      mesh.Flip(random);
      mesh.Flip(random);
    }
    ExpectWatertight(mesh.Records(), low, high, kWidth, kHeight);
  }
}

// Hundreds of slivers that meet in one point.
TEST(Watertight, Fans) {
  constexpr int kWidth = 70, kHeight = 40;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const PointFx8 low = {random.Int(0, 1000), random.Int(0, 1000)};
    const PointFx8 high = {random.Int(15000, 17920), random.Int(9000, 10240)};
    std::vector<PointFx8> rim;
    const auto side = [&](PointFx8 from, PointFx8 to) {
      std::vector<int> steps;
      const int length = std::abs(to.x - from.x) + std::abs(to.y - from.y);
      for (int i = 0; i < 100; ++i) steps.push_back(random.Int(1, length - 1));
      steps.push_back(0);
      std::sort(steps.begin(), steps.end());
      steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
      for (const int k : steps) {
        rim.push_back({from.x + (to.x > from.x   ? k
                                 : to.x < from.x ? -k
                                                 : 0),
                       from.y + (to.y > from.y   ? k
                                 : to.y < from.y ? -k
                                                 : 0)});
      }
    };
    side(low, {high.x, low.y});
    side({high.x, low.y}, high);
    side(high, {low.x, high.y});
    side({low.x, high.y}, low);
    // The centre: inside, on a pixel's centre, on a block's corner, on the rectangle's own corner.
    PointFx8 centre = {random.Int(low.x + 1, high.x - 1), random.Int(low.y + 1, high.y - 1)};
    if (seed == 2) centre = {centre.x / 256 * 256 + 128, centre.y / 256 * 256 + 128};
    if (seed == 3) centre = {4 * 2048, 2 * 2048};
    if (seed == 4) centre = low;
    std::vector<ScreenTriangle> records;
    for (std::size_t i = 0; i < rim.size(); ++i) {
      const PointFx8 a = rim[i], b = rim[(i + 1) % rim.size()];
      if (DoubleArea(centre, a, b) != 0) records.push_back(MakeScreenTriangle(centre, a, b));
    }
    ExpectWatertight(records, low, high, kWidth, kHeight);
  }
}

// One triangle against brute force over a tile that it touches.
void ExpectExact(const ScreenTriangle& record, int x0, int y0, int tile_size) {
  const TileGrid grid = MakeTileGrid(kMaxImageSize, kMaxImageSize, tile_size);
  const std::vector<ScreenTriangle> records = {record};
  const Submission submission(records);
  for (const int samples : kSampleCounts) {
    const TileBuffers tile = MakeTile(grid, x0 / tile_size, y0 / tile_size, samples);
    std::vector<std::uint8_t> expected(std::size_t(tile_size) * std::size_t(tile_size));
    for (int y = 0; y < tile_size; ++y) {
      for (int x = 0; x < tile_size; ++x) {
        for (int s = 0; s < samples; ++s) {
          if (CoversExactly(record, SampleAt(tile.x0 + x, tile.y0 + y, samples, s))) {
            expected[std::size_t(y * tile_size + x)] |= static_cast<std::uint8_t>(1 << s);
          }
        }
      }
    }
    for (const Target target : AvailableTargets()) {
      const ScopedTarget scoped(target);
      FragmentList fragments;
      RasterCollect(submission.All(), tile, fragments);
      std::vector<std::uint8_t> got(expected.size());
      for (std::size_t i = 0; i < fragments.Size(); ++i) {
        EXPECT_EQ(got[fragments.pixel[i]], 0) << "a pixel comes twice";
        EXPECT_NE(fragments.samples[i], 0) << "a fragment without samples";
        EXPECT_EQ(fragments.record[i], 0);
        got[fragments.pixel[i]] = fragments.samples[i];
      }
      EXPECT_EQ(got, expected) << TargetName(target) << ", " << samples << " samples, tile at " << tile.x0 << ", "
                               << tile.y0 << " of size " << tile_size;
    }
  }
}

TEST(Coverage, RandomTrianglesMatchBruteForce) {
  Random random(11);
  for (int i = 0; i < 250; ++i) {
    SCOPED_TRACE("seed 11, triangle " + std::to_string(i));
    const int step = i % 4 == 0 ? 16 : i % 4 == 1 ? 128 : 1;
    const auto point = [&] {
      return PointFx8{random.Int(-5000 / step, 30000 / step) * step, random.Int(-5000 / step, 30000 / step) * step};
    };
    const PointFx8 a = point(), b = point(),
                   c = i % 5 == 0 ? PointFx8{a.x + random.Int(-300, 300), a.y + random.Int(-300, 300)} : point();
    if (DoubleArea(a, b, c) == 0) continue;
    ExpectExact(MakeScreenTriangle(a, b, c), 0, 0, 64);
    const int tile_size = kTileSizes[random.Int(0, 3)];
    ExpectExact(MakeScreenTriangle(a, b, c), random.Int(0, 127), random.Int(0, 127), tile_size);
  }
}

// Vertices as far apart as the guard band allows: 32768 pixels.
TEST(Coverage, HugeTrianglesMatchBruteForce) {
  constexpr int kLow = (kMaxImageSize / 2 - kGuardBand) * 256, kHigh = (kMaxImageSize / 2 + kGuardBand) * 256;
  Random random(12);
  for (int i = 0; i < 250; ++i) {
    SCOPED_TRACE("seed 12, triangle " + std::to_string(i));
    const auto corner = [&] { return random.Int(0, 1) == 0 ? kLow : kHigh; };
    PointFx8 a = {random.Int(kLow, kHigh), random.Int(kLow, kHigh)}, b = {random.Int(kLow, kHigh), corner()},
             c = {corner(), random.Int(kLow, kHigh)};
    if (i % 3 == 0) a = {corner(), corner()}, b = {corner(), corner()};
    if (i % 3 == 1) c = {a.x + random.Int(-40, 40), a.y + random.Int(-40, 40)};  // a sliver
    if (DoubleArea(a, b, c) == 0) continue;
    // A tile on an edge.
    const double t = random.Real(0.0, 1.0);
    const int x = static_cast<int>((a.x + t * (double{static_cast<double>(b.x)} - a.x)) / 256.0);
    const int y = static_cast<int>((a.y + t * (double{static_cast<double>(b.y)} - a.y)) / 256.0);
    ExpectExact(MakeScreenTriangle(a, b, c), std::clamp(x, 0, kMaxImageSize - 1), std::clamp(y, 0, kMaxImageSize - 1),
                kTileSizes[random.Int(2, 3)]);
  }
}

// Triangles whose edges run exactly through samples, in all orientations of the edge.
TEST(Coverage, EdgesThroughSamples) {
  Random random(13);
  for (int i = 0; i < 400; ++i) {
    SCOPED_TRACE("seed 13, triangle " + std::to_string(i));
    const int samples = kSampleCounts[random.Int(0, 3)];
    const auto sample = [&] {
      return SampleAt(random.Int(0, 15), random.Int(0, 15), samples, random.Int(0, samples - 1));
    };
    const PointFx8 a = sample(), b = sample(), c = sample();
    if (DoubleArea(a, b, c) != 0) ExpectExact(MakeScreenTriangle(a, b, c), 0, 0, 16);
  }
}

// The rule by hand: the unit square [1, 2) x [1, 2) of pixel centres, as two triangles.
TEST(Coverage, TopLeftRuleByHand) {
  // Vertices on pixel centres (1,1) (3,1) (1,3): of the centres on its edges the top and the left ones belong to it.
  const ScreenTriangle r = MakeScreenTriangle({384, 384}, {896, 384}, {384, 896});
  for (const Target target : AvailableTargets()) {
    const ScopedTarget scoped(target);
    CoverageCount got = CountCoverage({r}, 8, 8, 8, 1);
    EXPECT_EQ(
        Differences(got, [](int x, int y,
                            int) { return (x == 1 && y == 1) || (x == 2 && y == 1) || (x == 1 && y == 2) ? 1 : 0; }),
        "")
        << TargetName(target);
  }
}

}  // namespace
}  // namespace facet::test
