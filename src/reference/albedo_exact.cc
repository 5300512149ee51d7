#include "reference/albedo_exact.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "math/elementary.h"

namespace facet {
namespace {

constexpr double kPiDouble = 3.14159265358979324;
constexpr double kFirstLog = -3.102;  // below the logarithm of the smallest perceptual roughness, 0.045

// Gauss-Legendre quadrature on [0, 1].
template <int kCount>
struct GaussRule {
  std::array<double, kCount> x, weight;

  GaussRule() {
    for (int i = 0; i < kCount; ++i) {
      double root = Cos(kPiDouble * (i + 0.75) / (kCount + 0.5)), slope = 1.0;
      for (int step = 0; step < 8; ++step) {  // Newton steps from an estimate that is accurate to three digits
        double before = 1.0, value = root;
        for (int n = 2; n <= kCount; ++n) {
          const double next = ((2 * n - 1) * root * value - (n - 1) * before) / n;
          before = value;
          value = next;
        }
        slope = kCount * (root * value - before) / (root * root - 1.0);
        root -= value / slope;
      }
      x[std::size_t(i)] = 0.5 * (1.0 - root);
      weight[std::size_t(i)] = 1.0 / ((1.0 - root * root) * slope * slope);
    }
  }
};

const GaussRule<10>& Gauss() {
  static const GaussRule<10> rule;
  return rule;
}

double FifthPower(double x) { return (x * x) * (x * x) * x; }

// The lobe over one circle of the light's azimuth. With q the square of half the azimuth's sine, counted from the
// mirror direction: v_dot_h^2 = p + q_scale q, and D = alpha^2 / pi ((p + q_scale q) / (r + q_scale q))^2.
struct Circle {
  double p, r, q_scale;

  // The integral of (pi / alpha^2) D.
  double Whole() const {
    const double product = r * (r + q_scale), root = std::sqrt(product), k = p - r;
    return 2.0 * kPiDouble * (1.0 + 2.0 * k / root + k * k * (r + 0.5 * q_scale) / (product * root));
  }

