#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "light/sheen_albedo.cc"
#include "hwy/foreach_target.h"

#include "facet/shader/dispatch.h"
#include "light/sheen_albedo.h"
#include "material/lobes/sheen-inl.h"

#ifndef FACET_LIGHT_SHEEN_COLUMN
#define FACET_LIGHT_SHEEN_COLUMN
namespace facet {

// E at one n_dot_v is the integral of D V n_dot_l dl over n_dot_l = z and the azimuth. sin(theta_h) at its nodes does
// not depend on roughness, so one logarithm of it serves all roughnesses. Number: float for lanes, or double.
template <class Number>
struct SheenColumn {
  static constexpr int kPolar = 24, kAzimuth = 16;
  Number n_dot_v;
  Number z[kPolar], z_weight[kPolar], azimuth_weight[kAzimuth];
  Number log2_sin2[kPolar * kAzimuth];  // of sin(theta_h)^2
  bool is_cloth;                        // of Filament's fibres
  const Number* roughness;              // SheenTable::kRows of them for lanes, else one
  Number* albedo;                       // E for each
};

}  // namespace facet
#endif

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

template <class T, class Number>
FACET_INLINE T IntegrateSheen(const SheenColumn<Number>& column, T roughness) {
  const T alpha = AlphaFromPerceptualRoughness(roughness), inverse_alpha = T(1.0f) / alpha, n_dot_v(column.n_dot_v);
  const CharlieMasking<T> masking(alpha);
  const T one_and_lambda_of_view = T(1.0f) + masking.Lambda(n_dot_v);
  T sum = T(0.0f);
  for (int i = 0; i < column.kPolar; ++i) {
    T ring = T(0.0f);
    for (int j = 0; j < column.kAzimuth; ++j) {
      const T log2_sin2(column.log2_sin2[i * column.kAzimuth + j]);
      ring += DistributionCharlieOfLog2(log2_sin2, inverse_alpha) * T(column.azimuth_weight[j]);
    }
    sum += ring * T(column.z_weight[i]) / (one_and_lambda_of_view + masking.Lambda(T(column.z[i])));
  }
  return sum / (T(4.0f) * n_dot_v);
}

// The same of Filament's fibres: D of Charlie, V of Neubelt.
template <class T, class Number>
FACET_INLINE T IntegrateCloth(const SheenColumn<Number>& column, T roughness) {
  const T inverse_alpha = T(1.0f) / AlphaFromPerceptualRoughness(roughness), n_dot_v(column.n_dot_v);
  T sum = T(0.0f);
  for (int i = 0; i < column.kPolar; ++i) {
    T ring = T(0.0f);
    for (int j = 0; j < column.kAzimuth; ++j) {
      const T log2_sin2(column.log2_sin2[i * column.kAzimuth + j]);
      ring += DistributionCharlieOfLog2(log2_sin2, inverse_alpha) * T(column.azimuth_weight[j]);
    }
    const T z(column.z[i]);
    sum += ring * T(column.z_weight[i]) * z / (z + n_dot_v - z * n_dot_v);
  }
  return sum * T(0.25f);
}

void IntegrateSheenColumn(const SheenColumn<float>& column) {
  static_assert(SheenTable::kRows % kMaxLanes == 0);
  for (int row = 0; row < SheenTable::kRows; row += static_cast<int>(LaneCount())) {
    const Float roughness = LoadFloat(column.roughness + row);
    Store(column.is_cloth ? IntegrateCloth(column, roughness) : IntegrateSheen(column, roughness), column.albedo + row);
  }
}

void IntegrateSheenPoint(const SheenColumn<double>& column) {
  *column.albedo =
      column.is_cloth ? IntegrateCloth(column, *column.roughness) : IntegrateSheen(column, *column.roughness);
}

static_assert(SheenTable::kFirstRow * SheenTable::kFirstRow * SheenTable::kFirstRow * SheenTable::kFirstRow <=
              kMinSheenRoughness);

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <algorithm>
#include <cmath>
#include <memory>

#include "base/parallel.h"
#include "math/elementary.h"

