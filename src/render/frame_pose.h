// The scene in the pose of a frame, kept for the next frame that has the same.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "render/texture_pass.h"
#include "scene/pose.h"

namespace facet {

// Tangents are generated late, once visibility is known: only for geometry that is visible.
class FramePose {
 public:
  explicit FramePose(const Scene& scene) : scene_(scene) {}

  // PoseIncomplete(). Charges the current memory budget with what it holds.
  const PosedScene& Pose(const PoseSettings& settings);

  // The work of generating the tangents that visible drawables, or all, need and do not have yet.
  WorkBeside TangentsOf(const std::vector<bool>& drawable_visible, bool all);

  // By drawable: its geometry, with tangents where they were needed and visible.
  std::vector<const Primitive*> Attributes() const;

  // Of what was deformed or got tangents.
  std::uint64_t HeldBytes() const;

 private:
  std::uint64_t HeldByTangents() const;
  const Primitive& WithoutTangents(std::size_t i) const;

  const Scene& scene_;
  PoseSettings settings_;
  std::optional<PosedScene> posed_;
  std::vector<Primitive> with_tangents_;  // in place of posed_->incomplete; empty: was not visible yet
};

}  // namespace facet
