// A showpiece: what the material extensions are for, on a photographer's backdrop in the built-in studio.

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "baking.h"
#include "facet/shader/elementary_double.h"
#include "gallery_shapes.h"
#include "gallery_textures.h"
#include "image.h"
#include "scenes.h"

namespace facet::assets {
namespace {

constexpr double kWallDistance = 1.25, kSweep = 0.75;  // the backdrop's wall, and the radius with which it rises
constexpr double kBackdropHalfWidth = 2.4, kBackdropFront = 1.9, kBackdropHeight = 1.9;

constexpr Vec3 kLampPlace{0.25, 0.64, -0.55};
constexpr double kLampRadius = 0.265;
constexpr Vec3 kTeapotPlace{-0.10, 0.075, 0.14};
constexpr Vec3 kGobletPlace{0.29, 0.375, -0.08};
constexpr Vec3 kDrapePlace{-0.55, 0, -0.16};
constexpr double kDrapeRadius = 0.155, kDrapeHeight = 0.33;
constexpr Vec3 kBowlPlace{-0.55, kDrapeHeight + 0.006, -0.16};
constexpr Vec3 kGemPlace{0.585, 0.16, 0.20};

Json TextureInfo(int texture) { return {{"index", texture}}; }

Json Extended(Glb& glb, Json material, const std::string& name, Json value) {
  glb.UseExtension("KHR_materials_" + name);
  material["extensions"]["KHR_materials_" + name] = std::move(value);
  return material;
}

class GalleryMaker {
 public:
  GalleryMaker() : glb_("gallery") {}

  Glb Make() {
    PlanPlinth("low plinth", {kTeapotPlace.x, 0, kTeapotPlace.z}, 0.25, kTeapotPlace.y, {0.66, 0.55, 0.42});
    PlanPlinth("tall plinth", {kGobletPlace.x, 0, kGobletPlace.z}, 0.115, kGobletPlace.y, {0.72, 0.61, 0.47});
    PlanPlinth("small plinth", {kGemPlace.x, 0, kGemPlace.z}, 0.12, kGemPlace.y, {0.66, 0.55, 0.42});
    AddTeapot();
    AddGoblet();
    AddDrape();
    AddBowl();
    AddLamp();
    AddGem();
    AddRing();
    AddPearls();
    AddBubbles();
    // When all that blocks light is known, the surfaces that it falls on.
    AddPlinths();
    AddBackdrop();
    AddPerspectiveCamera(glb_, "gallery", {0.0, 0.78, 2.62}, {0.0, 0.41, 0.0}, 0.44);
    return std::move(glb_);
  }

 private:
  struct Plinth {
    std::string name;
    std::vector<Vec2> profile;
    Vec3 place, color;
    int blocker = 0;
  };

  int Mesh(const std::string& name, const Shape& shape, Json material) {
    return glb_.AddMesh(name, shape, glb_.AddMaterial(std::move(material)));
  }

  void Place(const std::string& name, int mesh, Vec3 at, Vec3 scale = {1, 1, 1}) {
    Json node = {{"name", name}, {"mesh", mesh}, {"translation", ToJson(at)}};
    if (scale.x != 1 || scale.y != 1 || scale.z != 1) node["scale"] = ToJson(scale);
    glb_.AddRootNode(std::move(node));
  }

  void Block(Vec3 place, const std::vector<Vec2>& profile, double opacity = 1) {
    blockers_.push_back({place, profile, opacity});
  }

  void PlanPlinth(const std::string& name, Vec3 place, double radius, double height, Vec3 color) {
    constexpr double kEdge = 0.005;
    const std::vector<Vec2> profile = {{0, height},
                                       {radius - kEdge, height},
                                       {radius - 0.3 * kEdge, height - 0.3 * kEdge},
                                       {radius, height - kEdge},
                                       {radius, 0}};
    plinths_.push_back({name, profile, place, color, int(blockers_.size())});
    Block(place, profile);
  }

