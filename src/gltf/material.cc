#include "gltf/material.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/round_to_float.h"

namespace facet::gltf {
namespace {

class MaterialReader {
 public:
  MaterialReader(const Document& document, const Json& object, const Place& place)
      : texture_count_(document.Count("textures")), object_(object), place_(place) {}

  Material Read() const {
    Material out;
    out.name = NameOf(object_, place_);
    if (const Json* pbr = LenientObject(object_, "pbrMetallicRoughness", place_)) {
      const Place pbr_place(place_, "pbrMetallicRoughness");
      // An opaque colour is often written without its alpha.
      const auto base_color = LenientNumbers(*pbr, "baseColorFactor", 4, pbr_place, 3);
      for (std::size_t c = 0; c < base_color.size(); ++c) {
        out.base_color_factor[static_cast<int>(c)] = Clamp(base_color[c], 1.0, Place(pbr_place, "baseColorFactor"));
      }
      out.metallic_factor = Factor(*pbr, "metallicFactor", 1.0, 1.0, pbr_place);
      out.roughness_factor = Factor(*pbr, "roughnessFactor", 1.0, 1.0, pbr_place);
      out.base_color_texture = Ref(*pbr, "baseColorTexture", pbr_place);
      out.metallic_roughness_texture = Ref(*pbr, "metallicRoughnessTexture", pbr_place);
    }
    out.normal_texture = Ref(object_, "normalTexture", place_);
    if (const Json* info = LenientObject(object_, "normalTexture", place_)) {
      out.normal_scale =
          RoundToFiniteFloat(LenientNumber(*info, "scale", Place(place_, "normalTexture")).value_or(1.0));
    }
    out.occlusion_texture = Ref(object_, "occlusionTexture", place_);
    if (const Json* info = LenientObject(object_, "occlusionTexture", place_)) {
      out.occlusion_strength = Factor(*info, "strength", 1.0, 1.0, Place(place_, "occlusionTexture"));
    }
    out.emissive_texture = Ref(object_, "emissiveTexture", place_);
    const auto emissive = LenientNumbers(object_, "emissiveFactor", 3, place_);
    for (std::size_t c = 0; c < emissive.size(); ++c) {
      // Above 1 the core specification forbids, but exporters older than KHR_materials_emissive_strength wrote it.
      out.emissive_factor[static_cast<int>(c)] = Clamp(emissive[c], kUnbounded, Place(place_, "emissiveFactor"));
    }
    const std::string alpha_mode = LenientString(object_, "alphaMode", place_).value_or("OPAQUE");
    if (alpha_mode == "MASK") {
      out.alpha_mode = AlphaMode::Mask;
    } else if (alpha_mode == "BLEND") {
      out.alpha_mode = AlphaMode::Blend;
    } else if (alpha_mode != "OPAQUE") {
      Place(place_, "alphaMode").Warn("\"" + alpha_mode + "\" is unknown; OPAQUE is used");
    }
    out.alpha_cutoff = Factor(object_, "alphaCutoff", 0.5, kUnbounded, place_);
    out.double_sided = LenientBool(object_, "doubleSided", place_).value_or(false);
    out.unlit = ExtensionOf(object_, "KHR_materials_unlit", place_) != nullptr;
    constexpr const char* kStrength = "KHR_materials_emissive_strength";
    if (const Json* strength = ExtensionOf(object_, kStrength, place_)) {
      const Place extensions_place(place_, "extensions");
      out.emissive_strength =
          Factor(*strength, "emissiveStrength", 1.0, kUnbounded, Place(extensions_place, kStrength));
    }
    return out;
  }

 private:
  static constexpr double kUnbounded = std::numeric_limits<double>::infinity();

  // Into [0, high].
  static float Clamp(double value, double high, const Place& where) {
    const double clamped = std::min(std::max(value, 0.0), high);
    if (clamped != value) where.Warn("a number outside of its range was clamped");
    return RoundToFiniteFloat(clamped);
  }

  static float Factor(const Json& object, const char* key, double otherwise, double high, const Place& place) {
    return Clamp(LenientNumber(object, key, place).value_or(otherwise), high, Place(place, key));
  }

  static void SetTexCoord(const Json& object, const Place& place, TextureRef& ref) {
    constexpr std::size_t kMostSets = 0x10000;
    const int set = LenientIndex(object, "texCoord", kMostSets, "UV sets", place);
    if (set >= 0) ref.tex_coord = set;
  }

  TextureRef Ref(const Json& object, const char* key, const Place& place) const {
    TextureRef ref;
    const Json* info = LenientObject(object, key, place);
    if (!info) return ref;
    const Place info_place(place, key);
    if (!Find(*info, "index")) info_place.Warn("ignored: \"index\" is missing");
    ref.texture = LenientIndex(*info, "index", texture_count_, "textures", info_place);
    SetTexCoord(*info, info_place, ref);
    constexpr const char* kTransform = "KHR_texture_transform";
    const Json* transform = ExtensionOf(*info, kTransform, info_place);
    if (!transform) return ref;
    const Place extensions_place(info_place, "extensions");
    const Place transform_place(extensions_place, kTransform);
    const auto offset = LenientNumbers(*transform, "offset", 2, transform_place);
    const auto scale = LenientNumbers(*transform, "scale", 2, transform_place);
    if (!offset.empty()) ref.offset = {RoundToFiniteFloat(offset[0]), RoundToFiniteFloat(offset[1])};
    if (!scale.empty()) ref.scale = {RoundToFiniteFloat(scale[0]), RoundToFiniteFloat(scale[1])};
    ref.rotation = RoundToFiniteFloat(LenientNumber(*transform, "rotation", transform_place).value_or(0.0));
    SetTexCoord(*transform, transform_place, ref);
    return ref;
  }

  const std::size_t texture_count_;
  const Json& object_;
  const Place& place_;
};

}  // namespace

void ReadMaterials(Context& context, Scene& scene) {
  const Place list_place(context.place, "materials");
  context.Charge(context.document.Count("materials"), sizeof(Material), list_place);
  scene.materials.reserve(context.document.Count("materials"));
  for (std::size_t i = 0; i < context.document.Count("materials"); ++i) {
    const Place place(list_place, i);
    scene.materials.push_back(MaterialReader(context.document, context.Object("materials", i), place).Read());
  }
}

}  // namespace facet::gltf
