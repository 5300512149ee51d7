#include "reference/material_exact.h"

#include <map>

#include "base/memory_budget.h"
#include "facet/error.h"
#include "material/model_parameters.h"

namespace facet {

glm::dvec4 ExactMaterial::Read(Slot slot, const SurfacePoint& point) const {
  const Use& u = uses_[IndexOf(slot)];
  return u.texels->Sample(u.transform(point.Uv(u.tex_coord)), u.sampler);
}

glm::dvec4 ExactMaterial::BaseColor(const SurfacePoint& point) const {
  const float* const factor = frame_.factors.base_color;
  glm::dvec4 color(factor[0], factor[1], factor[2], factor[3]);
  if (frame_.vertex_colors) color *= point.color;
  const bool coverage_apart = frame_.coverage_slot != Slot::BaseColor;
  if (coverage_apart && frame_.ReadsCoverage()) color.a *= Read(frame_.coverage_slot, point)[frame_.coverage_channel];
  if (!frame_.Reads(Slot::BaseColor)) return color;
  const glm::dvec4 texel = Read(Slot::BaseColor, point);
  return color * (coverage_apart ? glm::dvec4(glm::dvec3(texel), 1.0) : texel);
}

std::vector<ExactMaterial> MakeExactMaterials(const Scene& scene, const FramePlan& plan,
                                              std::vector<std::string>& notes) {
  std::map<int, std::shared_ptr<const Image>> images;
  const auto decode = [&](int index) {
    const auto [place, is_new] = images.try_emplace(index);
    if (!is_new) return place->second;
    const ImageSource& source = *scene.images[std::size_t(index)].source;
    try {
      struct Held {
        Image image;
        MemoryLease lease;
      };
      const auto held = std::make_shared<Held>();
      held->image = source.Decode();
      held->lease = MemoryLease(held->image.bytes.size(), 1, "textures", source.Name());
      place->second = std::shared_ptr<const Image>(held, &held->image);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::InvalidInput && error.code() != ErrorCode::NotFound) throw;
      notes.push_back(source.Name() + ": " + error.message() + " (drawn without this texture)");
    }
    return place->second;
  };
  std::vector<std::shared_ptr<const ExactTexels>> textures;
  for (const PlannedTexture& planned : plan.textures) {
    const auto image = decode(planned.image);
    textures.push_back(image == nullptr ? nullptr : std::make_shared<const ExactTexels>(image, planned.role));
  }

  std::vector<ExactMaterial> result(plan.materials.size());
  for (std::size_t m = 0; m < result.size(); ++m) {
    const PlannedMaterial& planned = plan.materials[m];
    ExactMaterial& to = result[m];
    to.frame_ = planned.frame;
    for (const SlotInfo& slot : SlotsOf(planned.frame.ModelOfSlots())) {
      const int texture = planned.textures[IndexOf(slot.slot)];
      if (texture < 0) continue;
      const TextureRef& ref = TextureIn(scene.materials[std::size_t(planned.material)], slot);
      to.uses_[IndexOf(slot.slot)] = {textures[std::size_t(texture)], scene.textures[std::size_t(ref.texture)].sampler,
                                      ref.tex_coord, UvTransform(ref)};
      if (textures[std::size_t(texture)] == nullptr) to.frame_.features &= ~BitOf(slot.slot);
    }
  }
  return result;
}

}  // namespace facet
