#include "gltf/material.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/round_to_float.h"

namespace facet::gltf {
namespace {

class MaterialReader {
 public:
  MaterialReader(Context& context, const Json& object, const Place& place)
      : context_(context), object_(object), place_(place) {}

  Material Read(const tinygltf::Material& from) {
    Material out;
    out.name = from.name;
    const auto& pbr = from.pbrMetallicRoughness;
    const Json* pbr_object = ObjectAt(object_, "pbrMetallicRoughness", place_);
    const Place pbr_place(place_, "pbrMetallicRoughness");
    for (int c = 0; c < 4; ++c) {
      out.base_color_factor[c] =
          Clamp(pbr.baseColorFactor[static_cast<std::size_t>(c)], 1.0, Place(pbr_place, "baseColorFactor"));
    }
    out.metallic_factor = Clamp(pbr.metallicFactor, 1.0, Place(pbr_place, "metallicFactor"));
    out.roughness_factor = Clamp(pbr.roughnessFactor, 1.0, Place(pbr_place, "roughnessFactor"));
    if (pbr_object) {
      out.base_color_texture = Ref(*pbr_object, "baseColorTexture", pbr_place);
      out.metallic_roughness_texture = Ref(*pbr_object, "metallicRoughnessTexture", pbr_place);
    }
    out.normal_texture = Ref(object_, "normalTexture", place_);
    out.normal_scale = RoundToFiniteFloat(from.normalTexture.scale);
    out.occlusion_texture = Ref(object_, "occlusionTexture", place_);
    out.occlusion_strength = Clamp(from.occlusionTexture.strength, 1.0, Place(place_, "occlusionTexture"));
    out.emissive_texture = Ref(object_, "emissiveTexture", place_);
    for (std::size_t c = 0; c < from.emissiveFactor.size() && c < 3; ++c) {
      // Above 1 the core specification forbids, but exporters older than KHR_materials_emissive_strength wrote it.
      out.emissive_factor[static_cast<int>(c)] =
          Clamp(from.emissiveFactor[c], std::numeric_limits<double>::infinity(), Place(place_, "emissiveFactor"));
    }
    if (from.alphaMode == "MASK") {
      out.alpha_mode = AlphaMode::Mask;
    } else if (from.alphaMode == "BLEND") {
      out.alpha_mode = AlphaMode::Blend;
    } else if (from.alphaMode != "OPAQUE") {
      context_.Warn(Place(place_, "alphaMode"), "\"" + from.alphaMode + "\" is unknown; OPAQUE is used");
    }
    out.alpha_cutoff = Clamp(from.alphaCutoff, std::numeric_limits<double>::infinity(), Place(place_, "alphaCutoff"));
    out.double_sided = from.doubleSided;
    out.unlit = ExtensionOf(object_, "KHR_materials_unlit", place_) != nullptr;
    constexpr const char* kStrength = "KHR_materials_emissive_strength";
    if (const Json* strength = ExtensionOf(object_, kStrength, place_)) {
      const Place extensions_place(place_, "extensions");
      const Place strength_place(extensions_place, kStrength);
      out.emissive_strength = Clamp(NumberAt(*strength, "emissiveStrength", strength_place).value_or(1.0),
                                    std::numeric_limits<double>::infinity(), strength_place);
    }
    return out;
  }

 private:
  // Into [0, high].
  float Clamp(double value, double high, const Place& where) {
    const double clamped = std::min(std::max(value, 0.0), high);
    if (clamped != value) context_.Warn(where, "a number outside of its range was clamped");
    return RoundToFiniteFloat(clamped);
  }

  static TextureRef Ref(const Json& object, const char* key, const Place& place) {
    TextureRef ref;
    const Json* info = ObjectAt(object, key, place);
    if (!info) return ref;
    const Place info_place(place, key);
    ref.texture = (*info)["index"].get<int>();  // CheckSchema has seen both
    ref.tex_coord = static_cast<int>(SizeAt(*info, "texCoord", info_place).value_or(0));
    constexpr const char* kTransform = "KHR_texture_transform";
    const Json* transform = ExtensionOf(*info, kTransform, info_place);
    if (!transform) return ref;
    const Place extensions_place(info_place, "extensions");
    const Place transform_place(extensions_place, kTransform);
    const auto offset = NumbersAt(*transform, "offset", 2, transform_place);
    const auto scale = NumbersAt(*transform, "scale", 2, transform_place);
    if (!offset.empty()) ref.offset = {RoundToFiniteFloat(offset[0]), RoundToFiniteFloat(offset[1])};
    if (!scale.empty()) ref.scale = {RoundToFiniteFloat(scale[0]), RoundToFiniteFloat(scale[1])};
    ref.rotation = RoundToFiniteFloat(NumberAt(*transform, "rotation", transform_place).value_or(0.0));
    if (const auto tex_coord = SizeAt(*transform, "texCoord", transform_place)) {
      if (*tex_coord > 0xFFFF) Fail(Place(transform_place, "texCoord"), "is absurdly large");
      ref.tex_coord = static_cast<int>(*tex_coord);
    }
    return ref;
  }

  Context& context_;
  const Json& object_;
  const Place& place_;
};

}  // namespace

void ReadMaterials(Context& context, Scene& scene) {
  const Place list_place(context.place, "materials");
  for (std::size_t i = 0; i < context.document.core.materials.size(); ++i) {
    const Place place(list_place, i);
    scene.materials.push_back(
        MaterialReader(context, context.Object("materials", i), place).Read(context.document.core.materials[i]));
  }
}

}  // namespace facet::gltf
