// The camera in use, in words.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "facet/settings.h"

namespace facet::cli {

// "eye 1.2,0.5,3 looks at 0,0.4,0, 45 degrees high: --orbit 30,75,2 --target 0,0.4,0 --fov 45". `target_distance`: of
// what it looks at. The options give the same view again, but for near and far planes; they are left out where there
// are none such: of orthographic lenses and of cameras that lean to a side.
std::string CameraText(const FreeCamera& camera, double target_distance);

// The same as an object with stable keys: "eye", "target", "up" (three numbers each), "orthographic", "yfov_degrees" or
// "xmag" and "ymag", "znear", "zfar" (null: none), and "options" (null: none).
nlohmann::ordered_json CameraJson(const FreeCamera& camera, double target_distance);

}  // namespace facet::cli
