#include "render/frame_pose.h"

#include <algorithm>
#include <utility>

#include "base/memory_budget.h"
#include "base/parallel.h"
#include "scene/held_bytes.h"
#include "scene/topology.h"

namespace facet {

const PosedScene& FramePose::Pose(const PoseSettings& settings) {
  if (!posed_ || settings != settings_) {
    posed_.reset();
    with_tangents_.clear();
    PosedScene posed = PoseWithoutTangents(scene_, settings);
    with_tangents_.resize(posed.needs_tangents.size());
    settings_ = settings;
    posed_ = std::move(posed);
  }
  MemoryBudget::Current().Charge(facet::HeldBytes(*posed_) + HeldByTangents(), 1, kPosed);
  return *posed_;
}

WorkBeside FramePose::TangentsOf(const std::vector<bool>& drawable_visible, bool all) {
  constexpr std::size_t kBytesPerCorner = 2;  // a corner takes 0.2 us, a byte of an image file 0.03 to 0.12
  WorkBeside work;
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < with_tangents_.size(); ++i) {
    const std::vector<std::size_t>& drawables = posed_->needs_tangents[i].drawables;
    const bool needed = all || std::any_of(drawables.begin(), drawables.end(),
                                           [&](std::size_t drawable) { return bool(drawable_visible[drawable]); });
    if (!needed || !with_tangents_[i].positions.empty()) continue;
    missing.push_back(i);
    work.size += std::size_t{PrimitiveCount(WithoutTangents(i))} * 3 * kBytesPerCorner;
  }
  work.run = [this, missing = std::move(missing)] {
    ParallelFor(missing.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t m = begin; m < end; ++m) {
        const std::size_t i = missing[m];
        MemoryLease lease(facet::HeldBytes(WithoutTangents(i)), 1, kPosed);
        with_tangents_[i] = WithTangents(WithoutTangents(i), posed_->needs_tangents[i].normal_map);
        lease = MemoryLease();
        MemoryBudget::Current().Charge(facet::HeldBytes(with_tangents_[i]), 1, kPosed);
      }
    });
  };
  return work;
}

std::vector<const Primitive*> FramePose::Attributes() const {
  std::vector<const Primitive*> attributes;
  attributes.reserve(posed_->drawables.size());
  for (const Drawable& drawable : posed_->drawables) attributes.push_back(drawable.geometry);
  for (std::size_t i = 0; i < with_tangents_.size(); ++i) {
    if (with_tangents_[i].positions.empty()) continue;
    for (const std::size_t drawable : posed_->needs_tangents[i].drawables) attributes[drawable] = &with_tangents_[i];
  }
  return attributes;
}

std::uint64_t FramePose::HeldBytes() const {
  std::uint64_t bytes = HeldByTangents();
  for (const Primitive& deformed : posed_->owned) bytes += facet::HeldBytes(deformed);
  return bytes;
}

std::uint64_t FramePose::HeldByTangents() const {
  std::uint64_t bytes = 0;
  for (const Primitive& primitive : with_tangents_) bytes += facet::HeldBytes(primitive);
  return bytes;
}

const Primitive& FramePose::WithoutTangents(std::size_t i) const {
  return *posed_->drawables[posed_->needs_tangents[i].drawables[0]].geometry;
}

}  // namespace facet
