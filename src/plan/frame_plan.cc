#include "plan/frame_plan.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "facet/shader.h"
#include "material/model_parameters.h"
#include "material/models/models.h"
#include "plan/enterprise_measures.h"
#include "plan/unused_features.h"
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
    // Points and lines have no surface unless they have normals, and get no tangents from anyone: without the file's
    // they have no tangent space.
    const bool is_thin = ClassOf(geometry.topology) != PrimitiveClass::Triangles;
    const bool on_surface = !is_thin || !geometry.normals.empty(), flat = is_thin && geometry.tangents.empty();
    const bool colors = !geometry.colors.empty();
    const EnterpriseMeasures measures = Measures(material, drawable);
    const auto [known, is_new] = materials_.try_emplace({drawable.material, on_surface, colors, flat, measures},
                                                        static_cast<int>(plan.materials.size()));
    if (is_new) plan.materials.push_back(Plan(material, drawable.material, on_surface, colors, flat, measures));
    return known->second;
  }

  FramePlan plan;
  FeatureSet stated;         // features that drawn materials state, whether or not they are visible
  FeatureSet stated_by_lit;  // those that lit ones do

 private:
  static EnterpriseMeasures Measures(const Material& material, const Drawable& drawable) {
    const auto* enterprise = std::get_if<EnterpriseParameters>(material.parameters.get());
    return enterprise != nullptr ? MeasuresFor(*enterprise, drawable) : EnterpriseMeasures{};
  }

  PlannedMaterial Plan(Material material, int index, bool on_surface, bool colors, bool flat,
                       const EnterpriseMeasures& measures) {
    if (flat) RemoveTangentSpace(material);
    Disable(material, colors);
    if (const auto* enterprise = std::get_if<EnterpriseParameters>(material.parameters.get())) {
      material.parameters = std::make_shared<const ModelParameters>(WithMeasures(*enterprise, measures));
    }
    PlannedMaterial planned;
    planned.material = index;
    planned.vertex_colors = colors;
    FrameMaterial& f = planned.frame;
    f.features = FeaturesOf(material, on_surface);
    f.vertex_colors = colors;
    f.specular_antialiasing = settings_.specular_antialiasing;
    f.alpha_mode = material.alpha_mode;
    f.factors = FactorsOf(material);
    planned.parameters = material.parameters;
    f.parameters = planned.parameters.get();
    if (f.parameters != nullptr) {
      const CoverageTexture coverage = CoverageOf(*f.parameters);
      f.coverage_slot = coverage.slot, f.coverage_channel = coverage.channel;
    }
    f.model = on_surface ? material.model : ShadingModel::Unlit;
    const auto i = std::size_t(index);
    const bool has_own =
        index >= 0 && i < settings_.material_shaders.size() && settings_.material_shaders[i] != nullptr;
    f.shader = has_own ? settings_.material_shaders[i] : settings_.shader;
    f.is_seen_through = f.Has(kTransmission) && (f.shader == nullptr || f.shader->Transmits());
    if (!f.is_seen_through) {
      // A user's shader that knows nothing of what is behind a surface gets the material without transmission.
      Remove(kTransmission, Feature::Transmission, f);
      Remove(kDispersion, Feature::Dispersion, f);
      if (!f.Has(kDiffuseTransmission)) Remove(kVolume, Feature::Volume, f);
    }
    if (f.Has(kFlakes)) f.first_uv_slot = UvSlotFor(f, 0);
    ForEachSlotOf(f.ModelOfSlots(), f.features, [&](const SlotInfo& slot) { BindTexture(material, slot, planned); });
    return planned;
  }

  // Removes a feature with its textures.
  static void Remove(MaterialFeatures bit, Feature feature, FrameMaterial& f) {
    f.features &= ~bit;
    for (const SlotInfo& slot : SlotsOf(f.ModelOfSlots())) {
      if (slot.feature == feature) f.features &= ~BitOf(slot.slot);
    }
  }

  // Of geometry without tangents.
  static void RemoveTangentSpace(Material& material) {
    for (const SlotInfo& slot : kSlots) {
      if (slot.tangent_space) material.*slot.ref = {};
    }
    material.anisotropy_strength = 0.0f;
    if (material.parameters == nullptr) return;
    auto flat = std::make_shared<ModelParameters>(*material.parameters);
    std::visit(
        []<class Block>(Block& block) {
          const Block plain;
          ForEachParameterOf(block, [&]<class Value>(const auto& parameter, Value& value) {
            const bool along_tangents = std::is_same_v<Value, TangentSpaceNormal>;
            if (along_tangents || parameter.feature == Feature::Anisotropy) value = plain.*parameter.member;
          });
        },
        *flat);
    material.parameters = flat;
  }

  void BindTexture(const Material& material, const SlotInfo& info, PlannedMaterial& planned) {
    const Slot slot = info.slot;
    const TextureRef& ref = TextureIn(material, info);
    const Texture& texture = scene_.textures[std::size_t(ref.texture)];
    FrameMaterial& f = planned.frame;
    if (texture.image < 0) {
      f.features &= ~BitOf(slot);
      return;
    }
    BoundTexture& bound = f.textures[IndexOf(slot)];
    bound.sampler = texture.sampler;
    bound.sampler.mip = std::min(texture.sampler.mip, settings_.mip_filter);
    const bool reads_alpha = !info.alpha_is_coverage || material.alpha_mode != AlphaMode::Opaque;
    planned.textures[IndexOf(slot)] =
        TextureFor(texture.image, info.role, bound.sampler.mip != MipFilter::None,
                   reads_alpha ? ChannelsIn(material, info) : info.channels & kRgb, slot == Slot::Emissive);
    bound.max_anisotropy = static_cast<float>(settings_.max_anisotropy);
    bound.uv_slot = UvSlotFor(f, ref.tex_coord);
    SetTransform(ref, bound);
  }

  // Disables what the settings ask to disable, as if the file did not state it.
  void Disable(Material& m, bool& colors) {
    const auto disable = [&](Feature feature, bool is_stated, auto&& remove) {
      if (!is_stated) return;
      stated.Add(feature);
      if (m.model != ShadingModel::Unlit) stated_by_lit.Add(feature);
      if (settings_.without.Has(feature)) remove();
    };
    if (m.parameters != nullptr) {
      const Material own = m;
      m = Material();
      m.alpha_mode = own.alpha_mode, m.alpha_cutoff = own.alpha_cutoff, m.double_sided = own.double_sided;
      m.model = own.model;
      FeatureSet of_own;
      m.parameters =
          std::make_shared<const ModelParameters>(WithoutFeatures(*own.parameters, settings_.without, of_own));
      for (const FeatureWord& word : kFeatureWords) {
        if (of_own.Has(word.feature)) stated.Add(word.feature), stated_by_lit.Add(word.feature);
      }
    }
    for (const SlotInfo& slot : kSlots) {
      TextureRef& ref = m.*slot.ref;
      disable(slot.feature, bool(ref), [&ref] { ref = {}; });
    }
    for (const FactorFeature& factor : kFactorFeatures) {
      disable(factor.feature, factor.is_stated(m), [&] { factor.disable(m); });
    }
    disable(Feature::VertexColors, colors, [&colors] { colors = false; });
    const auto opaque = [&m] { m.alpha_mode = AlphaMode::Opaque; };
    disable(Feature::AlphaTest, m.alpha_mode == AlphaMode::Mask, opaque);
    disable(Feature::Blending, m.alpha_mode == AlphaMode::Blend, opaque);
  }

  int TextureFor(int image, TextureRole role, bool mips, int channels, bool emission) {
    const auto [known, is_new] = textures_.try_emplace({image, role}, static_cast<int>(plan.textures.size()));
    if (is_new) plan.textures.push_back({image, role, false, 0, true});
    PlannedTexture& planned = plan.textures[std::size_t(known->second)];
    planned.mips |= mips;
    planned.channels |= channels;
    planned.emission &= emission;
    return known->second;
  }

  static int UvSlotFor(FrameMaterial& material, int tex_coord) {
    for (int i = 0; i < material.uv_slots; ++i) {
      if (material.uv_sets[i] == tex_coord) return i;
    }
    material.uv_sets[material.uv_slots] = tex_coord;
    return material.uv_slots++;
  }

  const Scene& scene_;
  const RenderSettings& settings_;
  // By material, surface, vertex colours, no tangents, and what a model measured on the mesh.
  std::map<std::tuple<int, bool, bool, bool, EnterpriseMeasures>, int> materials_;
  std::map<std::pair<int, TextureRole>, int> textures_;
};

