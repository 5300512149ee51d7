// Triangle meshes of simple solids. Metres, right-handed, +Y up, counter-clockwise seen from outside; UV (0, 0) is the
// top left of an image.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace facet::assets {

inline constexpr double kPi = 3.14159265358979323846;

struct Vec2 {
  double x = 0, y = 0;
};

struct Vec3 {
  double x = 0, y = 0, z = 0;
};

Vec3 operator+(Vec3 a, Vec3 b);
Vec3 operator-(Vec3 a, Vec3 b);
Vec3 operator*(Vec3 a, double s);
double Dot(Vec3 a, Vec3 b);
Vec3 Cross(Vec3 a, Vec3 b);
Vec3 Normalize(Vec3 a);  // zero stays zero

struct Shape {
  std::vector<Vec3> positions, normals;
  std::vector<Vec2> uvs;
  std::vector<std::array<float, 4>> tangents;       // empty, or one per position: along +u, and handedness
  std::vector<std::array<std::uint8_t, 4>> joints;  // empty, or one per position
  std::vector<std::array<float, 4>> weights;
  std::vector<std::uint32_t> indices;

  // Appends `other`, moved by `offset` after turning it by `angle` radians about +Y.
  void Append(const Shape& other, Vec3 offset = {}, double angle = 0);
};

// A grid of (columns + 1) x (rows + 1) points of `surface`(u, v), u and v in [0, 1]; normals from its neighbours, seams
// welded where the first and last column coincide. Faces the side from which u to the right, v down is seen.
Shape GridSurface(int columns, int rows, const std::function<Vec3(double, double)>& surface);
// Radius 1; u around, v from +Y to -Y.
Shape Sphere(int columns, int rows);
// A profile of (radius, height) points from top to bottom turned about +Y. Corners are hard: each segment has its own
// normals, unless `smooth`.
Shape Lathe(const std::vector<Vec2>& profile, int columns, bool smooth);
// A profile of (radius, height) points from top to bottom around `sides` flat sides; radius is that of the corners, the
// first of which is towards +Z. UV are metres.
Shape Prism(const std::vector<Vec2>& profile, int sides);
// A tube around `curve`(t), t from 0 (v = 1) to 1 (v = 0), of radius `radius`(t); open at its ends.
Shape Tube(const std::function<Vec3(double)>& curve, const std::function<double(double)>& radius, int columns,
           int rows);
// Centred at the origin; one UV square per face.
Shape Box(Vec3 size);
// A box with bevelled edges of width `bevel`. UV are metres.
Shape BevelledBox(Vec3 size, double bevel);
// Around +Y.
Shape Torus(double radius, double tube_radius, int columns, int rows);
// Four corners, counter-clockwise: UV (0, 1), (1, 1), (1, 0), (0, 0).
Shape Quad(Vec3 a, Vec3 b, Vec3 c, Vec3 d);

}  // namespace facet::assets
