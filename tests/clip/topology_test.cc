// Points, lines, strips and fans: closed forms.
#include <gtest/gtest.h>

#include "clip/geometry_helpers.h"
#include "raster/raster_helpers.h"

namespace facet::test {
namespace {

constexpr int kSize = 48;

CoverageCount Cover(const Primitive& primitive, int samples, bool y_up = false) {
  const FrameView view = PixelView(kSize, kSize, y_up);
  const FrameDrawable drawable = PlaceDrawable(view, primitive);
  return CountCoverage(Assemble(view, drawable, samples).chunk.records, kSize, kSize, 16, samples);
}

TEST(Points, CoverOnePixelsWorthOfSamples) {
  Random random(71);
  for (const int samples : kSampleCounts) {
    Primitive point;
    point.topology = Topology::Points;
    point.positions = {{10.5f, 20.5f, -1.0f}};
    CoverageCount aligned = Cover(point, samples);
    EXPECT_EQ(Differences(aligned, [](int x, int y, int) { return x == 10 && y == 20 ? 1 : 0; }), "");
    for (int i = 0; i < 100; ++i) {
      // A half-open square of side 1 holds one position of every sample, wherever it is.
      point.positions = {{static_cast<float>(random.Real(2, 40)), static_cast<float>(random.Real(2, 40)), -1.0f}};
      const CoverageCount got = Cover(point, samples);
      std::vector<int> of_sample(std::size_t{8});
      for (std::size_t k = 0; k < got.count.size(); ++k) of_sample[k % std::size_t(samples)] += got.count[k];
      for (int s = 0; s < samples; ++s)
        EXPECT_EQ(of_sample[std::size_t(s)], 1) << "seed 71, point " << i << ", sample " << s;
    }
  }
}

TEST(Points, NoneForACentreOutside) {
  Primitive points;
  points.topology = Topology::Points;
  points.positions = {{-0.3f, 5, -1},        {5, -0.3f, -1}, {kSize + 0.3f, 5, -1},
                      {5, kSize + 0.3f, -1}, {5, 5, 1},      {5, 5, -2000}};
  EXPECT_EQ(Cover(points, 4).Total(), 0);
}

Primitive Polyline(Topology topology, std::vector<glm::vec3> positions) {
  Primitive out;
  out.topology = topology;
  out.positions = std::move(positions);
  return out;
}

TEST(Lines, AxisAlignedOnesCoverTheirLengthInPixels) {
  for (int n = 1; n < 20; ++n) {
    const float end = 7.5f + static_cast<float>(n);
    for (const bool reversed : {false, true}) {
      std::vector<glm::vec3> across = {{7.5f, 9.5f, -1}, {end, 9.5f, -1}}, down = {{9.5f, 7.5f, -1}, {9.5f, end, -1}};
      if (reversed) std::swap(across[0], across[1]), std::swap(down[0], down[1]);
      CoverageCount a = Cover(Polyline(Topology::Lines, across), 1), d = Cover(Polyline(Topology::Lines, down), 1);
      EXPECT_EQ(Differences(a, [&](int x, int y, int) { return y == 9 && x >= 7 && x < 7 + n ? 1 : 0; }), "");
      EXPECT_EQ(Differences(d, [&](int x, int y, int) { return x == 9 && y >= 7 && y < 7 + n ? 1 : 0; }), "");
      // From pixel corner to pixel corner, all samples of one row of pixels.
      EXPECT_EQ(Cover(Polyline(Topology::Lines, {{7, 9.5f, -1}, {7 + static_cast<float>(n), 9.5f, -1}}), 8).Total(),
                8 * n);
    }
  }
}

// A rectangle of width 1: the number of samples is its area, within what the outline may hold.
TEST(Lines, AreOnePixelWideInAnyDirection) {
  Random random(72);
  for (int i = 0; i < 200; ++i) {
    const double angle = random.Real(0.0, 6.3), length = random.Real(5.0, 20.0);
    const glm::dvec2 a(24.0, 24.0), b = a + glm::dvec2(std::cos(angle), std::sin(angle)) * length;
    CoverageCount got = Cover(Polyline(Topology::Lines, {{24, 24, -1}, glm::vec3(glm::dvec3(b, -1.0))}), 8);
    EXPECT_NEAR(got.Total() / 8.0, length, 1.2) << "seed 72, line " << i;
    // Each sample within half a pixel of the segment's line is covered, others are not.
    const glm::dvec2 along = (b - a) / length;
    EXPECT_EQ(Differences(got,
                          [&](int x, int y, int s) {
                            const PointFx8 p = SampleAt(x, y, 8, s);
                            const glm::dvec2 d = glm::dvec2(p.x / 256.0, p.y / 256.0) - a;
                            const double t = glm::dot(d, along), u = std::fabs(d.x * along.y - d.y * along.x);
                            const double outside = std::max({u - 0.5, -t, t - length});
                            return std::fabs(outside) < 1.0 / 128 ? -1 : outside < 0 ? 1 : 0;
                          }),
              "")
        << "seed 72, line " << i;
  }
}

// The outline of a square with n pixels a side: each line covers n pixels, half-open.
TEST(Lines, ListStripAndLoop) {
  constexpr int n = 11;
  const std::vector<glm::vec3> square = {
      {5.5f, 6.5f, -1}, {5.5f + n, 6.5f, -1}, {5.5f + n, 6.5f + n, -1}, {5.5f, 6.5f + n, -1}};
  EXPECT_EQ(Cover(Polyline(Topology::Lines, square), 1).Total(), 2 * n);
  EXPECT_EQ(Cover(Polyline(Topology::LineStrip, square), 1).Total(), 3 * n);
  CoverageCount loop = Cover(Polyline(Topology::LineLoop, square), 1);
  EXPECT_EQ(loop.Total(), 4 * n);
  EXPECT_EQ(Differences(loop,
                        [](int x, int y, int) {
                          int count = 0;
                          if (x >= 5 && x < 5 + n) count += (y == 6) + (y == 6 + n);
                          if (y >= 6 && y < 6 + n) count += (x == 5) + (x == 5 + n);
                          return count;
                        }),
            "");
}

TEST(Lines, RemainUnderTheNearPlaneAndTheGuardBand) {
  // Along the viewing axis's row: from behind the eye to far right; covered from the near plane's cut on.
  const FrameView view = PerspectiveView(64, 64, 32.0, 1.0);
  Primitive line = Polyline(Topology::Lines, {{-1.0f, -0.015625f, 1.0f}, {1.0f, -0.015625f, -3.0f}});
  const FrameDrawable drawable = PlaceDrawable(view, line);
  const Assembled out = Assemble(view, drawable, 1);
  CoverageCount got = CountCoverage(out.chunk.records, 64, 64, 16, 1);
  // At distance 1 x is 0, the image's middle; at distance 3 it is 1/3 of 32 pixels further right. y is near 32.5.
  EXPECT_EQ(out.chunk.clipped, 1u);
  int columns = 0;
  for (int x = 0; x < 64; ++x) columns += got.At(x, 32, 0);
  EXPECT_EQ(columns, 11);
  EXPECT_EQ(got.Total(), columns);

  const FrameView pixels = PixelView(kSize, kSize);
  Primitive endless = Polyline(Topology::Lines, {{-1e6f, 9.5f, -1}, {1e6f, 9.5f, -1}});
  const FrameDrawable across = PlaceDrawable(pixels, endless);
  CoverageCount row = CountCoverage(Assemble(pixels, across, 1).chunk.records, kSize, kSize, 16, 1);
  EXPECT_EQ(Differences(row, [](int, int y, int) { return y == 9 ? 1 : 0; }), "");
}

// Strips and fans are wound consistently: with culling on, each covers its area once seen from the front, and nothing
// from behind.
TEST(Triangles, StripsAndFans) {
  Primitive strip;
  strip.topology = Topology::TriangleStrip;
  for (int i = 0; i < 9; ++i) {  // zigzag, y up, counter-clockwise
    const float x = 4.0f + 4.0f * static_cast<float>(i);
    strip.positions.push_back({x, 30.0f, -1.0f});
    strip.positions.push_back({x, 10.0f, -1.0f});
  }
  CoverageCount got = Cover(strip, 4, true);
  EXPECT_EQ(
      Differences(got, [](int x, int y, int) { return x >= 4 && x < 36 && y >= kSize - 30 && y < kSize - 10 ? 1 : 0; }),
      "");
  for (glm::vec3& p : strip.positions) p.y = 40.0f - p.y;
  EXPECT_EQ(Cover(strip, 4, true).Total(), 0) << "seen from behind";

  Primitive fan;
  fan.topology = Topology::TriangleFan;
  fan.positions = {{20, 20, -1}, {30, 10, -1}, {30, 30, -1}, {10, 30, -1}, {10, 10, -1}, {30, 10, -1}};
  got = Cover(fan, 8, true);
  EXPECT_EQ(Differences(
                got, [](int x, int y, int) { return x >= 10 && x < 30 && y >= kSize - 30 && y < kSize - 10 ? 1 : 0; }),
            "");
  std::reverse(fan.positions.begin() + 1, fan.positions.end());
  EXPECT_EQ(Cover(fan, 8, true).Total(), 0) << "seen from behind";

  // The same through indices; and a list, with what is left over ignored.
  Primitive list;
  list.positions = {{10, 10, -1}, {30, 10, -1}, {30, 30, -1}, {10, 30, -1}};
  list.indices = {0, 1, 2, 2, 3, 0, 1, 2};
  got = Cover(list, 8, true);
  EXPECT_EQ(Differences(
                got, [](int x, int y, int) { return x >= 10 && x < 30 && y >= kSize - 30 && y < kSize - 10 ? 1 : 0; }),
            "");
}

TEST(Triangles, RecordsNameTheirPrimitive) {
  Primitive strip;
  strip.topology = Topology::TriangleStrip;
  for (int i = 0; i < 20; ++i)
    strip.positions.push_back({2.0f * static_cast<float>(i / 2), i % 2 == 0 ? 30.0f : 10.0f, -1.0f});
  const FrameView view = PixelView(kSize, kSize, true);
  const FrameDrawable drawable = PlaceDrawable(view, strip);
  const Assembled out = Assemble(view, drawable, 4);
  ASSERT_EQ(out.chunk.records.size(), 18u);
  for (std::size_t i = 0; i < 18; ++i) EXPECT_EQ(out.chunk.records[i].primitive, i);
}

}  // namespace
}  // namespace facet::test
