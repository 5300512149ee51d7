#include "light/sheen_albedo.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/parallel.h"
#include "material/lobes/sheen-inl.h"
#include "math/elementary.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace {

namespace lanes = HWY_NAMESPACE;

constexpr int kPolar = 24;
constexpr int kAzimuth = 16;
constexpr double kPiDouble = 3.14159265358979324;

static_assert(SheenTable::kFirstRow * SheenTable::kFirstRow * SheenTable::kFirstRow * SheenTable::kFirstRow <=
              lanes::kMinSheenRoughness);

// Midpoints of even steps in a variable s that reaches 0 and 1 with two vanishing derivatives, 6 s^5 - 15 s^4 + 10 s^3,
// so that the midpoint rule converges fast whatever the integrand does at the ends.
struct Node {
  double value, weight;
};
Node SmoothStep(int i, int count) {
  const double s = (i + 0.5) / count, rest = 1.0 - s;
  return {s * s * s * (10.0 + s * (6.0 * s - 15.0)), 30.0 * (s * s) * (rest * rest) / count};
}

// E at one n_dot_v for many roughnesses: the integral of D V n_dot_l dl over n_dot_l = z and the azimuth.
//
// sin(theta_h)^2 = q / (q + (n_dot_v + z)^2), with q the square of the length of view + light along the surface, has no
// cancellation. It does not depend on roughness, so its logarithm serves all of them.
void IntegrateColumn(double n_dot_v, const double* roughness, int count, double* out) {
  double cosine_plus_one[kAzimuth], azimuth_weight[kAzimuth];
  for (int j = 0; j < kAzimuth; ++j) {
    const Node azimuth = SmoothStep(j, kAzimuth);
    cosine_plus_one[j] = 1.0 + Cos(kPiDouble * azimuth.value);
    azimuth_weight[j] = 2.0 * kPiDouble * azimuth.weight;  // both halves of the circle
  }
  double z[kPolar], z_weight[kPolar], sin2[kPolar * kAzimuth];
  const double sin_v = std::sqrt(std::max(1.0 - n_dot_v * n_dot_v, 0.0));
  for (int i = 0; i < kPolar; ++i) {
    const Node polar = SmoothStep(i, kPolar);
    z[i] = polar.value * polar.value;  // the lobe lies near the horizon
    z_weight[i] = 2.0 * polar.value * polar.weight;
    const double sin_l = std::sqrt(1.0 - z[i] * z[i]);
    const double difference = sin_v - sin_l, upwards = n_dot_v + z[i];
    for (int j = 0; j < kAzimuth; ++j) {
      const double q = difference * difference + 2.0 * sin_v * sin_l * cosine_plus_one[j];
      sin2[i * kAzimuth + j] = q / (q + upwards * upwards);
    }
  }
  for (int k = 0; k < count; ++k) {
    const double alpha = roughness[k] * roughness[k];
    const lanes::CharlieMasking<double> masking(alpha);
    const double lambda_of_view = masking.Lambda(n_dot_v);
    double sum = 0.0;
    for (int i = 0; i < kPolar; ++i) {
      double ring = 0.0;
      for (int j = 0; j < kAzimuth; ++j) {
        ring += lanes::DistributionCharlie(sin2[i * kAzimuth + j], 1.0 / alpha) * azimuth_weight[j];
      }
      sum += ring * z_weight[i] / (1.0 + lambda_of_view + masking.Lambda(z[i]));
    }
    out[k] = sum / (4.0 * n_dot_v);
  }
}

double FourthPower(double x) { return (x * x) * (x * x); }

double Spaced(float first, int i, int count) { return double(first) + (1.0 - double(first)) * i / (count - 1); }

}  // namespace

double IntegrateSheenAlbedo(double n_dot_v, double perceptual_roughness) {
  double albedo = 0.0;
  IntegrateColumn(n_dot_v, &perceptual_roughness, 1, &albedo);
  return albedo;
}

void ComputeSheenTable(SheenTable* table) {
  constexpr int kRows = SheenTable::kRows, kColumns = SheenTable::kColumns;
  double roughness[kRows];
  for (int row = 0; row < kRows; ++row) roughness[row] = FourthPower(Spaced(SheenTable::kFirstRow, row, kRows));
  ParallelFor(kColumns, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t column = begin; column < end; ++column) {
      double albedo[kRows];
      const double n_dot_v = FourthPower(Spaced(SheenTable::kFirstColumn, static_cast<int>(column), kColumns));
      IntegrateColumn(n_dot_v, roughness, kRows, albedo);
      for (std::size_t row = 0; row + 1 < kRows; ++row) {
        float* out = table->albedo + 2 * (row * kColumns + column);
        out[0] = static_cast<float>(albedo[row]);
        out[1] = static_cast<float>(albedo[row + 1]);
      }
    }
  });
}

const SheenTable& SharedSheenTable() {
  static const std::unique_ptr<const SheenTable> table = [] {
    auto made = std::make_unique<SheenTable>();
    ComputeSheenTable(made.get());
    return made;
  }();
  return *table;
}

}  // namespace facet
HWY_AFTER_NAMESPACE();
