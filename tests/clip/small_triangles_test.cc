// Triangles set up in groups: the same records as one by one, and what is left out covers no sample.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>

#include "clip/geometry_helpers.h"
#include "clip/small_triangles.h"
#include "raster/raster_helpers.h"

namespace facet::test {
namespace {

constexpr int kWidth = 300, kHeight = 200;

// Triangles of a few pixels, on the grid of snapped positions often enough to be degenerate, to lie between samples and
// to have edges through them. With `others`, every tenth is large, beyond the image, behind the eye or not finite.
Primitive Soup(Random& random, int count, bool others) {
  Primitive soup;
  const auto vertex = [&](double x, double y, double z) {
    soup.positions.push_back(glm::vec3(glm::dvec3((x - kWidth * 0.5) * z / 100.0, (kHeight * 0.5 - y) * z / 100.0, -z)));
  };
  for (int i = 0; i < count; ++i) {
    const double x = random.Int(-5 * 16, (kWidth + 5) * 16) / 16.0, y = random.Int(-5 * 16, (kHeight + 5) * 16) / 16.0;
    const int kind = others && i % 10 == 0 ? random.Int(0, 3) : 4;
    for (int k = 0; k < 3; ++k) {
      const int reach = kind == 0 ? 40000 : i % 3 == 0 ? 8 : 80;  // sixteenths
      const double z = kind == 1 ? random.Real(-2.0, 2.0) : random.Real(0.5, 20.0);
      const double far_x = kind == 2 ? 3.0 * kWidth : 0.0;
      vertex(x + far_x + random.Int(-reach, reach) / 16.0, y + random.Int(-reach, reach) / 16.0, z);
      if (kind == 3 && k == 1) soup.positions.back().x = std::numeric_limits<float>::quiet_NaN();
    }
  }
  for (std::uint32_t i = 0; i < soup.positions.size(); ++i) soup.indices.push_back(i);
  return soup;
}

std::string Bits(const ScreenTriangle& r) {
  std::string text;
  const auto add = [&](const auto& value) {
    text.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (int k = 0; k < 3; ++k) add(r.x_fx8[k]), add(r.y_fx8[k]);
  add(r.depth_0), add(r.depth_dx), add(r.depth_dy), add(r.depth_min), add(r.depth_max);
  add(r.drawable), add(r.kind), add(r.back_facing), add(r.covered);
  return text;
}

using BitsByPrimitive = std::map<std::uint32_t, std::vector<std::string>>;

BitsByPrimitive BitsOf(const std::vector<ScreenTriangle>& records) {
  BitsByPrimitive bits;
  for (const ScreenTriangle& r : records) bits[r.primitive].push_back(Bits(r));
  return bits;
}

TEST(SmallTriangles, SameRecordsAsOneByOne) {
  Random random(301);
  const FrameView view = PerspectiveView(kWidth, kHeight, 100.0, 0.1);
  for (int round = 0; round < 24; ++round) {
    SCOPED_TRACE("seed 301, round " + std::to_string(round));
    const int samples = 1 << round % 4;
    const bool mirrored = round % 3 == 0, double_sided = round % 2 == 0;
    const int count = random.Int(1, 200);
    const Primitive soup = Soup(random, count, round >= 12);
    const auto place = [&](const Primitive& primitive) {
      FrameDrawable drawable = PlaceDrawable(view, primitive, glm::dmat4(1.0), double_sided);
      drawable.mirrored = mirrored;
      return drawable;
    };
    // A triangle across the whole image beside each: then none of its group is set up with others.
    BitsByPrimitive expected;
    std::uint64_t culled = 0, clipped = 0;
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(count); ++i) {
      Primitive pair;
      pair.positions = {soup.positions[3 * i], soup.positions[3 * i + 1], soup.positions[3 * i + 2],
                        {-9, -9, -5},          {9, -9, -5},               {0, 9, -5}};
      pair.indices = {0, 1, 2, 3, 4, 5};
      const Assembled both = Assemble(view, place(pair), samples);
      for (const ScreenTriangle& r : both.chunk.records) {
        if (r.primitive == 0) expected[i].push_back(Bits(r));
      }
      culled += both.chunk.culled, clipped += both.chunk.clipped;
      if (mirrored && !double_sided) --culled;  // the other one
    }
    for (const Target target : {Target::Scalar, Target::Sse4, Target::Avx2, Target::Avx3, Target::Neon}) {
      if (!TargetIsAvailable(target)) continue;
      const ScopedTarget scoped(target);
      const Assembled whole = Assemble(view, place(soup), samples);
      EXPECT_TRUE(BitsOf(whole.chunk.records) == expected) << TargetName(target);
      EXPECT_EQ(whole.chunk.culled, culled) << TargetName(target);
      EXPECT_EQ(whole.chunk.clipped, clipped) << TargetName(target);
      EXPECT_TRUE(std::is_sorted(whole.chunk.records.begin(), whole.chunk.records.end(),
                                 [](const auto& a, const auto& b) { return a.primitive < b.primitive; }));
    }
  }
}

void ExpectThatWhatIsCulledCoversNothing(Target target) {
  Random random(302);
  const FrameView view = PerspectiveView(kWidth, kHeight, 100.0, 0.1);
  std::uint64_t culled_with_area = 0;
  for (const int samples : {1, 2, 4, 8}) {
    SCOPED_TRACE(std::to_string(samples) + " samples, " + TargetName(target));
    const Primitive soup = Soup(random, 2000, false);
    const FrameDrawable drawable = PlaceDrawable(view, soup, glm::dmat4(1.0), true);
    const Assembled out = Assemble(view, drawable, samples);
    EXPECT_EQ(out.chunk.records.size() + out.chunk.culled + out.chunk.clipped, 2000u);
    std::vector<bool> kept(2000, false);
    for (const ScreenTriangle& r : out.chunk.records) kept[r.primitive] = true;
    for (std::uint32_t i = 0; i < 2000; ++i) {
      if (kept[i]) continue;
      PointFx8 p[3];
      for (std::uint32_t k = 0; k < 3; ++k) {
        p[k] = {out.vertices[3 * i + k].x_fx8, out.vertices[3 * i + k].y_fx8};
      }
      if (DoubleArea(p[0], p[1], p[2]) == 0) continue;
      ++culled_with_area;
      const ScreenTriangle r = MakeScreenTriangle(p[0], p[1], p[2]);
      const auto [low_x, high_x] = std::minmax({p[0].x, p[1].x, p[2].x});
      const auto [low_y, high_y] = std::minmax({p[0].y, p[1].y, p[2].y});
      for (int y = std::max(low_y >> 8, 0); y <= std::min(high_y >> 8, kHeight - 1); ++y) {
        for (int x = std::max(low_x >> 8, 0); x <= std::min(high_x >> 8, kWidth - 1); ++x) {
          for (int s = 0; s < samples; ++s) {
            EXPECT_FALSE(CoversExactly(r, SampleAt(x, y, samples, s))) << "triangle " << i << ", sample " << s;
          }
        }
      }
    }
  }
  EXPECT_GT(culled_with_area, 100u) << "the test shows nothing";
}

TEST(SmallTriangles, WhatIsCulledCoversNothing) {
  for (const Target target : {Target::Scalar, Target::Sse4, Target::Avx2, Target::Avx3, Target::Neon}) {
    if (!TargetIsAvailable(target)) continue;
    const ScopedTarget scoped(target);
    ExpectThatWhatIsCulledCoversNothing(target);
  }
}

// What a record says that it covers is what it covers, and no record of few samples covers none.
TEST(SmallTriangles, KnownCoverageIsExact) {
  Random random(303);
  const FrameView view = PerspectiveView(kWidth, kHeight, 100.0, 0.1);
  for (const Target target : {Target::Scalar, Target::Sse4, Target::Avx2, Target::Avx3, Target::Neon}) {
    if (!TargetIsAvailable(target)) continue;
    const ScopedTarget scoped(target);
    for (const int samples : {1, 2, 4, 8}) {
      const SampleReach reach = ReachOf(samples);
      const Primitive soup = Soup(random, 2000, false);
      const int side = samples <= 2 ? 3 : 2;  // pixels
      int known = 0, wide = 0;
      const Assembled out = Assemble(view, PlaceDrawable(view, soup, glm::dmat4(1.0), true), samples);
      for (const ScreenTriangle& r : out.chunk.records) {
        const auto [low_x, high_x] = std::minmax({r.x_fx8[0], r.x_fx8[1], r.x_fx8[2]});
        const auto [low_y, high_y] = std::minmax({r.y_fx8[0], r.y_fx8[1], r.y_fx8[2]});
        std::uint32_t expected = 0;
        int outside = 0;  // of the square, in the pixels around it
        for (int y = -1; y <= side; ++y) {
          for (int x = -1; x <= side; ++x) {
            for (int s = 0; s < samples; ++s) {
              const int column = FirstPixel(low_x, reach.high_x) + x, row = FirstPixel(low_y, reach.high_y) + y;
              if (!CoversExactly(r, SampleAt(column, row, samples, s))) continue;
              if (x < 0 || y < 0 || x >= side || y >= side) ++outside;
              else expected |= 1u << (((side == 3 ? 4 : 2) * y + x) * samples + s);
            }
          }
        }
        const auto last = [](std::int32_t high, int low) { return (high - low) >> kSubpixelBits; };
        const bool few = last(high_x, reach.low_x) - FirstPixel(low_x, reach.high_x) < side &&
                         last(high_y, reach.low_y) - FirstPixel(low_y, reach.high_y) < side;
        EXPECT_EQ(r.covered, few ? expected : 0u) << TargetName(target) << ", " << samples << " samples";
        if (few) {
          EXPECT_EQ(outside, 0);
          EXPECT_NE(expected, 0u);
        }
        (few ? known : wide) += 1;
      }
      EXPECT_GT(known, 20);
      EXPECT_GT(wide, 20);
    }
  }
}

// Strips, fans and lists without indices come to the same triangles as a list.
TEST(SmallTriangles, EveryTopology) {
  Random random(303);
  const FrameView view = PerspectiveView(kWidth, kHeight, 100.0, 0.1);
  Primitive list = Soup(random, 60, false);
  for (const Topology topology : {Topology::Triangles, Topology::TriangleStrip, Topology::TriangleFan}) {
    for (const bool indexed : {false, true}) {
      Primitive from = list;
      from.topology = topology;
      if (!indexed) from.indices.clear();
      Primitive unrolled = list;
      unrolled.indices.clear();
      for (std::uint32_t i = 0; i < PrimitiveCount(from); ++i) {
        for (const std::uint32_t v : PrimitiveVertices(from, i)) unrolled.indices.push_back(v);
      }
      const auto records = [&](const Primitive& p) {
        return BitsOf(Assemble(view, PlaceDrawable(view, p, glm::dmat4(1.0), true), 4).chunk.records);
      };
      EXPECT_TRUE(records(from) == records(unrolled));
    }
  }
}

}  // namespace
}  // namespace facet::test
