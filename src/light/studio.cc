#include "light/studio.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <vector>

#include "base/check.h"
#include "base/parallel.h"
#include "math/elementary.h"

namespace facet {
namespace {

constexpr double kPiDouble = 3.14159265358979324;

double SmoothStep(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

// A rectangular diffuser that faces the centre of the room from `towards`, one unit away.
class SoftBox {
 public:
  // Half sizes are tangents of half the angles that it subtends; `softness` is the half width of its edge in the same
  // unit.
  SoftBox(glm::dvec3 towards, double half_width, double half_height, double softness, double radiance)
      : axis_(glm::normalize(towards)),
        half_width_(half_width),
        half_height_(half_height),
        softness_(softness),
        radiance_(radiance) {
    const glm::dvec3 up = std::fabs(axis_.y) > 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(0.0, 1.0, 0.0);
    right_ = glm::normalize(glm::cross(up, axis_));
    up_ = glm::cross(axis_, right_);
  }

  // The radiance that it adds in a direction. The diffuser is brightest in front of its lamp.
  double Radiance(glm::dvec3 direction) const {
    const double depth = glm::dot(axis_, direction);
    if (depth <= 0.0) return 0.0;
    const double x = std::fabs(glm::dot(right_, direction)), y = std::fabs(glm::dot(up_, direction));
    if (x >= (half_width_ + softness_) * depth || y >= (half_height_ + softness_) * depth) return 0.0;
    const double u = x / depth, v = y / depth;
    const double inside = (1.0 - SmoothStep(half_width_ - softness_, half_width_ + softness_, u)) *
                          (1.0 - SmoothStep(half_height_ - softness_, half_height_ + softness_, v));
    const double off2 = (u * u) / (half_width_ * half_width_) + (v * v) / (half_height_ * half_height_);
    return radiance_ * inside * (1.0 - 0.25 * std::min(off2, 1.0));
  }

 private:
  glm::dvec3 axis_, right_{}, up_{};
  double half_width_, half_height_, softness_, radiance_;
};

// A scale with which a white surface that faces the lamps is just below white at exposure 0.
constexpr double kMeanRadiance = 0.65;

// The room, not scaled yet. The default camera stands at +Z, with the key light behind its left shoulder.
class Room {
 public:
  double Radiance(glm::dvec3 d) const {
    const double wall = 0.34 + 0.22 * SmoothStep(-0.6, 0.9, d.y);
    const double floor = 0.26 + 0.10 * SmoothStep(-1.0, -0.2, d.y);
    const double share = SmoothStep(-0.35, 0.05, d.y);
    double radiance = floor * (1.0 - share) + wall * share;
    for (const SoftBox& box : boxes_) radiance += box.Radiance(d);
    return radiance;
  }

 private:
  SoftBox boxes_[5] = {
      {{-0.75, 0.55, 0.75}, 0.42, 0.36, 0.06, 7.0},   // key
      {{0.95, 0.20, 0.55}, 0.30, 0.46, 0.08, 2.4},    // fill
      {{0.05, 1.0, -0.10}, 0.55, 0.42, 0.08, 7.0},    // overhead
      {{-0.85, 0.15, -0.80}, 0.10, 0.52, 0.03, 5.0},  // strip behind, left
      {{0.80, 0.20, -0.95}, 0.12, 0.55, 0.03, 6.0},   // strip behind, right
  };
};

}  // namespace

Image StudioImage(int width, int height) {
  FACET_CHECK_OP(height, >=, 2);
  FACET_CHECK_OP(width, ==, 2 * height);
  const Room room;
  std::vector<double> cosines(width), sines(width), radiance(std::size_t(width) * std::size_t(height));
  for (int i = 0; i < width; ++i) {
    const double angle = ((i + 0.5) / width - 0.5) * 2.0 * kPiDouble;
    cosines[i] = Cos(angle);
    sines[i] = Sin(angle);
  }
  ParallelFor(std::size_t(height), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      const double theta = kPiDouble * (double(row) + 0.5) / height;
      const double y = Cos(theta), around = Sin(theta);
      for (int i = 0; i < width; ++i) {
        radiance[row * width + i] = room.Radiance({around * cosines[i], y, around * sines[i]});
      }
    }
  });
  double sum = 0.0, weight = 0.0;
  for (int row = 0; row < height; ++row) {
    const double solid_angle = Sin(kPiDouble * (row + 0.5) / height);
    for (int i = 0; i < width; ++i) sum += solid_angle * radiance[std::size_t(row) * width + i];
    weight += solid_angle * width;
  }
  const double scale = kMeanRadiance * weight / sum;
  Image image;
  image.width = width;
  image.height = height;
  image.channels = 3;
  image.type = ChannelType::F32;
  image.encoding = Encoding::Linear;
  image.bytes.resize(image.PixelCount() * 3 * sizeof(float));
  float* out = image.As<float>();
  for (std::size_t i = 0; i < radiance.size(); ++i) {
    for (int c = 0; c < 3; ++c) out[3 * i + c] = static_cast<float>(radiance[i] * scale);
  }
  return image;
}

}  // namespace facet
