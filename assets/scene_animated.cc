#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "facet/shader/elementary_double.h"
#include "image.h"
#include "scenes.h"

namespace facet::assets {
namespace {

constexpr double kDuration = 4.0;  // seconds; every animation comes back to where it began

int AddSampler(Json& samplers, Glb& glb, const std::vector<float>& times, const std::vector<float>& values, int width,
               const char* interpolation) {
  samplers.push_back({{"input", glb.AddFloats(times, 1, true)},
                      {"output", glb.AddFloats(values, width)},
                      {"interpolation", interpolation}});
  return int(samplers.size()) - 1;
}

Json Channel(int sampler, int node, const char* path) {
  return {{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}};
}

// A tube over a chain of joints that sway one after another: cubic splines of rotations.
void AddTentacle(Glb& glb, Json& channels, Json& samplers) {
  constexpr int kJoints = 7, kKeys = 9;
  constexpr double kLink = 0.22, kHeight = kLink * (kJoints - 1);
  Shape tube = Tube(
      [](double t) {
        return Vec3{0, t * kHeight, 0};
      },
      [](double t) { return 0.14 * (1 - t) + 0.035 * (1 - t * t * t) + 0.004; }, 20, 36);
  for (const Vec3& p : tube.positions) {
    const double at = std::clamp(p.y / kLink, 0.0, kJoints - 1.0);
    const int low = std::min(int(at), kJoints - 2);
    const float upper = float(at - low);
    tube.joints.push_back({std::uint8_t(low), std::uint8_t(low + 1), 0, 0});
    tube.weights.push_back({1 - upper, upper, 0, 0});
  }
  const int material = glb.AddMaterial(PlainMaterial("tentacle", {0.55, 0.08, 0.22}, 0, 0.32));
  const int mesh = glb.AddMesh("tentacle", tube, material);

  std::vector<float> inverse_bind, times;
  for (int key = 0; key < kKeys; ++key) times.push_back(float(kDuration * key / (kKeys - 1)));
  std::array<int, kJoints> joints{};
  for (int joint = kJoints - 1; joint >= 0; --joint) {  // children first: a node names them
    Json node = {{"name", "joint " + std::to_string(joint)}, {"translation", ToJson({0, joint == 0 ? 0.0 : kLink, 0})}};
    if (joint + 1 < kJoints) node["children"] = Json::array({joints[std::size_t(joint) + 1]});
    joints[std::size_t(joint)] = glb.AddNode(node);
  }
  const int root = glb.AddRootNode(
      {{"name", "tentacle root"}, {"translation", ToJson({-0.9, 0.06, 0})}, {"children", Json::array({joints[0]})}});
  (void)root;
  for (int joint = 0; joint < kJoints; ++joint) {
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 4; ++row) {
        inverse_bind.push_back(column == row ? 1.0f : column == 3 && row == 1 ? float(-kLink * joint) : 0.0f);
      }
    }
    if (joint == 0) continue;
    // Rotation about Z by amplitude * sin(2 pi t / duration - lag); tangents are its derivatives.
    std::vector<float> values;
    const double amplitude = 0.32, lag = 0.55 * joint, speed = 2 * kPi / kDuration;
    for (float time : times) {
      const double phase = speed * time - lag, half = amplitude * Sin(phase) / 2;
      const double half_rate = amplitude * speed * Cos(phase) / 2;
      const std::array<double, 4> tangent = {0, 0, Cos(half) * half_rate, -Sin(half) * half_rate};
      const std::array<double, 4> value = {0, 0, Sin(half), Cos(half)};
      for (const auto& quaternion : {tangent, value, tangent}) {
        for (double component : quaternion) values.push_back(float(component));
      }
    }
    const int sampler = AddSampler(samplers, glb, times, values, 4, "CUBICSPLINE");
    channels.push_back(Channel(sampler, joints[std::size_t(joint)], "rotation"));
  }
  const int skin = glb.Add("skins", {{"name", "tentacle"},
                                     {"inverseBindMatrices", glb.AddFloats(inverse_bind, 16)},
                                     {"joints", joints},
                                     {"skeleton", joints[0]}});
  glb.AddRootNode({{"name", "tentacle"}, {"mesh", mesh}, {"skin", skin}});
}

std::vector<float> Differences(const Shape& to, const Shape& from, bool normals) {
  std::vector<float> flat;
  const auto& a = normals ? to.normals : to.positions;
  const auto& b = normals ? from.normals : from.positions;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec3 d = a[i] - b[i];
    flat.insert(flat.end(), {float(d.x), float(d.y), float(d.z)});
  }
  return flat;
}

