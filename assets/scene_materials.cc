// Every ratified extension of glTF's materials: a row of spheres for each parameter, which grows from left to right.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "facet/shader/elementary_double.h"
#include "lettering.h"
#include "scenes.h"

namespace facet::assets {
namespace {

constexpr int kSteps = 7, kRowsPerBlock = 8;
constexpr double kRadius = 0.5, kSpacing = 1.08, kPitch = 1.5, kBlockGap = 0.9;
constexpr double kBlockWidth = (kSteps - 1) * kSpacing + 2 * kRadius;
constexpr double kCell = 0.12;  // of the checks behind glass

struct Row {
  std::string extension, parameter;  // the parameter as the extension names it
  std::string title, range;          // as the label says them
  bool glass = false;                // stands before checks
  std::function<Json(double t)> material;
};

Json Extended(Json material, const std::string& name, Json value) {
  material["extensions"]["KHR_materials_" + name] = std::move(value);
  return material;
}

// Clear glass that fills the sphere, or as much of it as `thickness` says.
Json Glass(double roughness, double ior, double thickness = 2 * kRadius) {
  Json glass = PlainMaterial("", {1, 1, 1}, 0, roughness);
  glass = Extended(glass, "transmission", {{"transmissionFactor", 1.0}});
  glass = Extended(glass, "volume", {{"thicknessFactor", thickness}});
  return Extended(glass, "ior", {{"ior", ior}});
}

Json CarPaint() { return PlainMaterial("", {0.55, 0.02, 0.03}, 0.6, 0.55); }
Json Velvet() { return PlainMaterial("", {0.045, 0.010, 0.085}, 0, 1); }
Json Steel() { return PlainMaterial("", {0.72, 0.71, 0.69}, 1, 0.32); }

std::vector<Row> Rows() {
  const Vec3 sheen{0.85, 0.55, 1.0};
  return {
      {"clearcoat", "clearcoatFactor", "clearcoat", "0 to 1", false,
       [](double t) {
         return Extended(CarPaint(), "clearcoat", {{"clearcoatFactor", t}});
       }},
      {"clearcoat", "clearcoatRoughnessFactor", "clearcoat roughness", "0 to 1", false,
       [](double t) {
         return Extended(CarPaint(), "clearcoat", {{"clearcoatFactor", 1.0}, {"clearcoatRoughnessFactor", t}});
       }},
      {"sheen", "sheenColorFactor", "sheen colour", "black to lilac", false,
       [=](double t) {
         return Extended(Velvet(), "sheen", {{"sheenColorFactor", ToJson(sheen * t)}, {"sheenRoughnessFactor", 0.5}});
       }},
      {"sheen", "sheenRoughnessFactor", "sheen roughness", "0 to 1", false,
       [=](double t) {
         return Extended(Velvet(), "sheen", {{"sheenColorFactor", ToJson(sheen)}, {"sheenRoughnessFactor", t}});
       }},
      {"specular", "specularFactor", "specular", "0 to 1", false,
       [](double t) {
         return Extended(PlainMaterial("", {0.02, 0.07, 0.12}, 0, 0.12), "specular", {{"specularFactor", t}});
       }},
      {"specular", "specularColorFactor", "specular colour", "white to orange", false,
       [](double t) {
         const Vec3 color = Vec3{1, 1, 1} * (1 - t) + Vec3{1, 0.32, 0.03} * t;
         Json material = PlainMaterial("", {0.02, 0.07, 0.12}, 0, 0.12);
         material = Extended(material, "ior", {{"ior", 2.4}});
         return Extended(material, "specular", {{"specularColorFactor", ToJson(color)}});
       }},
      {"iridescence", "iridescenceThicknessMaximum", "iridescence thickness", "100 to 700 nm", false,
       [](double t) {
         return Extended(
             PlainMaterial("", {0.75, 0.75, 0.75}, 1, 0.15), "iridescence",
             {{"iridescenceFactor", 1.0}, {"iridescenceIor", 1.8}, {"iridescenceThicknessMaximum", 100.0 + 600.0 * t}});
       }},
      {"pbrSpecularGlossiness", "glossinessFactor", "specular-glossiness", "glossiness 0 to 1", false,
       [](double t) {
         return Json{{"extensions",
                      {{"KHR_materials_pbrSpecularGlossiness",
                        {{"diffuseFactor", Json::array({0.05, 0.20, 0.09, 1.0})},
                         {"specularFactor", ToJson({0.30, 0.26, 0.16})},
                         {"glossinessFactor", t}}}}}};
       }},
      {"anisotropy", "anisotropyStrength", "anisotropy", "0 to 1", false,
       [](double t) {
         return Extended(Steel(), "anisotropy", {{"anisotropyStrength", t}});
       }},
      {"anisotropy", "anisotropyRotation", "anisotropy rotation", "0 to 90 degrees", false,
       [](double t) {
         return Extended(Steel(), "anisotropy", {{"anisotropyStrength", 0.85}, {"anisotropyRotation", t * kPi / 2}});
       }},
      {"diffuse_transmission", "diffuseTransmissionFactor", "diffuse transmission", "0 to 1", false,
       [](double t) {
         return Extended(
             PlainMaterial("", {0.20, 0.34, 0.16}, 0, 0.6), "diffuse_transmission",
             {{"diffuseTransmissionFactor", t}, {"diffuseTransmissionColorFactor", ToJson({1, 0.62, 0.2})}});
       }},
      {"transmission", "transmissionFactor", "transmission", "0 to 1", true,
       [](double t) {
         return Extended(PlainMaterial("", {0.98, 0.72, 0.35}, 0, 0), "transmission", {{"transmissionFactor", t}});
       }},
      {"transmission", "roughnessFactor", "transmission roughness", "0 to 0.6", true,
       [](double t) { return Glass(0.6 * t, 1.5, 0.12); }},
      {"ior", "ior", "ior", "1 to 2.5", true, [](double t) { return Glass(0, 1 + 1.5 * t); }},
      {"volume", "attenuationDistance", "volume attenuation distance", "8 to 0.13 diameters", true,
       [](double t) {
         Json glass = Glass(0, 1.5);
         Json& volume = glass["extensions"]["KHR_materials_volume"];
         volume["attenuationColor"] = ToJson({0.62, 0.86, 0.95});
         volume["attenuationDistance"] = 2 * kRadius * 8 * Exp2(-6 * t);
         return glass;
       }},
      {"dispersion", "dispersion", "dispersion", "0 to 6", true,
       [](double t) {
         return Extended(Glass(0, 1.7), "dispersion", {{"dispersion", 6 * t}});
       }},
  };
}

// With tangents along +u, for renderers that make none themselves.
Shape TangentSphere() {
  Shape sphere = Sphere(48, 24);
  for (const Vec2& uv : sphere.uvs) {
    const double theta = (uv.x == 1.0 ? 0.0 : uv.x) * 2 * kPi;
    sphere.tangents.push_back({float(Cos(theta)), 0, float(-Sin(theta)), 1});
  }
  for (Vec3& p : sphere.positions) p = p * kRadius;
  return sphere;
}

int UnlitMaterial(Glb& glb, const char* name, Vec3 color) {
  glb.UseExtension("KHR_materials_unlit");
  return glb.AddMaterial(Extended(PlainMaterial(name, color, 0, 1), "unlit", Json::object()));
}

// Dark squares, every second one of a block's row.
Shape Checks() {
  const int columns = int(kBlockWidth / kCell + 0.5), rows = 9;
  Shape shape;
  for (int j = 0; j < rows; ++j) {
    for (int i = j % 2; i < columns; i += 2) {
      const double x = i * kCell - kRadius - (columns * kCell - kBlockWidth) / 2, y = (j - rows / 2.0) * kCell;
      shape.Append(Quad({x, y, 0}, {x + kCell, y, 0}, {x + kCell, y + kCell, 0}, {x, y + kCell, 0}));
    }
  }
  shape.normals.clear();
  shape.uvs.clear();
  return shape;
}

}  // namespace

Glb Materials() {
  Glb glb("materials");
  const std::vector<Row> rows = Rows();
  const Json sphere = glb.MakePrimitive(TangentSphere(), 0);
  const int paper = UnlitMaterial(glb, "paper", {0.82, 0.82, 0.81});
  const int ink = UnlitMaterial(glb, "ink", {0.02, 0.02, 0.025});
  const int dark = UnlitMaterial(glb, "dark check", {0.035, 0.06, 0.11});
  const int checks = glb.AddMesh("checks", Checks(), dark);
  constexpr double kXHeight = 0.135;

  // Close behind the spheres: what glass refracts is looked up where a ray leaves it.
  Shape board = Quad({-8.5, -6.4, 0}, {8.5, -6.4, 0}, {8.5, 6.4, 0}, {-8.5, 6.4, 0});
  board.normals.clear();
  board.uvs.clear();
  glb.AddRootNode(
      {{"name", "board"}, {"mesh", glb.AddMesh("board", board, paper)}, {"translation", ToJson({0, 0, -0.54})}});

  std::map<std::string, int> labels;  // meshes by what they say
  int number = 0;
  for (const Row& row : rows) {
    const int block = number / kRowsPerBlock, line = number % kRowsPerBlock;
    ++number;
    const std::string extension = "KHR_materials_" + row.extension;
    Json node = {{"name", extension + " " + row.parameter}, {"children", Json::array()}};
    const double left = (block == 0 ? -kBlockGap / 2 - kBlockWidth : kBlockGap / 2) + kRadius;
    const double height = ((kRowsPerBlock - 1) / 2.0 - line) * kPitch - 0.17;
    node["translation"] = ToJson({left, height, 0});
    for (int step = 0; step < kSteps; ++step) {
      const double t = double(step) / (kSteps - 1);
      const std::string where = ", step " + std::to_string(step) + " of " + std::to_string(kSteps - 1);
      const std::string name = row.parameter + where;
      Json material = row.material(t);
      material["name"] = row.title + where;
      for (const auto& item : material["extensions"].items()) glb.UseExtension(item.key());
      Json primitive = sphere;  // the same accessors with another material
      primitive["material"] = glb.AddMaterial(std::move(material));
      const int mesh = glb.Add("meshes", {{"name", name}, {"primitives", Json::array({primitive})}});
      node["children"].push_back(
          glb.AddNode({{"name", name}, {"mesh", mesh}, {"translation", ToJson({step * kSpacing, 0, 0})}}));
    }
    if (row.glass) {
      node["children"].push_back(
          glb.AddNode({{"name", "checks"}, {"mesh", checks}, {"translation", ToJson({0, 0, -0.52})}}));
    }
    const auto write = [&](const std::string& text, double x) {
      const auto [written, is_new] = labels.try_emplace(text);
      if (is_new) written->second = glb.AddMesh(text, Lettering(text, kXHeight), ink);
      node["children"].push_back(
          glb.AddNode({{"name", text}, {"mesh", written->second}, {"translation", ToJson({x, kRadius + 0.12, -0.5})}}));
    };
    write(row.title, -kRadius);
    write(row.range, kBlockWidth - kRadius - LetteringWidth(row.range, kXHeight));
    glb.AddRootNode(node);
  }
  const int camera =
      glb.Add("cameras", {{"name", "front"},
                          {"type", "orthographic"},
                          {"orthographic", {{"xmag", 8.24}, {"ymag", 6.18}, {"znear", 0.1}, {"zfar", 40.0}}}});
  glb.AddRootNode({{"name", "front"}, {"camera", camera}, {"translation", ToJson({0, 0, 20})}});
  return glb;
}

}  // namespace facet::assets
