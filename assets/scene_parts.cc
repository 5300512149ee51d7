#include "scenes.h"

namespace facet::assets {

Json LookAt(Vec3 eye, Vec3 target) {
  const Vec3 z = Normalize(eye - target), x = Normalize(Cross({0, 1, 0}, z)), y = Cross(z, x);
  return Json::array({x.x, x.y, x.z, 0, y.x, y.y, y.z, 0, z.x, z.y, z.z, 0, eye.x, eye.y, eye.z, 1});
}

Json ToJson(Vec3 v) { return Json::array({v.x, v.y, v.z}); }

Json PlainMaterial(const char* name, Vec3 color, double metallic, double roughness) {
  return {{"name", name},
          {"pbrMetallicRoughness",
           {{"baseColorFactor", Json::array({color.x, color.y, color.z, 1.0})},
            {"metallicFactor", metallic},
            {"roughnessFactor", roughness}}}};
}

int AddPerspectiveCamera(Glb& glb, const char* name, Vec3 eye, Vec3 target, double yfov) {
  const int camera =
      glb.Add("cameras", {{"name", name}, {"type", "perspective"}, {"perspective", {{"yfov", yfov}, {"znear", 0.01}}}});
  return glb.AddRootNode({{"name", name}, {"camera", camera}, {"matrix", LookAt(eye, target)}});
}

void AddLight(Glb& glb, const char* name, Json light, Json node) {
  glb.UseExtension("KHR_lights_punctual");
  light["name"] = name;
  Json& lights = glb.json()["extensions"]["KHR_lights_punctual"]["lights"];
  if (!lights.is_array()) lights = Json::array();
  lights.push_back(std::move(light));
  node["name"] = name;
  node["extensions"]["KHR_lights_punctual"]["light"] = lights.size() - 1;
  glb.AddRootNode(std::move(node));
}

}  // namespace facet::assets
