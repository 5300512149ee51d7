#include "scene/framing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "base/parallel.h"
#include "scene/bounds.h"

namespace facet {
namespace {

constexpr double kNothing = -std::numeric_limits<double>::infinity();
constexpr std::size_t kGrain = 16384;  // vertices

// The five measures are linear in the position; each is one row of a matrix.
struct Rows {
  glm::dvec4 row[5];

  // Of positions in world space relative to `target`.
  Rows(const glm::dvec3& target, const CameraAxes& axes, double tan_x, double tan_y) {
    const glm::dvec3 direction[5] = {axes.right + tan_x * axes.back, tan_x * axes.back - axes.right,
                                     axes.up + tan_y * axes.back, tan_y * axes.back - axes.up, axes.back};
    for (int i = 0; i < 5; ++i) row[i] = glm::dvec4(direction[i], -glm::dot(direction[i], target));
  }
  // Of positions in mesh space.
  Rows(const Rows& world, const glm::dmat4& world_from_mesh) {
    for (int i = 0; i < 5; ++i) row[i] = world.row[i] * world_from_mesh;
  }

  // Whether no point of the box can exceed the current maxima, with a small margin for rounding.
  bool NoneBeyond(const Bounds& box, const double (&largest)[5]) const {
    for (int i = 0; i < 5; ++i) {
      const glm::dvec3 a = glm::dvec3(row[i]) * box.low, b = glm::dvec3(row[i]) * box.high, most = glm::max(a, b);
      const glm::dvec3 size = glm::max(glm::abs(a), glm::abs(b));
      const double rounding = 1e-12 * (size.x + size.y + size.z + std::fabs(row[i].w));
      if (!(most.x + most.y + most.z + row[i].w + rounding <= largest[i])) return false;
    }
    return true;
  }

  void Include(const glm::dvec3& position, double (&largest)[5]) const {
    for (int i = 0; i < 5; ++i) {
      const double value = glm::dot(row[i], glm::dvec4(position, 1.0));
      if (std::isfinite(value)) largest[i] = std::max(largest[i], value);
    }
  }
};

// Times spread evenly over the animation; none if there is no animation or nothing moves.
std::vector<PoseSettings> PosesOfAnimation(const Scene& scene, const PoseSettings& pose) {
  constexpr int kMoments = 17;
  std::vector<PoseSettings> poses;
  if (pose.animation < 0) return poses;
  double first = std::numeric_limits<double>::infinity(), last = kNothing;
  for (const AnimationChannel& channel : scene.animations[std::size_t(pose.animation)].channels) {
    if (channel.times.empty()) continue;
    first = std::min(first, double(channel.times.front()));
    last = std::max(last, double(channel.times.back()));
  }
  for (int i = 0; i < kMoments && first <= last; ++i) {
    poses.push_back(pose);
    poses.back().time = first + (last - first) * i / (kMoments - 1);
  }
  return poses;
}

}  // namespace

ViewExtent MeasureView(const PosedScene& posed, const glm::dvec3& target, const CameraAxes& axes, double tan_x,
                       double tan_y) {
  const Rows world(target, axes, tan_x, tan_y);
  double largest[5] = {kNothing, kNothing, kNothing, kNothing, kNothing};
  std::mutex mutex;
  for (const Drawable& drawable : posed.drawables) {
    const Rows rows(world, drawable.world_from_mesh);
    if (!drawable.bounds_mesh.empty && rows.NoneBeyond(drawable.bounds_mesh, largest)) continue;
    const std::vector<glm::vec3>& positions = drawable.geometry->positions;
    ParallelFor(positions.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      double own[5] = {kNothing, kNothing, kNothing, kNothing, kNothing};
      for (std::size_t i = begin; i < end; ++i) rows.Include(glm::dvec3(positions[i]), own);
      const std::lock_guard lock(mutex);  // a maximum is the same in any order
      for (int i = 0; i < 5; ++i) largest[i] = std::max(largest[i], own[i]);
    });
  }
  if (largest[4] == kNothing) {
    const Bounds& b = posed.bounds;
    const glm::dvec3 low = b.empty ? glm::dvec3(-0.5) : b.low, high = b.empty ? glm::dvec3(0.5) : b.high;
    for (int i = 0; i < 8; ++i) {
      world.Include({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z}, largest);
    }
  }
  return {largest[0], largest[1], largest[2], largest[3], largest[4]};
}

OrbitBall MeasureBall(const Scene& scene, const PosedScene& posed, const std::optional<glm::dvec3>& centre) {
  const std::vector<PoseSettings> poses = PosesOfAnimation(scene, posed.settings);
  const auto centre_of = [](const Bounds& bounds) {
    return bounds.empty ? glm::dvec3(0.0) : 0.5 * bounds.low + 0.5 * bounds.high;
  };
  OrbitBall ball;
  if (poses.empty()) {
    ball.centre = centre.value_or(centre_of(posed.bounds));
    for (const Drawable& drawable : posed.drawables) {
      AddReach(drawable.geometry->positions, drawable.bounds_mesh, drawable.world_from_mesh, ball.centre, ball.radius);
    }
    if (posed.drawables.empty()) {
      const Bounds& b = posed.bounds;
      const glm::dvec3 low = b.empty ? glm::dvec3(-0.5) : b.low, high = b.empty ? glm::dvec3(0.5) : b.high;
      ball.radius = glm::length(glm::max(glm::abs(low - ball.centre), glm::abs(high - ball.centre)));
    }
    return ball;
  }
  if (centre) {
    ball.centre = *centre;
  } else {
    Bounds all;
    for (const PoseSettings& pose : poses) AddBounds(PosedBounds(scene, pose), all);
    ball.centre = centre_of(all);
  }
  for (const PoseSettings& pose : poses) ball.radius = std::max(ball.radius, PosedReach(scene, pose, ball.centre));
  return ball;
}

}  // namespace facet
