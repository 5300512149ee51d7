// Lamps of KHR_lights_punctual on a wall, and what glTF's material makes of them, pixel by pixel.
#include <gtest/gtest.h>

#include <algorithm>

#include "oracle/brdf.h"
#include "oracle/gltf_file.h"

namespace oracle {
namespace {

constexpr int kSize = 12;
constexpr double kHalf = 2.0;
constexpr Vec kNormal{0, 0, 1};

std::string Material(const Surface& s) {
  return R"({"pbrMetallicRoughness":{"baseColorFactor":)" + List({s.base.x, s.base.y, s.base.z, 1.0}) +
         R"(,"metallicFactor":)" + Number(s.metallic) + R"(,"roughnessFactor":)" + Number(s.roughness) + "}}";
}

// What arrives at a place of the wall.
struct Arriving {
  Vec toward, irradiance;  // unit, to the lamp; on a surface that faces it
};

// A wall at z = 0, seen straight on, whose light is the sum of what arrives.
void ExpectWall(GltfFile& file, const Surface& surface, const std::function<std::vector<Arriving>(Vec)>& arriving) {
  AddSquare(file, kHalf, Material(surface));
  AddStraightCamera(file, kHalf);
  const Image image = Draw(file, kSize, kSize);
  double brightest = 0.0;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      Vec expected;
      for (const Arriving& light : arriving(StraightPlace(x, y, kSize, kHalf))) {
        expected = expected + Reflect(surface, kNormal, {0, 0, 1}, light.toward) * light.irradiance;
      }
      ExpectColor(image, x, y, expected, kLitTolerance, kLitFloor);
      brightest = std::max(brightest, expected.y);
    }
  }
  EXPECT_GT(brightest, 0.01);
}

const Surface kPaint{{0.8, 0.5, 0.2}, 0.0, 0.9};

// 3.1: lux, from where its node's -Z points away.
TEST(Lamp, Directional) {
  const Vec axis = {1.0, 0.4, 0.2};
  const double angle = 0.9;
  GltfFile file;
  file.Light(R"({"type":"directional","color":[1,0.5,0.25],"intensity":3})",
             R"(,"translation":[5,5,-7],"rotation":)" + Numbers(Turn(axis, angle)));
  ExpectWall(file, kPaint, [&](Vec) {
    return std::vector<Arriving>{{-Rotated({0, 0, -1}, axis, angle), Vec{1, 0.5, 0.25} * 3.0}};
  });
}

// Two lights add up; the one from behind gives nothing.
TEST(Lamp, SeveralAddUp) {
  GltfFile file;
  file.Light(R"({"type":"directional","intensity":2})", R"(,"rotation":)" + Numbers(Turn({1, 0, 0}, -0.5)));
  file.Light(R"({"type":"point","intensity":7})", R"(,"translation":[1,-0.5,1.2])");
  file.Light(R"({"type":"point","intensity":50})", R"(,"translation":[0,0,-1])");
  ExpectWall(file, kPaint, [&](Vec at) {
    const Vec away = Vec{1, -0.5, 1.2} - at;
    return std::vector<Arriving>{{-Rotated({0, 0, -1}, {1, 0, 0}, -0.5), {2, 2, 2}},
                                 {Unit(away), Vec{1, 1, 1} * (7.0 / Dot(away, away))}};
  });
}

// 3.2: candela over the square of the distance, which the node's scale and its parents' do not change.
TEST(Lamp, Point) {
  GltfFile file;
  file.Light(R"({"type":"point","color":[0.5,1,0.75],"intensity":12})", R"(,"translation":[0.3,-0.4,0.8])");
  const int parent = file.Add("nodes", R"({"children":[0],"scale":[2,1,1.5],"translation":[0.1,0,0.2]})");
  file.Roots({parent, parent + 1, parent + 2});
  ExpectWall(file, kPaint, [&](Vec at) {
    const Vec away = Vec{0.7, -0.4, 1.4} - at;
    return std::vector<Arriving>{{Unit(away), Vec{0.5, 1, 0.75} * (12.0 / Dot(away, away))}};
  });
}

// "Range Property": windowed by max(min(1 - (distance / range)^4, 1), 0).
TEST(Lamp, RangeOfAPoint) {
  constexpr double kRange = 1.9;
  GltfFile file;
  file.Light(R"({"type":"point","intensity":9,"range":1.9})", R"(,"translation":[-0.5,0.2,1])");
  ExpectWall(file, kPaint, [&](Vec at) {
    const Vec away = Vec{-0.5, 0.2, 1} - at;
    const double window = std::clamp(1.0 - std::pow(Length(away) / kRange, 4.0), 0.0, 1.0);
    return std::vector<Arriving>{{Unit(away), Vec{1, 1, 1} * (9.0 * window / Dot(away, away))}};
  });
}

// 3.3 and "Inner and Outer Cone Angles": the square of a ramp between the angles' cosines.
void ExpectSpot(double inner, double outer, bool default_cone) {
  const Vec place = {0.6, 0.5, 2.2}, axis = {0.8, -0.6, 0.1};
  const double angle = 0.35;
  GltfFile file;
  const std::string cone =
      default_cone ? "{}" : R"({"innerConeAngle":)" + Number(inner) + R"(,"outerConeAngle":)" + Number(outer) + "}";
  file.Light(R"({"type":"spot","intensity":20,"range":6,"spot":)" + cone + "}",
             R"(,"scale":[3,3,3],"translation":)" + Numbers(place) + R"(,"rotation":)" + Numbers(Turn(axis, angle)));
  ExpectWall(file, kPaint, [&](Vec at) {
    const Vec away = place - at;
    const double cosine = Dot(Rotated({0, 0, -1}, axis, angle), -Unit(away));
    const double ramp = std::clamp((cosine - std::cos(outer)) / (std::cos(inner) - std::cos(outer)), 0.0, 1.0);
    const double window = std::clamp(1.0 - std::pow(Length(away) / 6.0, 4.0), 0.0, 1.0);
    return std::vector<Arriving>{{Unit(away), Vec{1, 1, 1} * (20.0 * ramp * ramp * window / Dot(away, away))}};
  });
}
TEST(Lamp, Spot) { ExpectSpot(0.2, 0.6, false); }
TEST(Lamp, SpotWithTheDefaultCone) { ExpectSpot(0.0, kPi / 4.0, true); }

