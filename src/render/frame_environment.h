// The environment of a frame, prefiltered as its settings ask, and kept for the next frame.
#pragma once

#include <memory>

#include "base/memory_budget.h"
#include "facet/render.h"
#include "light/environment.h"
#include "plan/frame_plan.h"

namespace facet {

class FrameEnvironment {
 public:
  // Null if the plan needs none. It is prefiltered again only if the settings differ from those of the last frame. Its
  // memory is charged to the budget. Throws Error(OutOfMemory) and what reading the environment's source throws.
  const EnvironmentMap* Prepare(const FramePlan& plan, const RenderSettings& settings, MemoryBudget& budget,
                                RenderStats& stats);

 private:
  EnvironmentOptions options_;
  std::shared_ptr<const Image> image_;  // held, so that no other image can take its address
  std::shared_ptr<const EnvironmentSource> source_;
  std::shared_ptr<const EnvironmentMap> map_;
};

}  // namespace facet
