#include "gallery_shapes.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "facet/shader/elementary_double.h"

namespace facet::assets {

std::vector<Vec2> SmoothProfile(const std::vector<Vec2>& points, int pieces) {
  std::vector<Vec2> curve;
  const int count = int(points.size());
  const auto at = [&](int i) { return points[std::size_t(i < 0 ? 0 : i >= count ? count - 1 : i)]; };
  for (int i = 0; i + 1 < count; ++i) {
    const Vec2 a = at(i - 1), b = at(i), c = at(i + 1), d = at(i + 2);
    for (int j = 0; j < pieces; ++j) {
      const double t = double(j) / pieces, t2 = t * t, t3 = t2 * t;
      const auto blend = [&](double p, double q, double r, double s) {
        return 0.5 * (2 * q + (r - p) * t + (2 * p - 5 * q + 4 * r - s) * t2 + (3 * q - p - 3 * r + s) * t3);
      };
      curve.push_back({std::fmax(blend(a.x, b.x, c.x, d.x), 0.0), blend(a.y, b.y, c.y, d.y)});
    }
  }
  curve.push_back(points.back());
  return curve;
}

Shape Turned(const std::vector<Vec2>& profile, int columns, double around, double per_metre) {
  Shape shape = Lathe(profile, columns, true);
  std::vector<double> length(profile.size(), 0);
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const double dx = profile[i].x - profile[i - 1].x, dy = profile[i].y - profile[i - 1].y;
    length[i] = length[i - 1] + std::sqrt(dx * dx + dy * dy);
  }
  for (std::size_t i = 0; i < shape.uvs.size(); ++i) {
    shape.uvs[i] = {shape.uvs[i].x * around, length[i / std::size_t(columns + 1)] * per_metre};
  }
  return shape;
}

Shape Brilliant() {
  constexpr int kFold = 8;
  // Half steps around, so that rings may stand between the corners of others.
  const auto at = [](double radius, double height, int half_step) {
    const double angle = kPi * half_step / kFold;
    return Vec3{radius * Sin(angle), height, radius * Cos(angle)};
  };
  Shape shape;
  const auto triangle = [&](Vec3 a, Vec3 b, Vec3 c) {
    Vec3 normal = Normalize(Cross(b - a, c - a));
    if (Dot(normal, a + b + c) < 0) {  // convex around the origin
      std::swap(b, c);
      normal = normal * -1;
    }
    const std::uint32_t base = std::uint32_t(shape.positions.size());
    shape.positions.insert(shape.positions.end(), {a, b, c});
    shape.normals.insert(shape.normals.end(), {normal, normal, normal});
    shape.uvs.insert(shape.uvs.end(), {{0, 1}, {1, 1}, {0.5, 0}});
    shape.indices.insert(shape.indices.end(), {base, base + 1, base + 2});
  };
  // Rings of corners: the table, the kites' sides, the girdle's two edges, the lower kites' sides, the point.
  constexpr double kTable = 0.56, kTop = 0.36, kSide = 0.80, kSideHeight = 0.205, kEdge = 0.025;
  constexpr double kLowSide = 0.36, kLowHeight = -0.57, kPoint = -0.86;
  for (int i = 0; i < 2 * kFold; i += 2) {
    const Vec3 table = at(kTable, kTop, i), next = at(kTable, kTop, i + 2), side = at(kSide, kSideHeight, i + 1);
    const Vec3 before = at(kSide, kSideHeight, i - 1), girdle = at(1, kEdge, i), middle = at(1, kEdge, i + 1);
    const Vec3 after = at(1, kEdge, i + 2);
    triangle({0, kTop, 0}, table, next);
    triangle(table, next, side);
    triangle(table, before, girdle);
    triangle(table, girdle, side);
    triangle(side, girdle, middle);
    triangle(side, middle, after);
    const Vec3 low = at(kLowSide, kLowHeight, i + 1), low_before = at(kLowSide, kLowHeight, i - 1);
    const Vec3 under = at(1, -kEdge, i), under_middle = at(1, -kEdge, i + 1), under_after = at(1, -kEdge, i + 2);
    triangle(girdle, middle, under);
    triangle(middle, under, under_middle);
    triangle(middle, after, under_middle);
    triangle(after, under_middle, under_after);
    triangle(low, under, under_middle);
    triangle(low, under_middle, under_after);
    triangle(under, low, low_before);
    triangle({0, kPoint, 0}, low, low_before);
  }
  return shape;
}

TeapotShape Teapot() {
  const std::vector<Vec2> body = SmoothProfile({{0.068, 0.196},
                                                {0.071, 0.199},
                                                {0.078, 0.197},
                                                {0.081, 0.190},
                                                {0.088, 0.180},
                                                {0.112, 0.155},
                                                {0.133, 0.118},
                                                {0.140, 0.080},
                                                {0.130, 0.044},
                                                {0.104, 0.020},
                                                {0.088, 0.013},
                                                {0.086, 0.004},
                                                {0.080, 0.000},
                                                {0.0, 0.0}},
                                               4);
  const std::vector<Vec2> lid = SmoothProfile({{0.0, 0.262},
                                               {0.012, 0.260},
                                               {0.0195, 0.250},
                                               {0.016, 0.238},
                                               {0.010, 0.229},
                                               {0.014, 0.223},
                                               {0.036, 0.216},
                                               {0.058, 0.206},
                                               {0.068, 0.199},
                                               {0.071, 0.195}},
                                              4);
  Shape pot = Turned(body, 80, 6, 7);
  pot.Append(Turned(lid, 56, 3, 7));
  const auto spout = [](double t) {  // an S from the belly up to the height of the rim
    return Vec3{0.112 + 0.125 * t + 0.016 * Sin(2 * kPi * t), 0.060 + 0.128 * (t * t * (2.2 - 1.2 * t)), 0};
  };
  Shape tube = Tube(
      spout, [](double t) { return 0.034 - 0.040 * t + 0.0175 * t * t; }, 32, 28);
  for (Vec2& uv : tube.uvs) uv = {uv.x * 1.2, uv.y * 1.4};
  pot.Append(tube);
  // An ear whose two ends stand in the body, at its shoulder and at its belly.
  const auto handle = [](double t) {
    const double angle = kPi * (0.24 + 1.38 * t);
    return Vec3{-0.150 + 0.080 * Cos(angle), 0.112 + 0.058 * Sin(angle), 0};
  };
  tube = Tube(
      handle, [](double t) { return 0.0105 + 0.0035 * Cos(2 * kPi * t); }, 24, 40);
  for (Vec2& uv : tube.uvs) uv = {uv.x * 0.5, uv.y * 2};
  pot.Append(tube);
  std::vector<Vec2> outline = {{0, 0.26}, {0.02, 0.25}, {0.014, 0.225}};
  outline.insert(outline.end(), body.begin() + 8, body.end());
  return {std::move(pot), std::move(outline)};
}

}  // namespace facet::assets
