// Describes the camera in use as text and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "facet/settings.h"

namespace facet::cli {

// "eye 1.2,0.5,3 looks at 0,0.4,0, 45 degrees high: --orbit 30,75,2 --target 0,0.4,0 --fov 45". `target_distance`: from
// the eye to the target. The options reproduce the view except for the near and far planes. They are omitted for views
// that they cannot express: those of orthographic cameras and of cameras with roll.
std::string CameraText(const FreeCamera& camera, double target_distance);

// The same as an object with stable keys: "eye", "target", "up" (x, y and z each), "orthographic", "yfov_degrees" or
// "xmag" and "ymag", "znear", "zfar" (null: none), and "options" (null: none).
nlohmann::ordered_json CameraJson(const FreeCamera& camera, double target_distance);

}  // namespace facet::cli
