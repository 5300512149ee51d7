// The material model written down once more, as formulas and with the C library's functions: what the renderers'
// closure is checked against. Source: glTF 2.0 specification, appendix B, with the compensation that
// src/material/closure-inl.h states.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

#include "reference/albedo_exact.h"

namespace facet {

class ClosedForm {
 public:
  ClosedForm(const glm::dvec3& base, double metallic, double roughness)
      : base_(base), metallic_(metallic), alpha_(roughness * roughness) {
    constexpr int kSteps = 400;  // Simpson's rule in u, mu = u^4
    for (int i = 1; i <= kSteps; ++i) {
      const double u = double(i) / kSteps, weight = (i == kSteps ? 1.0 : i % 2 != 0 ? 4.0 : 2.0) / (3.0 * kSteps);
      const ExactAlbedo e = IntegrateAlbedo(u * u * u * u, alpha_);
      average_.a += e.a * weight * 8.0 * std::pow(u, 7.0);
      average_.b += e.b * weight * 8.0 * std::pow(u, 7.0);
    }
  }

  // The BRDF; unit vectors, `n` on the side of both others.
  glm::dvec3 Brdf(const glm::dvec3& n, const glm::dvec3& v, const glm::dvec3& l) const {
    const glm::dvec3 h = glm::normalize(v + l);
    const double nl = glm::dot(n, l), nv = glm::dot(n, v), nh = glm::dot(n, h), vh = glm::dot(v, h),
                 a2 = alpha_ * alpha_;
    const double d = a2 / (kPi * std::pow(nh * nh * (a2 - 1.0) + 1.0, 2.0));
    const double vis = 0.5 / (nv * std::sqrt(nl * nl * (1.0 - a2) + a2) + nl * std::sqrt(nv * nv * (1.0 - a2) + a2));
    const ExactAlbedo ev = IntegrateAlbedo(nv, alpha_), el = IntegrateAlbedo(nl, alpha_);
    const double weight = std::pow(1.0 - vh, 5.0);
    const double multiple = Lost(ev) * Lost(el) / (kPi * Lost(average_));
    glm::dvec3 result;
    for (int c = 0; c < 3; ++c) {
      const double metal = (base_[c] + (1.0 - base_[c]) * weight) * d * vis + Fms(base_[c]) * multiple;
      const double specular = (0.04 + 0.96 * weight) * d * vis + Fms(0.04) * multiple;
      const double diffuse = base_[c] / kPi * Left(ev) * Left(el) / Left(average_);
      result[c] = (1.0 - metallic_) * (specular + diffuse) + metallic_ * metal;
    }
    return result;
  }

  // The share of light that the dielectric's interface lets pass at an angle.
  double LeftAt(double n_dot_v) const { return Left(IntegrateAlbedo(n_dot_v, alpha_)); }

 private:
  static constexpr double kPi = 3.14159265358979324;
  static double Lost(const ExactAlbedo& e) { return 1.0 - e.a - e.b; }
  double Left(const ExactAlbedo& e) const { return 1.0 - (0.04 * e.a + e.b + Fms(0.04) * Lost(e)); }
  double Fms(double f0) const {
    const double f = f0 + (1.0 - f0) / 21.0, e = average_.a + average_.b;
    return f * f * e / (1.0 - f * (1.0 - e));
  }

  glm::dvec3 base_;
  double metallic_, alpha_;
  ExactAlbedo average_;
};

}  // namespace facet
