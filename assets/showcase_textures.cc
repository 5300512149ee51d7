#include "showcase_textures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "facet/shader/elementary_double.h"
#include "image.h"

namespace facet::assets {
namespace {

// --- Tiles ----------------------------------------------------------------------------------------------------------

constexpr int kTilesPerImage = 4;

struct TilePoint {
  int column = 0, row = 0;
  double edge = 0;  // distance to the tile's edge, in tiles, rounded at the corners; 0.5 in the middle
};

TilePoint TileAt(double u, double v) {
  const double x = (u - std::floor(u)) * kTilesPerImage, y = (v - std::floor(v)) * kTilesPerImage;
  TilePoint point{int(x), int(y), 0};
  const double radius = 0.1;
  const double dx = std::fabs(x - point.column - 0.5), dy = std::fabs(y - point.row - 0.5);
  const double cx = std::max(dx - (0.5 - radius), 0.0), cy = std::max(dy - (0.5 - radius), 0.0);
  point.edge = cx > 0 && cy > 0 ? radius - std::sqrt(cx * cx + cy * cy) : 0.5 - std::max(dx, dy);
  return point;
}

constexpr double kGrout = 0.028, kBevel = 0.035;  // in tiles

double OnTile(const TilePoint& point) { return SmoothStep(kGrout - 0.008, kGrout + 0.008, point.edge); }

double TileHeight(double u, double v) {
  const TilePoint point = TileAt(u, v);
  const double rise = SmoothStep(kGrout - 0.01, kGrout + kBevel, point.edge);
  // Each tile lies a little askew, as a mason leaves it.
  const double tilt_x = (Hash(point.column, point.row, 21) - 0.5) * 0.016;
  const double tilt_y = (Hash(point.column, point.row, 22) - 0.5) * 0.016;
  const double x = u * kTilesPerImage - std::floor(u * kTilesPerImage) - 0.5;
  const double y = v * kTilesPerImage - std::floor(v * kTilesPerImage) - 0.5;
  const double glaze = 0.003 * PeriodicFractal(u, v, 16, 2, 0.5, 5);
  const double sand = 0.004 * PeriodicNoise(u * 128, v * 128, 128, 9);
  return (rise * (0.035 + tilt_x * x + tilt_y * y + glaze) + (1 - rise) * sand) / kTilesPerImage;
}

// --- Stone ----------------------------------------------------------------------------------------------------------

double StoneHeight(double u, double v) {
  const double rough = PeriodicFractal(u, v, 8, 5, 0.52, 40);
  const double crack = std::fabs(PeriodicFractal(u, v, 5, 4, 0.55, 60));
  return 0.011 * rough - 0.02 * (1 - SmoothStep(0.0, 0.07, crack));
}

double StoneCavity(double u, double v) {  // 1 in the open, less in cracks and pits
  const double crack = std::fabs(PeriodicFractal(u, v, 5, 4, 0.55, 60));
  const double pits = PeriodicFractal(u, v, 8, 5, 0.55, 40);
  return (0.35 + 0.65 * SmoothStep(0.0, 0.13, crack)) * (0.72 + 0.28 * SmoothStep(-0.7, 0.3, pits));
}

double Lichen(double u, double v) {
  return SmoothStep(0.12, 0.3, PeriodicFractal(u, v, 4, 5, 0.6, 80)) *
         SmoothStep(-0.3, 0.4, PeriodicFractal(u, v, 32, 2, 0.5, 90));
}

// --- Metal ----------------------------------------------------------------------------------------------------------

double Verdigris(double u, double v) { return 0.9 * SmoothStep(0.25, 0.95, PeriodicFractal(u, v, 4, 6, 0.6, 120)); }

double Chipped(double u, double v) {
  return SmoothStep(0.52, 0.58, PeriodicFractal(u, v, 6, 5, 0.58, 150) + 0.1 * PeriodicNoise(u * 64, v * 64, 64, 155));
}

// --- Leaf -----------------------------------------------------------------------------------------------------------

// Half the leaf's width at height t from the stalk (0) to the tip (1), with a serrated edge.
double LeafHalfWidth(double t) {
  if (t <= 0 || t >= 1) return 0;
  const double body = 0.40 * Pow(Sin(kPi * Pow(t, 0.72)), 0.85);
  const double tooth = t * 11 - std::floor(t * 11);
  return body * (0.90 + 0.13 * tooth);
}

}  // namespace

std::vector<std::uint8_t> TileColor() {
  return PngImage(512, [](double u, double v) {
    const TilePoint point = TileAt(u, v);
    const bool dark = (point.column + point.row) % 2 != 0;
    const double shade = (Hash(point.column, point.row, 3) - 0.5) * 0.09;
    const double mottle = 0.035 * PeriodicFractal(u, v, 8, 3, 0.55, 7);
    const Vec3 glaze = dark ? Vec3{0.13, 0.25, 0.31} : Vec3{0.80, 0.74, 0.63};
    const Vec3 tile = glaze * (1 + shade + mottle * (dark ? 2.0 : 1.0));
    const Vec3 grout = Vec3{0.46, 0.43, 0.39} * (1 + 0.1 * PeriodicNoise(u * 128, v * 128, 128, 9));
    return Mix(grout, tile, OnTile(point));
  });
}

std::vector<std::uint8_t> TileNormal() { return NormalMap(512, TileHeight); }

std::vector<std::uint8_t> TileOrm() {
  return PngImage(256, [](double u, double v) {
    const TilePoint point = TileAt(u, v);
    const double on = OnTile(point), occlusion = 0.45 + 0.55 * SmoothStep(0.0, kGrout + kBevel, point.edge);
    const double polish = 0.2 + 0.1 * Hash(point.column, point.row, 4) + 0.06 * PeriodicFractal(u, v, 8, 3, 0.5, 11);
    return Vec3{occlusion, 0.9 * (1 - on) + polish * on, 0};
  });
}

std::vector<std::uint8_t> StoneColor() {
  return PngImage(256, [](double u, double v) {
    const double grain = PeriodicFractal(u, v, 16, 4, 0.7, 45);
    Vec3 color = Mix({0.36, 0.35, 0.34}, {0.62, 0.59, 0.55}, Clamp01(0.5 + 0.45 * grain));
    color = color * (1 - 0.45 * SmoothStep(0.25, 0.8, PeriodicFractal(u, v, 48, 2, 0.6, 47)));  // mica
    color = Mix(color, {0.55, 0.57, 0.24}, 0.85 * Lichen(u, v));
    return color * (0.55 + 0.45 * StoneCavity(u, v));
  });
}

std::vector<std::uint8_t> StoneNormal() { return NormalMap(256, StoneHeight); }

std::vector<std::uint8_t> StoneOrm() {
  return PngImage(256, [](double u, double v) { return Vec3{StoneCavity(u, v), 0.72 + 0.2 * Lichen(u, v), 0}; });
}

std::vector<std::uint8_t> CopperColor() {
  return PngImage(256, [](double u, double v) {
    const double tarnish = 0.5 + 0.5 * PeriodicFractal(u, v, 5, 4, 0.55, 110);
    const Vec3 copper = Mix({0.97, 0.71, 0.57}, {0.72, 0.45, 0.32}, Clamp01(tarnish));
    const double bloom = 0.5 + 0.5 * PeriodicFractal(u, v, 16, 2, 0.6, 112);
    return Mix(copper, Mix({0.30, 0.50, 0.44}, {0.44, 0.66, 0.58}, Clamp01(bloom)), Verdigris(u, v));
  });
}

std::vector<std::uint8_t> CopperMetallicRoughness() {
  return PngImage(256, [](double u, double v) {
    const double green = Verdigris(u, v), wear = PeriodicFractal(u, v, 8, 3, 0.5, 115);
    return Vec3{1, 0.26 + 0.08 * wear + 0.5 * green, 1 - green};
  });
}

std::vector<std::uint8_t> PaintColor() {
  return PngImage(256, [](double u, double v) {
    const double fade = PeriodicFractal(u, v, 4, 3, 0.5, 140);
    const Vec3 paint = Mix({0.60, 0.09, 0.07}, {0.68, 0.16, 0.10}, Clamp01(0.5 + 0.5 * fade));
    return Mix(paint, {0.80, 0.56, 0.44}, Chipped(u, v));
  });
}

std::vector<std::uint8_t> PaintMetallicRoughness() {
  return PngImage(256, [](double u, double v) {
    const double chip = Chipped(u, v);
    return Vec3{1, 0.3 + 0.05 * PeriodicFractal(u, v, 8, 2, 0.5, 145) + 0.15 * chip, chip};
  });
}

std::vector<std::uint8_t> LeafColor() {
  return PngImageWithAlpha(256, [](double u, double v) {
    const double t = (0.97 - v) / 0.94, x = u - 0.5;
    const double inside = LeafHalfWidth(t - 0.06) - std::fabs(x);
    const double stalk = t < 0.3 ? 0.014 - std::fabs(x) : -1.0;
    const double alpha = SmoothStep(-0.006, 0.006, std::max(inside, stalk));
    // Side veins climb outwards from the middle one.
    const double climb = (t - 0.9 * std::fabs(x)) * 9;
    const double vein = std::fabs(climb - std::floor(climb) - 0.5);
    const double lines = std::max(1 - SmoothStep(0.004, 0.014, std::fabs(x)), 0.7 * (1 - SmoothStep(0.03, 0.1, vein)));
    const double mottle = 0.5 + 0.5 * PeriodicFractal(u, v, 6, 4, 0.55, 170);
    Vec3 color = Mix({0.66, 0.70, 0.56}, {0.84, 0.86, 0.70}, Clamp01(mottle));
    color = Mix(color, {0.97, 0.97, 0.90}, 0.7 * lines);
    color = color * (0.82 + 0.18 * SmoothStep(0.0, 0.05, inside));
    if (alpha == 0) color = {0.72, 0.75, 0.60};  // what filtering at the outline may reach
    return std::array<double, 4>{color.x, color.y, color.z, alpha};
  });
}

std::vector<std::uint8_t> FlameEmission() {
  return PngImage(64, [](double, double v) {
    const Vec3 tip{1.0, 0.55, 0.16}, heart{1.0, 0.88, 0.55}, base{0.35, 0.40, 0.85};
    return v < 0.6 ? Mix(tip, heart, SmoothStep(0.0, 0.5, v)) : Mix(heart, base, SmoothStep(0.72, 1.0, v));
  });
}

}  // namespace facet::assets
