#include <algorithm>
#include <string>

#include "gltf/nodes.h"
#include "math/round_to_float.h"

namespace facet::gltf {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kHalfPi = kPi / 2.0;

void ReadSpotCone(const Json& object, Light& light, const Place& place) {
  const Json* spot = LenientObject(object, "spot", place);
  if (!spot) {
    place.Warn("a spot light without \"spot\"; the defaults are used");
    return;
  }
  const Place spot_place(place, "spot");
  double inner = LenientNumber(*spot, "innerConeAngle", spot_place).value_or(0.0);
  double outer = LenientNumber(*spot, "outerConeAngle", spot_place).value_or(kPi / 4.0);
  // Exporters write pi/2 as a rounded float, a little above it.
  constexpr double kSlack = 1e-6;
  if (!(outer > 0.0 && outer <= kHalfPi + kSlack) || !(inner >= 0.0 && inner < outer)) {
    spot_place.Warn("cone angles outside of 0 <= inner < outer <= pi/2 were clamped");
  }
  outer = std::min(std::max(outer, 0.0), kHalfPi);
  inner = std::min(std::max(inner, 0.0), outer);
  light.inner_cone_angle = static_cast<float>(inner);
  light.outer_cone_angle = static_cast<float>(outer);
}

// Negative light counts as 0.
float Positive(double value, const Place& place) {
  if (value < 0.0) place.Warn("is negative; 0 is used");
  return RoundToFiniteFloat(std::max(value, 0.0));
}

Light ReadLight(const Json& object, const Place& place) {
  Light light;
  light.name = NameOf(object, place);
  const std::string type = LenientString(object, "type", place).value_or("");
  bool known = true;
  if (type == "directional") {
    light.type = LightType::Directional;
  } else if (type == "spot") {
    light.type = LightType::Spot;
    ReadSpotCone(object, light, place);
  } else if (type != "point") {
    Place(place, "type").Warn("ignored: \"" + type + "\" is unknown; the light stays dark");
    known = false;
  }
  const auto color = LenientNumbers(object, "color", 3, place);
  for (std::size_t c = 0; c < color.size(); ++c) {
    light.color[static_cast<int>(c)] = Positive(color[c], Place(place, "color"));
  }
  light.intensity = Positive(LenientNumber(object, "intensity", place).value_or(1.0), Place(place, "intensity"));
  if (!known) light.intensity = 0.0f;
  if (const auto range = LenientNumber(object, "range", place)) {
    if (*range > 0.0) {
      light.range = RoundToFiniteFloat(*range);
    } else {
      Place(place, "range").Warn("ignored: is not positive");
    }
  }
  return light;
}

}  // namespace

void ReadLights(Context& context, Scene& scene) {
  constexpr const char* kLights = "KHR_lights_punctual";
  const Json* extension = ExtensionOf(context.document.root, kLights, context.place);
  if (!extension) return;
  const Place extensions_place(context.place, "extensions");
  const Place extension_place(extensions_place, kLights);
  const Json* list = LenientArray(*extension, "lights", extension_place);
  if (!list) return;
  const Place list_place(extension_place, "lights");
  context.Charge(list->size(), sizeof(Light), list_place);
  scene.lights.reserve(list->size());
  for (const Json& object : *list) {
    const Place place(list_place, scene.lights.size());
    scene.lights.push_back(ReadLight(LenientElement(object, place), place));
  }
}

}  // namespace facet::gltf
