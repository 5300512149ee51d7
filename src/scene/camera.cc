#include "scene/camera.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include "facet/error.h"
#include "math/elementary.h"
#include "scene/framing.h"

namespace facet {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;
constexpr double kFieldOfView = 45.0 * kDegree;
constexpr double kMargin = 1.05;        // the size of the framed area, relative to the bounds
constexpr double kNearFraction = 1e-5;  // of the distance or of the bounds, whichever is larger

[[noreturn]] void Fail(const std::string& message, const std::string& hint = {}) {
  throw Error(ErrorCode::InvalidUsage, message, "camera", hint);
}

void CheckFieldOfView(double yfov) {
  if (!(yfov > 0.0 && yfov < kPi)) Fail("the vertical field of view must lie between 0 and 180 degrees");
}

void CheckFinite(const glm::dvec3& v, const char* what) {
  if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) Fail(std::string(what) + " is not finite");
}

glm::dmat4 PlaceAt(const glm::dvec3& eye, const CameraAxes& axes) {
  return glm::dmat4(glm::dvec4(axes.right, 0.0), glm::dvec4(axes.up, 0.0), glm::dvec4(axes.back, 0.0),
                    glm::dvec4(eye, 1.0));
}

// `back` is the direction from the target to the eye; `up` its derivative by -phi. Unlike a cross product with +Y this
// has a limit where the view is vertical.
CameraAxes OrbitAxes(double theta, double phi) {
  const double sin_theta = Sin(theta), cos_theta = Cos(theta), sin_phi = Sin(phi), cos_phi = Cos(phi);
  CameraAxes axes;
  axes.back = {sin_phi * sin_theta, cos_phi, sin_phi * cos_theta};
  axes.up = {-cos_phi * sin_theta, sin_phi, -cos_phi * cos_theta};
  axes.right = {cos_theta, 0.0, -sin_theta};
  if (sin_phi < 0.0) {  // past a pole: keep +Y up
    axes.up = -axes.up;
    axes.right = -axes.right;
  }
  return axes;
}

// The position of the eye relative to the target from which everything is visible.
struct Framing {
  double distance, right, up;
};

// The eye may move sideways, so that the margins on opposite sides of the image are equal.
Framing FrameAll(const PosedScene& posed, const glm::dvec3& target, const CameraAxes& axes, double tan_x,
                 double tan_y) {
  const double tx = tan_x / kMargin, ty = tan_y / kMargin;
  const ViewExtent seen = MeasureView(posed, target, axes, tx, ty);
  Framing framing = {std::max((seen.right + seen.left) / (2.0 * tx), (seen.top + seen.bottom) / (2.0 * ty)),
                     (seen.right - seen.left) / 2.0, (seen.top - seen.bottom) / 2.0};
  // Otherwise the eye would be at the end of a line that is seen end on, or at a single point.
  const double size = posed.bounds.empty ? 1.0 : glm::length(posed.bounds.high - posed.bounds.low);
  framing.distance = std::max(framing.distance, seen.nearest + 1e-3 * size);
  if (!(framing.distance > 0.0)) framing.distance = 1.0;
  return framing;
}

ResolvedCamera PlaceOrbit(const OrbitCamera& orbit, const PosedScene& posed, const CameraAxes& axes,
                          const glm::dvec3& target, const Framing& framing, double aspect) {
  ResolvedCamera camera;
  camera.world_from_camera =
      PlaceAt(target + framing.distance * axes.back + framing.right * axes.right + framing.up * axes.up, axes);
  camera.lens.yfov = orbit.yfov.value_or(kFieldOfView);
  camera.lens.aspect = aspect;
  const double size = posed.bounds.empty ? std::sqrt(3.0) : glm::length(posed.bounds.high - posed.bounds.low);
  camera.lens.znear = kNearFraction * std::max(framing.distance, size);
  camera.target_distance = framing.distance;
  return camera;
}

