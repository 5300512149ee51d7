#include "gallery_textures.h"

#include <cmath>

#include "facet/shader/elementary_double.h"
#include "image.h"

namespace facet::assets {

std::vector<std::uint8_t> FlakeNormal() {
  constexpr int kSize = 128;
  return PngImage(kSize, [](double u, double v) {
    const int x = int(u * kSize), y = int(v * kSize);
    const double turn = 2 * kPi * Hash(x, y, 301), tilt = 0.17 * std::sqrt(Hash(x, y, 302));
    const Vec3 normal = Normalize({tilt * Cos(turn), tilt * Sin(turn), 1});
    return Vec3{normal.x * 0.5 + 0.5, normal.y * 0.5 + 0.5, normal.z * 0.5 + 0.5};
  });
}

std::vector<std::uint8_t> OrangePeelNormal() {
  return NormalMap(128, [](double u, double v) { return 0.0005 * PeriodicFractal(u, v, 10, 2, 0.35, 310); });
}

std::vector<std::uint8_t> SoapThickness() {
  return PngImage(256, [](double u, double v) {
    const double stir = 0.10 * PeriodicFractal(u, v, 3, 3, 0.5, 320);
    const double swirl = PeriodicFractal(u + stir, v + 0.6 * stir, 4, 3, 0.5, 330);
    const double thickness = Clamp01(0.12 + 0.72 * v + 0.16 * swirl);
    return Vec3{thickness, thickness, thickness};
  });
}

std::vector<std::uint8_t> PaperColor() {
  return PngImage(128, [](double u, double v) {
    const double rib = std::fmin(v, 1 - v), line = 0.45 + 0.55 * SmoothStep(0.015, 0.06, rib);
    const double fibre = 0.04 * PeriodicNoise(u * 60, v * 12, 12, 350) + 0.05 * PeriodicFractal(u, v, 5, 3, 0.5, 351);
    const double shade = (0.94 + fibre) * line;
    return Vec3{shade, shade, shade};
  });
}

std::vector<std::uint8_t> GrooveRoughness() {
  return PngImage(128, [](double, double v) {
    const double fine = PeriodicNoise(0.5, v * 128, 128, 360), wide = PeriodicNoise(0.5, v * 32, 32, 361);
    return Vec3{1, 0.78 + 0.14 * fine + 0.08 * wide, 1};
  });
}

}  // namespace facet::assets
