#include "cli/camera_text.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>

namespace facet::cli {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

std::string Text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.7g", value + 0.0);  // turns -0 into 0
  return text;
}

std::string Text(const glm::dvec3& v) { return Text(v.x) + "," + Text(v.y) + "," + Text(v.z); }

struct View {
  glm::dvec3 eye, target, up;
};

View ViewOf(const FreeCamera& camera, double target_distance) {
  const glm::dvec3 eye(camera.world_from_camera[3]), back(camera.world_from_camera[2]);
  return {eye, eye - target_distance * back, glm::dvec3(camera.world_from_camera[1])};
}

// The options for this view, or an empty string if no orbit gives it.
std::string Options(const FreeCamera& camera, double target_distance) {
  const glm::dvec3 back(camera.world_from_camera[2]), right(camera.world_from_camera[0]);
  constexpr double kLevel = 1e-6;
  const bool upright = std::fabs(right.y) < kLevel && camera.world_from_camera[1][1] > -kLevel;
  const double degrees = camera.lens.yfov * kDegrees;
  if (camera.lens.orthographic || !upright || degrees < 1.0 || degrees > 179.0) return {};
  // Theta follows from the right axis, which is defined even if the camera looks straight down or up.
  const double theta = std::atan2(-right.z, right.x), phi = std::acos(std::fmin(std::fmax(back.y, -1.0), 1.0));
  return "--orbit " + Text(theta * kDegrees) + "," + Text(phi * kDegrees) + "," + Text(target_distance) + " --target " +
         Text(ViewOf(camera, target_distance).target) + " --fov " + Text(degrees);
}

}  // namespace

std::string CameraText(const FreeCamera& camera, double target_distance) {
  const View view = ViewOf(camera, target_distance);
  const Camera& lens = camera.lens;
  const std::string options = Options(camera, target_distance);
  return "eye " + Text(view.eye) + " looks at " + Text(view.target) + ", " +
         (lens.orthographic ? Text(2.0 * lens.ymag) + " m" : Text(lens.yfov * kDegrees) + " degrees") + " high" +
         (options.empty() ? "" : ": " + options);
}

nlohmann::ordered_json CameraJson(const FreeCamera& camera, double target_distance) {
  const auto list = [](const glm::dvec3& v) { return nlohmann::ordered_json{v.x, v.y, v.z}; };
  const View view = ViewOf(camera, target_distance);
  const Camera& lens = camera.lens;
  const std::string options = Options(camera, target_distance);
  nlohmann::ordered_json json = {{"eye", list(view.eye)},
                                 {"target", list(view.target)},
                                 {"up", list(view.up)},
                                 {"orthographic", lens.orthographic}};
  if (lens.orthographic) {
    json["xmag"] = lens.xmag;
    json["ymag"] = lens.ymag;
  } else {
    json["yfov_degrees"] = lens.yfov * kDegrees;
  }
  json["znear"] = lens.znear;
  json["zfar"] = std::isfinite(lens.zfar) ? nlohmann::ordered_json(lens.zfar) : nlohmann::ordered_json();
  json["options"] = options.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(options);
  return json;
}

}  // namespace facet::cli
