// Vertices on the screen, from the camera and the drawable on, against plain double arithmetic.
#include <gtest/gtest.h>

#include <cmath>

#include "clip/geometry_helpers.h"
#include "raster/raster_helpers.h"
#include "render/frame_view.h"
#include "vertex/outside_view.h"

namespace facet::test {
namespace {

struct Shot {
  ResolvedCamera camera;
  Primitive mesh;
  Drawable drawable;
  int width = 0, height = 0;
};

// Multiples of 2^-20, so that sums with 2^20 are exact.
double Dyadic(Random& random, double low, double high) { return std::round(random.Real(low, high) * 0x1p20) * 0x1p-20; }

glm::dmat3 RandomRotation(Random& random) {
  const auto direction = [&] { return glm::dvec3(random.Real(-1, 1), random.Real(-1, 1), random.Real(-1, 1)); };
  const glm::dvec3 z = glm::normalize(direction() + glm::dvec3(0.0, 0.0, 1e-3));
  const glm::dvec3 x = glm::normalize(glm::cross(direction() + glm::dvec3(1e-3, 2e-3, 0.0), z));
  return {x, glm::cross(z, x), z};
}

// A mesh of about two units in front of a camera some units away.
Shot RandomShot(Random& random, bool orthographic, const glm::dvec3& mesh_centre = glm::dvec3(0.0)) {
  Shot s;
  s.width = random.Int(100, 4096), s.height = random.Int(100, 4096);
  const glm::dmat3 axes = RandomRotation(random);
  s.camera.world_from_camera = glm::dmat4(axes);
  const glm::dvec3 target(Dyadic(random, -9, 9), Dyadic(random, -9, 9), Dyadic(random, -9, 9));
  glm::dvec3 eye = target + axes[2] * random.Real(3.0, 8.0);
  for (int k = 0; k < 3; ++k) eye[k] = std::round(eye[k] * 0x1p20) * 0x1p-20;
  s.camera.world_from_camera[3] = glm::dvec4(eye, 1.0);
  s.camera.lens.orthographic = orthographic;
  s.camera.lens.yfov = random.Real(0.3, 1.5);
  s.camera.lens.xmag = random.Real(1.0, 3.0), s.camera.lens.ymag = random.Real(1.0, 3.0);
  s.camera.lens.aspect = static_cast<double>(s.width) / s.height;
  s.camera.lens.znear = 0.1;
  const glm::dmat3 linear = RandomRotation(random) * random.Real(0.4, 0.8);
  s.drawable.world_from_mesh = glm::dmat4(linear);
  const glm::dvec3 origin = target - linear * mesh_centre;
  s.drawable.world_from_mesh[3] = glm::dvec4(origin, 1.0);
  for (int i = 0; i < 101; ++i) {
    s.mesh.positions.push_back(
        glm::vec3(mesh_centre + glm::dvec3(random.Real(-1, 1), random.Real(-1, 1), random.Real(-1, 1))));
  }
  return s;
}

VertexBuffer Transform(Shot& s) {
  s.drawable.geometry = &s.mesh;
  const FrameView view = MakeFrameView(s.camera, s.width, s.height);
  const FrameDrawable drawable = MakeFrameDrawable(view, s.drawable);
  return Assemble(view, drawable, 1).vertices;
}

struct Expected {
  double x, y, distance;  // pixels, units
};

Expected Project(const Shot& s, const glm::vec3& position) {
  const glm::dmat4& m = s.drawable.world_from_mesh;
  const glm::dmat4& c = s.camera.world_from_camera;
  glm::dvec3 world(0.0), camera(0.0);
  for (int row = 0; row < 3; ++row) {
    world[row] = m[0][row] * double{position.x} + m[1][row] * double{position.y} + m[2][row] * double{position.z} +
                 (m[3][row] - c[3][row]);
  }
  for (int axis = 0; axis < 3; ++axis)
    camera[axis] = c[axis][0] * world.x + c[axis][1] * world.y + c[axis][2] * world.z;
  const Camera& lens = s.camera.lens;
  if (lens.orthographic) {
    return {(camera.x / lens.xmag + 1.0) * 0.5 * s.width, (1.0 - camera.y / lens.ymag) * 0.5 * s.height, -camera.z};
  }
  const double half_height = std::tan(lens.yfov / 2) * -camera.z, half_width = half_height * s.width / s.height;
  return {(camera.x / half_width + 1.0) * 0.5 * s.width, (1.0 - camera.y / half_height) * 0.5 * s.height, -camera.z};
}

void ExpectAccurate(Shot& s) {
  const VertexBuffer out = Transform(s);
  int seen = 0;
  for (std::size_t i = 0; i < s.mesh.positions.size(); ++i) {
    const Expected want = Project(s, s.mesh.positions[i]);
    if (want.x < 0 || want.x > s.width || want.y < 0 || want.y > s.height || want.distance < 0.2) continue;
    // Half a unit of the grid for the snapping, and half for float.
    EXPECT_NEAR(out[i].x_fx8 / 256.0, want.x, 1.0 / 256) << "vertex " << i;
    EXPECT_NEAR(out[i].y_fx8 / 256.0, want.y, 1.0 / 256) << "vertex " << i;
    const double depth = s.camera.lens.orthographic ? -want.distance : 1.0 / want.distance;
    EXPECT_NEAR(out[i].depth, depth, std::fabs(depth) * 0x1p-20) << "vertex " << i;
    EXPECT_EQ(out[i].outcode, 0) << "vertex " << i;
    ++seen;
  }
  EXPECT_GT(seen, 10) << "the picture shows nothing";
}

TEST(Vertex, WithinAGridUnitOfDouble) {
  for (std::uint64_t seed = 81; seed < 141; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Shot s = RandomShot(random, seed % 3 == 0);
    ExpectAccurate(s);
  }
}

// Scenes far from the origin: the same grid positions as near it, to the last bit where the translation is exact.
TEST(Vertex, FarScenesLookTheSame) {
  for (std::uint64_t seed = 141; seed < 181; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Shot s = RandomShot(random, seed % 3 == 0);
    const VertexBuffer near_origin = Transform(s);
    Shot exact = s;
    for (glm::dmat4* m : {&exact.camera.world_from_camera, &exact.drawable.world_from_mesh})
      (*m)[3] += glm::dvec4(0x1p20, -0x1p21, 0x1p20, 0.0);
    const VertexBuffer far = Transform(exact);
    for (std::size_t i = 0; i < far.size(); ++i) {
      EXPECT_EQ(near_origin[i].x_fx8, far[i].x_fx8) << "vertex " << i;
      EXPECT_EQ(near_origin[i].y_fx8, far[i].y_fx8) << "vertex " << i;
      EXPECT_EQ(near_origin[i].depth, far[i].depth) << "vertex " << i;
    }
    Shot rounded = s;
    for (glm::dmat4* m : {&rounded.camera.world_from_camera, &rounded.drawable.world_from_mesh})
      (*m)[3] += glm::dvec4(1e6, 1e6 / 3, -1e6, 0.0);
    ExpectAccurate(rounded);
  }
}

// Meshes whose own coordinates are near a million, where float has steps of 1/16.
TEST(Vertex, FarMeshCoordinatesKeepTheirPlace) {
  for (std::uint64_t seed = 181; seed < 221; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Shot s = RandomShot(random, seed % 3 == 0, {1e6, -7e5, 9e5});
    ExpectAccurate(s);
  }
}

TEST(Vertex, OneBadVertexLeavesTheOthersInPlace) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                          -std::numeric_limits<float>::infinity()}) {
    for (const std::size_t which : {0, 1, 50, 100}) {
      Random random(221);
      Shot s = RandomShot(random, false);
      const VertexBuffer before = Transform(s);
      s.mesh.positions[which].y = bad;
      const VertexBuffer after = Transform(s);
      int moved = 0;
      for (std::size_t i = 0; i < s.mesh.positions.size(); ++i) {
        if (i == which) {
          EXPECT_NE(after[i].outcode & kOutNotFinite, 0);
          continue;
        }
        moved += after[i].outcode != before[i].outcode || std::abs(after[i].x_fx8 - before[i].x_fx8) > 1 ||
                 std::abs(after[i].y_fx8 - before[i].y_fx8) > 1;
      }
      EXPECT_EQ(moved, 0) << "others are moved by " << bad << " at " << which;
    }
  }
}