glm::dvec3 CentreOf(const Bounds& bounds) {
  return bounds.empty ? glm::dvec3(0.0) : 0.5 * bounds.low + 0.5 * bounds.high;
}

ResolvedCamera ResolveAuto(const AutoCamera& automatic, const PosedScene& posed, double aspect) {
  const OrbitCamera orbit{30.0 * kDegree, 75.0 * kDegree, {}, {}, automatic.yfov};
  const double yfov = orbit.yfov.value_or(kFieldOfView);
  CheckFieldOfView(yfov);
  const CameraAxes axes = OrbitAxes(orbit.theta, orbit.phi);
  const glm::dvec3 target = CentreOf(posed.bounds);
  const double tan_y = Tan(0.5 * yfov);
  return PlaceOrbit(orbit, posed, axes, target, FrameAll(posed, target, axes, tan_y * aspect, tan_y), aspect);
}

const OrbitBall& Ball(const Scene& scene, const PosedScene& posed, const std::optional<glm::dvec3>& centre,
                      KnownBall& known) {
  PoseSettings pose = posed.settings;
  pose.time = 0.0;  // the result does not depend on it
  if (!known.ball || known.pose != pose || known.centre != centre) {
    known = {pose, centre, MeasureBall(scene, posed, centre)};
  }
  return *known.ball;
}

ResolvedCamera ResolveOrbit(const OrbitCamera& orbit, const Scene& scene, const PosedScene& posed, double aspect,
                            KnownBall* known) {
  const double yfov = orbit.yfov.value_or(kFieldOfView);
  CheckFieldOfView(yfov);
  CheckFinite(orbit.target.value_or(glm::dvec3(0.0)), "the target");
  CheckFinite({orbit.theta, orbit.phi, orbit.radius.value_or(0.0)}, "theta, phi or the radius");
  Framing framing{orbit.radius.value_or(0.0), 0.0, 0.0};
  glm::dvec3 target = orbit.target.value_or(CentreOf(posed.bounds));
  if (!(framing.distance > 0.0)) {
    KnownBall unknown;
    const OrbitBall& ball = Ball(scene, posed, orbit.target, known != nullptr ? *known : unknown);
    target = ball.centre;
    // The sine of the angle whose tangent is that of the narrower side.
    const double narrow = Tan(0.5 * yfov) * std::min(aspect, 1.0);
    framing.distance = kMargin * ball.radius * std::sqrt(1.0 + narrow * narrow) / narrow;
    if (!(framing.distance > 0.0)) framing.distance = 1.0;
  }
  return PlaceOrbit(orbit, posed, OrbitAxes(orbit.theta, orbit.phi), target, framing, aspect);
}

glm::dvec3 NormalizedOr(const glm::dvec3& v, const glm::dvec3& otherwise) {
  const double length = std::sqrt(glm::dot(v, v));
  return length > 0.0 && std::isfinite(length) ? v / length : otherwise;
}

// Fits a lens to an image of another aspect ratio: all that the lens frames stays visible, with more on two sides.
// Source: glTF 2.0 specification, section 3.10.3: no cropping, no stretching.
void FitLens(double aspect, Camera& lens) {
  if (lens.orthographic) {
    lens.xmag = std::fabs(lens.xmag);
    lens.ymag = std::fabs(lens.ymag);
    if (aspect < lens.xmag / lens.ymag) {
      lens.ymag = lens.xmag / aspect;
    } else {
      lens.xmag = lens.ymag * aspect;
    }
  } else if (lens.aspect && aspect < *lens.aspect) {
    lens.yfov = 2.0 * Atan2(Tan(0.5 * lens.yfov) * (*lens.aspect / aspect), 1.0);
  }
  lens.aspect = aspect;
}

