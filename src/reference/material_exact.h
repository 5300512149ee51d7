// Materials in double: factors times textures at a point.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plan/frame_plan.h"
#include "reference/surface_exact.h"
#include "reference/texture_exact.h"

namespace facet {

class ExactMaterial {
 public:
  // Its features, factors and model; its textures are read below.
  const FrameMaterial& Frame() const { return frame_; }
  // Factor times texture times vertex colour: linear, straight alpha.
  glm::dvec4 BaseColor(const SurfacePoint& point) const;
  glm::dvec4 Read(Slot slot, const SurfacePoint& point) const;

 private:
  friend std::vector<ExactMaterial> MakeExactMaterials(const Scene&, const FramePlan&, std::vector<std::string>&);

  struct Use {
    std::shared_ptr<const ExactTexels> texels;
    Sampler sampler;
    int tex_coord = 0;
    UvTransform transform{TextureRef{}};
  };

  FrameMaterial frame_;
  Use uses_[kMaxSlots];  // by Slot
};

// Makes one for each of the plan's materials. An image that cannot be decoded is ignored with a note in `notes`, as in
// the rasterizer. Throws Error(MissingModule) where an image needs a module that is not installed.
std::vector<ExactMaterial> MakeExactMaterials(const Scene& scene, const FramePlan& plan,
                                              std::vector<std::string>& notes);

}  // namespace facet