TEST(Vertex, OutcodesNameThePlanes) {
  Random random(222);
  const FrameView view = PerspectiveView(200, 100, 150.0, 0.5, 50.0);
  Primitive mesh;
  for (int i = 0; i < 4000; ++i) {
    const double reach = i % 2 == 0 ? 10.0 : 6000.0;
    mesh.positions.push_back(
        glm::vec3(glm::dvec3(random.Real(-reach, reach), random.Real(-reach, reach), random.Real(-70, 10))));
  }
  const FrameDrawable drawable = PlaceDrawable(view, mesh);
  const VertexBuffer out = Assemble(view, drawable, 1).vertices;
  std::int32_t seen = 0;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const double d = -double{mesh.positions[i].z}, x = 150.0 * mesh.positions[i].x + 100.0 * d,
                 y = -150.0 * mesh.positions[i].y + 50.0 * d;
    const double slack = 1e-5 * (std::fabs(x) + std::fabs(y) + kGuardBand * std::fabs(d));
    const auto check = [&](double inside, OutcodeBit bit, double epsilon) {
      if (std::fabs(inside) < epsilon) return;
      EXPECT_EQ((out[i].outcode & bit) != 0, inside < 0) << "seed 222, vertex " << i << ", bit " << bit;
    };
    check(d - 0.5, kOutNear, 1e-5);
    check(50.0 - d, kOutFar, 1e-4);
    check(x + (kGuardBand - 100.0) * d, kOutGuardLeft, slack);
    check((kGuardBand + 100.0) * d - x, kOutGuardRight, slack);
    check(y + (kGuardBand - 50.0) * d, kOutGuardTop, slack);
    check((kGuardBand + 50.0) * d - y, kOutGuardBottom, slack);
    check(x, kOutLeft, slack);
    check(200.0 * d - x, kOutRight, slack);
    check(y, kOutTop, slack);
    check(100.0 * d - y, kOutBottom, slack);
    seen |= out[i].outcode;
  }
  EXPECT_EQ(seen, 1023) << "not all planes were tried";
}

