#include "image.h"

#include <algorithm>
#include <cmath>

#include "png.h"

namespace facet::assets {
namespace {

double Fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

std::uint8_t ToByte(double x) { return std::uint8_t(Clamp01(x) * 255 + 0.5); }

int Wrap(int i, int period) { return ((i % period) + period) % period; }

}  // namespace

double Clamp01(double x) { return x < 0 ? 0 : x > 1 ? 1 : x; }

double SmoothStep(double low, double high, double x) {
  const double t = Clamp01((x - low) / (high - low));
  return t * t * (3 - 2 * t);
}

Vec3 Mix(Vec3 a, Vec3 b, double t) { return a * (1 - t) + b * t; }

double Hash(int x, int y, int z) {
  std::uint32_t h = std::uint32_t(x) * 0x9E3779B1u ^ std::uint32_t(y) * 0x85EBCA77u ^ std::uint32_t(z) * 0xC2B2AE3Du;
  for (int round = 0; round < 2; ++round) {
    h ^= h >> 15;
    h *= 0x2C1B3C6Du;
    h ^= h >> 12;
    h *= 0x297A2D39u;
  }
  h ^= h >> 15;
  return (h >> 8) * (1.0 / 16777216.0);
}

double Noise(Vec3 p, int seed) {
  const int x = int(std::floor(p.x)), y = int(std::floor(p.y)), z = int(std::floor(p.z));
  const double fx = Fade(p.x - x), fy = Fade(p.y - y), fz = Fade(p.z - z);
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int i = corner & 1, j = corner >> 1 & 1, k = corner >> 2;
    const double weight = (i != 0 ? fx : 1 - fx) * (j != 0 ? fy : 1 - fy) * (k != 0 ? fz : 1 - fz);
    sum += weight * Hash(x + i, y + j, (z + k) * 131 + seed);
  }
  return 2 * sum - 1;
}

double PeriodicNoise(double x, double y, int period, int seed) {
  const int xi = int(std::floor(x)), yi = int(std::floor(y));
  const double fx = Fade(x - xi), fy = Fade(y - yi);
  const auto at = [&](int i, int j) { return Hash(Wrap(xi + i, period), Wrap(yi + j, period), seed); };
  const double top = at(0, 0) * (1 - fx) + at(1, 0) * fx, bottom = at(0, 1) * (1 - fx) + at(1, 1) * fx;
  return 2 * (top * (1 - fy) + bottom * fy) - 1;
}

double PeriodicFractal(double u, double v, int period, int octaves, double gain, int seed) {
  double sum = 0, weight = 1;
  for (int octave = 0; octave < octaves; ++octave, weight *= gain, period *= 2) {
    sum += weight * PeriodicNoise(u * period, v * period, period, seed + octave);
  }
  return sum;
}

double Fractal(Vec3 p, int octaves, double gain, int seed) {
  double sum = 0, weight = 1;
  for (int octave = 0; octave < octaves; ++octave, weight *= gain, p = p * 2) sum += weight * Noise(p, seed + octave);
  return sum;
}

std::vector<std::uint8_t> PngImage(int size, const std::function<Vec3(double, double)>& color) {
  std::vector<std::uint8_t> pixels;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const Vec3 c = color((x + 0.5) / size, (y + 0.5) / size);
      for (double channel : {c.x, c.y, c.z}) pixels.push_back(ToByte(channel));
    }
  }
  return EncodePng(size, size, 3, pixels);
}

std::vector<std::uint8_t> PngImageWithAlpha(int size,
                                            const std::function<std::array<double, 4>(double, double)>& color) {
  std::vector<std::uint8_t> pixels;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      for (double channel : color((x + 0.5) / size, (y + 0.5) / size)) pixels.push_back(ToByte(channel));
    }
  }
  return EncodePng(size, size, 4, pixels);
}

std::vector<std::uint8_t> NormalMap(int size, const std::function<double(double, double)>& height) {
  const double h = 1.0 / size;
  return PngImage(size, [&](double u, double v) {
    const double du = (height(u + h, v) - height(u - h, v)) / (2 * h);
    const double dv = (height(u, v + h) - height(u, v - h)) / (2 * h);
    const Vec3 normal = Normalize({-du, dv, 1});  // v points down, the map's green channel up
    return Vec3{normal.x * 0.5 + 0.5, normal.y * 0.5 + 0.5, normal.z * 0.5 + 0.5};
  });
}

}  // namespace facet::assets
