// Which way a surface faces: smooth and flat, scaled, mirrored, seen from behind, and bent by a normal map.
#include <gtest/gtest.h>

#include "oracle/brdf.h"
#include "oracle/gltf_file.h"

namespace oracle {
namespace {

const Surface kPaint{{0.7, 0.5, 0.3}, 0.0, 0.8};
constexpr const char* kPaintJson = R"("pbrMetallicRoughness":{"baseColorFactor":[0.7,0.5,0.3,1],"metallicFactor":0,)"
                                   R"("roughnessFactor":0.8})";

// A sun that shines down from the upper right, a little from the front.
constexpr Vec kSunAxis{0.8, -0.7, 0.1};
constexpr double kSunAngle = -0.8;
void AddSun(GltfFile& file) {
  file.Light(R"({"type":"directional","intensity":3})", R"(,"rotation":)" + Numbers(Turn(kSunAxis, kSunAngle)));
}
Vec TowardSun() { return -Rotated({0, 0, -1}, kSunAxis, kSunAngle); }

struct Mesh {
  std::vector<Vec> places, normals;
  std::vector<int> indices;
};

// Rings from pole to pole around y.
Mesh Ball(int rings, int segments) {
  Mesh mesh;
  for (int i = 0; i <= rings; ++i) {
    for (int k = 0; k <= segments; ++k) {
      const double down = kPi * i / rings, around = 2.0 * kPi * k / segments;
      mesh.places.push_back({std::sin(down) * std::cos(around), std::cos(down), -std::sin(down) * std::sin(around)});
      mesh.normals.push_back(mesh.places.back());
    }
  }
  for (int i = 0; i < rings; ++i) {
    for (int k = 0; k < segments; ++k) {
      const int a = i * (segments + 1) + k, b = a + segments + 1;
      for (const int v : {a, b, b + 1, a, b + 1, a + 1}) mesh.indices.push_back(v);
    }
  }
  return mesh;
}

int AddMesh(GltfFile& file, const Mesh& mesh, const std::string& material) {
  std::string attributes = R"("POSITION":)" + std::to_string(file.Floats(mesh.places));
  if (!mesh.normals.empty()) attributes += R"(,"NORMAL":)" + std::to_string(file.Floats(mesh.normals));
  return file.Add("meshes", R"({"primitives":[{"attributes":{)" + attributes + R"(},"indices":)" +
                                std::to_string(file.Shorts("SCALAR", mesh.indices)) + R"(,"material":)" +
                                std::to_string(file.Add("materials", material)) + "}]}");
}

// The mesh under a node, from straight on: the nearest triangle's normal, interpolated between its corners' (flat where
// the mesh has none), on the eye's side where both sides are seen.
void ExpectMesh(const Mesh& mesh, const std::string& node, const Frame& world, bool double_sided) {
  constexpr int kSize = 24;
  constexpr double kHalf = 2.0;
  GltfFile file;
  AddSun(file);
  const int index =
      AddMesh(file, mesh, std::string("{") + kPaintJson + (double_sided ? R"(,"doubleSided":true})" : "}"));
  file.Add("nodes", R"({"mesh":)" + std::to_string(index) + node + "}");
  AddStraightCamera(file, kHalf);
  const Image image = Draw(file, kSize, kSize);
  const bool mirrored = Dot(world.x, Cross(world.y, world.z)) < 0.0;
  int seen = 0;
  double brightest = 0.0;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const Ray ray{StraightPlace(x, y, kSize, kHalf) + Vec{0, 0, 10}, {0, 0, -1}};
      double nearest = 1e30;
      Vec normal;
      bool unsure = false;
      for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        Vec p[3], n[3];
        for (std::size_t k = 0; k < 3; ++k) {
          const auto v = std::size_t(mesh.indices[i + k]);
          p[k] = world.Point(mesh.places[v]);
          if (!mesh.normals.empty()) n[k] = world.Normal(mesh.normals[v]);
        }
        const Vec geometric = Cross(p[1] - p[0], p[2] - p[0]) * (mirrored ? -1.0 : 1.0);
        const auto hit = MeetPlane(ray, p[0], p[1], p[2]);
        if (!hit || hit->Nearness() < -0.05) continue;
        const bool front = geometric.z > 0.0;
        // The outline, where what is behind is seen beside it; within it edges are shared.
        if (!front && !double_sided) continue;
        if (hit->Nearness() < 0.02) {
          unsure = true;
          continue;
        }
        if (hit->distance >= nearest) continue;
        nearest = hit->distance;
        normal = geometric;
        if (!mesh.normals.empty()) normal = n[0] * hit->weight[0] + n[1] * hit->weight[1] + n[2] * hit->weight[2];
        normal = Unit(normal) * (!mesh.normals.empty() && !front ? -1.0 : 1.0);
        if (mesh.normals.empty() && !front) normal = -normal;
      }
      if (unsure) continue;
      ASSERT_EQ(image.Alpha(x, y), nearest < 1e30 ? 1.0 : 0.0) << x << ", " << y;
      if (nearest > 1e29 || normal.z < 0.02) continue;
      const Vec expected = Reflect(kPaint, normal, {0, 0, 1}, TowardSun()) * 3.0;
      ExpectColor(image, x, y, expected, kLitTolerance, kLitFloor);
      brightest = std::fmax(brightest, expected.x);
      ++seen;
    }
  }
  EXPECT_GT(seen, kSize * kSize / 8);
  EXPECT_GT(brightest, 0.2);
}