// Any target, any range, any place in the buffer: the same bits, and nothing else is touched.
TEST(Vertex, TargetsAndRangesAgree) {
  Random random(223);
  Shot s = RandomShot(random, false);
  s.mesh.positions[17] = {3e38f, -3e38f, 1.0f};
  s.mesh.positions[60].x = std::numeric_limits<float>::quiet_NaN();
  const VertexBuffer reference = Transform(s);
  const FrameView view = MakeFrameView(s.camera, s.width, s.height);
  FrameDrawable drawable = MakeFrameDrawable(view, s.drawable);
  drawable.vertex_base = 13;
  const std::size_t n = s.mesh.positions.size();
  for (const Target target : AvailableTargets()) {
    const ScopedTarget scoped(target);
    for (const auto& [begin, end] :
         {std::pair<std::size_t, std::size_t>{0, n}, {0, 1}, {5, 6}, {3, 20}, {n - 1, n}, {50, 50}}) {
      VertexBuffer out;
      ScreenVertex untouched;
      untouched.x_fx8 = untouched.y_fx8 = untouched.outcode = -77, untouched.depth = -77.0f;
      out.assign(n + 40, untouched);
      TransformVertices(view, drawable, begin, end, out);
      for (std::size_t i = 0; i < n + 40; ++i) {
        const bool inside = i >= 13 + begin && i < 13 + end;
        EXPECT_EQ(out[i].x_fx8, inside ? reference[i - 13].x_fx8 : -77) << TargetName(target) << " " << i;
        EXPECT_EQ(out[i].y_fx8, inside ? reference[i - 13].y_fx8 : -77) << TargetName(target) << " " << i;
        EXPECT_EQ(out[i].outcode, inside ? reference[i - 13].outcode : -77) << TargetName(target) << " " << i;
        const float want = inside ? reference[i - 13].depth : -77.0f;
        EXPECT_TRUE(out[i].depth == want || (std::isnan(out[i].depth) && std::isnan(want)))
            << TargetName(target) << " " << i;
      }
    }
  }
}

