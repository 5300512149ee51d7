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

constexpr int kRows = 16;                        // of directions
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
    centre_ = place_ + Vec3{0, (low_ + high_) / 2, 0};
    bound_ = std::sqrt(half * half + widest * widest);
  }

  // The share of a cone of directions that is free. The cone's width softens the outline.
  double Free(Vec3 from, Vec3 towards) const {
    const Vec3 to_centre = centre_ - from;
    const double middle = Dot(to_centre, towards), distance2 = Dot(to_centre, to_centre) - middle * middle;
    const double reach = bound_ + kHalfAngle * std::max(middle, 0.0);
    if (distance2 >= reach * reach || middle < -bound_) return 1;
    const double half = std::sqrt(reach * reach - distance2), begin = std::max(middle - half, 0.004);
    const double step = (middle + half - begin) / kSteps;
    double covered = 0;
    for (int i = 0; i < kSteps; ++i) {
      const double t = begin + step * (i + 0.5);
      const Vec3 p = from + towards * t - place_;
      const int sample = int(std::floor((p.y - low_) / (high_ - low_) * kSamples));
      if (sample < 0 || sample >= kSamples) continue;
      const double off_axis = std::sqrt(p.x * p.x + p.z * p.z);
      covered = std::max(covered, Clamp01(0.5 + (radius_[sample] - off_axis) / (2 * kHalfAngle * t)));
    }
    return 1 - opacity_ * covered;
  }

 private:
  static constexpr int kSamples = 48, kSteps = 20;
  Vec3 place_, centre_;
  double opacity_ = 1, low_ = 0, high_ = 0, bound_ = 0, radius_[kSamples] = {};
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
    for (std::size_t y = begin; y < end; ++y) {
      for (int x = 0; x < size; ++x) {
        const SurfacePoint at = surface((x + 0.5) / size, (double(y) + 0.5) / size);
        double all = 0, free = 0;
        for (const Direction& direction : directions) {
          const double cosine = Dot(at.normal, direction.towards);
          if (cosine <= 0) continue;
          double share = direction.radiance * cosine;
          all += share;
          for (const Solid& solid : solids) share *= solid.Free(at.position, direction.towards);
          free += share;
        }
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
