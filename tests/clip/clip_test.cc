// Clipping against a test in homogeneous coordinates, which clips nothing; and triangles that stay joined.
#include <gtest/gtest.h>

#include "clip/clip_polygon.h"
#include "clip/geometry_helpers.h"
#include "raster/raster_helpers.h"

namespace facet::test {
namespace {

constexpr int kWidth = 64, kHeight = 48;
constexpr double kMargin = 1.0 / 128.0;

using Answer = HomogeneousTriangle::Answer;

void ExpectMatchesHomogeneous(const FrameView& view, const glm::vec3 (&p)[3], int samples) {
  Primitive primitive;
  primitive.positions = {p[0], p[1], p[2]};
  const FrameDrawable drawable = PlaceDrawable(view, primitive, glm::dmat4(1.0), true);
  const HomogeneousTriangle exact(HomogeneousOf(drawable, p[0]), HomogeneousOf(drawable, p[1]),
                                  HomogeneousOf(drawable, p[2]));
  if (exact.Degenerate()) return;
  const Assembled out = Assemble(view, drawable, samples);
  CoverageCount got = CountCoverage(out.chunk.records, kWidth, kHeight, 64, samples);
  EXPECT_EQ(Differences(got,
                        [&](int x, int y, int s) {
                          const PointFx8 at = SampleAt(x, y, samples, s);
                          const Answer answer =
                              exact.At(at.x / 256.0, at.y / 256.0, view.near_distance, view.far_distance, kMargin);
                          return answer == Answer::Unsure ? -1 : answer == Answer::Inside ? 1 : 0;
                        }),
            "");
  for (const ScreenTriangle& r : out.chunk.records) {
    for (int i = 0; i < 3; ++i) {
      // What the rasteriser's 32-bit arithmetic counts on.
      EXPECT_LE(std::abs(r.x_fx8[i] - kWidth * 128), kGuardBand * 256 + 256);
      EXPECT_LE(std::abs(r.y_fx8[i] - kHeight * 128), kGuardBand * 256 + 256);
    }
    EXPECT_TRUE(std::isfinite(r.depth_0) && std::isfinite(r.depth_dx) && std::isfinite(r.depth_dy));
  }
}

glm::vec3 RandomPoint(Random& random, double reach, double z_low, double z_high) {
  return {static_cast<float>(random.Real(-reach, reach)), static_cast<float>(random.Real(-reach, reach)),
          static_cast<float>(-random.Real(z_low, z_high))};
}

TEST(Clip, NearPlaneMatchesHomogeneousTest) {
  Random random(41);
  const FrameView view = PerspectiveView(kWidth, kHeight, 40.0, 0.5);
  for (int i = 0; i < 600; ++i) {
    SCOPED_TRACE("seed 41, triangle " + std::to_string(i));
    const glm::vec3 p[3] = {RandomPoint(random, 6.0, -4.0, 8.0), RandomPoint(random, 6.0, -4.0, 8.0),
                            RandomPoint(random, 6.0, -4.0, 8.0)};
    ExpectMatchesHomogeneous(view, p, kSampleCounts[i % 4]);
  }
}

TEST(Clip, GuardBandMatchesHomogeneousTest) {
  Random random(42);
  const FrameView view = PerspectiveView(kWidth, kHeight, 40.0, 0.5);
  for (int i = 0; i < 600; ++i) {
    SCOPED_TRACE("seed 42, triangle " + std::to_string(i));
    // Reaches of up to 10^5 pixels, all in front of the eye.
    const double reach = i % 2 == 0 ? 2000.0 : 20.0;
    const glm::vec3 p[3] = {RandomPoint(random, reach, 0.6, 8.0), RandomPoint(random, reach, 0.6, 8.0),
                            RandomPoint(random, i % 3 == 0 ? 0.5 : reach, 0.6, 8.0)};
    ExpectMatchesHomogeneous(view, p, kSampleCounts[i % 4]);
  }
}

TEST(Clip, AllPlanesMatchHomogeneousTest) {
  Random random(43);
  for (int i = 0; i < 800; ++i) {
    SCOPED_TRACE("seed 43, triangle " + std::to_string(i));
    const FrameView view = PerspectiveView(kWidth, kHeight, 40.0, 0.5, random.Real(1.0, 30.0));
    const double reach = i % 2 == 0 ? 3000.0 : 60.0, depth = i % 4 < 2 ? 60.0 : 6.0;
    const glm::vec3 p[3] = {RandomPoint(random, reach, -depth, depth), RandomPoint(random, reach, -depth, depth),
                            RandomPoint(random, i % 3 == 0 ? 1.0 : reach, -depth, depth)};
    ExpectMatchesHomogeneous(view, p, kSampleCounts[i % 4]);
  }
}

TEST(Clip, FarPlane) {
  // A floor that runs away from the eye: it ends where its distance is 8.
  const FrameView view = PerspectiveView(kWidth, kHeight, 40.0, 0.5, 8.0);
  Primitive floor;
  floor.positions = {{-500, -2, -1}, {500, -2, -1}, {500, -2, -500}, {-500, -2, -500}};
  floor.indices = {0, 1, 2, 0, 2, 3};
  const FrameDrawable drawable = PlaceDrawable(view, floor);
  CoverageCount got = CountCoverage(Assemble(view, drawable, 1).chunk.records, kWidth, kHeight, 16, 1);
  // y = 24 + 40 * 2 / distance: 34 at distance 8.
  EXPECT_EQ(Differences(got, [](int, int y, int) { return y >= 34 ? 1 : 0; }), "");
}

// Depths and their rates are floats wherever a block begins, of the thinnest of triangles at the least distance too.
TEST(Clip, DepthsAreFloats) {
  Random random(44);
  const FrameView view = PerspectiveView(kWidth, kHeight, 40.0, kLeastDistance);
  std::size_t steep = 0;
  for (int i = 0; i < 20000; ++i) {
    SCOPED_TRACE("seed 44, triangle " + std::to_string(i));
    // Two corners near one another on the screen, the third anywhere, or beside them in a row; of any distance.
    Primitive primitive;
    const glm::dvec2 place(random.Real(-0.5, 0.5), random.Real(-0.5, 0.5));
    for (int k = 0; k < 3; ++k) {
      const double distance = std::pow(10.0, random.Real(-29.0, 2.0)), reach = k < 2 ? 1e-4 : i % 2 == 0 ? 2.0 : 200.0;
      const glm::dvec2 at =
          place + glm::dvec2(random.Real(-reach, reach), random.Real(-1.0, 1.0) * (i % 3 == 0 ? 1e-4 : reach));
      primitive.positions.emplace_back(glm::dvec3(at, -1.0) * distance);
    }
    const FrameDrawable drawable = PlaceDrawable(view, primitive, glm::dmat4(1.0), true);
    for (const ScreenTriangle& r : Assemble(view, drawable, 8).chunk.records) {
      const double most{std::numeric_limits<float>::max()};
      steep += std::fabs(r.depth_dx) >= kSteepestDepth || std::fabs(r.depth_dy) >= kSteepestDepth;
      for (const double x : {GreatestOf(r.x_fx8) / 256.0 + kBlockSize, LeastOf(r.x_fx8) / 256.0 - kBlockSize}) {
        for (const double y : {GreatestOf(r.y_fx8) / 256.0 + kBlockSize, LeastOf(r.y_fx8) / 256.0 - kBlockSize}) {
          const double depth =
              r.depth_0 + r.depth_dx * (x - r.x_fx8[0] / 256.0) + r.depth_dy * (y - r.y_fx8[0] / 256.0);
          ASSERT_LE(std::fabs(depth), most);
        }
      }
      ASSERT_LE(std::fabs(r.depth_dx), most);
      ASSERT_LE(std::fabs(r.depth_dy), most);
      ASSERT_TRUE(std::isfinite(r.depth_min) && std::isfinite(r.depth_max));
    }
  }
  EXPECT_GT(steep, 10u);
}

TEST(Clip, OutsideThereIsNothing) {
  Random random(44);
  const FrameView view = PerspectiveView(kWidth, kHeight, 40.0, 0.5, 20.0);
  for (int side = 0; side < 6; ++side) {
    for (int i = 0; i < 60; ++i) {
      SCOPED_TRACE("seed 44, side " + std::to_string(side) + ", triangle " + std::to_string(i));
      Primitive primitive;
      for (int k = 0; k < 3; ++k) {
        glm::vec3 p = RandomPoint(random, 30.0, 0.6, 19.0);
        const float z = -p.z, e = static_cast<float>(random.Real(1.01, i % 2 == 0 ? 3.0 : 10000.0));
        if (side == 0) p.x = -z * 0.8f * e;  // half of 64 pixels at a focal length of 40
        if (side == 1) p.x = z * 0.8f * e;
        if (side == 2) p.y = -z * 0.6f * e;
        if (side == 3) p.y = z * 0.6f * e;
        if (side == 4) p.z = 0.4f * e - 0.8f;  // behind the near plane, or the eye
        if (side == 4 && p.z < -0.49f) p.z = -0.3f;
        if (side == 5) p.z = -20.0f * e;
        primitive.positions.push_back(p);
      }
      const FrameDrawable drawable = PlaceDrawable(view, primitive, glm::dmat4(1.0), true);
      const Assembled out = Assemble(view, drawable, 8);
      EXPECT_TRUE(out.chunk.records.empty());
      EXPECT_EQ(out.chunk.clipped + out.chunk.culled, 1u);
    }
  }
}

TEST(Clip, VerticesThatAreNotFiniteTakeTheirTrianglesWithThem) {
  const float kInf = std::numeric_limits<float>::infinity(), kNan = std::numeric_limits<float>::quiet_NaN();
  const float kMax = std::numeric_limits<float>::max();
  for (const bool perspective : {true, false}) {
    const FrameView view = perspective ? PerspectiveView(kWidth, kHeight, 40.0, 0.5) : PixelView(kWidth, kHeight);
    for (const float bad : {kInf, -kInf, kNan}) {
      for (int vertex = 0; vertex < 3; ++vertex) {
        for (int axis = 0; axis < 3; ++axis) {
          for (const Topology topology : {Topology::Triangles, Topology::Points, Topology::LineLoop}) {
            Primitive primitive;
            primitive.topology = topology;
            primitive.positions = {{-1, -1, -3}, {1, -1, -3}, {0, 1, -3}};
            primitive.positions[std::size_t(vertex)][axis] = bad;
            const FrameDrawable drawable = PlaceDrawable(view, primitive, glm::dmat4(1.0), true);
            const Assembled out = Assemble(view, drawable, 4);
            for (const ScreenTriangle& r : out.chunk.records) {
              ASSERT_NE(topology, Topology::Triangles);
              ASSERT_LE(std::abs(r.x_fx8[0]), 2 * kGuardBand * 256);
            }
          }
        }
      }
    }
    // The largest finite numbers, mixed with ordinary ones.
    Random random(45);
    for (int i = 0; i < 300; ++i) {
      Primitive primitive;
      const float values[] = {kMax, -kMax, 1e30f, -1e20f, 1e-40f, 0.0f, -3.0f, 2.0f};
      for (int k = 0; k < 3; ++k)
        primitive.positions.push_back({values[random.Int(0, 7)], values[random.Int(0, 7)], values[random.Int(0, 7)]});
      primitive.topology = i % 2 == 0 ? Topology::Triangles : Topology::LineLoop;
      const FrameDrawable drawable = PlaceDrawable(view, primitive, glm::dmat4(1.0), true);
      for (const ScreenTriangle& r : Assemble(view, drawable, 4).chunk.records) {
        for (int k = 0; k < 3; ++k) {
          ASSERT_LE(std::abs(r.x_fx8[k]), 2 * kGuardBand * 256) << "seed 45";
          ASSERT_LE(std::abs(r.y_fx8[k]), 2 * kGuardBand * 256) << "seed 45";
        }
        ASSERT_FALSE(std::isnan(r.depth_0)) << "seed 45";
      }
    }
  }
}

// A plane z = 0 of mesh space, split up at exact positions, seen so that the near plane and the guard band cut it.
// Front faces count +1, back faces -1: however the snapping turns a sliver, each sample of the union counts 1.
TEST(Clip, CutTrianglesStayJoined) {
  for (std::uint64_t seed = 51; seed < 75; ++seed) {
    Random random(seed);
    const int half = random.Int(0, 1) == 0 ? 160 : 40000;  // sixteenths: a table, or a plain
    Triangulation mesh({-half, -half}, {half, half});
    for (int i = 0; i < 60; ++i) {
      const int reach = i % 2 == 0 ? half : 160;
      mesh.Insert({random.Int(-reach, reach), random.Int(-reach, reach)});
      mesh.Flip(random);
    }
    Primitive primitive;
    for (const PointFx8 p : mesh.points) {
      primitive.positions.push_back({static_cast<float>(p.x) / 16.0f, static_cast<float>(p.y) / 16.0f, 0.0f});
    }
    for (const auto& t : mesh.triangles) {
      for (const int v : t) primitive.indices.push_back(static_cast<std::uint32_t>(v));
    }
    const double near_distance = random.Real(0.3, 2.0);
    const double far_distance = seed % 3 == 0 ? random.Real(5.0, 15.0) : std::numeric_limits<double>::infinity();
    const FrameView view = PerspectiveView(kWidth, kHeight, 60.0, near_distance, far_distance);
    // The eye stands above the plane's middle and looks towards the horizon, tilted.
    const double pitch = random.Real(0.15, 1.0), roll = random.Real(-3.0, 3.0);
    const glm::dvec3 back(0.0, std::cos(pitch), std::sin(pitch)), right(1.0, 0.0, 0.0), up = glm::cross(back, right);
    const glm::dvec3 right_rolled = right * std::cos(roll) + up * std::sin(roll),
                     up_rolled = up * std::cos(roll) - right * std::sin(roll);
    const glm::dvec3 eye(random.Real(-3.0, 3.0), random.Real(-3.0, 3.0), random.Real(0.5, 2.5));
    const glm::dmat3 camera_from_world = glm::transpose(glm::dmat3(right_rolled, up_rolled, back));
    glm::dmat4 camera_from_mesh(camera_from_world);
    camera_from_mesh[3] = glm::dvec4(-(camera_from_world * eye), 1.0);
    const FrameDrawable drawable = PlaceDrawable(view, primitive, camera_from_mesh, true);

    const auto h = [&](int i) { return HomogeneousOf(drawable, primitive.positions[std::size_t(i)]); };
    const HomogeneousTriangle first(h(0), h(1), h(2)), second(h(0), h(2), h(3));
    const int samples = kSampleCounts[seed % 4];
    const Assembled out = Assemble(view, drawable, samples);
    EXPECT_GT(out.chunk.clipped, 0u);
    CoverageCount got = CountCoverage(out.chunk.records, kWidth, kHeight, 32, samples, true);
    int covered = 0;
    EXPECT_EQ(
        Differences(got,
                    [&](int x, int y, int s) {
                      const PointFx8 at = SampleAt(x, y, samples, s);
                      const Answer a = first.At(at.x / 256.0, at.y / 256.0, near_distance, far_distance, 1.0 / 64.0);
                      const Answer b = second.At(at.x / 256.0, at.y / 256.0, near_distance, far_distance, 1.0 / 64.0);
                      if (a == Answer::Inside || b == Answer::Inside) return ++covered, 1;
                      if (a == Answer::Outside && b == Answer::Outside) return 0;
                      return -1;
                    }),
        "")
        << "seed " << seed;
    EXPECT_GT(covered, 0) << "seed " << seed << ": nothing is seen";
  }
}

// Two triangles that share an edge get the same snapped points along it, so no crack can open whatever the samples.
// Here the second one is not clipped at all and the first is, away from the edge: by its third vertex. Vertices on the
// near plane and on the guard band themselves are the hard ones, the stages decide about them in float and in double.
TEST(Clip, VerticesThatNeedNoClippingKeepTheirPlace) {
  Random random(46);
  int found = 0;
  for (int i = 0; i < 4000; ++i) {
    const double near_distance = random.Real(0.1, 3.0);
    const FrameView view = PerspectiveView(kWidth, kHeight, 60.0, near_distance);
    // Rotated about the viewing axis and about x, so that distances are sums of rounded products.
    const double angle = random.Real(0.1, 1.2), c = std::cos(angle), s = std::sin(angle);
    glm::dmat4 camera_from_mesh(1.0);
    camera_from_mesh[1] = {0.0, c, s, 0.0};
    camera_from_mesh[2] = {0.0, -s, c, 0.0};
    const glm::dmat3 inverse = glm::transpose(glm::dmat3(camera_from_mesh));
    const auto place = [&](double x, double y, double distance) {
      return glm::vec3(inverse * glm::dvec3(x, y, -distance));
    };
    Primitive primitive;
    if (i % 2 == 0) {  // an edge on the near plane
      primitive.positions = {place(random.Real(-0.5, 0.5) * near_distance, 0.3 * near_distance, near_distance),
                             place(random.Real(-0.5, 0.5) * near_distance, -0.3 * near_distance, near_distance),
                             place(random.Real(-2.0, 2.0), 0.0, -1.0)};
    } else {  // an edge on the guard band's right side
      const double d0 = random.Real(3.5, 9.0), d1 = random.Real(3.5, 9.0);
      primitive.positions = {place(d0 * kGuardBand / 60.0, 0.3, d0), place(d1 * kGuardBand / 60.0, -0.3, d1),
                             place(random.Real(-2.0, 2.0), 0.5, i % 4 == 1 ? -1.0 : 5.0)};
    }
    const FrameDrawable drawable = PlaceDrawable(view, primitive, camera_from_mesh, true);
    const Assembled out = Assemble(view, drawable, 8);
    if (out.chunk.records.empty()) continue;
    for (std::size_t v = 0; v < 2; ++v) {
      if ((out.vertices[v].outcode & kOutClip) != 0) continue;
      ++found;
      bool kept = false;
      for (const ScreenTriangle& r : out.chunk.records) {
        for (int k = 0; k < 3; ++k)
          kept = kept || (r.x_fx8[k] == out.vertices[v].x_fx8 && r.y_fx8[k] == out.vertices[v].y_fx8);
      }
      EXPECT_TRUE(kept) << "seed 46, triangle " << i << ", vertex " << v;
    }
  }
  EXPECT_GT(found, 500);
}

// The cut of an edge does not depend on the direction or on the other vertex.
TEST(ClipPolygon, SharedEdgesAreCutAtTheSamePoints) {
  Random random(47);
  const FrameView view = PerspectiveView(kWidth, kHeight, 60.0, 0.5, 9.0);
  int compared = 0;
  for (int i = 0; i < 3000; ++i) {
    const auto point = [&] {
      return glm::dvec3(random.Real(-3e5, 3e5), random.Real(-3e5, 3e5), random.Real(-5.0, 15.0));
    };
    const glm::dvec3 a = point(), b = point();
    const auto cuts = [&](const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& other) {
      ClipVertex v[kMaxClipVertices + 1] = {{p, 0}, {q, 1}, {other, 2}};
      std::vector<glm::dvec3> on_edge;
      const int count = ClipPolygon(view, kOutClip, v, 3);
      EXPECT_LE(count, kMaxClipVertices);
      for (int k = 0; k < count; ++k) {
        // Distance from the line through a and b.
        if (glm::length(glm::cross(v[k].position - a, glm::normalize(b - a))) < 1e-6) on_edge.push_back(v[k].position);
      }
      std::sort(on_edge.begin(), on_edge.end(), [](const auto& u, const auto& w) { return u.x < w.x; });
      return on_edge;
    };
    const auto one = cuts(a, b, point()), two = cuts(b, a, point());
    if (one.size() != 2 || two.size() != 2) continue;
    ++compared;
    for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(one[k], two[k]) << "seed 47, edge " << i;
  }
  EXPECT_GT(compared, 100);
}

// Everything that is left lies inside all planes, and the convex polygon's edges turn one way.
TEST(ClipPolygon, WhatIsLeftIsInside) {
  Random random(48);
  const FrameView view = PerspectiveView(kWidth, kHeight, 60.0, 0.5, 9.0);
  for (int i = 0; i < 3000; ++i) {
    const auto point = [&] {
      return glm::dvec3(random.Real(-3e5, 3e5), random.Real(-3e5, 3e5), random.Real(-5.0, 15.0));
    };
    ClipVertex v[kMaxClipVertices + 1] = {{point(), 0}, {point(), 1}, {point(), 2}};
    const int count = ClipPolygon(view, kOutClip, v, 3);
    for (int k = 0; k < count; ++k) {
      const glm::dvec3 p = v[k].position;
      EXPECT_GE(p.z, 0.5 * (1 - 1e-12)) << "seed 48, triangle " << i;
      EXPECT_LE(p.z, 9.0 * (1 + 1e-12)) << "seed 48, triangle " << i;
      EXPECT_LE(std::fabs(p.x / p.z - kWidth * 0.5), kGuardBand * (1 + 1e-9)) << "seed 48, triangle " << i;
      EXPECT_LE(std::fabs(p.y / p.z - kHeight * 0.5), kGuardBand * (1 + 1e-9)) << "seed 48, triangle " << i;
    }
  }
}

// Depth on clipped triangles is 1 / distance of the whole triangle's plane.
TEST(Clip, DepthOfPiecesIsThatOfTheWhole) {
  Random random(49);
  const FrameView view = PerspectiveView(kWidth, kHeight, 40.0, 0.5);
  int checked = 0;
  for (int i = 0; i < 200; ++i) {
    Primitive primitive;
    primitive.positions = {RandomPoint(random, 6.0, -4.0, 8.0), RandomPoint(random, 6.0, -4.0, 8.0),
                           RandomPoint(random, 6.0, -4.0, 8.0)};
    const FrameDrawable drawable = PlaceDrawable(view, primitive, glm::dmat4(1.0), true);
    const auto h = [&](int k) { return HomogeneousOf(drawable, primitive.positions[std::size_t(k)]); };
    const HomogeneousTriangle exact(h(0), h(1), h(2));
    const std::vector<ScreenTriangle> records = Assemble(view, drawable, 4).chunk.records;
    if (records.empty() || exact.Degenerate()) continue;
    const glm::dvec3 inverse = exact.Inverse();
    // Steep planes move with the snapping of their vertices.
    const double tolerance = (std::fabs(inverse.x) + std::fabs(inverse.y)) / 128.0 + 1e-6;
    TileBuffers tile = MakeTile(MakeTileGrid(kWidth, kHeight, 64), 0, 0, 4);
    RasterOpaque(Submission(records).All(), tile);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        for (int s = 0; s < 4; ++s) {
          const std::size_t k = tile.Index(x, y, s);
          if (tile.record[k] == kNoRecord) continue;
          const PointFx8 at = SampleAt(x, y, 4, s);
          if (exact.At(at.x / 256.0, at.y / 256.0, 0.5, view.far_distance, 0.5) != Answer::Inside) continue;
          ASSERT_NEAR(tile.depth[k], glm::dot(inverse, glm::dvec3(at.x / 256.0, at.y / 256.0, 1.0)), tolerance)
              << "seed 49, triangle " << i;
          ++checked;
        }
      }
    }
  }
  EXPECT_GT(checked, 10000);
}

}  // namespace
}  // namespace facet::test