// Dielectrics, metals and mixtures, smooth and rough, where the lamp's reflection is seen and where it is not.
TEST(Material, EveryMixtureUnderALamp) {
  for (const double metallic : {0.0, 0.35, 1.0}) {
    for (const double roughness : {0.3, 0.6, 1.0}) {
      SCOPED_TRACE("metallic " + Number(metallic) + ", roughness " + Number(roughness));
      GltfFile file;
      file.Light(R"({"type":"point","intensity":10})", R"(,"translation":[0.4,0.3,1.5])");
      ExpectWall(file, {{0.9, 0.4, 0.1}, metallic, roughness}, [&](Vec at) {
        const Vec away = Vec{0.4, 0.3, 1.5} - at;
        return std::vector<Arriving>{{Unit(away), Vec{1, 1, 1} * (10.0 / Dot(away, away))}};
      });
    }
  }
}

// The same at an angle: a perspective camera close to the wall, under which view and half vectors turn.
TEST(Material, SeenAtAnAngle) {
  const Vec eye = {1.1, -0.9, 0.7}, axis = {0.7, 0.6, 0.1};
  constexpr double kAngle = 1.0, kFieldOfView = 1.1;
  const Surface surface{{0.6, 0.7, 0.9}, 0.2, 0.45};
  GltfFile file;
  file.Light(R"({"type":"point","intensity":6})", R"(,"translation":[-1.2,1.3,0.9])");
  AddSquare(file, 8.0, Material(surface));
  file.Add("cameras", R"({"type":"perspective","perspective":{"yfov":1.1,"aspectRatio":1,"znear":0.01}})");
  file.Add("nodes",
           R"({"camera":0,"translation":)" + Numbers(eye) + R"(,"rotation":)" + Numbers(Turn(axis, kAngle)) + "}");
  const Image image = Draw(file, kSize, kSize);
  int seen = 0;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const double reach = std::tan(0.5 * kFieldOfView);
      const Vec ray = Rotated({(2.0 * (x + 0.5) / kSize - 1.0) * reach, (1.0 - 2.0 * (y + 0.5) / kSize) * reach, -1.0},
                              axis, kAngle);
      const Vec at = eye + ray * (-eye.z / ray.z);
      if (ray.z > -0.05 || std::fabs(at.x) > 7.9 || std::fabs(at.y) > 7.9) continue;
      const Vec away = Vec{-1.2, 1.3, 0.9} - at;
      ExpectColor(image, x, y, Reflect(surface, kNormal, -Unit(ray), Unit(away)) * (6.0 / Dot(away, away)),
                  kLitTolerance, kLitFloor);
      ++seen;
    }
  }
  EXPECT_GT(seen, kSize * kSize / 3);
}

// 3.9.2: factor times texture (none: 1) times strength, added to what is reflected, in any light.
TEST(Material, Emission) {
  const Surface surface{{0.5, 0.5, 0.5}, 0.0, 1.0};
  GltfFile file;
  file.Use("KHR_materials_emissive_strength");
  file.Light(R"({"type":"directional","intensity":2})", "");
  AddSquare(
      file, kHalf,
      R"({"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.5,0.5,1],"metallicFactor":0},)"
      R"("emissiveFactor":[0.1,0.6,1],"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":3.5}}})");
  AddStraightCamera(file, kHalf);
  const Image image = Draw(file, 4, 4);
  ExpectColor(image, 1, 2, Vec{0.35, 2.1, 3.5} + Reflect(surface, kNormal, {0, 0, 1}, {0, 0, 1}) * 2.0, kLitTolerance,
              kLitFloor);
}

// KHR_materials_unlit: base colour, whatever the light. The default material (3.9): white metal, rough.
TEST(Material, UnlitAndDefault) {
  GltfFile unlit;
  unlit.Use("KHR_materials_unlit");
  unlit.Light(R"({"type":"directional","intensity":5})", "");
  AddSquare(unlit, kHalf,
            R"({"pbrMetallicRoughness":{"baseColorFactor":[0.2,0.55,0.9,1]},"extensions":{"KHR_materials_unlit":{}}})");
  AddStraightCamera(unlit, kHalf);
  ExpectColor(Draw(unlit, 4, 4), 2, 1, {0.2, 0.55, 0.9}, 1e-6);

  GltfFile plain;
  plain.Light(R"({"type":"directional","intensity":5})", R"(,"rotation":)" + Numbers(Turn({0, 1, 0}, 0.7)));
  AddSquare(plain, kHalf, "{}");
  AddStraightCamera(plain, kHalf);
  const Vec toward = -Rotated({0, 0, -1}, {0, 1, 0}, 0.7);
  ExpectColor(Draw(plain, 4, 4), 2, 1, Reflect({}, kNormal, {0, 0, 1}, toward) * 5.0, kLitTolerance, kLitFloor);
}

}  // namespace
}  // namespace oracle