  void AddPlinths() {
    for (const Plinth& plinth : plinths_) {
      const int segments = int(plinth.profile.size()) - 1;
      const auto surface = [&](double u, double v) {
        const int j = std::min(int(v * segments), segments - 1);
        const double t = v * segments - j;
        const Vec2 a = plinth.profile[std::size_t(j)], b = plinth.profile[std::size_t(j) + 1];
        const double radius = a.x + (b.x - a.x) * t, height = a.y + (b.y - a.y) * t;
        const double s = Sin(2 * kPi * u), c = Cos(2 * kPi * u);
        const Vec3 normal = Normalize({(a.y - b.y) * s, b.x - a.x, (a.y - b.y) * c});
        return SurfacePoint{plinth.place + Vec3{radius * s, height, radius * c}, normal};
      };
      Json material = PlainMaterial(plinth.name.c_str(), plinth.color, 0, 0.75);
      material["occlusionTexture"] =
          TextureInfo(glb_.AddTexture(plinth.name + " light", BakeOcclusion(128, surface, blockers_, plinth.blocker)));
      Place(plinth.name, Mesh(plinth.name, Lathe(plinth.profile, 96, false), material), plinth.place);
    }
  }

  void AddBackdrop() {
    const double floor = kBackdropFront + kWallDistance - kSweep, arc = kSweep * kPi / 2;
    const double wall = kBackdropHeight - kSweep, length = floor + arc + wall;
    // u to the right, v from the wall's top to the front edge.
    const auto surface = [=](double u, double v) {
      const double x = (2 * u - 1) * kBackdropHalfWidth, s = (1 - v) * length;
      if (s < floor) return SurfacePoint{{x, 0, kBackdropFront - s}, {0, 1, 0}};
      if (s > floor + arc) return SurfacePoint{{x, kSweep + s - floor - arc, -kWallDistance}, {0, 0, 1}};
      const double angle = (s - floor) / kSweep, sine = Sin(angle), cosine = Cos(angle);
      return SurfacePoint{{x, kSweep * (1 - cosine), -kWallDistance + kSweep * (1 - sine)}, {0, cosine, sine}};
    };
    Shape shape = GridSurface(2, 96, [&](double u, double v) { return surface(u, v).position; });
    for (std::size_t i = 0; i < shape.normals.size(); ++i) {
      shape.normals[i] = surface(shape.uvs[i].x, shape.uvs[i].y).normal;
    }
    Json material = PlainMaterial("backdrop", {0.040, 0.125, 0.145}, 0, 0.8);
    material["occlusionTexture"] =
        TextureInfo(glb_.AddTexture("backdrop light", BakeOcclusion(256, surface, blockers_, -1)));
    Place("backdrop", Mesh("backdrop", shape, material), {});
  }

  // Car paint: metal flakes under clear lacquer.
  void AddTeapot() {
    Json paint = PlainMaterial("car paint", {0.46, 0.008, 0.013}, 0.9, 0.42);
    paint["normalTexture"] = {{"index", glb_.AddTexture("flakes", FlakeNormal())}, {"scale", 1.0}};
    paint = Extended(glb_, paint, "clearcoat",
                     {{"clearcoatFactor", 1.0},
                      {"clearcoatRoughnessFactor", 0.02},
                      {"clearcoatNormalTexture", TextureInfo(glb_.AddTexture("orange peel", OrangePeelNormal()))}});
    const TeapotShape teapot = Teapot();
    const double turn = -0.42;
    glb_.AddRootNode({{"name", "teapot"},
                      {"mesh", Mesh("teapot", teapot.shape, paint)},
                      {"translation", ToJson(kTeapotPlace)},
                      {"rotation", Json::array({0.0, Sin(turn / 2), 0.0, Cos(turn / 2)})}});
    Block(kTeapotPlace, teapot.outline);
    const Vec3 along{Cos(turn), 0, -Sin(turn)};
    Block(kTeapotPlace + along * 0.19, {{0, 0.16}, {0.03, 0.12}, {0.02, 0.08}, {0, 0.07}}, 0.9);
    Block(kTeapotPlace - along * 0.20, {{0, 0.18}, {0.025, 0.12}, {0, 0.05}}, 0.5);
  }