std::string TrsNode(Vec translation, Vec axis, double angle, Vec scale) {
  return R"(,"translation":)" + Numbers(translation) + R"(,"rotation":)" + Numbers(Turn(axis, angle)) + R"(,"scale":)" +
         Numbers(scale);
}

TEST(Normals, OfASphere) { ExpectMesh(Ball(10, 14), "", {}, false); }

// 3.7.2.1: without normals, flat.
TEST(Normals, FlatWhereThereAreNone) {
  Mesh mesh = Ball(6, 8);
  mesh.normals.clear();
  ExpectMesh(mesh, "", {}, false);
}

// By the inverse transpose: a sphere pressed flat still faces outwards.
TEST(Normals, UnderAScaleThatIsNotUniform) {
  const Vec axis = {1, 0.5, 0.2}, scale = {1.7, 0.6, 1.0};
  ExpectMesh(Ball(10, 14), TrsNode({0.1, 0.1, 0}, axis, 0.7, scale), Place({0.1, 0.1, 0}, axis, 0.7, scale), false);
}

// 3.7.4: a node that mirrors turns the winding, so that the same side is the front.
TEST(Normals, Mirrored) {
  const Vec axis = {-0.2, 0.5, 1}, scale = {1.3, -0.8, 1.0};
  ExpectMesh(Ball(10, 14), TrsNode({-0.1, 0.2, 0}, axis, 0.4, scale), Place({-0.1, 0.2, 0}, axis, 0.4, scale), false);
  Mesh flat = Ball(6, 8);
  flat.normals.clear();
  ExpectMesh(flat, TrsNode({-0.1, 0.2, 0}, axis, 0.4, scale), Place({-0.1, 0.2, 0}, axis, 0.4, scale), false);
}

// 3.9.6: back faces are left out, or have their normals reversed where the material is double-sided.
TEST(Normals, SeenFromBehind) {
  Mesh bowl = Ball(10, 14);
  // The half away from the eye, whose inside is seen.
  std::vector<int> kept;
  for (std::size_t i = 0; i < bowl.indices.size(); i += 3) {
    const Vec middle = bowl.places[std::size_t(bowl.indices[i])] + bowl.places[std::size_t(bowl.indices[i + 1])] +
                       bowl.places[std::size_t(bowl.indices[i + 2])];
    if (middle.z < -0.2) kept.insert(kept.end(), bowl.indices.begin() + long(i), bowl.indices.begin() + long(i) + 3);
  }
  bowl.indices = kept;
  ExpectMesh(bowl, TrsNode({}, {1, 0, 0}, 0.0, {1.6, 1.6, 1.0}), Place({}, {1, 0, 0}, 0.0, {1.6, 1.6, 1.0}), true);
}

// --- Normal maps (3.9.3) --------------------------------------------------------------------------------------------

struct Tilt {
  int red = 0, green = 0, blue = 0;
  double scale = 1.0;
  // "scaledNormal = normalize((<sampled value> * 2 - 1) * vec3(scale, scale, 1))"
  Vec InTangentSpace() const {
    return {(red / 255.0 * 2 - 1) * scale, (green / 255.0 * 2 - 1) * scale, blue / 255.0 * 2 - 1};
  }
};

