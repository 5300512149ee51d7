#include "baking.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/parallel.h"
#include "facet/image.h"
#include "facet/shader/elementary_double.h"
#include "image.h"
#include "light/studio.h"

namespace facet::assets {
namespace {

constexpr int kRows = 16;                       // of directions
constexpr double kHalfAngle = kPi / kRows / 2;  // of a cell of directions

struct Direction {
  Vec3 towards;
  double radiance = 0;  // times the cell's solid angle
};

std::vector<Direction> StudioDirections() {
  const Image image = StudioImage(2 * kRows, kRows);
  const float* pixels = image.As<float>();
  std::vector<Direction> directions;
  for (int row = 0; row < kRows; ++row) {
    const double theta = kPi * (row + 0.5) / kRows, around = Sin(theta);
    for (int i = 0; i < 2 * kRows; ++i) {
      const double phi = ((i + 0.5) / (2 * kRows) - 0.5) * 2 * kPi;
      const double radiance = pixels[(row * 2 * kRows + i) * image.channels];
      directions.push_back({{around * Cos(phi), Cos(theta), around * Sin(phi)}, radiance * around});
    }
  }
  return directions;
}

// A blocker with its radius sampled at equal heights, and a sphere around it.
class Solid {
 public:
  explicit Solid(const Blocker& blocker) : place_(blocker.place), opacity_(blocker.opacity) {
    low_ = high_ = blocker.profile.front().y;
    for (const Vec2& p : blocker.profile) {
      low_ = std::min(low_, p.y);
      high_ = std::max(high_, p.y);
    }
    double widest = 0;
    for (int i = 0; i < kSamples; ++i) {
      const double y = low_ + (high_ - low_) * (i + 0.5) / kSamples;
      for (std::size_t j = 0; j + 1 < blocker.profile.size(); ++j) {
        const Vec2 a = blocker.profile[j], b = blocker.profile[j + 1];
        if (std::min(a.y, b.y) > y || std::max(a.y, b.y) < y || a.y == b.y) continue;
        radius_[i] = std::max(radius_[i], a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y));
      }
      widest = std::max(widest, radius_[i]);
    }
    const double half = (high_ - low_) / 2;
    samples_per_metre_ = kSamples / (high_ - low_);
    centre_ = place_ + Vec3{0, (low_ + high_) / 2, 0};
    bound_ = std::sqrt(half * half + widest * widest);
  }

  // Multiplies what is left of the light from each direction by the share of its cone that is free. The cone's width
  // softens the outline.
  void Shade(Vec3 from, const std::vector<Direction>& directions, std::vector<double>& left) const {
    const Vec3 to_centre = centre_ - from;
    const double distance2 = Dot(to_centre, to_centre);
    for (std::size_t i = 0; i < directions.size(); ++i) {
      if (left[i] == 0) continue;
      const Vec3& towards = directions[i].towards;
      const double middle = to_centre.x * towards.x + to_centre.y * towards.y + to_centre.z * towards.z;
      const double reach = bound_ + kHalfAngle * std::max(middle, 0.0), off2 = distance2 - middle * middle;
      if (off2 >= reach * reach || middle < -bound_) continue;
      const double half = std::sqrt(reach * reach - off2);
      left[i] *= 1 - opacity_ * Covered(from - place_, towards, std::max(middle - half, 0.004), middle + half);
    }
  }

 private:
  double Covered(Vec3 from, Vec3 towards, double begin, double end) const {
    const double step = (end - begin) / kSteps;
    double covered = 0;
    for (int i = 0; i < kSteps; ++i) {
      const double t = begin + step * (i + 0.5);
      const double x = from.x + towards.x * t, y = from.y + towards.y * t, z = from.z + towards.z * t;
      if (y <= low_ || y >= high_) continue;
      const double radius = radius_[std::min(int((y - low_) * samples_per_metre_), kSamples - 1)];
      const double width = kHalfAngle * t, off_axis2 = x * x + z * z;
      if (off_axis2 >= (radius + width) * (radius + width)) continue;
      covered = std::max(covered, 0.5 + (radius - std::sqrt(off_axis2)) / (2 * width));
      if (covered >= 1) return 1;
    }
    return covered;
  }

  static constexpr int kSamples = 48, kSteps = 14;
  Vec3 place_, centre_;
  double opacity_ = 1, low_ = 0, high_ = 0, bound_ = 0, samples_per_metre_ = 0, radius_[kSamples] = {};
};

}  // namespace

std::vector<std::uint8_t> BakeOcclusion(int size, const std::function<SurfacePoint(double, double)>& surface,
                                        const std::vector<Blocker>& blockers, int itself) {
  const std::vector<Direction> directions = StudioDirections();
  std::vector<Solid> solids;
  for (int i = 0; i < int(blockers.size()); ++i) {
    if (i != itself) solids.emplace_back(blockers[std::size_t(i)]);
  }
  std::vector<double> left(std::size_t(size) * std::size_t(size));
  ParallelFor(std::size_t(size), 4, [&](std::size_t begin, std::size_t end) {
    std::vector<double> light(directions.size());
    for (std::size_t y = begin; y < end; ++y) {
      for (int x = 0; x < size; ++x) {
        const SurfacePoint at = surface((x + 0.5) / size, (double(y) + 0.5) / size);
        double all = 0, free = 0;
        for (std::size_t i = 0; i < directions.size(); ++i) {
          light[i] = directions[i].radiance * std::max(Dot(at.normal, directions[i].towards), 0.0);
          all += light[i];
        }
        for (const Solid& solid : solids) solid.Shade(at.position, directions, light);
        for (double part : light) free += part;
        left[y * std::size_t(size) + std::size_t(x)] = free / all;
      }
    }
  });
  return PngImage(size, [&](double u, double v) {
    const double share = left[std::size_t(v * size) * std::size_t(size) + std::size_t(u * size)];
    return Vec3{share, share, share};
  });
}

}  // namespace facet::assets
