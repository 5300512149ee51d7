#include <string>

#include "scenes.h"

namespace facet::assets {

Glb MaterialGrid() {
  constexpr int kSteps = 7;
  constexpr double kSpacing = 2.25;
  Glb glb("material grid");
  const Shape sphere = Sphere(48, 24);
  Json first;
  for (int row = 0; row < kSteps; ++row) {
    for (int column = 0; column < kSteps; ++column) {
      const double metallic = double(row) / (kSteps - 1), roughness = double(column) / (kSteps - 1);
      const std::string name = "metalness " + std::to_string(row) + "/6, roughness " + std::to_string(column) + "/6";
      const int material = glb.AddMaterial(PlainMaterial(name.c_str(), {0.955, 0.44, 0.26}, metallic, roughness));
      Json primitive;
      if (first.is_null()) {
        primitive = first = glb.MakePrimitive(sphere, material);
      } else {  // the same accessors with another material
        primitive = first;
        primitive["material"] = material;
      }
      const int mesh = glb.Add("meshes", {{"name", name}, {"primitives", Json::array({primitive})}});
      const double x = (column - (kSteps - 1) / 2.0) * kSpacing, y = (row - (kSteps - 1) / 2.0) * kSpacing;
      glb.AddRootNode({{"name", name}, {"mesh", mesh}, {"translation", ToJson({x, y, 0})}});
    }
  }
  const int camera =
      glb.Add("cameras", {{"name", "front"},
                          {"type", "orthographic"},
                          {"orthographic", {{"xmag", 8.1}, {"ymag", 8.1}, {"znear", 0.1}, {"zfar", 40.0}}}});
  glb.AddRootNode({{"name", "front"}, {"camera", camera}, {"translation", ToJson({0, 0, 20})}});
  return glb;
}

}  // namespace facet::assets
