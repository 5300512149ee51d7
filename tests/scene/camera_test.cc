#include "scene/camera.h"

#include <gtest/gtest.h>

#include "facet/error.h"
#include "scene_helpers.h"

namespace facet {
namespace {

PosedScene PosedBox(const glm::dvec3& low, const glm::dvec3& high) {
  PosedScene posed;
  posed.bounds = {low, high, false};
  return posed;
}

// Largest |x| / tan and |y| / tan over the box's corners, as shares of the picture's half size; 1 touches the border.
glm::dvec2 Extent(const ResolvedCamera& camera, const Bounds& box) {
  const glm::dmat4 camera_from_world = glm::inverse(camera.world_from_camera);
  const double tan_y = std::tan(camera.lens.yfov / 2), tan_x = tan_y * *camera.lens.aspect;
  glm::dvec2 extent(0.0);
  for (int i = 0; i < 8; ++i) {
    const glm::dvec4 corner(i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y,
                            i & 4 ? box.high.z : box.low.z, 1);
    const glm::dvec4 p = camera_from_world * corner;
    EXPECT_LT(p.z, -camera.lens.znear) << "behind the near plane";
    extent.x = std::max(extent.x, std::fabs(p.x / (p.z * tan_x)));
    extent.y = std::max(extent.y, std::fabs(p.y / (p.z * tan_y)));
  }
  return extent;
}

void ExpectRigid(const glm::dmat4& m) {
  const glm::dmat3 axes(m);
  const glm::dmat3 product = glm::transpose(axes) * axes;
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) EXPECT_NEAR(product[c][r], c == r ? 1.0 : 0.0, 1e-14);
  }
  EXPECT_NEAR(glm::determinant(axes), 1.0, 1e-14);
}

ErrorCode CodeOf(const CameraChoice& choice, const Scene& scene = {}, const PosedScene& posed = {}) {
  try {
    ResolveCamera(choice, scene, posed, 10, 10);
  } catch (const Error& error) {
    return error.code();
  }
  ADD_FAILURE() << "accepted";
  return ErrorCode::Internal;
}

TEST(Camera, FramesBoxesTightlyInEveryAspect) {
  const glm::dvec3 sizes[] = {{1, 1, 1},          {100, 1, 1}, {1, 100, 1}, {1, 1, 100},
                              {1e-6, 2e-6, 1e-6}, {0, 3, 0},   {5, 0, 2}};
  for (const glm::dvec3& size : sizes) {
    const PosedScene posed = PosedBox(glm::dvec3(7, -3, 2) - size / 2.0, glm::dvec3(7, -3, 2) + size / 2.0);
    for (const auto& [width, height] : {std::pair(100, 100), std::pair(400, 100), std::pair(100, 300)}) {
      const ResolvedCamera automatic = ResolveCamera(AutoCamera{}, {}, posed, width, height);
      const glm::dvec2 extent = Extent(automatic, posed.bounds);
      EXPECT_LE(std::max(extent.x, extent.y), 1.0 / 1.0499);
      EXPECT_GT(automatic.world_from_camera[3].y, -3.0) << "from above";
      EXPECT_GT(automatic.world_from_camera[3].z, 2.0) << "from the front";
    }
  }
}

double DistanceFrom(const ResolvedCamera& camera, const glm::dvec3& target) {
  return glm::length(glm::dvec3(camera.world_from_camera[3]) - target);
}

// Its ball just fits: the margin is 5 % of the ball's radius on the narrower side, from wherever it is seen.
TEST(Camera, AnOrbitWithoutRadiusKeepsItsDistance) {
  const glm::dvec3 centre(7, -3, 2), half(3, 1, 0.5);
  const PosedScene posed = PosedBox(centre - half, centre + half);
  for (const auto& [width, height] : {std::pair(100, 100), std::pair(400, 100), std::pair(100, 300)}) {
    const double tan_y = std::tan(0.5 * 45.0 * kTestPi / 180.0), narrow = tan_y * std::min(1.0, double(width) / height);
    const double expected = 1.05 * glm::length(half) / std::sin(std::atan(narrow));
    for (const double phi : {0.0, 0.5, 1.5, kTestPi / 2, 3.0}) {
      for (const double theta : {0.0, 1.0, 4.0}) {
        const ResolvedCamera camera = ResolveCamera(OrbitCamera{theta, phi, {}, {}, {}}, {}, posed, width, height);
        ExpectRigid(camera.world_from_camera);
        EXPECT_NEAR(DistanceFrom(camera, centre), expected, 1e-12 * expected);
        EXPECT_NEAR(camera.target_distance, expected, 1e-12 * expected) << "as far as it says";
        EXPECT_EQ(*camera.lens.aspect, double(width) / height);
        const glm::dvec2 extent = Extent(camera, posed.bounds);
        EXPECT_LE(std::max(extent.x, extent.y), 1.0 / 1.04);
      }
    }
  }
}

