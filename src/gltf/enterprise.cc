#include "gltf/enterprise.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "base/number_text.h"
#include "facet/models.h"
#include "material/from_gltf.h"
#include "material/model_parameters.h"
#include "math/round_to_float.h"

namespace facet::gltf {
namespace {

// The nearest number of the range, with a warning if it is another one.
float Within(double value, ParameterRange range, const Place& where) {
  const double within = std::min(std::max(value, double{range.low}), double{range.high});
  if (within != value) where.Warn(ShortNumber(value) + " is out of range; " + ShortNumber(within) + " is used");
  return RoundToFiniteFloat(within);
}

// --- Members by the names of the table -------------------------------------------------------------------------------

void ReadNamed(const Json& group, const Place& place, const RowOptions& row, const char* name, float& out) {
  if (const auto value = LenientNumber(group, name, place)) out = Within(*value, row.range, Place(place, name));
}
void ReadNamed(const Json& group, const Place& place, const RowOptions& row, const char* name, glm::vec3& out) {
  const auto values = LenientNumbers(group, name, 3, place);
  const Place where(place, name);
  for (std::size_t c = 0; c < values.size(); ++c) out[static_cast<int>(c)] = Within(values[c], row.range, where);
}
void ReadNamed(const Json& group, const Place& place, const RowOptions&, const char* name, bool& out) {
  out = LenientBool(group, name, place).value_or(out);
}
template <class Value>
requires std::is_enum_v<Value>
void ReadNamed(const Json& group, const Place& place, const RowOptions& row, const char* name, Value& out) {
  const auto text = LenientString(group, name, place);
  if (!text) return;
  for (std::size_t i = 0; i < row.words.size(); ++i) {
    const std::string_view word = row.words[i];  // the draft texts write POWER for LUMINOUS_POWER
    if (*text == word || *text == word.substr(word.find('_') + 1)) {
      out = static_cast<Value>(i);
      return;
    }
  }
  Place(place, name).Warn("\"" + *text + "\" is unknown; " + row.words[0] + " is used");
}
template <class Value>
requires kHasTexture<Value>
void ReadNamed(const Json& group, const Place& place, const RowOptions& row, const char* name, Value& out) {
  ReadNamed(group, place, row, name, out.value);
}

// The parameter that a member of the block is, from a group that may call it otherwise.
template <class Value>
void ReadAs(const Json& group, const Place& place, const char* name, Value EnterpriseParameters::*member,
            EnterpriseParameters& p) {
  ForEachParameterOf(p, [&](const auto& row, auto& value) {
    if constexpr (std::is_same_v<decltype(row.member), Value EnterpriseParameters::*>) {
      if (row.member == member) ReadNamed(group, place, row, name, value);
    }
  });
}

}  // namespace

std::map<std::string_view, std::set<std::string_view>> EnterpriseProperties() {
  std::map<std::string_view, std::set<std::string_view>> all = {
      {"3DS_materials_anisotropy",
       {"ansiotropyFactor", "anisotropyFactor", "anisotropyRotationFactor", "anisotropyTexture"}},
      {"3DS_materials_emission", {"emissionValue", "emissionMode", "emissionEnergyNormalization"}},
      {"3DS_materials_sss", {"subsurfaceColor", "subsurfaceAsymmetry"}},
      {"3DS_materials_translucency", {"translucencyFactor", "translucencyTexture"}},
      {"3DS_materials_volume", {"subsurfaceColor", "subsurfaceAsymmetry"}},
  };
  ForEachParameterOf(EnterpriseParameters(),
                     [&](const auto& row, const auto&) { all["3DS_materials_enterprise_pbr"].insert(row.name); });
  return all;
}

bool IsEnterpriseExtension(std::string_view name) {
  return std::ranges::find(kEnterpriseExtensions, name) != std::end(kEnterpriseExtensions);
}

bool IsEnterprise(const Json& material, const Place& place) {
  const Json* const extensions = LenientObject(material, "extensions", place);
  return extensions != nullptr &&
         std::ranges::any_of(extensions->items(), [](const auto& item) { return IsEnterpriseExtension(item.key()); });
}

void ReadEnterprise(const Json& object, const Place& place, const ReadTextureInfo& read_texture, Material& material) {
  using P = EnterpriseParameters;
  Material stated = material;
  stated.occlusion_texture = {};  // for other viewers
  if (stated.model == ShadingModel::Unlit) stated.model = ShadingModel::MetallicRoughness;
  if (ExtensionOf(object, "3DS_materials_anisotropy", place) != nullptr) stated.anisotropy_strength = 0.0f;
  const FromGltf core = ConvertFromGltf(stated, ShadingModel::Enterprise);
  if (!core.lost.empty()) place.Warn(SentenceOf(core.lost, ShadingModel::Enterprise));
  P p = std::get<P>(core.parameters);
  // glTF's sheen is smooth by default, DSPBR's is not.
  if (ExtensionOf(object, "KHR_materials_sheen", place) == nullptr) p.sheen_roughness = P().sheen_roughness;

  const Place extensions_place(place, "extensions");
  // Calls read(group, its place) for an extension that the material has.
  const auto with = [&](const char* name, const auto& read) {
    if (const Json* group = ExtensionOf(object, name, place)) read(*group, Place(extensions_place, name));
  };
  const auto texture_of = [&](const Json& group, const char* name, const Place& where) {
    const Json* const info = LenientObject(group, name, where);
    return info != nullptr ? read_texture(*info, Place(where, name)) : TextureRef{};
  };
  with("3DS_materials_anisotropy", [&](const Json& group, const Place& where) {
    ReadAs(group, where, "ansiotropyFactor", &P::anisotropy, p);  // as the draft's schema spells it
    ReadAs(group, where, "anisotropyFactor", &P::anisotropy, p);
    ReadAs(group, where, "anisotropyRotationFactor", &P::anisotropy_rotation, p);
    p.anisotropy.texture = p.anisotropy_rotation.texture = texture_of(group, "anisotropyTexture", where);
    p.anisotropy_rotation.channel = 1;
  });
  with("3DS_materials_translucency", [&](const Json& group, const Place& where) {
    ReadAs(group, where, "translucencyFactor", &P::translucency, p);
    p.translucency.texture = texture_of(group, "translucencyTexture", where);
    p.translucency.channel = 0;
    p.profile = EnterpriseProfile::V2022x;  // the draft has no colour of translucency
  });
  with("3DS_materials_emission", [&](const Json& group, const Place& where) {
    if (Find(object, "emissiveFactor") == nullptr) p.emission_color.value = glm::vec3(1.0f);
    p.emission_value = 0.0f;
    ReadAs(group, where, "emissionValue", &P::emission_value, p);
    ReadAs(group, where, "emissionMode", &P::emission_mode, p);
    ReadAs(group, where, "emissionEnergyNormalization", &P::emission_energy_normalization, p);
  });
  for (const char* name : {"3DS_materials_sss", "3DS_materials_volume"}) {  // the draft's schema has the second name
    with(name, [&](const Json& group, const Place& where) {
      ReadAs(group, where, "subsurfaceColor", &P::subsurface_color, p);
      ReadAs(group, where, "subsurfaceAsymmetry", &P::subsurface_anisotropy, p);
    });
  }
  AlphaMode alpha_mode = material.alpha_mode;
  with("3DS_materials_enterprise_pbr", [&](const Json& group, const Place& where) {
    const bool states_coverage = Find(group, "cutoutOpacity") != nullptr;
    if (states_coverage && Find(object, "alphaMode") == nullptr) alpha_mode = AlphaMode::Blend;
    ForEachParameterOf(p, [&](const auto& row, auto& value) { ReadNamed(group, where, row, row.name, value); });
  });
  if (p.displacement != glm::vec3(0.0f)) place.Warn("displacement is not drawn");

  Material out;
  out.name = material.name;
  out.alpha_mode = alpha_mode;
  out.alpha_cutoff = material.alpha_cutoff;
  out.double_sided = material.double_sided;
  out.model = ShadingModel::Enterprise;
  out.parameters = std::make_shared<const ModelParameters>(std::move(p));
  material = std::move(out);
}

}  // namespace facet::gltf
