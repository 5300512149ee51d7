// Vectors of doubles, rotations and rays, written out for the oracles: they share no arithmetic with facet.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace oracle {

constexpr double kPi = 3.14159265358979324;

struct Vec {
  double x = 0.0, y = 0.0, z = 0.0;
};

inline Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator-(Vec a) { return {-a.x, -a.y, -a.z}; }
inline Vec operator*(Vec a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline Vec operator*(double s, Vec a) { return a * s; }
inline Vec operator*(Vec a, Vec b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline double Dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec Cross(Vec a, Vec b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double Length(Vec a) { return std::sqrt(Dot(a, a)); }
inline Vec Unit(Vec a) { return a * (1.0 / Length(a)); }

// glTF 2.0, 3.5.3: a unit quaternion (x, y, z, w), here from an axis and an angle, counter-clockwise seen from its tip.
struct Quaternion {
  double x = 0.0, y = 0.0, z = 0.0, w = 1.0;
};
inline Quaternion Turn(Vec axis, double angle) {
  const Vec a = Unit(axis) * std::sin(0.5 * angle);
  return {a.x, a.y, a.z, std::cos(0.5 * angle)};
}

// Rodrigues, 1840: v turned about an axis.
inline Vec Rotated(Vec v, Vec axis, double angle) {
  const Vec k = Unit(axis);
  return v * std::cos(angle) + Cross(k, v) * std::sin(angle) + k * (Dot(k, v) * (1.0 - std::cos(angle)));
}

// A place and its axes: what a node's matrix says, column by column. p -> origin + x p.x + y p.y + z p.z.
struct Frame {
  Vec x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin{0, 0, 0};

  Vec Direction(Vec d) const { return x * d.x + y * d.y + z * d.z; }
  Vec Point(Vec p) const { return origin + Direction(p); }
  // Normals: the inverse transpose, by the cross products of the axes (Cramer's rule), which points outwards where the
  // frame mirrors, too, when divided by the determinant.
  Vec Normal(Vec n) const {
    const double determinant = Dot(x, Cross(y, z));
    return Unit((Cross(y, z) * n.x + Cross(z, x) * n.y + Cross(x, y) * n.z) * (1.0 / determinant));
  }
  Frame operator*(const Frame& inner) const {
    return {Direction(inner.x), Direction(inner.y), Direction(inner.z), Point(inner.origin)};
  }
};

// glTF 2.0, 3.5.2: translation * rotation * scale.
inline Frame Place(Vec translation, Vec axis, double angle, Vec scale) {
  return {Rotated({1, 0, 0}, axis, angle) * scale.x, Rotated({0, 1, 0}, axis, angle) * scale.y,
          Rotated({0, 0, 1}, axis, angle) * scale.z, translation};
}

struct Ray {
  Vec from, along;
};

// A ray through a triangle: how far, in lengths of `along`, and the corners' weights.
struct Hit {
  double distance = 0.0;
  std::array<double, 3> weight{};
  double Nearness() const { return std::fmin(weight[0], std::fmin(weight[1], weight[2])); }  // to an edge; < 0: outside
};

// Of the plane, wherever it is hit: Cramer's rule on a + w1 (b - a) + w2 (c - a) = from + t along.
inline std::optional<Hit> MeetPlane(const Ray& ray, Vec a, Vec b, Vec c) {
  const Vec u = b - a, v = c - a, n = Cross(u, v);
  const double facing = -Dot(ray.along, n);
  if (std::fabs(facing) < 1e-12) return std::nullopt;
  const Vec s = ray.from - a, q = Cross(s, -ray.along);
  const double w1 = -Dot(v, q) / facing, w2 = Dot(u, q) / facing;
  return Hit{Dot(s, n) / facing, {1.0 - w1 - w2, w1, w2}};
}

}  // namespace oracle
