#include "shapes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "facet/shader/elementary_double.h"

namespace facet::assets {

Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec3 operator*(Vec3 a, double s) { return {a.x * s, a.y * s, a.z * s}; }
double Dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3 Cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
Vec3 Normalize(Vec3 a) {
  const double length = std::sqrt(Dot(a, a));
  return length > 0 ? a * (1.0 / length) : a;
}

void Shape::Append(const Shape& other, Vec3 offset, double angle) {
  const std::uint32_t base = std::uint32_t(positions.size());
  const double c = Cos(angle), s = Sin(angle);
  const auto turn = [&](Vec3 v) { return Vec3{c * v.x + s * v.z, v.y, c * v.z - s * v.x}; };
  for (const Vec3& p : other.positions) positions.push_back(turn(p) + offset);
  for (const Vec3& n : other.normals) normals.push_back(turn(n));
  uvs.insert(uvs.end(), other.uvs.begin(), other.uvs.end());
  for (std::uint32_t index : other.indices) indices.push_back(base + index);
}

Shape GridSurface(int columns, int rows, const std::function<Vec3(double, double)>& surface) {
  Shape shape;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      const double u = double(i) / columns, v = double(j) / rows;
      shape.positions.push_back(surface(u, v));
      shape.uvs.push_back({u, v});
    }
  }
  const auto at = [&](int i, int j) { return std::uint32_t(j * (columns + 1) + i); };
  shape.normals.assign(shape.positions.size(), {});
  const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const Vec3 normal = Cross(shape.positions[b] - shape.positions[a], shape.positions[c] - shape.positions[a]);
    if (Dot(normal, normal) < 1e-24) return;  // a pole
    for (std::uint32_t index : {a, b, c}) {
      shape.normals[index] = shape.normals[index] + normal;
      shape.indices.push_back(index);
    }
  };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      triangle(at(i, j), at(i, j + 1), at(i + 1, j + 1));
      triangle(at(i, j), at(i + 1, j + 1), at(i + 1, j));
    }
  }
  const auto coincide = [&](std::uint32_t a, std::uint32_t b) {
    const Vec3 d = shape.positions[a] - shape.positions[b];
    return Dot(d, d) < 1e-12;
  };
  for (int j = 0; j <= rows; ++j) {
    const std::uint32_t first = at(0, j), last = at(columns, j);
    if (coincide(first, at(1, j))) {  // a pole: one normal for the whole row
      Vec3 sum;
      for (int i = 0; i <= columns; ++i) sum = sum + shape.normals[at(i, j)];
      for (int i = 0; i <= columns; ++i) shape.normals[at(i, j)] = sum;
    } else if (coincide(first, last)) {
      shape.normals[first] = shape.normals[last] = shape.normals[first] + shape.normals[last];
    }
  }
  for (Vec3& normal : shape.normals) normal = Normalize(normal);
  return shape;
}

Shape Sphere(int columns, int rows) {
  Shape shape = GridSurface(columns, rows, [](double u, double v) {
    const double phi = v * kPi, theta = (u == 1.0 ? 0.0 : u) * 2 * kPi;
    const double s = v == 0.0 || v == 1.0 ? 0.0 : Sin(phi);
    return Vec3{s * Sin(theta), Cos(phi), s * Cos(theta)};
  });
  shape.normals = shape.positions;  // exact
  return shape;
}

Shape Lathe(const std::vector<Vec2>& profile, int columns, bool smooth) {
  const auto turned = [](Vec2 p, double u) {
    const double theta = (u == 1.0 ? 0.0 : u) * 2 * kPi;
    return Vec3{p.x * Sin(theta), p.y, p.x * Cos(theta)};
  };
  const int segments = int(profile.size()) - 1;
  if (smooth) {
    return GridSurface(columns, segments, [&](double u, double v) {
      const int j = std::min(segments, int(v * segments + 0.5));
      return turned(profile[std::size_t(j)], u);
    });
  }
  Shape shape;
  for (int j = 0; j < segments; ++j) {
    const Vec2 a = profile[std::size_t(j)], b = profile[std::size_t(j) + 1];
    Shape ring = GridSurface(columns, 1, [&](double u, double v) { return turned(v < 0.5 ? a : b, u); });
    for (Vec2& uv : ring.uvs) uv.y = (j + uv.y) / segments;
    shape.Append(ring);
  }
  return shape;
}

Shape Quad(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  Shape shape;
  shape.positions = {a, b, c, d};
  shape.normals.assign(4, Normalize(Cross(b - a, d - a)));
  shape.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  shape.indices = {0, 1, 2, 0, 2, 3};
  return shape;
}

Shape Box(Vec3 size) {
  const double x = size.x / 2, y = size.y / 2, z = size.z / 2;
  Shape shape;
  shape.Append(Quad({-x, -y, z}, {x, -y, z}, {x, y, z}, {-x, y, z}));
  shape.Append(Quad({x, -y, -z}, {-x, -y, -z}, {-x, y, -z}, {x, y, -z}));
  shape.Append(Quad({x, -y, z}, {x, -y, -z}, {x, y, -z}, {x, y, z}));
  shape.Append(Quad({-x, -y, -z}, {-x, -y, z}, {-x, y, z}, {-x, y, -z}));
  shape.Append(Quad({-x, y, z}, {x, y, z}, {x, y, -z}, {-x, y, -z}));
  shape.Append(Quad({-x, -y, -z}, {x, -y, -z}, {x, -y, z}, {-x, -y, z}));
  return shape;
}

