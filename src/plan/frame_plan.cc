#include "plan/frame_plan.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "scene/topology.h"

namespace facet {
namespace {

const Material kDefaultMaterial{};

class Planner {
 public:
  Planner(const Scene& scene, const RenderSettings& settings) : scene_(scene), settings_(settings) {}

  int MaterialFor(const Drawable& drawable) {
    const Primitive& geometry = *drawable.geometry;
    const Material& material =
        drawable.material >= 0 ? scene_.materials[std::size_t(drawable.material)] : kDefaultMaterial;
    // Points and lines have no surface: without normals they are drawn unlit (glTF 2.0 specification, 3.9.6).
    const bool unlit =
        material.unlit || (geometry.normals.empty() && ClassOf(geometry.topology) != PrimitiveClass::Triangles);
    const bool colors = !geometry.colors.empty();
    // Points and lines get no tangents from anyone; without the file's they have no tangent space.
    const bool flat = geometry.tangents.empty() && ClassOf(geometry.topology) != PrimitiveClass::Triangles;
    const auto [known, is_new] =
        materials_.try_emplace({drawable.material, unlit, colors, flat}, static_cast<int>(plan.materials.size()));
    if (is_new) plan.materials.push_back(Plan(material, drawable.material, unlit, colors, flat));
    return known->second;
  }

  FramePlan plan;

 private:
  PlannedMaterial Plan(Material material, int index, bool unlit, bool colors, bool flat) {
    material.unlit = unlit;
    if (flat) material.normal_texture = {};
    PlannedMaterial planned;
    planned.material = index;
    planned.unlit = unlit;
    planned.vertex_colors = colors;
    FrameMaterial& f = planned.frame;
    f.features = FeaturesOf(material);
    f.vertex_colors = colors;
    f.alpha_mode = material.alpha_mode;
    for (int i = 0; i < 4; ++i) f.base_color[i] = material.base_color_factor[i];
    f.metallic = material.metallic_factor;
    f.perceptual_roughness = material.roughness_factor;
    f.normal_scale = material.normal_scale;
    f.occlusion_strength = material.occlusion_strength;
    for (int i = 0; i < 3; ++i) f.emissive[i] = material.emissive_factor[i] * material.emissive_strength;
    f.alpha_cutoff = material.alpha_cutoff;

    struct Use {
      const TextureRef& ref;
      MaterialFeature feature;
      TextureRole role;
      TextureSlot& slot;
    };
    const Use uses[5] = {
        {material.base_color_texture, kBaseColorTexture, TextureRole::Color, f.base_color_texture},
        {material.metallic_roughness_texture, kMetallicRoughnessTexture, TextureRole::Data,
         f.metallic_roughness_texture},
        {material.normal_texture, kNormalTexture, TextureRole::Data, f.normal_texture},
        {material.occlusion_texture, kOcclusionTexture, TextureRole::Data, f.occlusion_texture},
        {material.emissive_texture, kEmissiveTexture, TextureRole::Color, f.emissive_texture},
    };
    for (int i = 0; i < 5; ++i) {
      const Use& use = uses[i];
      if (!f.Has(use.feature)) continue;
      const Texture& texture = scene_.textures[std::size_t(use.ref.texture)];
      if (texture.image < 0) {
        f.features &= ~std::uint32_t{use.feature};
        continue;
      }
      use.slot.sampler = texture.sampler;
      use.slot.sampler.mip = std::min(texture.sampler.mip, settings_.mip_filter);
      planned.textures[i] = TextureFor(texture.image, use.role, use.slot.sampler.mip != MipFilter::None);
      use.slot.max_anisotropy = static_cast<float>(settings_.max_anisotropy);
      use.slot.uv_slot = SlotFor(f, use.ref.tex_coord);
      SetTransform(use.ref, use.slot);
    }
    return planned;
  }

  int TextureFor(int image, TextureRole role, bool mips) {
    const auto [known, is_new] = textures_.try_emplace({image, role}, static_cast<int>(plan.textures.size()));
    if (is_new) plan.textures.push_back({image, role, false});
    plan.textures[std::size_t(known->second)].mips |= mips;
    return known->second;
  }

  static int SlotFor(FrameMaterial& material, int tex_coord) {
    for (int i = 0; i < material.uv_slots; ++i) {
      if (material.uv_sets[i] == tex_coord) return i;
    }
    material.uv_sets[material.uv_slots] = tex_coord;
    return material.uv_slots++;
  }

  const Scene& scene_;
  const RenderSettings& settings_;
  std::map<std::tuple<int, bool, bool, bool>, int> materials_;  // material, unlit, vertex colours, no tangents
  std::map<std::pair<int, TextureRole>, int> textures_;
};

}  // namespace

FramePlan MakeFramePlan(const Scene& scene, const PosedScene& posed, const RenderSettings& settings) {
  Planner planner(scene, settings);
  FramePlan& plan = planner.plan;
  plan.material_of_drawable.reserve(posed.drawables.size());
  for (const Drawable& drawable : posed.drawables) plan.material_of_drawable.push_back(planner.MaterialFor(drawable));

  const auto any = [&](auto&& predicate) {
    return std::any_of(plan.materials.begin(), plan.materials.end(),
                       [&](const PlannedMaterial& m) { return predicate(m.frame); });
  };
  const auto leave_out = [&](const char* what, const char* why) {
    plan.left_out.push_back(std::string(what) + ": " + why);
  };
  const bool lit = any([](const FrameMaterial& m) { return m.Has(kLit); }) || settings.shader != nullptr;
  const bool has_environment = settings.environment.kind != EnvironmentSettings::Kind::None;
  plan.environment_light = lit && has_environment;
  plan.environment_background = settings.background == Background::Environment && has_environment;
  plan.punctual_lights = lit && !posed.lights.empty();
  plan.alpha_test = any([](const FrameMaterial& m) { return m.alpha_mode == AlphaMode::Mask; });
  plan.blending = any([](const FrameMaterial& m) { return m.alpha_mode == AlphaMode::Blend; });

  if (!plan.environment_light) leave_out("environment light", lit ? "no environment" : "no lit material");
  if (!plan.environment_background) leave_out("environment background", "not asked for");
  if (!plan.punctual_lights) leave_out("punctual lights", lit ? "the scene has none" : "no lit material");
  if (!plan.alpha_test) leave_out("alpha test", "no material with alpha mode MASK");
  if (!plan.blending) leave_out("blending", "no material with alpha mode BLEND");
  if (!any([](const FrameMaterial& m) { return m.Has(kNormalTexture); })) {
    leave_out("tangents", "no normal texture");
  }
  if (!any([](const FrameMaterial& m) { return m.vertex_colors; })) leave_out("vertex colours", "no geometry has them");
  if (plan.textures.empty()) leave_out("textures", "no material reads one");
  return plan;
}

}  // namespace facet