  Json Glass(const char* name, double ior, double thickness) {
    Json glass = PlainMaterial(name, {1, 1, 1}, 0, 0);
    glass = Extended(glb_, glass, "transmission", {{"transmissionFactor", 1.0}});
    glass = Extended(glb_, glass, "ior", {{"ior", ior}});
    return Extended(glb_, glass, "volume", {{"thicknessFactor", thickness}});
  }

  // A goblet with mead in it. The glass is a thin wall, the drink fills it.
  void AddGoblet() {
    constexpr double kWall = 0.0028;
    const std::vector<Vec2> outside = {
        {0.0505, 0.300}, {0.0555, 0.275}, {0.0635, 0.240}, {0.0680, 0.208}, {0.0640, 0.176}, {0.0500, 0.152},
        {0.0270, 0.136}, {0.0110, 0.127}, {0.0065, 0.110}, {0.0055, 0.070}, {0.0068, 0.030}, {0.0120, 0.015},
        {0.0300, 0.008}, {0.0540, 0.004}, {0.0570, 0.002}, {0.0550, 0.000}, {0.0, 0.0}};
    std::vector<Vec2> inside = {{0, 0.138}, {0.020, 0.1395}};
    for (int i = 5; i >= 0; --i) {
      inside.push_back({outside[std::size_t(i)].x - kWall, outside[std::size_t(i)].y + (i == 5 ? 0.003 : 0)});
    }
    std::vector<Vec2> profile = SmoothProfile(inside, 3);
    profile.push_back({0.0493, 0.3012});
    const std::vector<Vec2> outer = SmoothProfile(outside, 4);
    profile.insert(profile.end(), outer.begin(), outer.end());
    Place("goblet", Mesh("goblet", Lathe(profile, 72, true), Glass("clear glass", 1.5, kWall)), kGobletPlace);

    Json mead = Glass("mead", 1.36, 0.07);
    Json& volume = mead["extensions"]["KHR_materials_volume"];
    volume["attenuationColor"] = ToJson({0.95, 0.42, 0.07});
    volume["attenuationDistance"] = 0.10;
    constexpr double kLevel = 0.236;
    std::vector<Vec2> fill;
    for (const Vec2& p : SmoothProfile(inside, 3)) {
      if (p.y < kLevel) fill.push_back({std::fmax(p.x - 0.0006, 0.0), p.y + 0.0006});
    }
    Shape drink = Lathe({{0, kLevel}, {fill.back().x, kLevel}}, 72, false);
    drink.Append(Lathe({fill.rbegin(), fill.rend()}, 72, true));
    Place("mead", Mesh("mead", drink, mead), kGobletPlace);
    Block(kGobletPlace, outer, 0.45);
  }