ResolvedCamera ResolveSceneCamera(int index, const Scene& scene, const PosedScene& posed, double aspect) {
  if (index < 0 || std::size_t(index) >= scene.cameras.size()) {
    Fail("camera " + std::to_string(index) + " is not one of the scene's " + std::to_string(scene.cameras.size()),
         "count from 0");
  }
  const auto placed = std::find_if(posed.cameras.begin(), posed.cameras.end(),
                                   [&](const PosedCamera& candidate) { return candidate.camera == index; });
  if (placed == posed.cameras.end()) {
    Fail("no node of the scene holds camera " + std::to_string(index) + ", or it is broken, which a warning says",
         "choose another camera or another scene");
  }
  const glm::dmat4& matrix = placed->world_from_camera;
  CameraAxes axes;
  axes.back = NormalizedOr(glm::dvec3(matrix[2]), {0.0, 0.0, 1.0});
  const glm::dvec3 up(matrix[1]);
  const glm::dvec3 other = std::fabs(axes.back.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, -1.0);
  axes.up = NormalizedOr(up - axes.back * glm::dot(axes.back, up),
                         NormalizedOr(other - axes.back * glm::dot(axes.back, other), other));
  axes.right = glm::cross(axes.up, axes.back);

  ResolvedCamera camera;
  camera.world_from_camera = PlaceAt(glm::dvec3(matrix[3]), axes);
  camera.lens = scene.cameras[std::size_t(index)];
  FitLens(aspect, camera.lens);
  return camera;
}

// Whether the matrix is rigid, so that its transpose can serve as its inverse. False for NaN, which fails every
// comparison.
void CheckRigid(const glm::dmat4& m) {
  constexpr double kTolerance = 1e-6;
  const glm::dmat3 axes(m);
  const glm::dmat3 product = glm::transpose(axes) * axes;
  bool rigid = std::fabs(glm::determinant(axes) - 1.0) <= 4.0 * kTolerance;
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) rigid = rigid && std::fabs(product[c][r] - (c == r ? 1.0 : 0.0)) <= kTolerance;
  }
  for (int c = 0; c < 4; ++c) rigid = rigid && m[c][3] == (c == 3 ? 1.0 : 0.0);
  if (!rigid) Fail("the camera's matrix is not rigid", "rotate and move only: no scale, shear or mirroring");
}

ResolvedCamera ResolveFree(const FreeCamera& free, double aspect) {
  for (int c = 0; c < 4; ++c) CheckFinite(glm::dvec3(free.world_from_camera[c]), "the camera's matrix");
  CheckRigid(free.world_from_camera);
  const Camera& lens = free.lens;
  if (lens.orthographic) {
    const bool fine = std::isfinite(lens.xmag) && std::isfinite(lens.ymag) && lens.xmag != 0.0 && lens.ymag != 0.0;
    if (!fine) Fail("xmag and ymag must be finite and not zero");
  } else {
    CheckFieldOfView(lens.yfov);
    if (!(lens.znear > 0.0)) Fail("znear must be positive");
    if (lens.aspect && !(*lens.aspect > 0.0 && std::isfinite(*lens.aspect))) Fail("the aspect ratio must be positive");
  }
  if (!(lens.zfar > lens.znear)) Fail("zfar must be larger than znear");
  ResolvedCamera camera{free.world_from_camera, lens};
  FitLens(aspect, camera.lens);
  return camera;
}

}  // namespace

ResolvedCamera ResolveCamera(const CameraChoice& choice, const Scene& scene, const PosedScene& posed, int width,
                             int height, KnownBall* known) {
  if (width < 1 || height < 1) Fail("the picture has no pixels");
  const double aspect = double(width) / double(height);
  if (const auto* automatic = std::get_if<AutoCamera>(&choice)) return ResolveAuto(*automatic, posed, aspect);
  if (const auto* orbit = std::get_if<OrbitCamera>(&choice)) return ResolveOrbit(*orbit, scene, posed, aspect, known);
  if (const auto* of_scene = std::get_if<SceneCamera>(&choice)) {
    return ResolveSceneCamera(of_scene->camera, scene, posed, aspect);
  }
  return ResolveFree(std::get<FreeCamera>(choice), aspect);
}

}  // namespace facet
