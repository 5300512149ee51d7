#include <cmath>
#include <string>

#include "gltf/nodes.h"

namespace facet::gltf {
namespace {

constexpr double kPi = 3.14159265358979323846;

// "perspective" or "orthographic": the type that the camera states, or else the one for which it has parameters.
std::string TypeOf(const Json& object, const Place& place) {
  const std::string type = LenientString(object, "type", place).value_or("");
  if (type == "perspective" || type == "orthographic") return type;
  const Place type_place(place, "type");
  const std::string wrong =
      Find(object, "type") ? "\"" + type + "\" is not a type that glTF knows" : std::string("is missing");
  const bool perspective = Find(object, "perspective"), orthographic = Find(object, "orthographic");
  if (perspective == orthographic) Fail(type_place, wrong);
  const std::string guessed = perspective ? "perspective" : "orthographic";
  type_place.Warn(wrong + "; " + guessed + " is used");
  return guessed;
}

double RequireNumber(const Json& object, const char* key, const Place& place) {
  const auto number = NumberAt(object, key, place);
  if (!number) Fail(place, '"' + std::string(key) + "\" is missing");
  return *number;
}

// Fields of view and magnifications must be valid; the near and far planes and the aspect ratio have defaults.
Camera ReadCamera(const Json& object, const Place& place) {
  Camera camera;
  const std::string type = TypeOf(object, place);
  const Json& lens = RequireObject(object, type.c_str(), place);
  const Place lens_place(place, type);
  camera.orthographic = type == "orthographic";
  const auto fix = [&](const char* key, double& value, double otherwise, const char* what) {
    Place(lens_place, key).Warn(what);
    value = otherwise;
  };
  if (camera.orthographic) {
    camera.xmag = std::fabs(RequireNumber(lens, "xmag", lens_place));
    camera.ymag = std::fabs(RequireNumber(lens, "ymag", lens_place));
    if (!(camera.xmag > 0.0 && camera.ymag > 0.0)) Fail(lens_place, "xmag or ymag is zero");
    camera.znear = LenientNumber(lens, "znear", lens_place).value_or(0.0);
    if (!Find(lens, "znear")) fix("znear", camera.znear, 0.0, "is missing; 0 is used");
    if (camera.znear < 0.0) fix("znear", camera.znear, 0.0, "is negative; 0 is used");
  } else {
    camera.yfov = RequireNumber(lens, "yfov", lens_place);
    if (!(camera.yfov > 0.0 && camera.yfov < kPi)) Fail(Place(lens_place, "yfov"), "is not between 0 and pi");
    camera.aspect = LenientNumber(lens, "aspectRatio", lens_place);
    if (camera.aspect && !(*camera.aspect > 0.0)) {
      Place(lens_place, "aspectRatio").Warn("is not positive; the picture's is used");
      camera.aspect.reset();
    }
    const double near = camera.znear;
    camera.znear = LenientNumber(lens, "znear", lens_place).value_or(near);
    if (!Find(lens, "znear")) fix("znear", camera.znear, near, "is missing; 0.01 is used");
    if (!(camera.znear > 0.0)) fix("znear", camera.znear, near, "is not positive; 0.01 is used");
  }
  const double infinity = camera.zfar;
  camera.zfar = LenientNumber(lens, "zfar", lens_place).value_or(infinity);
  if (camera.orthographic && !Find(lens, "zfar")) fix("zfar", camera.zfar, infinity, "is missing; none is used");
  if (!(camera.zfar > camera.znear)) fix("zfar", camera.zfar, infinity, "is not beyond znear; none is used");
  return camera;
}

}  // namespace

std::vector<bool> ReadCameras(Context& context, Scene& scene) {
  const Place list_place(context.place, "cameras");
  context.Charge(context.document.Count("cameras"), sizeof(Camera), list_place);
  scene.cameras.reserve(context.document.Count("cameras"));
  std::vector<bool> usable;
  for (std::size_t i = 0; i < context.document.Count("cameras"); ++i) {
    const Json& object = context.Object("cameras", i);
    const Place place(list_place, i);
    Camera camera;
    usable.push_back(context.TryUnused(place, "cannot be used", [&] { camera = ReadCamera(object, place); }));
    camera.name = NameOf(object, place);
    scene.cameras.push_back(std::move(camera));
  }
  return usable;
}

}  // namespace facet::gltf
