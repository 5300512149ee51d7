// Random directions by the shapes of lobes.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "facet/shader/brdf-inl.h"
#include "math/elementary.h"
#include "reference/exact_source-inl.h"

// Compiled for the baseline instruction set, as exact_source-inl.h.
HWY_BEFORE_NAMESPACE();
namespace facet {

inline constexpr double kPiExact = 3.14159265358979324;

// Tangent frame of a shading normal: Duff et al., 2017, Building an Orthonormal Basis, Revisited.
class Frame {
 public:
  explicit Frame(const glm::dvec3& normal) : z_(normal) {
    const double sign = std::copysign(1.0, normal.z), a = -1.0 / (sign + normal.z), b = normal.x * normal.y * a;
    x_ = {1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x};
    y_ = {b, sign + normal.y * normal.y * a, -normal.y};
  }
  Frame(const glm::dvec3& tangent, const glm::dvec3& bitangent, const glm::dvec3& normal)
      : x_(tangent), y_(bitangent), z_(normal) {}
  glm::dvec3 ToWorld(const glm::dvec3& v) const { return x_ * v.x + y_ * v.y + z_ * v.z; }
  glm::dvec3 ToLocal(const glm::dvec3& v) const { return {glm::dot(x_, v), glm::dot(y_, v), glm::dot(z_, v)}; }

 private:
  glm::dvec3 x_, y_, z_;
};

// The point at a fraction of the unit circle's circumference.
inline glm::dvec2 OnCircle(double share) {
  const double cosine = Cos(2.0 * kPiExact * share);
  return {cosine, std::copysign(std::sqrt(std::max(1.0 - cosine * cosine, 0.0)), 0.5 - share)};
}

// Sampling of a specular lobe by reflection about visible normals. With interpolated and mapped normals, the view may
// be below the horizon; it then sees the normals that are tilted towards it. The lobe that the closure evaluates is as
// narrow there, so that other densities would miss it. Axes of the frame: tangent, bitangent, normal.
class VisibleNormals {
 public:
  VisibleNormals(const Frame& frame, const glm::dvec3& view, double alpha_t, double alpha_b)
      : frame_(frame), alpha_t_(alpha_t), alpha_b_(alpha_b) {
    const glm::dvec3 local = frame.ToLocal(view);
    view_ = glm::normalize(glm::dvec3(local.x, local.y, std::max(local.z, -0.9999)));
    stretched_ = glm::normalize(glm::dvec3(alpha_t * view_.x, alpha_b * view_.y, view_.z));
    // The area of the visible normals seen along the view (Heitz, 2014, Understanding the Masking-Shadowing Function,
    // equation 14), twice: z + masked, where that does not cancel.
    const double x = alpha_t * view_.x, y = alpha_b * view_.y, across = x * x + y * y;
    const double masked = std::sqrt(view_.z * view_.z + across);
    twice_area_ = view_.z >= 0.0 ? view_.z + masked : across / (masked - view_.z);
  }

  // A normal of the microfacets: unit, on the view's side.
  glm::dvec3 SampleNormal(const glm::dvec2& random) const { return frame_.ToWorld(Half(random)); }

  // May lie below the horizon.
  glm::dvec3 Sample(const glm::dvec2& random) const {
    const glm::dvec3 half = Half(random);
    return frame_.ToWorld(half * (2.0 * glm::dot(view_, half)) - view_);
  }

  double Density(const glm::dvec3& direction) const {
    const glm::dvec3 local = frame_.ToLocal(direction);
    if (!(local.z > 0.0)) return 0.0;
    const lanes::Vec3<double> normal = {0.0, 0.0, 1.0};
    const lanes::Vec3<double> half = lanes::NormalizeOr(ToLanes(view_ + local), normal);
    if (alpha_t_ == alpha_b_) return lanes::DistributionGgx(normal, half, alpha_t_) / (2.0 * twice_area_);
    return lanes::DistributionGgxAnisotropic(half.x, half.y, half.z, alpha_t_, alpha_b_) / (2.0 * twice_area_);
  }

 private:
  glm::dvec3 Half(const glm::dvec2& random) const {
    const double z = (1.0 - random.y) * (1.0 + stretched_.z) - stretched_.z;
    const double around = std::sqrt(std::max(1.0 - z * z, 0.0));
    const glm::dvec3 h = glm::dvec3(OnCircle(random.x) * around, z) + stretched_;
    return glm::normalize(glm::dvec3(alpha_t_ * h.x, alpha_b_ * h.y, h.z));
  }

  Frame frame_;
  glm::dvec3 view_, stretched_;
  double alpha_t_, alpha_b_, twice_area_;
};

// Sampling by the cosine with a normal.
class Cosine {
 public:
  explicit Cosine(const glm::dvec3& normal) : frame_(normal), normal_(normal) {}
  glm::dvec3 Sample(const glm::dvec2& random) const {
    return frame_.ToWorld({OnCircle(random.x) * std::sqrt(random.y), std::sqrt(std::max(1.0 - random.y, 0.0))});
  }
  double Density(const glm::dvec3& direction) const { return std::max(glm::dot(normal_, direction), 0.0) / kPiExact; }

 private:
  Frame frame_;
  glm::dvec3 normal_;
};

}  // namespace facet
HWY_AFTER_NAMESPACE();
