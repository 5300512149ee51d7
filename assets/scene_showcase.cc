#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "facet/shader/elementary_double.h"
#include "image.h"
#include "scenes.h"
#include "showcase_textures.h"

namespace facet::assets {
namespace {

constexpr int kSides = 6;  // of the lantern
constexpr double kPaneRadius = 0.118, kPostRadius = 0.125;
constexpr Vec3 kLanternPlace{-0.17, 0, -0.04};

Json TextureInfo(int texture) { return {{"index", texture}}; }

Vec3 HexCorner(double radius, double y, double side) {
  const double theta = 2 * kPi * side / kSides;
  return {radius * Sin(theta), y, radius * Cos(theta)};
}

Json Textured(Glb& glb, const char* name, const std::vector<std::uint8_t>& color,
              const std::vector<std::uint8_t>& metallic_roughness) {
  Json material = PlainMaterial(name, {1, 1, 1}, 1, 1);
  Json& pbr = material["pbrMetallicRoughness"];
  pbr["baseColorTexture"] = TextureInfo(glb.AddTexture(std::string(name) + " colour", color));
  pbr["metallicRoughnessTexture"] = TextureInfo(glb.AddTexture(std::string(name) + " surface", metallic_roughness));
  return material;
}

// A material with normal and occlusion maps; occlusion shares the image of metalness and roughness.
int AddRelief(Glb& glb, const char* name, const std::vector<std::uint8_t>& color,
              const std::vector<std::uint8_t>& normal, const std::vector<std::uint8_t>& orm, double normal_scale) {
  Json material = Textured(glb, name, color, orm);
  material["normalTexture"] = {{"index", glb.AddTexture(std::string(name) + " normal", normal)},
                               {"scale", normal_scale}};
  material["occlusionTexture"] = material["pbrMetallicRoughness"]["metallicRoughnessTexture"];
  return glb.AddMaterial(material);
}

int AddGlass(Glb& glb, const char* name, Vec3 color, double opacity) {
  Json material = PlainMaterial(name, color, 0, 0.06);
  material["pbrMetallicRoughness"]["baseColorFactor"][3] = opacity;
  material["alphaMode"] = "BLEND";
  material["doubleSided"] = true;
  return glb.AddMaterial(material);
}

void AddFloor(Glb& glb) {
  const int tiles = AddRelief(glb, "tiles", TileColor(), TileNormal(), TileOrm(), 1.0);
  const int rim = glb.AddMaterial(PlainMaterial("bronze rim", {0.72, 0.50, 0.30}, 1, 0.38));
  constexpr double kRadius = 0.72, kTile = 0.115;
  Shape top = Lathe({{0, 0}, {kRadius, 0}}, 96, false);
  for (std::size_t i = 0; i < top.uvs.size(); ++i) {
    top.uvs[i] = {top.positions[i].x / (4 * kTile) + 0.125, top.positions[i].z / (4 * kTile) + 0.125};
  }
  glb.AddRootNode({{"name", "floor"}, {"mesh", glb.AddMesh("floor", top, tiles)}});
  const Shape edge = Lathe({{kRadius, 0},
                            {kRadius + 0.004, 0.006},
                            {kRadius + 0.022, 0.006},
                            {kRadius + 0.03, 0},
                            {kRadius + 0.03, -0.05},
                            {kRadius + 0.015, -0.06},
                            {0, -0.06}},
                           96, false);
  glb.AddRootNode({{"name", "rim"}, {"mesh", glb.AddMesh("rim", edge, rim)}});
}

// UV in metres would show little of an image on parts this small.
Shape ScaleUvs(Shape shape, double scale) {
  for (Vec2& uv : shape.uvs) uv = {uv.x * scale, uv.y * scale};
  return shape;
}

void AddLantern(Glb& glb) {
  const int copper = glb.AddMaterial(Textured(glb, "copper", CopperColor(), CopperMetallicRoughness()));
  const int paint = glb.AddMaterial(Textured(glb, "paint", PaintColor(), PaintMetallicRoughness()));
  const int pane_glass = AddGlass(glb, "pane", {0.80, 0.92, 0.95}, 0.14);
  Json wax_material = PlainMaterial("wax", {0.90, 0.82, 0.66}, 0, 0.55);
  wax_material["emissiveFactor"] = ToJson({0.10, 0.05, 0.018});  // light inside the wax
  const int wax = glb.AddMaterial(wax_material);
  Json flame_material = PlainMaterial("flame", {0, 0, 0}, 0, 1);
  flame_material["emissiveFactor"] = ToJson({1, 1, 1});
  flame_material["emissiveTexture"] = TextureInfo(glb.AddTexture("flame emission", FlameEmission()));
  flame_material["extensions"] = {{"KHR_materials_emissive_strength", {{"emissiveStrength", 7.0}}}};
  glb.UseExtension("KHR_materials_emissive_strength");
  const int flame = glb.AddMaterial(flame_material);

  Shape frame;
  frame.Append(Prism({{0, 0.05}, {0.13, 0.05}, {0.145, 0.035}, {0.145, 0.024}, {0.17, 0.010}, {0.17, 0}}, kSides));
  frame.Append(Prism({{0, 0.375}, {0.137, 0.375}, {0.142, 0.37}, {0.142, 0.352}, {0.137, 0.347}, {0, 0.347}}, kSides));
  for (int side = 0; side < kSides; ++side) {
    const double angle = 2 * kPi * side / kSides;
    frame.Append(BevelledBox({0.018, 0.31, 0.018}, 0.004), HexCorner(kPostRadius, 0.2, side), angle);
    // A bar across each pane.
    const Vec3 middle = HexCorner(kPostRadius * Cos(kPi / kSides), 0.275, side + 0.5);
    frame.Append(BevelledBox({kPostRadius - 0.012, 0.009, 0.009}, 0.002), middle, angle + kPi / kSides);
  }
  frame = ScaleUvs(frame, 2.5);
  Shape knob = Lathe({{0.0, 0.545},
                      {0.014, 0.543},
                      {0.024, 0.534},
                      {0.027, 0.522},
                      {0.022, 0.510},
                      {0.014, 0.503},
                      {0.013, 0.497},
                      {0.026, 0.492},
                      {0.040, 0.482},
                      {0.044, 0.470}},
                     32, true);
  frame.Append(knob);
  const int frame_mesh = glb.AddMesh("frame", frame, copper);
  const int ring_mesh = glb.AddMesh("ring", Torus(0.048, 0.0065, 48, 16), copper);
  const Shape roof = ScaleUvs(Prism({{0.036, 0.480},
                                     {0.052, 0.462},
                                     {0.085, 0.430},
                                     {0.130, 0.398},
                                     {0.185, 0.374},
                                     {0.185, 0.366},
                                     {0.13, 0.372}},
                                    kSides),
                              2.0);
  Shape panes;
  for (int side = 0; side < kSides; ++side) {
    panes.Append(Quad(HexCorner(kPaneRadius, 0.05, side), HexCorner(kPaneRadius, 0.05, side + 1),
                      HexCorner(kPaneRadius, 0.347, side + 1), HexCorner(kPaneRadius, 0.347, side)));
  }
  const Shape candle =
      Lathe({{0, 0.168}, {0.030, 0.168}, {0.040, 0.172}, {0.045, 0.168}, {0.046, 0.155}, {0.047, 0.05}}, 40, true);
  const Shape light = Lathe({{0, 0.285},
                             {0.004, 0.268},
                             {0.010, 0.246},
                             {0.0165, 0.224},
                             {0.0195, 0.205},
                             {0.017, 0.189},
                             {0.009, 0.178},
                             {0, 0.174}},
                            24, true);

  Json lantern = {{"name", "lantern"}, {"translation", ToJson(kLanternPlace)}, {"children", Json::array()}};
  const double turn = 0.21;  // so that no face looks straight at the camera
  lantern["rotation"] = Json::array({0.0, Sin(turn / 2), 0.0, Cos(turn / 2)});
  const auto add = [&](const char* name, int mesh) {
    lantern["children"].push_back(glb.AddNode({{"name", name}, {"mesh", mesh}}));
  };
  add("frame", frame_mesh);
  add("roof", glb.AddMesh("roof", roof, paint));
  add("panes", glb.AddMesh("panes", panes, pane_glass));
  add("candle", glb.AddMesh("candle", candle, wax));
  add("flame", glb.AddMesh("flame", light, flame));
  // The ring hangs from the knob's top, upright.
  lantern["children"].push_back(glb.AddNode({{"name", "ring"},
                                             {"mesh", ring_mesh},
                                             {"translation", ToJson({0, 0.585, 0})},
                                             {"rotation", Json::array({std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5)})}}));
  glb.AddRootNode(lantern);
  AddLight(glb, "candle light", {{"type", "point"}, {"color", ToJson({1, 0.58, 0.24})}, {"intensity", 0.45}},
           {{"translation", ToJson(kLanternPlace + Vec3{0, 0.23, 0})}});
}

void AddStones(Glb& glb) {
  const int stone = AddRelief(glb, "stone", StoneColor(), StoneNormal(), StoneOrm(), 1.0);
  const Shape ball = Sphere(64, 32);
  constexpr int kColumns = 64, kRows = 32;
  Shape rock = GridSurface(kColumns, kRows, [&](double u, double v) {
    const int column = int(u * kColumns + 0.5) % kColumns, row = int(v * kRows + 0.5);
    const Vec3 p = ball.positions[std::size_t(row * (kColumns + 1) + (row == 0 || row == kRows ? 0 : column))];
    double radius = 1 + 0.22 * Fractal(p * 1.1 + Vec3{3.1, 7.7, 1.3}, 4, 0.5, 200);
    // A few blunt facets, as a hammer leaves them.
    for (int facet = 0; facet < 9; ++facet) {
      const Vec3 normal = Normalize({Hash(facet, 0, 7) - 0.5, Hash(facet, 1, 7) - 0.4, Hash(facet, 2, 7) - 0.5});
      const double reach = Dot(p, normal);
      if (reach > 0.1) radius = std::fmin(radius, 0.88 / reach);
    }
    return p * radius;
  });
  for (Vec2& uv : rock.uvs) uv.x *= 2;
  const int mesh = glb.AddMesh("stone", rock, stone);
  // Lying on its side, across the view, so that neither pole of the texture is seen; `size` is along world axes.
  const auto place = [&](const char* name, Vec3 at, double turn, Vec3 size) {
    const double s = Sin(turn / 2) * std::sqrt(0.5), c = Cos(turn / 2) * std::sqrt(0.5);
    glb.AddRootNode({{"name", name},
                     {"mesh", mesh},
                     {"translation", ToJson(at)},
                     {"rotation", Json::array({s, s, c, c})},
                     {"scale", ToJson({size.y, size.x, size.z})}});
  };
  place("large stone", {0.19, 0.095, 0.20}, 0.25, {0.19, 0.125, 0.15});
  place("small stone", {-0.01, 0.045, 0.38}, 0.12, {0.078, 0.056, 0.066});
}

void AddGlassware(Glb& glb) {
  const int amber = AddGlass(glb, "amber glass", {0.62, 0.23, 0.03}, 0.48);
  const int green = AddGlass(glb, "green glass", {0.10, 0.45, 0.22}, 0.34);
  const int gold = glb.AddMaterial(PlainMaterial("gold", {1.0, 0.77, 0.34}, 1, 0.2));
  const Shape bottle = Lathe({{0.022, 0.300},
                              {0.030, 0.297},
                              {0.031, 0.288},
                              {0.025, 0.283},
                              {0.023, 0.262},
                              {0.026, 0.235},
                              {0.045, 0.205},
                              {0.068, 0.180},
                              {0.080, 0.150},
                              {0.083, 0.110},
                              {0.083, 0.050},
                              {0.080, 0.016},
                              {0.070, 0.004},
                              {0.0, 0.002}},
                             48, true);
  glb.AddRootNode(
      {{"name", "bottle"}, {"mesh", glb.AddMesh("bottle", bottle, amber)}, {"translation", ToJson({0.36, 0, -0.20})}});
  const Shape ball = Sphere(48, 24);
  const int glass_ball = glb.AddMesh("glass ball", ball, green), gold_ball = glb.AddMesh("gold ball", ball, gold);
  const Vec3 place{-0.20, 0.075, 0.36};
  glb.AddRootNode({{"name", "glass ball"},
                   {"mesh", glass_ball},
                   {"translation", ToJson(place)},
                   {"scale", ToJson({0.075, 0.075, 0.075})}});
  glb.AddRootNode({{"name", "gold core"},
                   {"mesh", gold_ball},
                   {"translation", ToJson(place)},
                   {"scale", ToJson({0.034, 0.034, 0.034})}});
}

// A leaf of length 1 from the origin along +Y, bent towards +Z, 0.8 wide.
Shape Leaf() {
  return GridSurface(4, 8, [](double u, double v) {
    const double t = 1 - v, x = (u - 0.5) * 0.8;
    return Vec3{x, Sin(t * 0.9) / 0.9, 0.35 * t * t - 0.9 * x * x};
  });
}

void AddLeaves(Glb& glb) {
  const int texture = glb.AddTexture("leaf", LeafColor());
  const auto material = [&](const char* name, Vec3 tint) {
    Json json = PlainMaterial(name, tint, 0, 0.55);
    json["pbrMetallicRoughness"]["baseColorTexture"] = TextureInfo(texture);
    json["alphaMode"] = "MASK";
    json["doubleSided"] = true;
    return glb.AddMaterial(json);
  };
  const Json leaf = glb.MakePrimitive(Leaf(), material("green leaf", {0.36, 0.62, 0.13}));
  const auto mesh_with = [&](const char* name, int leaf_material) {
    Json primitive = leaf;
    primitive["material"] = leaf_material;
    return glb.Add("meshes", {{"name", name}, {"primitives", Json::array({primitive})}});
  };
  const int green = glb.Add("meshes", {{"name", "green leaf"}, {"primitives", Json::array({leaf})}});
  const int amber = mesh_with("amber leaf", material("amber leaf", {0.95, 0.50, 0.09}));
  const int red = mesh_with("red leaf", material("red leaf", {0.80, 0.13, 0.06}));

  // A twig in the bottle.
  const Vec3 root{0.36, 0.02, -0.20};
  const auto twig = [&](double t) {
    return root + Vec3{0.02 * Sin(t * 4) + 0.05 * t * t, 0.55 * t, 0.03 * t - 0.04 * t * t};
  };
  const int bark = glb.AddMaterial(PlainMaterial("bark", {0.20, 0.12, 0.06}, 0, 0.8));
  glb.AddRootNode({{"name", "twig"},
                   {"mesh", glb.AddMesh("twig",
                                        Tube(
                                            twig, [](double t) { return 0.006 - 0.0045 * t; }, 8, 24),
                                        bark)}});
  const auto place = [&](const std::string& name, int mesh, Vec3 at, Vec3 along, Vec3 facing, double size) {
    const Vec3 y = Normalize(along), x = Normalize(Cross(y, facing)), z = Cross(x, y);
    glb.AddRootNode({{"name", name},
                     {"mesh", mesh},
                     {"matrix", Json::array({x.x * size, x.y * size, x.z * size, 0, y.x * size, y.y * size, y.z * size,
                                             0, z.x * size, z.y * size, z.z * size, 0, at.x, at.y, at.z, 1})}});
  };
  constexpr int kLeaves = 13;
  for (int i = 0; i < kLeaves; ++i) {
    const double t = 0.56 + 0.44 * i / (kLeaves - 1), turn = i * 2.399963;  // the golden angle
    const double lift = 0.35 + 0.9 * (t - 0.56);
    place("twig leaf " + std::to_string(i), green, twig(t), {Sin(turn), lift, Cos(turn)},
          {-0.6 * Sin(turn), 1, -0.6 * Cos(turn)}, 0.115 - 0.04 * (t - 0.56));
  }
  struct Fallen {
    double x, z, turn, size;
    int mesh;
  };
  const std::array<Fallen, 8> fallen = {{{0.42, 0.34, 0.4, 0.10, amber},
                                         {-0.42, 0.28, 2.2, 0.11, red},
                                         {-0.52, -0.06, 4.0, 0.10, amber},
                                         {0.52, 0.08, 5.2, 0.11, red},
                                         {0.20, 0.50, 3.1, 0.09, red},
                                         {-0.05, 0.56, 1.2, 0.10, amber},
                                         {0.16, -0.46, 1.9, 0.10, amber},
                                         {-0.36, -0.42, 0.3, 0.11, red}}};
  int number = 0;
  for (const Fallen& leaf_at : fallen) {
    place("fallen leaf " + std::to_string(number++), leaf_at.mesh, {leaf_at.x, 0.012, leaf_at.z},
          {Sin(leaf_at.turn), 0.06, Cos(leaf_at.turn)}, {0.1, 1, 0.05}, leaf_at.size);
  }
}

}  // namespace

Glb Showcase() {
  Glb glb("showcase");
  AddFloor(glb);
  AddLantern(glb);
  AddStones(glb);
  AddGlassware(glb);
  AddLeaves(glb);
  AddPerspectiveCamera(glb, "still life", {0.50, 0.80, 1.84}, {0.0, 0.170, 0.0}, 0.575);
  return glb;
}

}  // namespace facet::assets