Shape BevelledBox(Vec3 size, double bevel) {
  // Each face shrinks by the bevel; twelve edge strips and eight corners join them. A strip or corner is found by the
  // faces it touches, so its corners are picked from theirs.
  const double x = size.x / 2, y = size.y / 2, z = size.z / 2;
  const double xi = x - bevel, yi = y - bevel, zi = z - bevel;
  Shape shape;
  const auto face = [&](Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    // Outward whatever the order of the corners: the box is convex and holds the origin.
    const Vec3 normal = Cross(b - a, d - a);
    Shape quad = Dot(normal, a + c) > 0 ? Quad(a, b, c, d) : Quad(b, a, d, c);
    const double width = std::sqrt(Dot(b - a, b - a)), height = std::sqrt(Dot(d - a, d - a));
    for (Vec2& uv : quad.uvs) uv = {uv.x * width, uv.y * height};
    shape.Append(quad);
  };
  for (double s : {-1.0, 1.0}) {
    face({-xi, -yi, s * z}, {xi, -yi, s * z}, {xi, yi, s * z}, {-xi, yi, s * z});
    face({s * x, -yi, zi}, {s * x, -yi, -zi}, {s * x, yi, -zi}, {s * x, yi, zi});
    face({-xi, s * y, zi}, {xi, s * y, zi}, {xi, s * y, -zi}, {-xi, s * y, -zi});
    for (double t : {-1.0, 1.0}) {
      face({s * x, -yi, t * zi}, {s * xi, -yi, t * z}, {s * xi, yi, t * z}, {s * x, yi, t * zi});
      face({-xi, s * y, t * zi}, {xi, s * y, t * zi}, {xi, s * yi, t * z}, {-xi, s * yi, t * z});
      face({s * x, t * yi, -zi}, {s * x, t * yi, zi}, {s * xi, t * y, zi}, {s * xi, t * y, -zi});
      for (double r : {-1.0, 1.0}) {
        const Vec3 a{s * x, t * yi, r * zi}, b{s * xi, t * y, r * zi}, c{s * xi, t * yi, r * z};
        const Vec3 normal = Normalize({s, t, r});
        const bool outward = Dot(Cross(b - a, c - a), normal) > 0;
        Shape corner;
        corner.positions = outward ? std::vector<Vec3>{a, b, c} : std::vector<Vec3>{b, a, c};
        corner.normals.assign(3, normal);
        corner.uvs = {{0, 1}, {1, 1}, {0.5, 0}};
        corner.indices = {0, 1, 2};
        shape.Append(corner);
      }
    }
  }
  return shape;
}

Shape Torus(double radius, double tube_radius, int columns, int rows) {
  Shape shape;
  shape = GridSurface(columns, rows, [=](double u, double v) {
    const double theta = (u == 1.0 ? 0.0 : u) * 2 * kPi, phi = (v == 1.0 ? 0.0 : v) * 2 * kPi;
    const double ring = radius + tube_radius * Sin(phi);
    return Vec3{ring * Sin(theta), tube_radius * Cos(phi), ring * Cos(theta)};
  });
  for (std::size_t i = 0; i < shape.positions.size(); ++i) {  // exact, and without a seam
    const Vec3 p = shape.positions[i];
    const Vec3 centre = Normalize({p.x, 0, p.z}) * radius;
    shape.normals[i] = Normalize(p - centre);
  }
  return shape;
}

Shape Prism(const std::vector<Vec2>& profile, int sides) {
  Shape shape;
  const auto corner = [&](Vec2 p, int side) {
    const double theta = 2 * kPi * (side % sides) / sides;
    return Vec3{p.x * Sin(theta), p.y, p.x * Cos(theta)};
  };
  const auto length = [](Vec3 v) { return std::sqrt(Dot(v, v)); };
  for (int side = 0; side < sides; ++side) {
    double v_top = 0;
    for (std::size_t j = 0; j + 1 < profile.size(); ++j) {
      const Vec3 a = corner(profile[j + 1], side), b = corner(profile[j + 1], side + 1);
      const Vec3 c = corner(profile[j], side + 1), d = corner(profile[j], side);
      const Vec3 normal = Normalize(Cross(b - d, c - a));
      const double v_bottom = v_top + length((a + b) * 0.5 - (c + d) * 0.5);
      const std::uint32_t base = std::uint32_t(shape.positions.size());
      const double bottom = length(b - a) / 2, top = length(c - d) / 2, u = side * 0.37;
      for (const Vec3& p : {a, b, c, d}) {
        shape.positions.push_back(p);
        shape.normals.push_back(normal);
      }
      for (const Vec2& uv :
           {Vec2{u - bottom, v_bottom}, Vec2{u + bottom, v_bottom}, Vec2{u + top, v_top}, Vec2{u - top, v_top}}) {
        shape.uvs.push_back(uv);
      }
      if (bottom > 0) shape.indices.insert(shape.indices.end(), {base, base + 1, base + 2});
      if (top > 0) shape.indices.insert(shape.indices.end(), {base, base + 2, base + 3});
      v_top = v_bottom;
    }
  }
  return shape;
}

Shape Tube(const std::function<Vec3(double)>& curve, const std::function<double(double)>& radius, int columns,
           int rows) {
  return GridSurface(columns, rows, [&](double u, double v) {
    const double t = 1 - v, h = 1e-3, theta = (u == 1.0 ? 0.0 : u) * 2 * kPi;
    const Vec3 along = Normalize(curve(t + h) - curve(t - h));
    const Vec3 side = Normalize(Cross(along, std::fabs(along.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}));
    const Vec3 front = Cross(side, along);
    return curve(t) + side * (radius(t) * Sin(theta)) + front * (radius(t) * Cos(theta));
  });
}

}  // namespace facet::assets