bool HasMorphTargets(const Scene& scene) {
  for (const Mesh& mesh : scene.meshes) {
    for (const Primitive& primitive : mesh.primitives) {
      if (!primitive.targets.empty()) return true;
    }
  }
  return false;
}

// Whether a texture is read that the feature disables.
bool ReadsTextureOf(const FrameMaterial& material, Feature feature) {
  bool reads = false;
  ForEachSlotOf(material.ModelOfSlots(), material.features,
                [&](const SlotInfo& slot) { reads |= slot.feature == feature; });
  return reads;
}

// The tables that the materials' lobes look up. Filament's models read one of their own in the place of glTF's.
AlbedoTables TablesFor(const FramePlan& plan) {
  AlbedoTables tables;
  for (const PlannedMaterial& planned : plan.materials) {
    const FrameMaterial& m = planned.frame;
    const bool is_filament = m.model == ShadingModel::Filament;
    tables.sheen |= m.Has(kSheen) && !is_filament;
    tables.cloth |= m.Has(kSheen) && is_filament;
    tables.anisotropic_dfg |= m.Has(kAnisotropy) && !is_filament;
    if (m.model != ShadingModel::Lecture) continue;
    const auto& p = m.Parameters<LectureParameters>();
    tables.schlick_dfg[static_cast<std::size_t>(p.alpha)] |=
        plan.environment_light && p.ambient == LectureAmbient::Image && p.geometry == LectureGeometry::SchlickGgx;
  }
  return tables;
}