// A square that moves from the origin to x = 10 and back to x = 4.
Scene MovingSquare() {
  Primitive square;
  square.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  square.indices = {0, 1, 2, 0, 2, 3};
  Scene scene = SceneOf(square);
  Animation animation;
  animation.channels.push_back(
      {0, AnimationPath::Translation, Interpolation::Linear, {1.0f, 2.0f, 3.0f}, {0, 0, 0, 10, 0, 0, 4, 0, 0}});
  scene.animations.push_back(animation);
  return scene;
}

TEST(Camera, AnOrbitWithoutRadiusKeepsItsDistanceOverTime) {
  const Scene scene = MovingSquare();
  std::vector<glm::dmat4> places;
  for (const double time : {0.0, 1.0, 1.3, 2.0, 2.9, 7.0}) {
    PoseSettings pose;
    pose.animation = 0;
    pose.time = time;
    const PosedScene posed = Pose(scene, pose);
    places.push_back(ResolveCamera(OrbitCamera{0.3, 1.2, {}, {}, {}}, scene, posed, 64, 64).world_from_camera);
    EXPECT_EQ(places.back(), places.front()) << time;
    // All of the way fits: the ball is around (5, 0, 0), and reaches the corners at (11, 1, 0).
    KnownBall known;
    const glm::dvec3 target(1, 0, 0);
    const ResolvedCamera about = ResolveCamera(OrbitCamera{0.3, 1.2, {}, target, {}}, scene, posed, 64, 64, &known);
    EXPECT_NEAR(known.ball->radius, std::sqrt(101.0), 1e-12);
    EXPECT_EQ(ResolveCamera(OrbitCamera{0.3, 1.2, {}, target, {}}, scene, posed, 64, 64, &known).world_from_camera,
              about.world_from_camera);
  }
  const glm::dvec3 eye(places[0][3]), back(places[0][2]);
  const double distance = glm::dot(eye - glm::dvec3(5, 0, 0), back);
  EXPECT_LT(Distance(eye - distance * back, glm::dvec3(5, 0, 0)), 1e-12) << "looks at the middle of all poses";
  EXPECT_NEAR(distance, 1.05 * std::sqrt(37.0) / std::sin(kTestPi / 8.0), 1e-9);
}

TEST(Camera, OrbitsByTheFormula) {
  const double theta = 0.7, phi = 1.1, radius = 3.0;
  const glm::dvec3 target(1, 2, 3);
  const ResolvedCamera camera =
      ResolveCamera(OrbitCamera{theta, phi, radius, target, 0.5}, {}, PosedBox({0, 0, 0}, {1, 1, 1}), 8, 4);
  const glm::dvec3 eye = target + radius * glm::dvec3(std::sin(phi) * std::sin(theta), std::cos(phi),
                                                      std::sin(phi) * std::cos(theta));
  EXPECT_LT(Distance(glm::dvec3(camera.world_from_camera[3]), eye), 1e-14);
  EXPECT_LT(Distance(glm::dvec3(camera.world_from_camera[2]), (eye - target) / radius), 1e-14) << "looks along -Z";
  EXPECT_GT(camera.world_from_camera[1].y, 0.0) << "+Y up";
  EXPECT_EQ(camera.world_from_camera[0].y, 0.0) << "level";
  ExpectRigid(camera.world_from_camera);
  EXPECT_EQ(camera.lens.yfov, 0.5);
  EXPECT_LT(camera.lens.znear, 1e-4);
  EXPECT_FALSE(std::isfinite(camera.lens.zfar));
}

TEST(Camera, VerticalViewsAreTheLimitsOfTiltedOnes) {
  const PosedScene posed = PosedBox({-1, -1, -1}, {1, 1, 1});
  for (const double theta : {0.0, 1.0, 3.0}) {
    for (const double phi : {0.0, kTestPi}) {
      const double tilt = phi == 0.0 ? 1e-7 : kTestPi - 1e-7;
      const glm::dmat4 at = ResolveCamera(OrbitCamera{theta, phi, 5.0, {}, {}}, {}, posed, 1, 1).world_from_camera;
      const glm::dmat4 by = ResolveCamera(OrbitCamera{theta, tilt, 5.0, {}, {}}, {}, posed, 1, 1).world_from_camera;
      for (int c = 0; c < 4; ++c) EXPECT_LT(glm::length(at[c] - by[c]), 1e-6);
    }
  }
  const glm::dmat4 top = ResolveCamera(OrbitCamera{0.0, 0.0, 5.0, {}, {}}, {}, posed, 1, 1).world_from_camera;
  EXPECT_EQ(glm::dvec3(top[1]), glm::dvec3(0, 0, -1));
}

