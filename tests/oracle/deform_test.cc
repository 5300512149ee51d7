// Vertices that move: morph targets, skins and animations, by the sums that glTF states.
#include <gtest/gtest.h>

#include "oracle/gltf_file.h"

namespace oracle {
namespace {

constexpr int kSize = 24;
constexpr double kHalf = 2.0;

// Unlit triangles whose corners' colours are given, at places that were computed.
struct Shape {
  std::vector<Vec> places, colors;  // three a triangle
};

// Seen straight on; nothing overlaps.
void ExpectShape(const Image& image, const Shape& shape) {
  int seen = 0;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const Ray ray{StraightPlace(x, y, kSize, kHalf) + Vec{0, 0, 10}, {0, 0, -1}};
      bool met = false, unsure = false;
      Vec color;
      for (std::size_t i = 0; i < shape.places.size(); i += 3) {
        const auto hit = MeetPlane(ray, shape.places[i], shape.places[i + 1], shape.places[i + 2]);
        if (!hit) continue;
        unsure = unsure || std::fabs(hit->Nearness()) < 5e-3;
        if (hit->Nearness() < 0.0) continue;
        met = true;
        color = {};
        for (std::size_t k = 0; k < 3; ++k) color = color + shape.colors[i + k] * hit->weight[k];
      }
      if (unsure) continue;
      ASSERT_EQ(image.Alpha(x, y), met ? 1.0 : 0.0) << x << ", " << y;
      if (!met) continue;
      ExpectColor(image, x, y, color, 3e-5, 1.0);
      ++seen;
    }
  }
  EXPECT_GT(seen, kSize * kSize / 30);
}

const Shape kTriangle = {{{-1, -0.8, 0}, {1.1, -0.6, 0}, {-0.2, 1, 0}}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

std::string Attributes(GltfFile& file, const Shape& shape) {
  return R"("POSITION":)" + std::to_string(file.Floats(shape.places)) + R"(,"COLOR_0":)" +
         std::to_string(file.Floats(shape.colors));
}

// A mesh of the shape, unlit and double-sided; `more` are members of the primitive and of the mesh.
int AddMesh(GltfFile& file, const Shape& shape, const std::string& more_attributes, const std::string& more_primitive,
            const std::string& more_mesh) {
  file.Use("KHR_materials_unlit");
  const int material = file.Add("materials", R"({"doubleSided":true,"extensions":{"KHR_materials_unlit":{}}})");
  return file.Add("meshes", R"({"primitives":[{"attributes":{)" + Attributes(file, shape) + more_attributes +
                                R"(},"material":)" + std::to_string(material) + more_primitive + "}]" + more_mesh +
                                "}");
}

// 3.7.2.2: the base and each target's displacements times its weight; a node's weights replace its mesh's.
TEST(Morph, TargetsAreAddedByTheirWeights) {
  const std::vector<Vec> first = {{0.4, 0, 0}, {0, 0.5, 0}, {0, 0, 0}},
                         second = {{0, -0.3, 0}, {0.2, 0, 0}, {0.6, 0.2, 0}};
  for (const bool of_node : {false, true}) {
    GltfFile file;
    const int a = file.Floats(first), b = file.Floats(second);
    const int mesh =
        AddMesh(file, kTriangle, "",
                R"(,"targets":[{"POSITION":)" + std::to_string(a) + R"(},{"POSITION":)" + std::to_string(b) + "}]",
                R"(,"weights":[0.5,1.25])");
    file.Add("nodes", R"({"mesh":)" + std::to_string(mesh) + (of_node ? R"(,"weights":[-0.75,0.5]})" : "}"));
    AddStraightCamera(file, kHalf);
    Shape expected = kTriangle;
    for (std::size_t k = 0; k < 3; ++k) {
      const double wa = of_node ? -0.75 : 0.5, wb = of_node ? 0.5 : 1.25;
      expected.places[k] = expected.places[k] + first[k] * wa + second[k] * wb;
    }
    ExpectShape(Draw(file, kSize, kSize), expected);
  }
}

// 3.7.3.1: sum of weight * joint's global matrix * inverse bind matrix; the mesh's own node moves nothing.
TEST(Skin, VerticesFollowTheirJoints) {
  const Frame bind_a = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0.2, 0}},
              bind_b = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-0.4, 0.1, 0}};
  const auto columns = [](const Frame& f) {
    return std::vector<double>{f.x.x, f.x.y, f.x.z, 0, f.y.x,      f.y.y,      f.y.z,      0,
                               f.z.x, f.z.y, f.z.z, 0, f.origin.x, f.origin.y, f.origin.z, 1};
  };
  GltfFile file;
  std::vector<double> matrices = columns(bind_a);
  for (const double number : columns(bind_b)) matrices.push_back(number);
  const int inverse = file.Floats("MAT4", matrices);
  const int joints = file.Shorts("VEC4", {0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0});
  const int weights = file.Floats("VEC4", {1, 0, 0, 0, 0.7, 0.3, 0, 0, 0.4, 0.6, 0, 0});
  const int mesh =
      AddMesh(file, kTriangle,
              R"(,"JOINTS_0":)" + std::to_string(joints) + R"(,"WEIGHTS_0":)" + std::to_string(weights), "", "");
  file.Add("nodes", R"({"translation":[-0.3,0.2,0],"children":[1],"rotation":)" + Numbers(Turn({0, 0, 1}, 0.4)) + "}");
  file.Add("nodes",
           R"({"translation":[0.3,-0.2,0],"scale":[1.2,0.9,1],"rotation":)" + Numbers(Turn({0, 0, 1}, -0.9)) + "}");
  file.Add("skins", R"({"joints":[0,1],"inverseBindMatrices":)" + std::to_string(inverse) + "}");
  const int drawn = file.Add("nodes", R"({"skin":0,"translation":[50,60,70],"mesh":)" + std::to_string(mesh) + "}");
  AddStraightCamera(file, kHalf);
  file.Roots({0, drawn, drawn + 1});

  const Frame joint_a = Place({-0.3, 0.2, 0}, {0, 0, 1}, 0.4, {1, 1, 1});
  const Frame joint_b = joint_a * Place({0.3, -0.2, 0}, {0, 0, 1}, -0.9, {1.2, 0.9, 1});
  const double of_a[3] = {1.0, 0.3, 0.4}, of_b[3] = {0.0, 0.7, 0.6};
  Shape expected = kTriangle;
  for (std::size_t k = 0; k < 3; ++k) {
    expected.places[k] = (joint_a * bind_a).Point(kTriangle.places[k]) * of_a[k] +
                         (joint_b * bind_b).Point(kTriangle.places[k]) * of_b[k];
  }
  ExpectShape(Draw(file, kSize, kSize), expected);
}

