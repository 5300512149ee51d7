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

// The inputs of the metallic-roughness model at a point: like MaterialInputs<double>, but outside of lane code.
struct ShadingInputs {
  glm::dvec3 base_color{1.0};
  double metallic = 1.0, perceptual_roughness = 1.0;
  glm::dvec3 normal{0.0, 0.0, 1.0};  // unit, perturbed by the normal texture
  double occlusion = 1.0;
  glm::dvec3 emissive{0.0};
};

class ExactMaterial {
 public:
  ShadingModel Model() const { return model_; }
  AlphaMode Mode() const { return material_.alpha_mode; }
  bool IsDoubleSided() const { return (features_ & kDoubleSided) != 0; }
  double AlphaCutoff() const { return double(material_.alpha_cutoff); }

  // Factor times texture times vertex colour: linear, straight alpha.
  glm::dvec4 BaseColor(const SurfacePoint& point) const;
  glm::dvec3 Emission(const SurfacePoint& point) const;
  ShadingInputs Inputs(const SurfacePoint& point, const glm::dvec3& base_color) const;

 private:
  friend std::vector<ExactMaterial> MakeExactMaterials(const Scene&, const FramePlan&, std::vector<std::string>&);

  struct Use {
    std::shared_ptr<const ExactTexels> texels;
    Sampler sampler;
    int tex_coord = 0;
    UvTransform transform{TextureRef{}};
  };
  bool Has(MaterialFeatures feature) const { return (features_ & feature) != 0; }
  glm::dvec4 Read(Slot slot, const SurfacePoint& point) const;
  glm::dvec3 Normal(const SurfacePoint& point) const;

  MaterialFeatures features_ = 0;
  ShadingModel model_ = ShadingModel::MetallicRoughness;
  bool vertex_colors_ = false;
  Material material_;
  Use uses_[kSlotCount];  // by Slot
};

// Makes one for each of the plan's materials. An image that cannot be decoded is ignored with a note in `notes`, as in
// the rasterizer. Throws Error(MissingModule) where an image needs a module that is not installed.
std::vector<ExactMaterial> MakeExactMaterials(const Scene& scene, const FramePlan& plan,
                                              std::vector<std::string>& notes);

}  // namespace facet
