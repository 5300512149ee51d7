// Where a vertex lands, which surface is nearest and what is interpolated over it: rays through the pixels' centres
// against the triangles that the file states.
#include <gtest/gtest.h>

#include "oracle/gltf_file.h"

namespace oracle {
namespace {

struct Corner {
  Vec place, color;
};
struct Triangle {
  Corner a, b, c;
};

// An unlit, double-sided triangle with colours at its corners, as a node.
void AddTriangle(GltfFile& file, const Triangle& t, const std::string& node_members = "") {
  file.Use("KHR_materials_unlit");
  const int material = file.Add("materials", R"({"doubleSided":true,"extensions":{"KHR_materials_unlit":{}}})");
  const int positions = file.Floats({t.a.place, t.b.place, t.c.place});
  const int colors = file.Floats({t.a.color, t.b.color, t.c.color});
  const int mesh =
      file.Add("meshes", R"({"primitives":[{"attributes":{"POSITION":)" + std::to_string(positions) + R"(,"COLOR_0":)" +
                             std::to_string(colors) + R"(},"material":)" + std::to_string(material) + "}]}");
  file.Add("nodes", R"({"mesh":)" + std::to_string(mesh) + node_members + "}");
}

struct Placed {
  Triangle triangle;
  Frame world;
};

// The light of each pixel's centre: of the nearest triangle that its ray meets between the planes. `along` has length 1
// along the viewing axis.
void ExpectTriangles(const Image& image, const std::vector<Placed>& triangles,
                     const std::function<Ray(double x, double y)>& ray_through, double near_distance,
                     double far_distance) {
  int seen = 0, passed = 0;
  for (int y = 0; y < image.film.height; ++y) {
    for (int x = 0; x < image.film.width; ++x) {
      const Ray ray = ray_through(x + 0.5, y + 0.5);
      double nearest = far_distance;
      Vec color;
      bool unsure = false, met = false;
      for (const Placed& p : triangles) {
        const Corner* corner[3] = {&p.triangle.a, &p.triangle.b, &p.triangle.c};
        const auto hit = MeetPlane(ray, p.world.Point(corner[0]->place), p.world.Point(corner[1]->place),
                                   p.world.Point(corner[2]->place));
        if (!hit) continue;
        // Corners are snapped to 1/256 pixel: what is that near to an edge or a plane may be on either side.
        unsure = unsure || std::fabs(hit->Nearness()) < 2e-3 || std::fabs(hit->distance - near_distance) < 1e-3 ||
                 std::fabs(hit->distance - far_distance) < 1e-3;
        if (hit->Nearness() < 0.0 || hit->distance < near_distance || hit->distance >= nearest) continue;
        nearest = hit->distance;
        met = true;
        color = {};
        for (int k = 0; k < 3; ++k) color = color + corner[k]->color * hit->weight[std::size_t(k)];
      }
      if (unsure) {
        ++passed;
        continue;
      }
      ASSERT_EQ(image.Alpha(x, y), met ? 1.0 : 0.0) << x << ", " << y;
      if (met) {
        ExpectColor(image, x, y, color, 2e-5, 1.0);
        ++seen;
      }
    }
  }
  EXPECT_GT(seen, image.film.width * image.film.height / 10);
  EXPECT_LT(passed, image.film.width * image.film.height / 10);
}

const Triangle kFirst = {{{-1.2, -0.7, 0.3}, {1, 0, 0}}, {{1.5, -0.2, -1.0}, {0, 1, 0}}, {{0.1, 1.1, 0.8}, {0, 0, 1}}};
const Triangle kSecond = {{{-0.9, 0.8, 0.9}, {1, 1, 0}}, {{1.1, 0.9, -0.4}, {0, 1, 1}}, {{0.3, -1.3, 0.1}, {1, 0, 1}}};

// A perspective camera (glTF 2.0, 3.10.3.3): yfov is the vertical angle; -Z forward, +Y up, placed by its node.
struct PerspectiveCamera {
  double yfov = 0.7, aspect = 1.5, near_distance = 0.2;
  Vec place{0.4, 0.3, 3.5}, axis{0.2, 1.0, -0.3};
  double angle = 0.15;

