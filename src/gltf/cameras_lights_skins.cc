#include <algorithm>
#include <cmath>

#include "gltf/nodes.h"
#include "math/round_to_float.h"

namespace facet::gltf {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kHalfPi = kPi / 2.0;

void ReadSpotCone(Context& context, const Json& object, Light& light, const Place& place) {
  const Json* spot = ObjectAt(object, "spot", place);
  if (!spot) {
    context.Warn(place, "a spot light without \"spot\"; the defaults are used");
    return;
  }
  const Place spot_place(place, "spot");
  double inner = NumberAt(*spot, "innerConeAngle", spot_place).value_or(0.0);
  double outer = NumberAt(*spot, "outerConeAngle", spot_place).value_or(kPi / 4.0);
  // Exporters write pi/2 as a rounded float, a little above it.
  constexpr double kSlack = 1e-6;
  if (!(outer > 0.0 && outer <= kHalfPi + kSlack) || !(inner >= 0.0 && inner < outer)) {
    context.Warn(spot_place, "cone angles outside of 0 <= inner < outer <= pi/2 were clamped");
  }
  outer = std::min(std::max(outer, 0.0), kHalfPi);
  inner = std::min(std::max(inner, 0.0), outer);
  light.inner_cone_angle = static_cast<float>(inner);
  light.outer_cone_angle = static_cast<float>(outer);
}

Light ReadLight(Context& context, const Json& object, const Place& place) {
  Light light;
  light.name = NameOf(object, place);
  const std::string type = RequireString(object, "type", place);
  bool known = true;
  if (type == "directional") {
    light.type = LightType::Directional;
  } else if (type == "spot") {
    light.type = LightType::Spot;
    ReadSpotCone(context, object, light, place);
  } else if (type != "point") {
    context.Warn(Place(place, "type"), "ignored: \"" + type + "\" is unknown; the light stays dark");
    known = false;
  }
  const auto color = NumbersAt(object, "color", 3, place);
  for (std::size_t c = 0; c < color.size(); ++c) {
    light.color[static_cast<int>(c)] = RoundToFiniteFloat(std::max(color[c], 0.0));
  }
  light.intensity = RoundToFiniteFloat(std::max(NumberAt(object, "intensity", place).value_or(1.0), 0.0));
  if (!known) light.intensity = 0.0f;
  if (const auto range = NumberAt(object, "range", place)) {
    if (*range > 0.0) {
      light.range = RoundToFiniteFloat(*range);
    } else {
      context.Warn(Place(place, "range"), "ignored: is not positive");
    }
  }
  return light;
}

}  // namespace

void ReadCameras(Context& context, Scene& scene) {
  const Place list_place(context.place, "cameras");
  for (std::size_t i = 0; i < context.document.core.cameras.size(); ++i) {
    const Json& object = context.Object("cameras", i);
    const Place place(list_place, i);
    Camera camera;
    camera.name = NameOf(object, place);
    camera.orthographic = object["type"] == "orthographic";
    const char* lens_key = camera.orthographic ? "orthographic" : "perspective";
    const Json& lens = object[lens_key];
    const Place lens_place(place, lens_key);
    camera.znear = NumberAt(lens, "znear", lens_place).value_or(camera.znear);
    camera.zfar = NumberAt(lens, "zfar", lens_place).value_or(camera.zfar);
    if (camera.orthographic) {
      camera.xmag = std::fabs(NumberAt(lens, "xmag", lens_place).value_or(1.0));
      camera.ymag = std::fabs(NumberAt(lens, "ymag", lens_place).value_or(1.0));
      if (!(camera.xmag > 0.0 && camera.ymag > 0.0)) Fail(lens_place, "xmag or ymag is zero");
      if (!(camera.znear >= 0.0)) Fail(lens_place, "znear is negative");
    } else {
      camera.yfov = NumberAt(lens, "yfov", lens_place).value_or(camera.yfov);
      camera.aspect = NumberAt(lens, "aspectRatio", lens_place);
      if (!(camera.yfov > 0.0 && camera.yfov < kPi)) Fail(lens_place, "yfov is not between 0 and pi");
      if (camera.aspect && !(*camera.aspect > 0.0)) Fail(lens_place, "aspectRatio is not positive");
      if (!(camera.znear > 0.0)) Fail(lens_place, "znear is not positive");
    }
    if (!(camera.zfar > camera.znear)) Fail(lens_place, "zfar is not beyond znear");
    scene.cameras.push_back(std::move(camera));
  }
}

void ReadLights(Context& context, Scene& scene) {
  constexpr const char* kLights = "KHR_lights_punctual";
  const Json* extension = ExtensionOf(context.document.root, kLights, context.place);
  if (!extension) return;
  const Place extensions_place(context.place, "extensions");
  const Place extension_place(extensions_place, kLights);
  const Json* list = ArrayAt(*extension, "lights", extension_place);
  if (!list) return;
  const Place list_place(extension_place, "lights");
  for (const Json& object : *list) {
    const Place place(list_place, scene.lights.size());
    RequireObject(object, place);
    scene.lights.push_back(ReadLight(context, object, place));
  }
}

void ReadSkins(Context& context, AccessorReader& reader, Scene& scene) {
  const Place list_place(context.place, "skins");
  for (std::size_t i = 0; i < context.document.core.skins.size(); ++i) {
    const auto& from = context.document.core.skins[i];
    const Place place(list_place, i);
    Skin skin;
    skin.name = from.name;
    skin.joints = from.joints;
    if (from.inverseBindMatrices >= 0) {
      const Place matrices_place(place, "inverseBindMatrices");
      const AccessorView view = reader.View(from.inverseBindMatrices);
      if (view.type != ComponentType::F32 || view.components != 16) Fail(matrices_place, "are not float matrices");
      if (view.count < skin.joints.size()) {
        Fail(matrices_place,
             "has " + std::to_string(view.count) + " matrices for " + std::to_string(skin.joints.size()) + " joints");
      }
      // More than one for each joint is allowed, and useless.
      context.Charge(skin.joints.size(), sizeof(glm::mat4), matrices_place);
      skin.inverse_bind.resize(skin.joints.size());
      if (!skin.joints.empty()) {
        reader.ReadFloats(view, {0, skin.joints.size()}, 16, &skin.inverse_bind[0][0][0], matrices_place);
      }
    }
    scene.skins.push_back(std::move(skin));
  }
}

}  // namespace facet::gltf
