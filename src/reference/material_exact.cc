#include "reference/material_exact.h"

#include <map>

#include "base/memory_budget.h"
#include "facet/error.h"

namespace facet {
glm::dvec4 ExactMaterial::Read(Slot slot, const SurfacePoint& point) const {
  const Use& u = uses_[IndexOf(slot)];
  return u.texels->Sample(u.transform(point.Uv(u.tex_coord)), u.sampler);
}

glm::dvec4 ExactMaterial::BaseColor(const SurfacePoint& point) const {
  glm::dvec4 color(material_.base_color_factor);
  if (vertex_colors_) color *= point.color;
  return Has(BitOf(Slot::BaseColor)) ? color * Read(Slot::BaseColor, point) : color;
}

glm::dvec3 ExactMaterial::Normal(const SurfacePoint& point) const {
  if (!Has(BitOf(Slot::Normal))) return point.normal;
  const glm::dvec3 texel = glm::dvec3(Read(Slot::Normal, point)) * 2.0 - 1.0;
  const double scale = double(material_.normal_scale);
  const glm::dvec3 tangent(point.tangent);
  const glm::dvec3 bitangent = glm::cross(point.interpolated_normal, tangent) * point.tangent.w;
  return UnitOr(tangent * (texel.x * scale) + bitangent * (texel.y * scale) + point.interpolated_normal * texel.z,
                point.normal);
}

ShadingInputs ExactMaterial::Inputs(const SurfacePoint& point, const glm::dvec3& base_color) const {
  ShadingInputs in;
  in.base_color = base_color;
  in.metallic = double(material_.metallic_factor);
  in.perceptual_roughness = double(material_.roughness_factor);
  if (Has(BitOf(Slot::MetallicRoughness))) {
    const glm::dvec4 texel = Read(Slot::MetallicRoughness, point);
    in.perceptual_roughness *= texel.y;
    in.metallic *= texel.z;
  }
  in.normal = Normal(point);
  if (Has(BitOf(Slot::Occlusion)))
    in.occlusion = 1.0 + double(material_.occlusion_strength) * (Read(Slot::Occlusion, point).x - 1.0);
  in.emissive = Emission(point);
  return in;
}

glm::dvec3 ExactMaterial::Emission(const SurfacePoint& point) const {
  if (!Has(kEmission)) return glm::dvec3(0.0);
  const glm::dvec3 emission = glm::dvec3(material_.emissive_factor) * double(material_.emissive_strength);
  return Has(BitOf(Slot::Emissive)) ? emission * glm::dvec3(Read(Slot::Emissive, point)) : emission;
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
    if (planned.material >= 0) to.material_ = scene.materials[std::size_t(planned.material)];
    to.features_ = planned.frame.features;
    to.model_ = planned.frame.model;
    to.material_.alpha_mode = planned.frame.alpha_mode;
    to.vertex_colors_ = planned.frame.vertex_colors;
    const Material& from = to.material_;
    for (const SlotInfo& slot : kSlots) {
      const int texture = planned.textures[IndexOf(slot.slot)];
      if (texture < 0) continue;
      const TextureRef& ref = from.*slot.ref;
      to.uses_[IndexOf(slot.slot)] = {textures[std::size_t(texture)], scene.textures[std::size_t(ref.texture)].sampler,
                                      ref.tex_coord, UvTransform(ref)};
      if (textures[std::size_t(texture)] == nullptr) to.features_ &= ~BitOf(slot.slot);
    }
  }
  return result;
}

}  // namespace facet
