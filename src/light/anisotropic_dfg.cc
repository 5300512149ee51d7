#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "light/anisotropic_dfg.cc"
#include "hwy/foreach_target.h"

#include "facet/shader/brdf-inl.h"
#include "facet/shader/dispatch.h"
#include "light/anisotropic_dfg.h"

#ifndef FACET_LIGHT_ANISOTROPIC_DFG_TASK
#define FACET_LIGHT_ANISOTROPIC_DFG_TASK
namespace facet {

// Points of equal density in the cap of directions that a view sees, before it is known which view: the share of the
// cap's height, measured from its top, and the azimuth.
struct CapPoints {
  // A Fibonacci lattice: as even as a grid of twice as many points (root mean square error of A + B over views,
  // roughnesses and strengths: 4e-4, at most 0.0018; a grid of 24 x 16 has 0.0011 and 0.0039).
  static constexpr int kCount = 377, kGenerator = 233;
  float share[kCount], weight[kCount], cos_azimuth[kCount], sin_azimuth[kCount];
};

// The views of a table's samples, the same in every row and layer.
struct SampleViews {
  static constexpr int kCount = AnisotropicDfgTable::kTurns * AnisotropicDfgTable::kColumns;
  float n[kCount], t[kCount], b[kCount];  // components along the normal (> 0), the tangent and the bitangent
};

struct AnisotropicDfgTask {
  float alpha_t, alpha_b;
  const CapPoints* points;
  const SampleViews* views;
  float* albedo;  // A, B for each view
};

}  // namespace facet
#endif

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// The mean of F G2 / G1 over the normals that the view sees, of which even points of a spherical cap are the image
// (Dupuy and Benyoub, 2023, Sampling Visible GGX Normals with Spherical Caps): no roughness leaves a narrow peak in it.
void IntegrateAnisotropicDfg(const AnisotropicDfgTask& task) {
  static_assert(SampleViews::kCount % kMaxLanes == 0);
  const CapPoints& points = *task.points;
  const Float alpha_t(task.alpha_t), alpha_b(task.alpha_b), zero(0.0f), one(1.0f);
  for (int view = 0; view < SampleViews::kCount; view += static_cast<int>(LaneCount())) {
    const Float n = LoadFloat(task.views->n + view), t = LoadFloat(task.views->t + view);
    const Float b = LoadFloat(task.views->b + view);
    const auto length = [&](Float along_t, Float along_b, Float along_n) HWY_ATTR {
      const Float x = alpha_t * along_t, y = alpha_b * along_b;
      return Sqrt(x * x + y * y + along_n * along_n);
    };
    const Float view_length = length(t, b, n), inverse = one / view_length;
    const Float top_t = alpha_t * t * inverse, top_b = alpha_b * b * inverse, top_n = n * inverse;
    Float whole = zero, fresnel = zero;
    for (int i = 0; i < CapPoints::kCount; ++i) {
      // The half vector, not normalised: the cap's point and the stretched view, added and stretched back.
      const Float h_n = (one + top_n) * Float(1.0f - points.share[i]), z = h_n - top_n;
      const Float around = Sqrt(Max(one - z * z, zero));
      const Float h_t = alpha_t * (around * Float(points.cos_azimuth[i]) + top_t);
      const Float h_b = alpha_b * (around * Float(points.sin_azimuth[i]) + top_b);
      const Float length2 = h_t * h_t + h_b * h_b + h_n * h_n, v_dot_h = t * h_t + b * h_b + n * h_n;
      const Float twice = Float(2.0f) * v_dot_h / length2;
      const Float n_dot_l = Max(twice * h_n - n, zero);
      const Float light_length = length(twice * h_t - t, twice * h_b - b, n_dot_l);
      const Float seen = n_dot_l * (n + view_length) / (n_dot_l * view_length + n * light_length);
      const Float weight = seen * Float(points.weight[i]);
      whole += weight;
      fresnel += weight * SchlickWeight(v_dot_h / Sqrt(length2));
    }
    float a_of[kMaxLanes], b_of[kMaxLanes];
    Store(whole - fresnel, a_of);
    Store(fresnel, b_of);
    for (std::size_t lane = 0; lane < LaneCount(); ++lane) {
      float* out = task.albedo + 2 * (static_cast<std::size_t>(view) + lane);
      out[0] = a_of[lane];
      out[1] = b_of[lane];
    }
  }
}

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

FACET_EXPORT(IntegrateAnisotropicDfg);

using Table = AnisotropicDfgTable;
constexpr double kPiDouble = 3.14159265358979324;
static_assert(Table::kFirstRow * Table::kFirstRow <= HWY_NAMESPACE::kMinPerceptualRoughness);

double EighthPower(double x) { return ((x * x) * (x * x)) * ((x * x) * (x * x)); }
double FourthRoot(double x) { return std::sqrt(std::sqrt(x)); }