// What is left out as a whole is what the vertex stage finds beyond one side, vertex by vertex; and nearly all of that is.
TEST(OutsideView, AgreesWithTheVertices) {
  Random random(223);
  int outside = 0, missed = 0;
  for (int round = 0; round < 2000; ++round) {
    SCOPED_TRACE("seed 223, round " + std::to_string(round));
    Shot s = RandomShot(random, round % 3 == 0);
    s.camera.lens.zfar = round % 4 == 0 ? random.Real(2.0, 20.0) : s.camera.lens.zfar;
    const double far = round % 5 == 0 ? 1e6 : 0.0;
    const glm::dvec3 move(random.Real(-9, 9), random.Real(-9, 9), random.Real(-9, 9));
    s.drawable.world_from_mesh[3] += glm::dvec4(move + far, 0.0);
    s.camera.world_from_camera[3] += glm::dvec4(glm::dvec3(far), 0.0);
    // The corners of the box are vertices.
    const glm::vec3 centre(random.Real(-1, 1), random.Real(-1, 1), random.Real(-1, 1));
    const glm::vec3 half(random.Real(0, 1), random.Real(0, 1), random.Real(0, 1));
    Bounds box;
    s.mesh.positions.clear();
    for (int i = 0; i < 40; ++i) {
      const auto part = [&](int bit) { return i < 8 ? (i & bit ? 1.0 : -1.0) : random.Real(-1, 1); };
      const glm::vec3 p = centre + half * glm::vec3(part(1), part(2), part(4));
      s.mesh.positions.push_back(p);
      box.low = box.empty ? glm::dvec3(p) : glm::min(box.low, glm::dvec3(p));
      box.high = box.empty ? glm::dvec3(p) : glm::max(box.high, glm::dvec3(p));
      box.empty = false;
    }
    std::int32_t common = kOutReject;
    for (const ScreenVertex& v : Transform(s)) common &= v.outcode;
    s.drawable.geometry = &s.mesh;
    const FrameView view = MakeFrameView(s.camera, s.width, s.height);
    const bool culled = OutsideView(view, MakeFrameDrawable(view, s.drawable), box);
    if (culled) {
      EXPECT_NE(common & (kOutNear | kOutFar | kOutLeft | kOutRight | kOutTop | kOutBottom), 0);
    }
    outside += culled;
    missed += !culled && common != 0;
  }
  EXPECT_GT(outside, 300) << "the test shows nothing";
  EXPECT_LT(missed, 10);
}

TEST(FrameView, DirectionThroughAPixelIsWhereItsPointsLie) {
  for (std::uint64_t seed = 231; seed < 251; ++seed) {
    Random random(seed);
    const Shot s = RandomShot(random, seed % 4 == 0);
    const FrameView view = MakeFrameView(s.camera, s.width, s.height);
    for (const glm::vec3& p : s.mesh.positions) {
      const Expected at = Project(s, p);
      const glm::dvec3 direction = glm::normalize(DirectionThrough(view, at.x, at.y));
      const glm::dvec3 eye(s.camera.world_from_camera[3]), world(s.drawable.world_from_mesh * glm::dvec4(p, 1.0));
      const glm::dvec3 want =
          s.camera.lens.orthographic ? -glm::dvec3(s.camera.world_from_camera[2]) : glm::normalize(world - eye);
      EXPECT_LT(glm::length(direction - want), 1e-9) << "seed " << seed;
    }
  }
}

// Normals stay perpendicular to the surface and on its outer side, also where a transform mirrors or flattens it.
TEST(FrameDrawable, NormalsFollowTheSurface) {
  Random random(251);
  const Shot s = RandomShot(random, false);
  const FrameView view = MakeFrameView(s.camera, 64, 64);
  for (int i = 0; i < 300; ++i) {
    Drawable drawable;
    drawable.geometry = &s.mesh;
    glm::dmat3 scale(0.0);
    for (int k = 0; k < 3; ++k) scale[k][k] = random.Real(0.2, 2.0) * (random.Int(0, 1) == 0 ? 1 : -1);
    const bool flat = i % 5 == 0;
    if (flat) scale[2][2] = 0.0;
    const glm::dmat3 linear = RandomRotation(random) * scale * RandomRotation(random);
    drawable.world_from_mesh = glm::dmat4(linear);
    const FrameDrawable out = MakeFrameDrawable(view, drawable);
    const glm::dmat3 surface = RandomRotation(random);  // two tangents and the normal
    const glm::dvec3 n = out.normal_from_mesh * surface[2];
    EXPECT_NEAR(glm::dot(n, linear * surface[0]), 0.0, 1e-9) << "seed 251, transform " << i;
    EXPECT_NEAR(glm::dot(n, linear * surface[1]), 0.0, 1e-9) << "seed 251, transform " << i;
    if (flat) continue;
    EXPECT_EQ(out.mirrored, glm::determinant(linear) < 0.0);
    EXPECT_GT(glm::dot(n, linear * surface[2]), 0.0) << "seed 251, transform " << i;
  }
}

}  // namespace
}  // namespace facet::test