TEST(Camera, RadiusThatIsNotPositiveFrames) {
  const PosedScene posed = PosedBox({-1, -1, -1}, {1, 1, 1});
  const ResolvedCamera framed = ResolveCamera(OrbitCamera{0.1, 1.0, {}, {}, {}}, {}, posed, 1, 1);
  const ResolvedCamera zero = ResolveCamera(OrbitCamera{0.1, 1.0, 0.0, {}, {}}, {}, posed, 1, 1);
  EXPECT_EQ(framed.world_from_camera, zero.world_from_camera);
}

TEST(Camera, EmptyBoundsHaveACamera) {
  const ResolvedCamera camera = ResolveCamera(AutoCamera{}, {}, PosedScene{}, 10, 10);
  ExpectRigid(camera.world_from_camera);
  EXPECT_GT(camera.lens.znear, 0.0);
}

TEST(Camera, OfTheScene) {
  Scene scene;
  scene.cameras.resize(3);
  scene.cameras[1].yfov = 0.9;
  scene.cameras[1].aspect = 2.0;
  scene.cameras[1].znear = 0.5;
  scene.cameras[1].zfar = 70.0;
  scene.cameras[2].orthographic = true;
  scene.cameras[2].xmag = 3.0;
  scene.cameras[2].ymag = -2.0;
  scene.nodes.resize(2);
  scene.nodes[0].camera = 1;
  scene.nodes[0].transform = {{1, 2, 3}, RotationAbout({0, 1, 0}, kTestPi / 2), {-2, 3, 0.5}};
  scene.nodes[1].camera = 2;
  const PosedScene posed = Pose(scene, {});
  const ResolvedCamera camera = ResolveCamera(SceneCamera{1}, scene, posed, 300, 100);
  ExpectRigid(camera.world_from_camera);
  EXPECT_LT(Distance(glm::dvec3(camera.world_from_camera[2]), {1, 0, 0}), 1e-15) << "looks along -X";
  EXPECT_EQ(glm::dvec3(camera.world_from_camera[3]), glm::dvec3(1, 2, 3));
  EXPECT_EQ(camera.lens.yfov, 0.9);
  EXPECT_EQ(*camera.lens.aspect, 3.0) << "the picture's";
  EXPECT_EQ(camera.lens.znear, 0.5);
  EXPECT_EQ(camera.lens.zfar, 70.0);
  const ResolvedCamera flat = ResolveCamera(SceneCamera{2}, scene, posed, 300, 100);
  EXPECT_EQ(flat.lens.ymag, 2.0);
  EXPECT_EQ(flat.lens.xmag, 6.0);
  EXPECT_EQ(CodeOf(SceneCamera{0}, scene, posed), ErrorCode::InvalidUsage) << "no node holds it";
  EXPECT_EQ(CodeOf(SceneCamera{3}, scene, posed), ErrorCode::InvalidUsage);
  EXPECT_EQ(CodeOf(SceneCamera{-1}, scene, posed), ErrorCode::InvalidUsage);
  scene.nodes[0].visible = false;
  const ResolvedCamera hidden = ResolveCamera(SceneCamera{1}, scene, Pose(scene, {}), 300, 100);
  EXPECT_EQ(hidden.world_from_camera, camera.world_from_camera) << "visibility is none of its concern";
}

TEST(Camera, RefusesNumbersOutOfRange) {
  EXPECT_EQ(CodeOf(AutoCamera{0.0}), ErrorCode::InvalidUsage);
  EXPECT_EQ(CodeOf(AutoCamera{3.2}), ErrorCode::InvalidUsage);
  EXPECT_EQ(CodeOf(OrbitCamera{std::nan(""), 1.0, {}, {}, {}}), ErrorCode::InvalidUsage);
  EXPECT_EQ(CodeOf(OrbitCamera{0.0, 1.0, std::nan(""), {}, {}}), ErrorCode::InvalidUsage);
  FreeCamera free;
  free.lens.znear = 0.0;
  EXPECT_EQ(CodeOf(free), ErrorCode::InvalidUsage);
  free.lens.znear = 0.1;
  EXPECT_EQ(*ResolveCamera(free, {}, {}, 20, 10).lens.aspect, 2.0);
  free.lens.aspect = -1.5;
  EXPECT_EQ(CodeOf(free), ErrorCode::InvalidUsage);
  free.lens.orthographic = true;
  free.lens.xmag = 0.0;
  EXPECT_EQ(CodeOf(free), ErrorCode::InvalidUsage);
}

