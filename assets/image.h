// Procedural images: periodic noise, and images filled by a function.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "shapes.h"

namespace facet::assets {

// A number in [0, 1) from three integers.
double Hash(int x, int y, int z);
// Smooth noise in [-1, 1] of a point of space.
double Noise(Vec3 p, int seed);
// The same on the plane, repeating every `period` units in both directions.
double PeriodicNoise(double x, double y, int period, int seed);
// Sum of `octaves` of the above, each twice as fine and `gain` as strong; about [-1, 1]. u and v repeat after 1.
double PeriodicFractal(double u, double v, int period, int octaves, double gain, int seed);
double Fractal(Vec3 p, int octaves, double gain, int seed);

double Clamp01(double x);
double SmoothStep(double low, double high, double x);
Vec3 Mix(Vec3 a, Vec3 b, double t);

// An 8-bit PNG of size x size pixels. `color`(u, v) gives 3 or 4 numbers in [0, 1] as the file shall hold them; (u, v)
// is the pixel's centre in [0, 1].
std::vector<std::uint8_t> PngImage(int size, const std::function<Vec3(double, double)>& color);
std::vector<std::uint8_t> PngImageWithAlpha(int size,
                                            const std::function<std::array<double, 4>(double, double)>& color);
// The tangent-space normal map (+Y up) of a height field that repeats; height and (u, v) in the same unit.
std::vector<std::uint8_t> NormalMap(int size, const std::function<double(double, double)>& height);

}  // namespace facet::assets