// --- Animation (appendix C) -----------------------------------------------------------------------------------------

// The triangle under a node that an animation moves, at a moment.
void ExpectMoved(const std::string& path, const std::string& interpolation, const std::string& type,
                 const std::vector<double>& values, double time, const Frame& expected) {
  SCOPED_TRACE(path + " " + interpolation + " at " + Number(time));
  GltfFile file;
  const int input = file.Floats("SCALAR", {1.0, 2.0, 4.0});
  const int output = file.Floats(type, values);
  const int mesh = AddMesh(file, kTriangle, "", "", "");
  file.Add("nodes", R"({"translation":[0.1,0.05,0],"mesh":)" + std::to_string(mesh) + "}");
  file.Add("animations", R"({"samplers":[{"input":)" + std::to_string(input) + R"(,"output":)" +
                             std::to_string(output) + R"(,"interpolation":")" + interpolation +
                             R"("}],"channels":[{"sampler":0,"target":{"node":0,"path":")" + path + "\"}}]}");
  AddStraightCamera(file, kHalf);
  Shape moved = kTriangle;
  for (Vec& place : moved.places) place = expected.Point(place);
  ExpectShape(
      Draw(file, kSize, kSize, [&](facet::RenderSettings& settings) { settings.animation = 0, settings.time = time; }),
      moved);
}

// Three keys at 1, 2 and 4 seconds.
TEST(Animation, Translation) {
  const std::vector<double> keys = {0, 0, 0, 0.8, -0.4, 0, -0.6, 0.5, 0};
  const auto at = [](double x, double y) { return Place({x, y, 0}, {1, 0, 0}, 0.0, {1, 1, 1}); };
  ExpectMoved("translation", "LINEAR", "VEC3", keys, 0.0, at(0, 0));
  ExpectMoved("translation", "LINEAR", "VEC3", keys, 1.25, at(0.2, -0.1));
  ExpectMoved("translation", "LINEAR", "VEC3", keys, 3.5, at(0.8 + 0.75 * -1.4, -0.4 + 0.75 * 0.9));
  ExpectMoved("translation", "LINEAR", "VEC3", keys, 9.0, at(-0.6, 0.5));
  ExpectMoved("translation", "STEP", "VEC3", keys, 1.99, at(0, 0));
  ExpectMoved("translation", "STEP", "VEC3", keys, 3.5, at(0.8, -0.4));
}

// C.4: spherical, along the shorter arc.
TEST(Animation, Rotation) {
  std::vector<double> keys;
  for (const double angle : {0.0, 1.2, -0.5}) {
    const Quaternion q = Turn({0, 0, 1}, angle);
    const double sign = angle == 1.2 ? -1.0 : 1.0;  // the same turn
    keys.insert(keys.end(), {sign * q.x, sign * q.y, sign * q.z, sign * q.w});
  }
  const auto at = [](double angle) { return Place({0.1, 0.05, 0}, {0, 0, 1}, angle, {1, 1, 1}); };
  ExpectMoved("rotation", "LINEAR", "VEC4", keys, 1.25, at(0.3));
  ExpectMoved("rotation", "LINEAR", "VEC4", keys, 3.0, at(0.35));
  ExpectMoved("rotation", "STEP", "VEC4", keys, 3.0, at(1.2));
}

// C.5: Hermite's cubic, its tangents times the keys' distance.
TEST(Animation, CubicScale) {
  // In-tangent, value, out-tangent of each key.
  const std::vector<double> keys = {0, 0,    0, 1,   1,   1, 0.5, -0.2, 0,  // 1 s
                                    1, -0.4, 0, 1.4, 0.8, 1, 0.3, 0.1,  0,  // 2 s
                                    0, 0.2,  0, 0.7, 1.2, 1, 0,   0,    0};
  const double t = 0.4, d = 2.0, t2 = t * t, t3 = t2 * t;
  const auto hermite = [&](double v0, double out, double v1, double in) {
    return (2 * t3 - 3 * t2 + 1) * v0 + d * (t3 - 2 * t2 + t) * out + (3 * t2 - 2 * t3) * v1 + d * (t3 - t2) * in;
  };
  ExpectMoved("scale", "CUBICSPLINE", "VEC3", keys, 2.8,
              Place({0.1, 0.05, 0}, {1, 0, 0}, 0.0, {hermite(1.4, 0.3, 0.7, 0.0), hermite(0.8, 0.1, 1.2, 0.2), 1.0}));
}

}  // namespace
}  // namespace oracle
