// Which side is seen: culling, mirrored transforms, double-sided materials.
#include <gtest/gtest.h>

#include "clip/geometry_helpers.h"
#include "raster/raster_helpers.h"

namespace facet::test {
namespace {

// A square of side 2 that faces +Z, counter-clockwise.
Primitive Quad() {
  Primitive quad;
  quad.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  quad.indices = {0, 1, 2, 0, 2, 3};
  return quad;
}

TEST(Facing, AllSignsOfScale) {
  const FrameView view = PerspectiveView(64, 64, 60.0, 0.1);
  const Primitive quad = Quad();
  for (int signs = 0; signs < 8; ++signs) {
    for (const bool from_behind : {false, true}) {
      for (const bool double_sided : {false, true}) {
        SCOPED_TRACE("signs " + std::to_string(signs) + (from_behind ? ", from behind" : "") +
                     (double_sided ? ", double-sided" : ""));
        glm::dmat4 m(1.0);
        for (int k = 0; k < 3; ++k) m[k][k] = (signs >> k & 1) != 0 ? -1.5 : 1.5;
        m[3] = {0.0, 0.0, -5.0, 1.0};
        if (from_behind) {  // half a turn about Y, before the scale
          m[0] = -m[0], m[2] = -m[2];
        }
        // The face's outward normal is +-Z; a mirroring of z alone turns it, mirrorings of x or y do not.
        const bool front = ((signs >> 2 & 1) != 0) == from_behind;
        const FrameDrawable drawable = PlaceDrawable(view, quad, m, double_sided);
        const Assembled out = Assemble(view, drawable, 1);
        ASSERT_EQ(out.chunk.records.size(), front || double_sided ? 2u : 0u);
        EXPECT_EQ(out.chunk.culled, front || double_sided ? 0u : 2u);
        for (const ScreenTriangle& r : out.chunk.records) EXPECT_EQ(r.back_facing, !front);
        // 3 units at distance 5 and a focal length of 60: 36 pixels.
        CoverageCount got = CountCoverage(out.chunk.records, 64, 64, 32, 1);
        EXPECT_EQ(got.Total(), front || double_sided ? 36 * 36 : 0);
      }
    }
  }
}

TEST(Facing, ClippedTrianglesAreCulledTheSame) {
  Random random(61);
  const FrameView view = PerspectiveView(64, 64, 40.0, 0.5);
  int seen = 0, checked = 0;
  for (int i = 0; i < 500; ++i) {
    Primitive primitive;
    for (int k = 0; k < 3; ++k) {
      primitive.positions.push_back({static_cast<float>(random.Real(-6, 6)), static_cast<float>(random.Real(-6, 6)),
                                     static_cast<float>(random.Real(-8, 4))});
    }
    // Seen from the front if the eye, at the origin, lies on the side of the normal.
    const glm::dvec3 a(primitive.positions[0]), b(primitive.positions[1]), c(primitive.positions[2]);
    const double side = glm::dot(glm::cross(b - a, c - a), -a);
    if (std::fabs(side) < 5.0) continue;
    const FrameDrawable drawable = PlaceDrawable(view, primitive, glm::dmat4(1.0), true);
    const Assembled both = Assemble(view, drawable, 8);
    for (const ScreenTriangle& r : both.chunk.records) {
      // A piece of a few units of area may be turned by the snapping.
      if (DoubleArea({r.x_fx8[0], r.y_fx8[0]}, {r.x_fx8[1], r.y_fx8[1]}, {r.x_fx8[2], r.y_fx8[2]}) < 65536) continue;
      EXPECT_EQ(r.back_facing, side < 0.0) << "seed 61, triangle " << i;
      ++checked;
    }
    const FrameDrawable culled = PlaceDrawable(view, primitive);
    const Assembled front = Assemble(view, culled, 8);
    if (side > 0.0) seen += !front.chunk.records.empty();
  }
  EXPECT_GT(seen, 20);
  EXPECT_GT(checked, 50);
}

TEST(Facing, EmptyTrianglesAndThoseBetweenSamplesAreCulled) {
  const FrameView view = PixelView(32, 32);
  Primitive primitive;
  primitive.positions = {{1, 1, -1},       {5, 5, -1},       {9, 9, -1},         // a line
                         {3, 3, -1},       {3, 3, -1},       {7, 3, -1},         // two equal vertices
                         {4.6f, 4.6f, -1}, {4.9f, 4.6f, -1}, {4.7f, 5.4f, -1}};  // between pixel centres
  const FrameDrawable drawable = PlaceDrawable(view, primitive, glm::dmat4(1.0), true);
  const Assembled out = Assemble(view, drawable, 1);
  EXPECT_TRUE(out.chunk.records.empty());
  EXPECT_EQ(out.chunk.culled, 3u);
}

// Culling of what covers no sample never takes what does.
TEST(Facing, SmallTrianglesThatCoverASampleStay) {
  Random random(62);
  const FrameView view = PixelView(8, 8);
  int covering = 0;
  for (int i = 0; i < 4000; ++i) {
    const int samples = kSampleCounts[i % 4];
    const PointFx8 v[3] = {{random.Int(900, 1300), random.Int(900, 1300)},
                           {random.Int(900, 1300), random.Int(900, 1300)},
                           {random.Int(900, 1300), random.Int(900, 1300)}};
    if (DoubleArea(v[0], v[1], v[2]) == 0) continue;
    Primitive primitive;
    for (const PointFx8 p : v)
      primitive.positions.push_back({static_cast<float>(p.x) / 256.0f, static_cast<float>(p.y) / 256.0f, -1.0f});
    const FrameDrawable drawable = PlaceDrawable(view, primitive, glm::dmat4(1.0), true);
    const Assembled out = Assemble(view, drawable, samples);
    CoverageCount got = CountCoverage(out.chunk.records, 8, 8, 8, samples);
    const ScreenTriangle exact = MakeScreenTriangle(v[0], v[1], v[2]);
    EXPECT_EQ(
        Differences(got, [&](int x, int y, int s) { return CoversExactly(exact, SampleAt(x, y, samples, s)) ? 1 : 0; }),
        "")
        << "seed 62, triangle " << i;
    covering += got.Total() > 0;
  }
  EXPECT_GT(covering, 500);
}

}  // namespace
}  // namespace facet::test
