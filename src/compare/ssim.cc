#include "compare/ssim.h"

#include <algorithm>
#include <cstddef>

#include "base/parallel.h"
#include "math/elementary.h"

namespace facet {
namespace {

// Weights of a Gaussian window with the paper's length, or that of the image's side if it is shorter.
std::vector<double> Window(int side) {
  constexpr int kLength = 11;
  constexpr double kSigma = 1.5;
  const int length = std::min(kLength, side);
  std::vector<double> weights;
  double sum = 0.0;
  for (int i = 0; i < length; ++i) {
    const double x = i - 0.5 * (length - 1);
    weights.push_back(Exp(-x * x / (2.0 * kSigma * kSigma)));
    sum += weights.back();
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

// Equations 13 and 14, from the means of a, b, a^2, b^2 and ab in the window. Exactly 1 if a and b are equal.
double Ssim(double a, double b, double aa, double bb, double ab) {
  constexpr double kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;
  const double variance_a = aa - a * a, variance_b = bb - b * b, covariance = ab - a * b;
  return ((2.0 * (a * b) + kC1) * (2.0 * covariance + kC2)) / ((a * a + b * b + kC1) * (variance_a + variance_b + kC2));
}

// The sum of SSIM over the windows whose top row is `top`.
double RowOfWindows(const LumaPlane& a, const LumaPlane& b, const std::vector<std::uint8_t>& broken,
                    const std::vector<double>& window_x, const std::vector<double>& window_y, int top) {
  const std::size_t width = static_cast<std::size_t>(a.width);
  std::vector<double> column_a(width), column_b(width), column_aa(width), column_bb(width), column_ab(width);
  std::vector<std::uint8_t> column_broken(width);
  for (std::size_t i = 0; i < window_y.size(); ++i) {
    const std::size_t row = (static_cast<std::size_t>(top) + i) * width;
    const double weight = window_y[i];
    for (std::size_t x = 0; x < width; ++x) {
      const double p = a.values[row + x], q = b.values[row + x];
      column_a[x] += weight * p;
      column_b[x] += weight * q;
      column_aa[x] += weight * (p * p);
      column_bb[x] += weight * (q * q);
      column_ab[x] += weight * (p * q);
    }
    if (broken.empty()) continue;
    for (std::size_t x = 0; x < width; ++x) column_broken[x] |= broken[row + x];
  }
  double sum = 0.0;
  for (std::size_t left = 0; left + window_x.size() <= width; ++left) {
    double mean_a = 0.0, mean_b = 0.0, mean_aa = 0.0, mean_bb = 0.0, mean_ab = 0.0;
    bool any_broken = false;
    for (std::size_t i = 0; i < window_x.size(); ++i) {
      const double weight = window_x[i];
      mean_a += weight * column_a[left + i];
      mean_b += weight * column_b[left + i];
      mean_aa += weight * column_aa[left + i];
      mean_bb += weight * column_bb[left + i];
      mean_ab += weight * column_ab[left + i];
      any_broken = any_broken || column_broken[left + i] != 0;
    }
    if (!any_broken) sum += Ssim(mean_a, mean_b, mean_aa, mean_bb, mean_ab);
  }
  return sum;
}

}  // namespace

double MeanSsim(const LumaPlane& a, const LumaPlane& b, const std::vector<std::uint8_t>& broken) {
  const std::vector<double> window_x = Window(a.width), window_y = Window(a.height);
  const std::size_t rows = static_cast<std::size_t>(a.height) - window_y.size() + 1;
  const std::size_t columns = static_cast<std::size_t>(a.width) - window_x.size() + 1;
  std::vector<double> sums(rows);
  ParallelFor(rows, 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t top = begin; top < end; ++top) {
      sums[top] = RowOfWindows(a, b, broken, window_x, window_y, static_cast<int>(top));
    }
  });
  double sum = 0.0;  // summed row by row, in an order that does not depend on threads
  for (const double row : sums) sum += row;
  return sum / (static_cast<double>(rows) * static_cast<double>(columns));
}

}  // namespace facet
