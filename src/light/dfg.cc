#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "light/dfg.cc"
#include "hwy/foreach_target.h"

#include "facet/shader/brdf-inl.h"
#include "facet/shader/dispatch.h"
#include "light/dfg.h"
#include "material/models/lecture_terms-inl.h"

#ifndef FACET_LIGHT_DFG_TASK
#define FACET_LIGHT_DFG_TASK
namespace facet {

// Inputs and outputs of the kernel that computes one row of the table.
struct DfgRowTask {
  float alpha;
  float schlick_k;  // of VisibilitySchlick(); 0: height-correlated Smith
  int polar_count, azimuth_count;
  const float* polar;         // tan(theta_h) / alpha
  const float* polar_weight;  // see IntegrateDfgRow; constant factors included
  const float* cos_azimuth;   // of half vectors, in [0, pi]
  const float* n_dot_v;       // DfgTable::kColumns of them, > 0
  float* albedo;              // A, B for each
};

}  // namespace facet
#endif

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// The integral of D V n_dot_l dl over half vectors, with dl = 4 v_dot_h dh. In x = tan(theta_h) / alpha and y = ln x:
//   D dh = x^2 / (1 + x^2)^2 / (pi cos(theta_h)) dy dphi,
// so that the part that varies fast is the same for every alpha. Equal steps in y also reach the far tails, which
// matter at grazing views; points evenly spaced in D's cumulative distribution miss them and lose up to 5 %.
void IntegrateDfgRow(const DfgRowTask& task) {
  static_assert(DfgTable::kColumns % kMaxLanes == 0);
  for (int column = 0; column < DfgTable::kColumns; column += static_cast<int>(LaneCount())) {
    const Float n_dot_v = LoadFloat(task.n_dot_v + column);
    const Float sin_v = Sqrt(Max(Float(1.0f) - n_dot_v * n_dot_v, Float(0.0f)));
    Float sum_a = 0.0f;
    Float sum_b = 0.0f;
    for (int i = 0; i < task.polar_count; ++i) {
      const float tangent = task.alpha * task.polar[i];
      const Float secant = Sqrt(Float(1.0f + tangent * tangent));
      const Float n_dot_h = Float(1.0f) / secant;
      const Float reach = sin_v * Float(tangent) * n_dot_h;
      const Float v_dot_h_mean = n_dot_v * n_dot_h;
      Float ring_a = 0.0f;
      Float ring_b = 0.0f;
      for (int j = 0; j < task.azimuth_count; ++j) {
        const Float v_dot_h = reach * Float(task.cos_azimuth[j]) + v_dot_h_mean;
        const Float n_dot_l = Max(Float(2.0f) * v_dot_h * n_dot_h - n_dot_v, Float(0.0f));  // > 0 only if v_dot_h > 0
        const Float visibility = task.schlick_k > 0.0f ? VisibilitySchlick(n_dot_l, n_dot_v, Float(task.schlick_k))
                                                       : VisibilitySmith(n_dot_l, n_dot_v, Float(task.alpha));
        const Float weight = visibility * n_dot_l * v_dot_h;
        const Float fresnel = weight * SchlickWeight(v_dot_h);
        ring_a += weight - fresnel;
        ring_b += fresnel;
      }
      const Float polar_weight = Float(task.polar_weight[i]) * secant;
      sum_a += ring_a * polar_weight;
      sum_b += ring_b * polar_weight;
    }
    float a[kMaxLanes], b[kMaxLanes];
    Store(sum_a, a);
    Store(sum_b, b);
    for (std::size_t lane = 0; lane < LaneCount(); ++lane) {
      float* out = task.albedo + 2 * (static_cast<std::size_t>(column) + lane);
      out[0] = a[lane];
      out[1] = b[lane];
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <algorithm>
#include <memory>

#include "base/parallel.h"
#include "math/elementary.h"

namespace facet {
namespace {

FACET_EXPORT(IntegrateDfgRow);

constexpr int kPolar = 96;
constexpr int kAzimuth = 24;
constexpr double kFirstLogTangent = -5.0, kLastLogTangent = 8.0;
constexpr double kPiDouble = 3.14159265358979324;

// 2 * integral over [0, 1] of E(mu) mu d mu, of E as the table's lookup interpolates it: linear in u, the fourth root
// of mu, so that each piece is the integral of (e0 + slope (u - u0)) 8 u^7 du.
double AverageOverHemisphere(const float* albedo) {
  const auto power8 = [](double u) { return ((u * u) * (u * u)) * ((u * u) * (u * u)); };
  const double step = 1.0 / (DfgTable::kColumns - 1);
  double sum = 0.0;
  for (int i = 0; i + 1 < DfgTable::kColumns; ++i) {
    const double u0 = i * step, u1 = (i + 1) * step;
    const double e0 = double(albedo[2 * i]);
    const double slope = (double(albedo[2 * i + 2]) - e0) / step;
    sum += (e0 - slope * u0) * (power8(u1) - power8(u0)) + slope * (8.0 / 9.0) * (power8(u1) * u1 - power8(u0) * u0);
  }
  return sum;
}

// `schlick_k(alpha)`: that of a row.
template <class SchlickK>
void ComputeTable(DfgTable* table, const SchlickK& schlick_k) {
  float polar[kPolar], polar_weight[kPolar], cos_azimuth[kAzimuth], n_dot_v[DfgTable::kColumns];
  const double polar_step = (kLastLogTangent - kFirstLogTangent) / kPolar;
  for (int i = 0; i < kPolar; ++i) {
    const double x = Exp(kFirstLogTangent + (i + 0.5) * polar_step);
    polar[i] = static_cast<float>(x);
    // 4 of dl, 1 / pi of D, 2 for azimuths beyond pi, and the steps in y and in the azimuth.
    const double steps = polar_step * (kPiDouble / kAzimuth);
    polar_weight[i] = static_cast<float>(x * x / ((1.0 + x * x) * (1.0 + x * x)) * 4.0 / kPiDouble * 2.0 * steps);
  }
  for (int j = 0; j < kAzimuth; ++j) cos_azimuth[j] = static_cast<float>(Cos(kPiDouble * (j + 0.5) / kAzimuth));
  for (int i = 0; i < DfgTable::kColumns; ++i) {
    const double u = double(i) / (DfgTable::kColumns - 1);
    n_dot_v[i] = static_cast<float>(std::max(u * u * u * u, 1e-7));  // at 0 the integral would divide by 0
  }
  const auto integrate = IntegrateDfgRowForTarget(ActiveTarget());
  ParallelFor(DfgTable::kRows, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      const double first = double(DfgTable::kFirstRow);
      const double root = first + (1.0 - first) * double(row) / (DfgTable::kRows - 1);
      const double alpha = (root * root) * (root * root);
      float* albedo = table->albedo + row * DfgTable::kColumns * 2;
      integrate({static_cast<float>(alpha), static_cast<float>(schlick_k(alpha)), kPolar, kAzimuth, polar, polar_weight,
                 cos_azimuth, n_dot_v, albedo});
      table->average[2 * row] = static_cast<float>(AverageOverHemisphere(albedo));
      table->average[2 * row + 1] = static_cast<float>(AverageOverHemisphere(albedo + 1));
    }
  });
}

template <class SchlickK>
std::unique_ptr<const DfgTable> MakeTable(const SchlickK& schlick_k) {
  auto made = std::make_unique<DfgTable>();
  ComputeTable(made.get(), schlick_k);
  return made;
}

constexpr auto kSmith = [](double) { return 0.0; };

}  // namespace

void ComputeDfgTable(DfgTable* table) { ComputeTable(table, kSmith); }

const DfgTable& SharedDfgTable() {
  static const std::unique_ptr<const DfgTable> table = MakeTable(kSmith);
  return *table;
}

const DfgTable& SharedSchlickDfgTable(LectureAlpha alpha) {
  if (alpha == LectureAlpha::RoughnessSquared) {
    static const std::unique_ptr<const DfgTable> table = MakeTable([](double a) { return a / 2.0; });
    return *table;
  }
  static const std::unique_ptr<const DfgTable> table = MakeTable([](double a) { return a * a / 2.0; });
  return *table;
}

}  // namespace facet
#endif