  // A square cloth over a round stand, falling in folds.
  void AddDrape() {
    constexpr int kFolds = 9;
    constexpr double kRound = 0.022;          // of the edge
    const auto depth_of = [](double angle) {  // how far the hem hangs: corners hang lower
      const double c = std::fabs(Cos(angle - 0.5)), s = std::fabs(Sin(angle - 0.5));
      return std::fmin(0.315 / std::fmax(c, s), 0.43);
    };
    const auto wave = [](double angle) {  // of the folds, -1 to 1, with crests narrower than valleys
      const double phase = kFolds * angle + 0.9 * Sin(angle * 2 + 0.4) + 0.5 * Sin(3 * angle);
      const double w = 0.5 + 0.5 * Sin(phase);
      return 2 * w * w * (1.5 - 0.5 * w) - 1;
    };
    constexpr double kFlatPart = 0.12, kRoundPart = 0.30;  // of v, at the end of the flat part and of the edge
    const auto surface = [&](double u, double v) {
      const double angle = (u == 1.0 ? 0.0 : u) * 2 * kPi, flat = kDrapeRadius - kRound;
      double radius = flat * v / kFlatPart, height = kDrapeHeight + 0.004, fall = 0;
      if (v > kRoundPart) {
        fall = (v - kRoundPart) / (1 - kRoundPart) * (depth_of(angle) - kRound);
        radius = kDrapeRadius;
        height -= kRound + fall;
      } else if (v > kFlatPart) {
        const double bend = (v - kFlatPart) / (kRoundPart - kFlatPart) * kPi / 2;
        radius = flat + kRound * Sin(bend);
        height -= kRound * (1 - Cos(bend));
      }
      const double open = fall / 0.35;
      radius += (0.045 + 0.052 * wave(angle)) * open * (1.6 - 0.6 * std::fmin(open, 1.0));
      height = std::fmax(height, 0.004);
      return Vec3{radius * Sin(angle), height, radius * Cos(angle)};
    };
    Shape cloth = GridSurface(180, 44, surface);
    Json velvet = PlainMaterial("velvet", {0.085, 0.010, 0.10}, 0, 0.9);
    velvet["doubleSided"] = true;
    velvet = Extended(glb_, velvet, "sheen",
                      {{"sheenColorFactor", ToJson({0.75, 0.32, 0.85})}, {"sheenRoughnessFactor", 0.35}});
    const auto occlusion = [&](double u, double v) {
      if (v < kFlatPart) return 0.35 + 0.65 * SmoothStep(0.3, 0.95, v / kFlatPart);  // under the bowl
      // Valleys between folds are darker, and darker below.
      const double below = SmoothStep(0.3, 1.1, v), angle = 2 * kPi * u;
      const double valley = 0.5 - 0.5 * wave(angle);
      return 1 - below * (0.25 + 0.65 * valley);
    };
    velvet["occlusionTexture"] = TextureInfo(glb_.AddTexture("velvet light", PngImage(128, [&](double u, double v) {
                                                               const double left = occlusion(u, v);
                                                               return Vec3{left, left, left};
                                                             })));
    Place("drape", Mesh("drape", cloth, velvet), kDrapePlace);
    Block(kDrapePlace, {{0, kDrapeHeight}, {kDrapeRadius, kDrapeHeight}, {kDrapeRadius + 0.06, 0.1}, {0, 0.09}});
    Block(kDrapePlace, {{0, 0.1}, {kDrapeRadius, 0.09}, {kDrapeRadius, 0}});
  }

  // A bowl of spun steel: the grooves run around it.
  void AddBowl() {
    Json steel = PlainMaterial("brushed steel", {0.78, 0.76, 0.73}, 1, 0.42);
    steel["pbrMetallicRoughness"]["metallicRoughnessTexture"] =
        TextureInfo(glb_.AddTexture("grooves", GrooveRoughness()));
    steel = Extended(glb_, steel, "anisotropy", {{"anisotropyStrength", 0.85}, {"anisotropyRotation", kPi / 2}});
    const std::vector<Vec2> outside = {{0.1300, 0.112}, {0.1265, 0.096}, {0.1150, 0.066},
                                       {0.0940, 0.040}, {0.0640, 0.022}, {0.0480, 0.016},
                                       {0.0460, 0.006}, {0.0500, 0.000}, {0.0, 0.0}};
    const std::vector<Vec2> inside = {{0, 0.024},      {0.035, 0.026},  {0.0640, 0.034}, {0.0910, 0.050},
                                      {0.1105, 0.074}, {0.1215, 0.100}, {0.1262, 0.1135}};
    std::vector<Vec2> profile = SmoothProfile(inside, 3);
    profile.push_back({0.1282, 0.1150});
    const std::vector<Vec2> outer = SmoothProfile(outside, 4);
    profile.insert(profile.end(), outer.begin(), outer.end());
    const double turn = 2.0;  // the seam of the texture coordinates to the back
    glb_.AddRootNode({{"name", "bowl"},
                      {"mesh", Mesh("bowl", Turned(profile, 80, 1, 4), steel)},
                      {"translation", ToJson(kBowlPlace)},
                      {"rotation", Json::array({0.0, Sin(turn / 2), 0.0, Cos(turn / 2)})}});
    Block(kBowlPlace, outer);
  }