// A square whose every texel bends the normal alike, under a node: what it is lit like tells the normal. `right` and
// `up`: the directions in the square's plane in which the image's right and top point.
void ExpectBent(const Tilt& tilt, const std::vector<double>& uv, const std::string& tangents, const std::string& node,
                const Frame& world, Vec right, Vec up) {
  GltfFile file;
  AddSun(file);
  const int texture = file.Texture(MakeTexels(2, 2, [&](int, int) {
    return std::vector<int>{tilt.red, tilt.green, tilt.blue, 255};
  }));
  std::string attributes;
  if (!tangents.empty()) {
    std::vector<double> numbers;
    for (int k = 0; k < 4; ++k) {
      const bool mirrored = tangents == "mirrored";
      numbers.insert(numbers.end(), {right.x, right.y, right.z, mirrored ? -1.0 : 1.0});
    }
    attributes = R"(,"TANGENT":)" + std::to_string(file.Floats("VEC4", numbers));
  }
  AddSquare(file, 1.5,
            std::string("{") + kPaintJson + R"(,"doubleSided":true,"normalTexture":{"index":)" +
                std::to_string(texture) + R"(,"scale":)" + Number(tilt.scale) + "}}",
            attributes, node, uv);
  AddStraightCamera(file, 1.0);
  const Image image = Draw(file, 4, 4);
  const Vec n = tilt.InTangentSpace();
  // Tangents turn as directions do, the normal by the inverse transpose, and the bitangent is made of both: all are
  // perpendicular here.
  const Vec t = Unit(world.Direction(right)), b = Unit(world.Direction(up)), z = world.Normal({0, 0, 1});
  Vec normal = Unit(t * n.x + b * n.y + z * n.z);
  if (z.z < 0.0) normal = -normal;  // seen from behind
  for (int i = 0; i < 4; ++i) {
    ExpectColor(image, i, 3 - i, Reflect(kPaint, normal, {0, 0, 1}, TowardSun()) * 3.0, kLitTolerance, kLitFloor);
  }
}

const Tilt kTilt{190, 90, 220, 1.0};  // to the right and down
const std::vector<double> kUpright = {0, 1, 1, 1, 1, 0, 0, 0};

// "+X right, +Y up, +Z toward the viewer", with the file's tangents and with those that are made of the UVs.
TEST(NormalMap, BendsAsItSays) {
  for (const Tilt& tilt :
       {kTilt, Tilt{60, 140, 200, 1.0}, Tilt{128, 230, 190, 1.0}, Tilt{190, 90, 220, 0.5}, Tilt{150, 110, 220, -1.5}}) {
    SCOPED_TRACE(std::to_string(tilt.red) + ", " + std::to_string(tilt.green) + ", scale " + Number(tilt.scale));
    ExpectBent(tilt, kUpright, "", "", {}, {1, 0, 0}, {0, 1, 0});
    ExpectBent(tilt, kUpright, "given", "", {}, {1, 0, 0}, {0, 1, 0});
  }
}

// The image turned by a quarter and mirrored on the square: tangents follow it.
TEST(NormalMap, FollowsTheTexture) {
  // u runs up and v to the right: the image's right is up, its top to the left.
  ExpectBent(kTilt, {0, 0, 0, 1, 1, 1, 1, 0}, "", "", {}, {0, 1, 0}, {-1, 0, 0});
  // u runs to the left: mirrored.
  ExpectBent(kTilt, {1, 1, 0, 1, 0, 0, 1, 0}, "", "", {}, {-1, 0, 0}, {0, 1, 0});
  ExpectBent(kTilt, {1, 1, 0, 1, 0, 0, 1, 0}, "mirrored", "", {}, {-1, 0, 0}, {0, 1, 0});
}

// Under nodes that turn, stretch and mirror.
TEST(NormalMap, UnderItsNode) {
  for (const std::string tangents : {"", "given"}) {
    for (const Vec scale : {Vec{1.2, 1.9, 1}, Vec{-1.2, 1.5, 1}, Vec{1.3, -1.4, 1}, Vec{1.4, 1.2, -1}}) {
      SCOPED_TRACE(tangents + " " + Numbers(scale));
      const Vec axis = {0, 0, 1};
      ExpectBent(kTilt, kUpright, tangents, TrsNode({}, axis, 0.5, scale), Place({}, axis, 0.5, scale), {1, 0, 0},
                 {0, 1, 0});
    }
    // Turned round, so that its back is seen.
    ExpectBent(kTilt, kUpright, tangents, TrsNode({}, {0, 1, 0}, kPi, {1.5, 1.5, 1}),
               Place({}, {0, 1, 0}, kPi, {1.5, 1.5, 1}), {1, 0, 0}, {0, 1, 0});
  }
}

}  // namespace
}  // namespace oracle
