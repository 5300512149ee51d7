#include "scene/camera.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include "facet/error.h"
#include "math/elementary.h"

namespace facet {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;
constexpr double kMargin = 1.05;        // how much larger than the bounds the framed picture is
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

// Unit vectors of a camera at rest in world space.
struct Axes {
  glm::dvec3 right, up, back;
};

glm::dmat4 PlaceAt(const glm::dvec3& eye, const Axes& axes) {
  return glm::dmat4(glm::dvec4(axes.right, 0.0), glm::dvec4(axes.up, 0.0), glm::dvec4(axes.back, 0.0),
                    glm::dvec4(eye, 1.0));
}

// `back` is the direction from the target to the eye; `up` its derivative by -phi. Unlike a cross product with +Y this
// has a limit where the view is vertical.
Axes OrbitAxes(double theta, double phi) {
  const double sin_theta = Sin(theta), cos_theta = Cos(theta), sin_phi = Sin(phi), cos_phi = Cos(phi);
  Axes axes;
  axes.back = {sin_phi * sin_theta, cos_phi, sin_phi * cos_theta};
  axes.up = {-cos_phi * sin_theta, sin_phi, -cos_phi * cos_theta};
  axes.right = {cos_theta, 0.0, -sin_theta};
  if (sin_phi < 0.0) {  // past a pole: keep +Y up
    axes.up = -axes.up;
    axes.right = -axes.right;
  }
  return axes;
}

// The smallest distance from target to eye at which the whole box is seen.
double FramedDistance(const Bounds& box, const glm::dvec3& target, const Axes& axes, double tan_x, double tan_y) {
  double distance = 0.0, nearest = 0.0;
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 corner(i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y,
                            i & 4 ? box.high.z : box.low.z);
    const glm::dvec3 from_target = corner - target;
    // Seen where |x| <= tan * depth, and depth = distance - z.
    const double x = std::fabs(glm::dot(from_target, axes.right)), y = std::fabs(glm::dot(from_target, axes.up));
    const double z = glm::dot(from_target, axes.back);
    const double needed = z + kMargin * std::max(x / tan_x, y / tan_y);
    distance = i == 0 ? needed : std::max(distance, needed);
    nearest = i == 0 ? z : std::max(nearest, z);
  }
  // A line seen end on would have the eye at its end, a single point at itself.
  const double size = glm::length(box.high - box.low);
  distance = std::max(distance, nearest + 1e-3 * size);
  return distance > 0.0 ? distance : 1.0;
}

ResolvedCamera ResolveOrbit(const OrbitCamera& orbit, const Bounds& bounds, double aspect) {
  Bounds box = bounds;
  if (box.empty) box = {glm::dvec3(-0.5), glm::dvec3(0.5), false};
  const double yfov = orbit.yfov.value_or(45.0 * kDegree);
  const glm::dvec3 target = orbit.target.value_or(0.5 * box.low + 0.5 * box.high);
  CheckFieldOfView(yfov);
  CheckFinite(target, "the target");
  CheckFinite({orbit.theta, orbit.phi, orbit.radius.value_or(0.0)}, "theta, phi or the radius");

  const Axes axes = OrbitAxes(orbit.theta, orbit.phi);
  const double tan_y = Tan(0.5 * yfov);
  const bool is_framed = !orbit.radius || *orbit.radius <= 0.0;
  const double distance = is_framed ? FramedDistance(box, target, axes, tan_y * aspect, tan_y) : *orbit.radius;
  ResolvedCamera camera;
  camera.world_from_camera = PlaceAt(target + distance * axes.back, axes);
  camera.lens.yfov = yfov;
  camera.lens.aspect = aspect;
  camera.lens.znear = kNearFraction * std::max(distance, glm::length(box.high - box.low));
  return camera;
}

glm::dvec3 NormalizedOr(const glm::dvec3& v, const glm::dvec3& otherwise) {
  const double length = std::sqrt(glm::dot(v, v));
  return length > 0.0 && std::isfinite(length) ? v / length : otherwise;
}

ResolvedCamera ResolveSceneCamera(int index, const Scene& scene, const PosedScene& posed, double aspect) {
  if (index < 0 || std::size_t(index) >= scene.cameras.size()) {
    Fail("camera " + std::to_string(index) + " is not one of the scene's " + std::to_string(scene.cameras.size()),
         "count from 0");
  }
  const auto placed = std::find_if(posed.cameras.begin(), posed.cameras.end(),
                                   [&](const PosedCamera& candidate) { return candidate.camera == index; });
  if (placed == posed.cameras.end()) {
    Fail("no visible node holds camera " + std::to_string(index), "choose another camera or another scene");
  }
  const glm::dmat4& matrix = placed->world_from_camera;
  Axes axes;
  axes.back = NormalizedOr(glm::dvec3(matrix[2]), {0.0, 0.0, 1.0});
  const glm::dvec3 up(matrix[1]);
  const glm::dvec3 other = std::fabs(axes.back.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, -1.0);
  axes.up = NormalizedOr(up - axes.back * glm::dot(axes.back, up),
                         NormalizedOr(other - axes.back * glm::dot(axes.back, other), other));
  axes.right = glm::cross(axes.up, axes.back);

  ResolvedCamera camera;
  camera.world_from_camera = PlaceAt(glm::dvec3(matrix[3]), axes);
  camera.lens = scene.cameras[std::size_t(index)];
  camera.lens.aspect = aspect;
  if (camera.lens.orthographic) {
    camera.lens.ymag = std::fabs(camera.lens.ymag);
    camera.lens.xmag = camera.lens.ymag * aspect;
  }
  return camera;
}

ResolvedCamera ResolveFree(const FreeCamera& free, double aspect) {
  for (int c = 0; c < 4; ++c) CheckFinite(glm::dvec3(free.world_from_camera[c]), "the camera's matrix");
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
  camera.lens.aspect = lens.aspect.value_or(aspect);
  return camera;
}

}  // namespace

ResolvedCamera ResolveCamera(const CameraChoice& choice, const Scene& scene, const PosedScene& posed, int width,
                             int height) {
  if (width < 1 || height < 1) Fail("the picture has no pixels");
  const double aspect = double(width) / double(height);
  if (const auto* automatic = std::get_if<AutoCamera>(&choice)) {
    const OrbitCamera orbit{30.0 * kDegree, 75.0 * kDegree, {}, {}, automatic->yfov};
    return ResolveOrbit(orbit, posed.bounds, aspect);
  }
  if (const auto* orbit = std::get_if<OrbitCamera>(&choice)) return ResolveOrbit(*orbit, posed.bounds, aspect);
  if (const auto* of_scene = std::get_if<SceneCamera>(&choice)) {
    return ResolveSceneCamera(of_scene->camera, scene, posed, aspect);
  }
  return ResolveFree(std::get<FreeCamera>(choice), aspect);
}

}  // namespace facet