CapPoints MakeCapPoints() {
  CapPoints points;
  for (int i = 0; i < CapPoints::kCount; ++i) {
    // Denser at both ends of the height, where the integrand has a root: 3 s^2 - 2 s^3 of even steps s.
    const double s = (i + 0.5) / CapPoints::kCount;
    points.share[i] = static_cast<float>(s * s * (3.0 - 2.0 * s));
    points.weight[i] = static_cast<float>(6.0 * s * (1.0 - s) / CapPoints::kCount);
    const double azimuth = double(i * CapPoints::kGenerator % CapPoints::kCount) + 0.25;
    points.cos_azimuth[i] = static_cast<float>(Cos(2.0 * kPiDouble * azimuth / CapPoints::kCount));
    points.sin_azimuth[i] = static_cast<float>(Sin(2.0 * kPiDouble * azimuth / CapPoints::kCount));
  }
  return points;
}

SampleViews MakeSampleViews() {
  SampleViews views;
  for (int i = 0; i < SampleViews::kCount; ++i) {
    const double turn = double(i / Table::kColumns) / (Table::kTurns - 1);
    const double u = double(i % Table::kColumns) / (Table::kColumns - 1);
    const double n = std::max((u * u) * (u * u), 1e-7);  // at 0 the integral would divide by 0
    const double sin2 = 1.0 - n * n, across = FourthRoot(n);
    const double t2 = std::clamp(EighthPower(across + (1.0 - across) * turn) - n * n, 0.0, sin2);
    views.n[i] = static_cast<float>(n);
    views.t[i] = static_cast<float>(std::sqrt(t2));
    views.b[i] = static_cast<float>(std::sqrt(sin2 - t2));
  }
  return views;
}

// What each turn and column contributes to the average over the hemisphere, 2 * integral of mu d mu and the mean over
// azimuths, of the table as it is interpolated: midpoints of `kSteps` steps in u between columns, and in the azimuth,
// where they crowd towards the bitangent.
struct HemisphereWeights {
  double at[SampleViews::kCount] = {};

  HemisphereWeights() {
    constexpr int kSteps = 8, kAzimuths = 128;
    double cos2[kAzimuths], share[kAzimuths];
    for (int j = 0; j < kAzimuths; ++j) {
      const double s = (j + 0.5) / kAzimuths, cosine = Sin(0.5 * kPiDouble * s * s);
      cos2[j] = cosine * cosine;
      share[j] = 2.0 * s / kAzimuths;
    }
    double all = 0.0;
    for (int i = 0; i < (Table::kColumns - 1) * kSteps; ++i) {
      const int column = i / kSteps;
      const double within = (i % kSteps + 0.5) / kSteps, u = (column + within) / (Table::kColumns - 1);
      const double mu = (u * u) * (u * u), mu2 = mu * mu;
      const double of_mu = mu * (u * u * u);  // 2 mu d mu, but for a constant
      for (int j = 0; j < kAzimuths; ++j) {
        const double y = std::sqrt(FourthRoot(mu2 + (1.0 - mu2) * cos2[j]));
        const double turn = std::clamp((y - u) / (1.0 - u), 0.0, 1.0) * (Table::kTurns - 1);
        const int first = std::min(static_cast<int>(turn), Table::kTurns - 2);
        const double weight = of_mu * share[j], second = turn - first;
        double* out = at + first * Table::kColumns + column;
        out[0] += weight * (1.0 - second) * (1.0 - within);
        out[1] += weight * (1.0 - second) * within;
        out[Table::kColumns] += weight * second * (1.0 - within);
        out[Table::kColumns + 1] += weight * second * within;
        all += weight;
      }
    }
    for (double& weight : at) weight /= all;
  }

  float Average(const float* albedo) const {
    double sum = 0.0;
    for (int i = 0; i < SampleViews::kCount; ++i) sum += at[i] * double(albedo[2 * i]);
    return static_cast<float>(sum);
  }
};

}  // namespace

void ComputeAnisotropicDfgTable(AnisotropicDfgTable* table) {
  const CapPoints points = MakeCapPoints();
  const SampleViews views = MakeSampleViews();
  const HemisphereWeights weights;
  const auto integrate = IntegrateAnisotropicDfgForTarget(ActiveTarget());
  ParallelFor(Table::kRows * Table::kLayers, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double first = double(Table::kFirstRow);
      const double root = first + (1.0 - first) * double(i / Table::kLayers) / (Table::kRows - 1);
      const double strength = double(i % Table::kLayers) / (Table::kLayers - 1);
      const double alpha_b = (root * root) * (root * root), alpha_t = alpha_b + (1.0 - alpha_b) * strength * strength;
      float* albedo = table->albedo + i * SampleViews::kCount * 2;
      integrate({static_cast<float>(alpha_t), static_cast<float>(alpha_b), &points, &views, albedo});
      table->average[2 * i] = weights.Average(albedo);
      table->average[2 * i + 1] = weights.Average(albedo + 1);
    }
  });
}

const AnisotropicDfgTable& SharedAnisotropicDfgTable() {
  static const std::unique_ptr<const AnisotropicDfgTable> table = [] {
    auto made = std::make_unique<AnisotropicDfgTable>();
    ComputeAnisotropicDfgTable(made.get());
    return made;
  }();
  return *table;
}

}  // namespace facet
#endif