// A ball with two morph targets, flat and bumpy: linear weights.
void AddBlob(Glb& glb, Json& channels, Json& samplers) {
  constexpr int kColumns = 36, kRows = 18;
  const Shape ball = Sphere(kColumns, kRows);
  const auto deformed = [&](const auto& deform) {
    return GridSurface(kColumns, kRows, [&](double u, double v) {
      const int column = int(u * kColumns + 0.5), row = int(v * kRows + 0.5);
      return deform(ball.positions[std::size_t(row * (kColumns + 1) + column)]);
    });
  };
  const Shape flat = deformed([](Vec3 p) { return Vec3{p.x * 1.25, p.y * 0.5 - 0.5, p.z * 1.25}; });
  const Shape bumpy = deformed([](Vec3 p) {
    const double bump = Sin(6 * p.x) * Sin(6 * p.y) * Sin(6 * p.z);
    return p * (1 + 0.35 * bump);
  });
  const int material = glb.AddMaterial(PlainMaterial("blob", {0.02, 0.32, 0.36}, 0, 0.18));
  Json primitive = glb.MakePrimitive(ball, material);
  for (const Shape* target : {&flat, &bumpy}) {
    primitive["targets"].push_back({{"POSITION", glb.AddFloats(Differences(*target, ball, false), 3, true)},
                                    {"NORMAL", glb.AddFloats(Differences(*target, ball, true), 3)}});
  }
  const int mesh = glb.Add(
      "meshes", {{"name", "blob"}, {"primitives", Json::array({primitive})}, {"weights", Json::array({0.0, 0.0})}});
  const int node = glb.AddRootNode(
      {{"name", "blob"}, {"mesh", mesh}, {"translation", ToJson({0, 0.47, 0})}, {"scale", ToJson({0.4, 0.4, 0.4})}});
  const int sampler = AddSampler(samplers, glb, {0, 1, 2, 3, 4}, {0, 0, 1, 0, 0, 0.3f, 0, 1, 0, 0}, 1, "LINEAR");
  channels.push_back(Channel(sampler, node, "weights"));
}

// A cube that hops between four pads at once and turns evenly: steps of translation, linear rotation and scale.
void AddCube(Glb& glb, Json& channels, Json& samplers) {
  const int material = glb.AddMaterial(PlainMaterial("cube", {1.0, 0.72, 0.32}, 1, 0.3));
  const int node = glb.AddRootNode({{"name", "cube"},
                                    {"mesh", glb.AddMesh("cube", BevelledBox({0.3, 0.3, 0.3}, 0.03), material)},
                                    {"translation", ToJson({0.75, 0.3, 0.25})}});
  const std::vector<float> times = {0, 1, 2, 3, 4};
  const std::vector<float> places = {0.75f,  0.3f,  0.25f, 1.25f,  0.3f,  0.25f, 1.25f, 0.3f,
                                     -0.25f, 0.75f, 0.3f,  -0.25f, 0.75f, 0.3f,  0.25f};
  channels.push_back(Channel(AddSampler(samplers, glb, times, places, 3, "STEP"), node, "translation"));
  std::vector<float> turns;
  for (int key = 0; key <= 4; ++key) {  // a quarter turn a second about +Y
    const double half = kPi / 4 * key;
    turns.insert(turns.end(), {0, float(Sin(half)), 0, float(Cos(half))});
  }
  channels.push_back(Channel(AddSampler(samplers, glb, times, turns, 4, "LINEAR"), node, "rotation"));
  std::vector<float> scales;
  for (double s : {1.0, 0.8, 1.0, 0.8, 1.0}) scales.insert(scales.end(), {float(s), float(s), float(s)});
  channels.push_back(Channel(AddSampler(samplers, glb, times, scales, 3, "LINEAR"), node, "scale"));

  const int pad_material = glb.AddMaterial(PlainMaterial("pad", {0.25, 0.25, 0.28}, 0, 0.5));
  const Shape pad = Lathe({{0, 0.1}, {0.17, 0.1}, {0.19, 0.085}, {0.19, 0.06}}, 32, false);
  Shape pads;
  for (double x : {0.75, 1.25}) {
    for (double z : {-0.25, 0.25}) pads.Append(pad, {x, 0, z});
  }
  glb.AddRootNode({{"name", "pads"}, {"mesh", glb.AddMesh("pads", pads, pad_material)}});
}

}  // namespace

Glb Animated() {
  Glb glb("animated");
  const int floor = glb.AddMaterial(PlainMaterial("floor", {0.6, 0.6, 0.58}, 0, 0.6));
  glb.AddRootNode({{"name", "floor"}, {"mesh", glb.AddMesh("floor", BevelledBox({3.4, 0.12, 1.4}, 0.02), floor)}});
  Json channels = Json::array(), samplers = Json::array();
  AddTentacle(glb, channels, samplers);
  AddBlob(glb, channels, samplers);
  AddCube(glb, channels, samplers);
  glb.Add("animations", {{"name", "loop"}, {"channels", channels}, {"samplers", samplers}});
  AddPerspectiveCamera(glb, "three quarters", {1.4, 2.0, 4.9}, {0.0, 0.6, 0}, 0.56);
  return glb;
}

}  // namespace facet::assets