  // A paper lantern with ribs; the light inside shines through the paper.
  void AddLamp() {
    constexpr int kRibs = 13, kPiecesPerRib = 4, kPieces = kRibs * kPiecesPerRib;
    std::vector<Vec2> profile;
    for (int i = 0; i <= kPieces; ++i) {
      const double phi = kPi * (0.07 + 0.86 * i / kPieces);
      const double part = double(i % kPiecesPerRib) / kPiecesPerRib;
      const double radius = kLampRadius * (1 + 0.026 * Sin(kPi * part));
      profile.push_back({radius * Sin(phi), radius * Cos(phi) * 0.96});
    }
    Json paper = PlainMaterial("paper", {0.66, 0.56, 0.44}, 0, 0.9);
    paper["doubleSided"] = true;
    const Json fibres = TextureInfo(glb_.AddTexture("paper", PaperColor()));
    paper["pbrMetallicRoughness"]["baseColorTexture"] = fibres;
    paper = Extended(glb_, paper, "diffuse_transmission",
                     {{"diffuseTransmissionFactor", 0.75},
                      {"diffuseTransmissionColorFactor", ToJson({1, 0.84, 0.62})},
                      {"diffuseTransmissionColorTexture", fibres}});
    Shape lantern = Lathe(profile, 64, true);
    for (Vec2& uv : lantern.uvs) uv = {uv.x * 3, uv.y * kRibs};
    Place("lantern", Mesh("lantern", lantern, paper), kLampPlace);
    const double top = profile.front().y;
    Shape wire = Lathe({{0.003, 1.6}, {0.003, top + 0.012}}, 12, true);
    wire.Append(Lathe({{0.0, top + 0.016}, {profile.front().x, top + 0.010}, {profile.front().x + 0.002, top - 0.004}},
                      48, false));
    Place("wire", Mesh("wire", wire, PlainMaterial("wire", {0.03, 0.03, 0.03}, 0, 0.5)), kLampPlace);
    AddLight(glb_, "lantern light", {{"type", "point"}, {"color", ToJson({1, 0.60, 0.27})}, {"intensity", 0.21}},
             {{"translation", ToJson(kLampPlace + Vec3{0, -0.09, 0})}});
    Block(kLampPlace, profile, 0.8);
  }

  // A brilliant, lying on its side.
  void AddGem() {
    Json glass = Glass("cut crystal", 1.9, 0.8);
    glass = Extended(glb_, glass, "dispersion", {{"dispersion", 3.0}});
    const double tilt = 0.80;
    glb_.AddRootNode({{"name", "crystal"},
                      {"mesh", Mesh("crystal", Brilliant(), glass)},
                      {"translation", ToJson(kGemPlace + Vec3{0, 0.062, 0})},
                      {"rotation", Json::array({Sin(tilt / 2), 0.0, 0.0, Cos(tilt / 2)})},
                      {"scale", ToJson({0.09, 0.09, 0.09})}});
    Block(kGemPlace, {{0, 0.11}, {0.07, 0.06}, {0.02, 0.0}}, 0.4);
  }

  // A ring of blue glass, leaning on the tall plinth.
  void AddRing() {
    Json glass = Glass("blue glass", 1.5, 0.035);
    Json& volume = glass["extensions"]["KHR_materials_volume"];
    volume["attenuationColor"] = ToJson({0.20, 0.62, 0.80});
    volume["attenuationDistance"] = 0.06;
    constexpr double kRing = 0.085, kTube = 0.026;
    const double lean = kPi / 2 - 0.30;
    glb_.AddRootNode({{"name", "ring"},
                      {"mesh", Mesh("ring", Torus(kRing, kTube, 72, 32), glass)},
                      {"translation", ToJson({0.335, (kRing * Sin(lean)) + kTube, 0.092})},
                      {"rotation", Json::array({Sin(lean / 2), 0.0, 0.0, Cos(lean / 2)})}});
    Block({0.335, 0, 0.10}, {{0, 0.06}, {0.05, 0.03}, {0.04, 0.0}}, 0.5);
  }