// A scene with one camera of this lens, chosen both ways.
std::vector<Camera> Fitted(const Camera& lens, int width, int height) {
  Scene scene;
  scene.cameras.push_back(lens);
  scene.nodes.resize(1);
  scene.nodes[0].camera = 0;
  FreeCamera free;
  free.lens = lens;
  return {ResolveCamera(SceneCamera{0}, scene, Pose(scene, {}), width, height).lens,
          ResolveCamera(free, {}, {}, width, height).lens};
}

TEST(Camera, PerspectiveLensesAreNeverCropped) {
  Camera lens;
  lens.yfov = 0.8;
  lens.aspect = 1.5;
  const double tan_y = std::tan(0.4);
  for (const Camera& wide : Fitted(lens, 300, 100)) {
    EXPECT_EQ(wide.yfov, 0.8) << "more to the sides";
    EXPECT_EQ(*wide.aspect, 3.0);
  }
  for (const Camera& same : Fitted(lens, 150, 100)) EXPECT_EQ(same.yfov, 0.8);
  for (const int width : {1, 20, 100, 149}) {
    for (const Camera& narrow : Fitted(lens, width, 100)) {
      const double aspect = width / 100.0;
      EXPECT_EQ(*narrow.aspect, aspect);
      EXPECT_NEAR(std::tan(narrow.yfov / 2) * aspect / (tan_y * 1.5), 1.0, 1e-13) << "the horizontal field is kept";
      EXPECT_GT(narrow.yfov, 0.8);
      EXPECT_LT(narrow.yfov, kTestPi);
    }
  }
  lens.aspect.reset();
  for (const Camera& any : Fitted(lens, 20, 100)) EXPECT_EQ(any.yfov, 0.8) << "it has the shape of the picture";
}

TEST(Camera, OrthographicLensesAreNeverCropped) {
  Camera lens;
  lens.orthographic = true;
  lens.zfar = 10.0;
  for (const double sign_x : {1.0, -1.0}) {
    for (const double sign_y : {1.0, -1.0}) {
      lens.xmag = 3.0 * sign_x;
      lens.ymag = 2.0 * sign_y;
      for (const Camera& wide : Fitted(lens, 300, 100)) {
        EXPECT_EQ(wide.ymag, 2.0);
        EXPECT_EQ(wide.xmag, 6.0);
      }
      for (const Camera& same : Fitted(lens, 150, 100)) {
        EXPECT_EQ(same.ymag, 2.0);
        EXPECT_EQ(same.xmag, 3.0);
      }
      for (const Camera& narrow : Fitted(lens, 50, 100)) {
        EXPECT_EQ(narrow.xmag, 3.0);
        EXPECT_EQ(narrow.ymag, 6.0);
      }
    }
  }
}

TEST(Camera, FreeCamerasMustBeRigid) {
  const glm::dmat4 turn =
      glm::dmat4(glm::mat3_cast(RotationAbout(glm::normalize(glm::dvec3(1, 2, 3)), 1.2)));
  const auto with = [&](int column, int row, double change) {
    FreeCamera free;
    free.world_from_camera = turn;
    free.world_from_camera[3] = {1e6, -2, 3, 1};
    free.world_from_camera[column][row] += change;
    return free;
  };
  const FreeCamera rigid = with(0, 0, 0.0);
  EXPECT_EQ(ResolveCamera(rigid, {}, {}, 10, 10).world_from_camera, rigid.world_from_camera);
  // What was rounded to float is still rigid.
  FreeCamera rounded = rigid;
  rounded.world_from_camera = glm::dmat4(glm::mat4(rigid.world_from_camera));
  EXPECT_NO_THROW(ResolveCamera(rounded, {}, {}, 10, 10));
  for (int column = 0; column < 4; ++column) {
    EXPECT_EQ(CodeOf(with(column, 3, 0.5)), ErrorCode::InvalidUsage) << "projective";
    for (int row = 0; row < 4; ++row) {
      EXPECT_EQ(CodeOf(with(column, row, std::nan(""))), ErrorCode::InvalidUsage) << column << row;
      if (column < 3 && row < 3) {
        EXPECT_EQ(CodeOf(with(column, row, 1e-3)), ErrorCode::InvalidUsage) << column << row;
      }
    }
  }
  FreeCamera scaled = rigid, mirrored = rigid, zero = rigid;
  for (int c = 0; c < 3; ++c) scaled.world_from_camera[c] *= 2.0;
  EXPECT_EQ(CodeOf(scaled), ErrorCode::InvalidUsage);
  mirrored.world_from_camera[0] *= -1.0;
  EXPECT_EQ(CodeOf(mirrored), ErrorCode::InvalidUsage);
  zero.world_from_camera = glm::dmat4(0.0);
  EXPECT_EQ(CodeOf(zero), ErrorCode::InvalidUsage);
}

}  // namespace
}  // namespace facet