constexpr const char* kOnRequest = "on request";

}  // namespace

PoseSettings PoseOf(const RenderSettings& settings) {
  PoseSettings pose;
  pose.scene = settings.scene;
  pose.animation = settings.animation;
  pose.time = settings.time;
  pose.variant = settings.variant;
  pose.generate_tangents = settings.tangents == TangentSource::Generated;
  for (const ModelInfo& model : kModels) {
    for (const SlotInfo& slot : SlotsOf(model.model)) {
      if (slot.tangent_space && settings.without.Has(slot.feature)) pose.without.Add(slot.feature);
    }
  }
  pose.skins = !settings.without.Has(Feature::Skins);
  pose.morph_targets = !settings.without.Has(Feature::MorphTargets);
  return pose;
}

FramePlan MakeFramePlan(const Scene& scene, const PosedScene& posed, const RenderSettings& settings) {
  Planner planner(scene, settings);
  FramePlan& plan = planner.plan;
  plan.material_of_drawable.reserve(posed.drawables.size());
  for (const Drawable& drawable : posed.drawables) plan.material_of_drawable.push_back(planner.MaterialFor(drawable));

  const auto any = [&](auto&& predicate) {
    return std::any_of(plan.materials.begin(), plan.materials.end(),
                       [&](const PlannedMaterial& m) { return predicate(m.frame); });
  };
  const auto any_has = [&](MaterialFeatures feature) {
    return any([&](const FrameMaterial& m) { return m.Has(feature); });
  };
  const auto asked_out = [&](Feature feature) { return settings.without.Has(feature); };
  // Records that the frame uses the feature, or why it is disabled.
  const auto decide = [&](bool used, Feature feature, const std::string& what, const char* why) {
    if (used) {
      plan.uses.Add(feature);
    } else {
      plan.disabled.push_back(what + ": " + why);
    }
  };
  // The same for features that materials state; `none` is the reason if no drawn material states it.
  const auto decide_of_materials = [&](bool used, Feature feature, const std::string& what, const char* none) {
    decide(used, feature, what,
           !planner.stated.Has(feature) ? none
           : asked_out(feature)         ? kOnRequest
           : !planner.stated_by_lit.Has(feature)
               ? "only unlit materials state it, and show the base colour alone"
               : "shows nothing: unlit geometry, factors of 0 or textures without a picture");
  };

  for (const SlotInfo& slot : kSlots) {
    const auto has_factor = [&](const FactorFeature& factor) { return factor.feature == slot.feature; };
    if (std::ranges::any_of(kFactorFeatures, has_factor)) continue;  // handled below
    decide_of_materials(any([&](const FrameMaterial& m) { return ReadsTextureOf(m, slot.feature); }), slot.feature,
                        std::string(slot.name) + "s", "no drawn material has one");
  }
  if (!any_has(kTangentSpaceBits))
    plan.disabled.emplace_back("tangents: no normal texture is read, and no surface is anisotropic");
  for (const FactorFeature& factor : kFactorFeatures) {
    decide_of_materials(any_has(factor.bit), factor.feature, factor.name, factor.why_none);
  }
  decide_of_materials(any([](const FrameMaterial& m) { return m.vertex_colors; }), Feature::VertexColors,
                      "vertex colours", "no drawn geometry has them");

  const auto reads_light = [](const FrameMaterial& m) {
    const LightUse use = m.shader != nullptr ? m.shader->Light() : LightUse::LitMaterials;
    return use == LightUse::EveryMaterial || (use == LightUse::LitMaterials && m.Has(kLit));
  };
  const bool lit = any(reads_light);
  const char* const unlit = any_has(kLit) ? "the shader reads no light" : "no lit material";
  const bool has_environment = settings.environment.kind != EnvironmentSettings::Kind::None;
  plan.environment_light = lit && has_environment && !asked_out(Feature::EnvironmentLight);
  plan.environment_background = settings.background == Background::Environment && has_environment;
  plan.punctual_lights = lit && !posed.lights.empty() && !asked_out(Feature::PunctualLights);
  plan.alpha_test = any([](const FrameMaterial& m) { return m.alpha_mode == AlphaMode::Mask; });
  plan.blending = any([](const FrameMaterial& m) { return m.alpha_mode == AlphaMode::Blend; });

  plan.transmission = any([](const FrameMaterial& m) { return m.is_seen_through; });

  decide(plan.environment_light, Feature::EnvironmentLight, "environment light",
         !has_environment ? "no environment"
         : lit            ? kOnRequest
                          : unlit);
  if (!plan.environment_background) {
    plan.disabled.push_back(std::string("environment background: ") +
                            (settings.background == Background::Environment ? "no environment" : "not asked for"));
  }
  decide(plan.punctual_lights, Feature::PunctualLights, "punctual lights",
         posed.lights.empty() ? "the scene has none"
         : lit                ? kOnRequest
                              : unlit);
  decide_of_materials(plan.alpha_test, Feature::AlphaTest, "alpha test", "no drawn material has alpha mode MASK");
  decide_of_materials(plan.blending, Feature::Blending, "blending", "no drawn material has alpha mode BLEND");
  decide(posed.skinned, Feature::Skins, "skins",
         asked_out(Feature::Skins) && !scene.skins.empty() ? kOnRequest : "nothing drawn has one");
  decide(posed.morphed, Feature::MorphTargets, "morph targets",
         !HasMorphTargets(scene)            ? "the scene has none"
         : asked_out(Feature::MorphTargets) ? kOnRequest
                                            : "none of what is drawn has a weight");
  plan.planes = settings.planes;
  if (plan.planes.empty()) plan.disabled.emplace_back("planes besides colour: not asked for");
  if (settings.samples == 1) plan.disabled.emplace_back("multisampling: one sample a pixel");
  if (!settings.specular_antialiasing) plan.disabled.emplace_back(std::string("specular antialiasing: ") + kOnRequest);
  if (!settings.omit_unused) UseEverything(settings, plan);
  plan.albedo_tables = TablesFor(plan);
  return plan;
}

}  // namespace facet