  // The integral of (pi / alpha^2) D (1 - v_dot_h)^5.
  double Fresnel(double whole) const {
    constexpr double kStep = 0.5;
    static const double up = Exp(kStep), up2 = up * up;
    const double at_peak = FifthPower(1.0 - std::sqrt(p));
    // t = tan(azimuth / 2) = e^y; the azimuth grows by dy / cosh y. The lobe's flank is where t^2 = r / (r + q_scale).
    const double flank2 = r / (r + q_scale), flank = std::sqrt(flank2);
    const auto term = [&](double t, double t2) {
      const double q = q_scale * t2 / (1.0 + t2);
      const double share = (p + q) / (r + q);
      return (FifthPower(1.0 - std::sqrt(p + q)) - at_peak) * share * share * 2.0 * t / (1.0 + t2);
    };
    double sum = 0.0;
    const auto add = [&](double value) {
      sum += value;
      return std::fabs(value) > 1e-10 * std::fabs(sum) + 1e-12 * whole;
    };
    double t = flank, t2 = flank2;
    for (int i = 0; add(term(t, t2)) || i < 4; ++i) t *= up, t2 *= up2;
    t = flank / up, t2 = flank2 / up2;
    while (add(term(t, t2))) t /= up, t2 /= up2;
    return at_peak * whole + 2.0 * kStep * sum;
  }
};

// The ends of the intervals for integrating over the light's polar angle, ascending from 0 to pi / 2.
std::vector<double> Pieces(double polar_v, double n_dot_v, double alpha) {
  const double right = 0.5 * kPiDouble;
  std::vector<double> ends = {0.0, right};
  const auto add = [&](double angle) {
    if (angle > 0.0 && angle < right) ends.push_back(angle);
  };
  add(polar_v);
  for (double d = 0.5 * alpha; d < kPiDouble; d *= 4.0) {
    add(polar_v - d);
    add(polar_v + d);
  }
  // Masking changes where the cosine of the light's polar angle is near alpha or near n_dot_v.
  for (double d = std::clamp(n_dot_v, 1e-10, alpha); d < right; d *= 4.0) add(right - d);
  std::sort(ends.begin(), ends.end());
  return ends;
}

}  // namespace

ExactAlbedo IntegrateAlbedo(double n_dot_v, double alpha) {
  const double a2 = alpha * alpha;
  const double polar_v = Acos(n_dot_v), sin_v = std::sqrt(1.0 - n_dot_v * n_dot_v);
  const double masked_v = std::sqrt(n_dot_v * n_dot_v * (1.0 - a2) + a2);
  const std::vector<double> ends = Pieces(polar_v, n_dot_v, alpha);
  const GaussRule<10>& gauss = Gauss();
  double whole = 0.0, fresnel = 0.0;
  for (std::size_t piece = 0; piece + 1 < ends.size(); ++piece) {
    const double length = ends[piece + 1] - ends[piece];
    for (std::size_t i = 0; i < gauss.x.size(); ++i) {
      const double polar_l = ends[piece] + length * gauss.x[i];
      const double elevation_l = (0.5 * kPiDouble - ends[piece + 1]) + length * (1.0 - gauss.x[i]);
      const double n_dot_l = Sin(elevation_l), sin_l = Sin(polar_l);
      const double masked_l = std::sqrt(n_dot_l * n_dot_l * (1.0 - a2) + a2);
      const double mean = Cos(0.5 * (polar_l + polar_v)), off = Sin(0.5 * (polar_l - polar_v));
      const double p = mean * mean;
      const Circle circle{p, p * (off * off + a2 * (1.0 - off * off)), sin_l * sin_v};
      const double visibility = 0.5 / (n_dot_v * masked_l + n_dot_l * masked_v);
      const double weight = length * gauss.weight[i] * sin_l * n_dot_l * visibility * a2 / kPiDouble;
      const double around = circle.Whole();
      whole += weight * around;
      fresnel += weight * circle.Fresnel(around);
    }
  }
  return {whole - fresnel, fresnel};
}

namespace {

// The values of the Chebyshev polynomials at x in [-1, 1].
template <int kCount>
std::array<double, kCount> ChebyshevAt(double x) {
  std::array<double, kCount> t;
  t[0] = 1.0;
  t[1] = x;
  for (std::size_t k = 2; k < kCount; ++k) t[k] = 2.0 * x * t[k - 1] - t[k - 2];
  return t;
}

// Node j of `count`, and the weight of its value in polynomial k's coefficient.
double ChebyshevNode(int j, int count) { return Cos(kPiDouble * (j + 0.5) / count); }
double ChebyshevWeight(int j, int k, int count) {
  return (k == 0 ? 1.0 : 2.0) / count * Cos(kPiDouble * k * (j + 0.5) / count);
}

struct PanelPosition {
  int panel;
  double x;  // [-1, 1]
};
PanelPosition FindPanel(double unit, int panels) {
  const int panel = std::clamp(static_cast<int>(unit * panels), 0, panels - 1);
  return {panel, std::clamp(2.0 * (unit * panels - panel) - 1.0, -1.0, 1.0)};
}

}  // namespace

ExactAlbedo AlbedoRow::At(double n_dot_v) const {
  const auto [panel, x] = FindPanel(std::sqrt(std::sqrt(std::clamp(n_dot_v, 0.0, 1.0))), kPanels);
  const auto t = ChebyshevAt<kNodes>(x);
  ExactAlbedo sum;
  for (int k = 0; k < kNodes; ++k) {
    sum.a += coefficients_[panel][k][0] * t[std::size_t(k)];
    sum.b += coefficients_[panel][k][1] * t[std::size_t(k)];
  }
  return sum;
}

AlbedoRow AlbedoSurface::Row(double perceptual_roughness) const {
  const auto [panel, x] = FindPanel(1.0 - Log(perceptual_roughness) / kFirstLog, kPanels);
  const auto t = ChebyshevAt<kNodes>(x);
  AlbedoRow row{};
  double* out = &row.coefficients_[0][0][0];
  for (int i = 0; i < kNodes; ++i) {
    const AlbedoRow& from = coefficients_[std::size_t(panel * kNodes + i)];
    const double* in = &from.coefficients_[0][0][0];
    for (int k = 0; k < AlbedoRow::kPanels * AlbedoRow::kNodes * 2; ++k) out[k] += in[k] * t[std::size_t(i)];
    row.average_.a += from.average_.a * t[std::size_t(i)];
    row.average_.b += from.average_.b * t[std::size_t(i)];
  }
  return row;
}

ExactAlbedo AlbedoSurface::At(double n_dot_v, double perceptual_roughness) const {
  const auto [panel, x] = FindPanel(1.0 - Log(perceptual_roughness) / kFirstLog, kPanels);
  const auto t = ChebyshevAt<kNodes>(x);
  ExactAlbedo sum;
  for (int i = 0; i < kNodes; ++i) {
    const ExactAlbedo at = coefficients_[std::size_t(panel * kNodes + i)].At(n_dot_v);
    sum.a += at.a * t[std::size_t(i)];
    sum.b += at.b * t[std::size_t(i)];
  }
  return sum;
}

AlbedoSurface::AlbedoSurface() {
  constexpr int kColumns = AlbedoRow::kPanels, kOrder = AlbedoRow::kNodes;
  // First, a row for each node over roughness.
  std::vector<AlbedoRow> rows(kPanels * kNodes);
  ParallelFor(rows.size() * kColumns, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const int node = int(i) / kColumns, column = int(i) % kColumns;
      const double unit = (node / kNodes + 0.5 + 0.5 * ChebyshevNode(node % kNodes, kNodes)) / kPanels;
      const double alpha = Exp(2.0 * kFirstLog * (1.0 - unit));
      auto& to = rows[std::size_t(node)].coefficients_[column];
      std::fill(&to[0][0], &to[0][0] + kOrder * 2, 0.0);
      for (int j = 0; j < kOrder; ++j) {
        const double fourth_root = (column + 0.5 + 0.5 * ChebyshevNode(j, kOrder)) / kColumns;
        const double square = fourth_root * fourth_root;
        const ExactAlbedo albedo = IntegrateAlbedo(square * square, alpha);
        for (int k = 0; k < kOrder; ++k) {
          to[k][0] += albedo.a * ChebyshevWeight(j, k, kOrder);
          to[k][1] += albedo.b * ChebyshevWeight(j, k, kOrder);
        }
      }
    }
  });
  // Then their averages: with u the fourth root of mu, mu d mu = 4 u^7 du. The integrand is a polynomial of degree 17.
  for (AlbedoRow& row : rows) {
    row.average_ = {};
    for (int column = 0; column < kColumns; ++column) {
      for (std::size_t i = 0; i < Gauss().x.size(); ++i) {
        const double u = (column + Gauss().x[i]) / kColumns, u2 = u * u;
        const ExactAlbedo at = row.At(u2 * u2);
        const double weight = Gauss().weight[i] / kColumns * 8.0 * u2 * u2 * u2 * u;
        row.average_.a += weight * at.a;
        row.average_.b += weight * at.b;
      }
    }
  }
  // Last, the polynomials over roughness that interpolate the rows.
  coefficients_.resize(rows.size());
  for (int panel = 0; panel < kPanels; ++panel) {
    for (int i = 0; i < kNodes; ++i) {
      AlbedoRow& to = coefficients_[std::size_t(panel * kNodes + i)];
      to = AlbedoRow{};
      for (int j = 0; j < kNodes; ++j) {
        const AlbedoRow& from = rows[std::size_t(panel * kNodes + j)];
        const double weight = ChebyshevWeight(j, i, kNodes);
        for (int column = 0; column < kColumns; ++column) {
          for (int k = 0; k < kOrder; ++k) {
            for (int c = 0; c < 2; ++c) to.coefficients_[column][k][c] += weight * from.coefficients_[column][k][c];
          }
        }
        to.average_.a += weight * from.average_.a;
        to.average_.b += weight * from.average_.b;
      }
    }
  }
}

const AlbedoSurface& AlbedoSurface::Shared() {
  static const AlbedoSurface surface;
  return surface;
}

}  // namespace facet