  std::string Lens(const std::string& more = "") const {
    return R"({"type":"perspective","perspective":{"yfov":)" + Number(yfov) + R"(,"aspectRatio":)" + Number(aspect) +
           R"(,"znear":)" + Number(near_distance) + more + "}}";
  }
  std::string Node(int camera) const {
    return R"({"camera":)" + std::to_string(camera) + R"(,"translation":)" + Numbers(place) + R"(,"rotation":)" +
           Numbers(Turn(axis, angle)) + "}";
  }
  Ray Through(double x, double y, int width, int height) const {
    const double reach = std::tan(0.5 * yfov);
    const Vec in_camera = {(2.0 * x / width - 1.0) * reach * aspect, (1.0 - 2.0 * y / height) * reach, -1.0};
    return {place, Rotated(in_camera, axis, angle)};
  }
};

constexpr int kWidth = 48, kHeight = 32;

TEST(Projection, PerspectiveCamera) {
  const PerspectiveCamera camera;
  GltfFile file;
  AddTriangle(file, kFirst);
  AddTriangle(file, kSecond);
  file.Add("nodes", camera.Node(file.Add("cameras", camera.Lens())));
  ExpectTriangles(
      Draw(file, kWidth, kHeight), {{kFirst, {}}, {kSecond, {}}},
      [&](double x, double y) { return camera.Through(x, y, kWidth, kHeight); }, 0.2, 1e30);
}

// What lies before the near or beyond the far plane is cut away, through the middle of both triangles.
TEST(Projection, NearAndFarPlane) {
  PerspectiveCamera camera;
  camera.near_distance = 3.0;
  GltfFile file;
  AddTriangle(file, kFirst);
  AddTriangle(file, kSecond);
  file.Add("nodes", camera.Node(file.Add("cameras", camera.Lens(R"(,"zfar":3.9)"))));
  ExpectTriangles(
      Draw(file, kWidth, kHeight), {{kFirst, {}}, {kSecond, {}}},
      [&](double x, double y) { return camera.Through(x, y, kWidth, kHeight); }, 3.0, 3.9);
}

// An orthographic camera sees 2 xmag by 2 ymag (3.10.3.4).
TEST(Projection, OrthographicCamera) {
  const Vec place = {0.1, -0.2, 4.0}, axis = {-0.3, 0.5, 1.0};
  const double angle = 0.4, xmag = 1.8, ymag = 1.2;
  GltfFile file;
  AddTriangle(file, kFirst);
  AddTriangle(file, kSecond);
  file.Add("cameras", R"({"type":"orthographic","orthographic":{"xmag":1.8,"ymag":1.2,"znear":0.5,"zfar":20}})");
  file.Add("nodes",
           R"({"camera":0,"translation":)" + Numbers(place) + R"(,"rotation":)" + Numbers(Turn(axis, angle)) + "}");
  const auto through = [&](double x, double y) {
    const Vec aside = {(2.0 * x / kWidth - 1.0) * xmag, (1.0 - 2.0 * y / kHeight) * ymag, 0.0};
    return Ray{place + Rotated(aside, axis, angle), Rotated({0, 0, -1}, axis, angle)};
  };
  ExpectTriangles(Draw(file, kWidth, kHeight), {{kFirst, {}}, {kSecond, {}}}, through, 0.5, 20.0);
}

// Translation, rotation and scale of a node, not uniform and mirroring, below a parent's matrix (3.5.2, 3.5.3: columns
// one after the other).
TEST(Projection, NodesAndTheirParents) {
  const PerspectiveCamera camera;
  GltfFile file;
  AddTriangle(file, kFirst,
              R"(,"translation":[0.3,-0.1,0.2],"scale":[0.7,1.4,-0.9],"rotation":)" + Numbers(Turn({1, 2, 3}, 0.8)));
  AddTriangle(file, kSecond, R"(,"scale":[-0.8,0.9,1.1])");
  const Frame parent = {{0.9, 0.2, -0.1}, {-0.3, 1.1, 0.2}, {0.15, 0.1, 0.8}, {0.2, 0.1, -0.4}};
  const std::string columns = List({0.9, 0.2, -0.1, 0, -0.3, 1.1, 0.2, 0, 0.15, 0.1, 0.8, 0, 0.2, 0.1, -0.4, 1});
  const int root = file.Add("nodes", R"({"children":[0,1],"matrix":)" + columns + "}");
  const int eye = file.Add("nodes", camera.Node(file.Add("cameras", camera.Lens())));
  file.Roots({root, eye});
  ExpectTriangles(
      Draw(file, kWidth, kHeight),
      {{kFirst, parent * Place({0.3, -0.1, 0.2}, {1, 2, 3}, 0.8, {0.7, 1.4, -0.9})},
       {kSecond, parent * Place({}, {1, 0, 0}, 0.0, {-0.8, 0.9, 1.1})}},
      [&](double x, double y) { return camera.Through(x, y, kWidth, kHeight); }, 0.2, 1e30);
}

// Instances of EXT_mesh_gpu_instancing stand in their node's place.
TEST(Projection, Instances) {
  const PerspectiveCamera camera;
  GltfFile file;
  file.Use("EXT_mesh_gpu_instancing");
  const Quaternion turn = Turn({0, 1, 0.5}, 0.6);
  const int translations = file.Floats({{-0.6, 0.1, 0.0}, {0.7, -0.2, 0.3}});
  const int rotations = file.Floats("VEC4", {0, 0, 0, 1, turn.x, turn.y, turn.z, turn.w});
  const int scales = file.Floats({{0.8, 0.9, 0.8}, {0.7, 0.8, 0.9}});
  AddTriangle(file, kFirst,
              R"(,"translation":[0.1,0.2,0.3],"extensions":{"EXT_mesh_gpu_instancing":{"attributes":)"
              R"({"TRANSLATION":)" +
                  std::to_string(translations) + R"(,"ROTATION":)" + std::to_string(rotations) + R"(,"SCALE":)" +
                  std::to_string(scales) + "}}}");
  file.Add("nodes", camera.Node(file.Add("cameras", camera.Lens())));
  const Frame node = Place({0.1, 0.2, 0.3}, {1, 0, 0}, 0.0, {1, 1, 1});
  ExpectTriangles(
      Draw(file, kWidth, kHeight),
      {{kFirst, node * Place({-0.6, 0.1, 0.0}, {1, 0, 0}, 0.0, {0.8, 0.9, 0.8})},
       {kFirst, node * Place({0.7, -0.2, 0.3}, {0, 1, 0.5}, 0.6, {0.7, 0.8, 0.9})}},
      [&](double x, double y) { return camera.Through(x, y, kWidth, kHeight); }, 0.2, 1e30);
}

}  // namespace
}  // namespace oracle
