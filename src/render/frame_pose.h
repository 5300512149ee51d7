// The pose of a frame, kept for the next frame with the same settings.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "render/texture_pass.h"
#include "scene/pose.h"

namespace facet {

// Tangents are generated after visibility is known, and only for geometry that is visible.
class FramePose {
 public:
  explicit FramePose(const Scene& scene) : scene_(scene) {}

  // PoseWithoutTangents(). Its memory is charged to the current budget.
  const PosedScene& Pose(const PoseSettings& settings);

  // The work of generating the tangents that visible drawables, or all, need and do not have.
  WorkBeside TangentsOf(const std::vector<bool>& drawable_visible, bool all);

  // By drawable: its geometry, with tangents where they were needed and visible.
  std::vector<const Primitive*> Attributes() const;

  // The memory of geometry that was deformed or got tangents.
  std::uint64_t HeldBytes() const;

 private:
  std::uint64_t HeldByTangents() const;
  const Primitive& WithoutTangents(std::size_t i) const;

  const Scene& scene_;
  PoseSettings settings_;
  std::optional<PosedScene> posed_;
  std::vector<Primitive> with_tangents_;  // in place of posed_->needs_tangents; empty: was not visible yet
};

}  // namespace facet
