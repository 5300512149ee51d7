#include "vertex/outside_view.h"

namespace facet {
namespace {

// A bound on the rounding error of the vertex stage, relative to the sum of the absolute values of its terms: about ten
// roundings to float.
constexpr double kRounding = 0x1p-19;

// An upper bound of dot(factor, (x, y, distance)) + constant over the box.
class Highest {
 public:
  Highest(const FrameDrawable& drawable, const Bounds& box)
      : middle_((box.low + box.high) * 0.5 - glm::dvec3(drawable.centre_mesh)),
        half_((box.high - box.low) * 0.5),
        reach_(glm::abs(middle_) + half_) {
    for (int i = 0; i < 3; ++i) rows_[i] = glm::dvec4(drawable.screen_from_local[i]);
  }

  double Of(const glm::dvec3& factor, double constant) const {
    glm::dvec4 sum(0.0), size(0.0);
    for (int i = 0; i < 3; ++i) sum += rows_[i] * factor[i], size += glm::abs(rows_[i] * factor[i]);
    const double value = glm::dot(glm::dvec3(sum), middle_) + sum.w + constant;
    const double terms = glm::dot(glm::dvec3(size), reach_) + size.w + glm::abs(constant);
    return value + glm::dot(glm::abs(glm::dvec3(sum)), half_) + terms * kRounding;
  }

 private:
  glm::dvec3 middle_, half_, reach_;  // relative to the drawable's centre
  glm::dvec4 rows_[3];
};

}  // namespace

bool OutsideView(const FrameView& view, const FrameDrawable& drawable, const Bounds& box) {
  if (box.empty) return false;
  const Highest highest(drawable, box);
  // Beyond the right side, x > width * w, with w = distance or 1.
  const double w = view.perspective ? 1.0 : 0.0, one = view.perspective ? 0.0 : 1.0;
  return highest.Of({0.0, 0.0, 1.0}, -view.near_distance) < 0.0 ||
         highest.Of({0.0, 0.0, -1.0}, view.far_distance) < 0.0 || highest.Of({1.0, 0.0, 0.0}, 0.0) < 0.0 ||
         highest.Of({0.0, 1.0, 0.0}, 0.0) < 0.0 ||
         highest.Of({-1.0, 0.0, view.width * w}, view.width * one) < 0.0 ||
         highest.Of({0.0, -1.0, view.height * w}, view.height * one) < 0.0;
}

}  // namespace facet