  // Metal with a film on it.
  void AddPearls() {
    const Shape ball = Sphere(64, 32);
    const auto place = [&](const std::string& name, Vec3 at, double radius, int mesh) {
      Place(name, mesh, at, Vec3{1, 1, 1} * radius);
      Block(at, {{0, radius}, {0.7 * radius, 0.7 * radius}, {radius, 0}, {0.7 * radius, -0.7 * radius}, {0, -radius}});
    };
    const auto film = [&](const char* name, double thickness) {
      Json metal = PlainMaterial(name, {0.62, 0.60, 0.58}, 1, 0.13);
      metal =
          Extended(glb_, metal, "iridescence",
                   {{"iridescenceFactor", 1.0}, {"iridescenceIor", 1.9}, {"iridescenceThicknessMaximum", thickness}});
      Json primitive = ball_.is_null() ? ball_ = glb_.MakePrimitive(ball, 0) : ball_;
      primitive["material"] = glb_.AddMaterial(metal);
      return glb_.Add("meshes", {{"name", name}, {"primitives", Json::array({primitive})}});
    };
    const int green = film("green pearl", 480), blue = film("blue pearl", 255), gold = film("gold pearl", 330);
    place("green pearl", {-0.47, 0.052, 0.34}, 0.052, green);
    place("gold pearl", {-0.365, 0.036, 0.44}, 0.036, gold);
    place("blue pearl", {-0.585, 0.028, 0.42}, 0.028, blue);
    place("gold pearl in the bowl", kBowlPlace + Vec3{-0.040, 0.082, 0.020}, 0.044, gold);
    place("blue pearl in the bowl", kBowlPlace + Vec3{0.046, 0.080, 0.020}, 0.040, blue);
    place("green pearl in the bowl", kBowlPlace + Vec3{0.004, 0.086, -0.050}, 0.046, green);
  }

  // A film of soap and nothing inside: the air's index of refraction under the film's.
  void AddBubbles() {
    Json soap = PlainMaterial("soap", {1, 1, 1}, 0, 0);
    soap["doubleSided"] = true;
    soap = Extended(glb_, soap, "transmission", {{"transmissionFactor", 1.0}});
    soap = Extended(glb_, soap, "ior", {{"ior", 1.0}});
    soap = Extended(glb_, soap, "iridescence",
                    {{"iridescenceFactor", 1.0},
                     {"iridescenceIor", 1.45},
                     {"iridescenceThicknessMinimum", 120.0},
                     {"iridescenceThicknessMaximum", 720.0},
                     {"iridescenceThicknessTexture", TextureInfo(glb_.AddTexture("soap film", SoapThickness()))}});
    Json primitive = ball_;
    primitive["material"] = glb_.AddMaterial(soap);
    const int mesh = glb_.Add("meshes", {{"name", "bubble"}, {"primitives", Json::array({primitive})}});
    Place("large bubble", mesh, {-0.20, 0.62, 0.05}, Vec3{1, 1, 1} * 0.125);
    Place("bubble", mesh, {-0.40, 0.80, -0.10}, Vec3{1, 1, 1} * 0.062);
    Place("small bubble", mesh, {0.62, 0.56, 0.10}, Vec3{1, 1, 1} * 0.075);
  }

  Glb glb_;
  Json ball_;
  std::vector<Blocker> blockers_;
  std::vector<Plinth> plinths_;
};

}  // namespace

Glb Gallery() { return GalleryMaker().Make(); }

}  // namespace facet::assets