namespace facet {
namespace {

FACET_EXPORT(IntegrateSheenColumn);
FACET_EXPORT(IntegrateSheenPoint);

constexpr double kPiDouble = 3.14159265358979324;

// Midpoints of even steps in a variable s, of which 6 s^5 - 15 s^4 + 10 s^3 reaches 0 and 1 with two vanishing
// derivatives, so that the midpoint rule converges fast whatever the integrand does at the ends.
struct Node {
  double value, weight;
};
Node SmoothStep(int i, int count) {
  const double s = (i + 0.5) / count, rest = 1.0 - s;
  return {s * s * s * (10.0 + s * (6.0 * s - 15.0)), 30.0 * (s * s) * (rest * rest) / count};
}

// sin(theta_h)^2 = q / (q + (n_dot_v + z)^2), with q the square of the length of view + light along the surface, which
// is computed without cancellation.
template <class Number>
SheenColumn<Number> MakeColumn(bool is_cloth, double n_dot_v, const Number* roughness, Number* albedo) {
  SheenColumn<Number> column{};
  column.n_dot_v = static_cast<Number>(n_dot_v);
  column.is_cloth = is_cloth;
  column.roughness = roughness;
  column.albedo = albedo;
  double cosine_plus_one[SheenColumn<Number>::kAzimuth];
  for (int j = 0; j < column.kAzimuth; ++j) {
    const Node azimuth = SmoothStep(j, column.kAzimuth);
    cosine_plus_one[j] = 1.0 + Cos(kPiDouble * azimuth.value);
    column.azimuth_weight[j] = static_cast<Number>(2.0 * kPiDouble * azimuth.weight);  // both halves of the circle
  }
  const double sin_v = std::sqrt(std::max(1.0 - n_dot_v * n_dot_v, 0.0));
  for (int i = 0; i < column.kPolar; ++i) {
    const Node polar = SmoothStep(i, column.kPolar);
    const double z = polar.value * polar.value;  // the lobe lies near the horizon
    const double sin_l = std::sqrt(1.0 - z * z), difference = sin_v - sin_l, upwards = n_dot_v + z;
    column.z[i] = static_cast<Number>(z);
    column.z_weight[i] = static_cast<Number>(2.0 * polar.value * polar.weight);
    for (int j = 0; j < column.kAzimuth; ++j) {
      const double q = difference * difference + 2.0 * sin_v * sin_l * cosine_plus_one[j];
      column.log2_sin2[i * column.kAzimuth + j] = static_cast<Number>(Log2(q / (q + upwards * upwards)));
    }
  }
  return column;
}

double FourthPower(double x) { return (x * x) * (x * x); }

double Spaced(float first, int i, int count) { return double(first) + (1.0 - double(first)) * i / (count - 1); }

}  // namespace

double IntegrateSheenAlbedo(double n_dot_v, double perceptual_roughness) {
  double albedo = 0.0;
  FACET_DISPATCH(IntegrateSheenPoint)(MakeColumn(false, n_dot_v, &perceptual_roughness, &albedo));
  return albedo;
}
double IntegrateClothAlbedo(double n_dot_v, double perceptual_roughness) {
  double albedo = 0.0;
  FACET_DISPATCH(IntegrateSheenPoint)(MakeColumn(true, n_dot_v, &perceptual_roughness, &albedo));
  return albedo;
}

namespace {

void ComputeTable(bool is_cloth, SheenTable* table) {
  constexpr int kRows = SheenTable::kRows, kColumns = SheenTable::kColumns;
  float roughness[kRows];
  for (int row = 0; row < kRows; ++row) {
    roughness[row] = static_cast<float>(FourthPower(Spaced(SheenTable::kFirstRow, row, kRows)));
  }
  const auto integrate = IntegrateSheenColumnForTarget(ActiveTarget());
  ParallelFor(kColumns, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t column = begin; column < end; ++column) {
      float albedo[kRows];
      const double n_dot_v = FourthPower(Spaced(SheenTable::kFirstColumn, static_cast<int>(column), kColumns));
      integrate(MakeColumn(is_cloth, n_dot_v, roughness, albedo));
      for (std::size_t row = 0; row + 1 < kRows; ++row) {
        float* out = table->albedo + 2 * (row * kColumns + column);
        out[0] = albedo[row];
        out[1] = albedo[row + 1];
      }
    }
  });
}

}  // namespace

void ComputeSheenTable(SheenTable* table) { ComputeTable(false, table); }

const SheenTable& SharedSheenTable() {
  static const std::unique_ptr<const SheenTable> table = [] {
    auto made = std::make_unique<SheenTable>();
    ComputeSheenTable(made.get());
    return made;
  }();
  return *table;
}
const SheenTable& SharedClothTable() {
  static const std::unique_ptr<const SheenTable> table = [] {
    auto made = std::make_unique<SheenTable>();
    ComputeTable(true, made.get());
    return made;
  }();
  return *table;
}

}  // namespace facet
#endif
