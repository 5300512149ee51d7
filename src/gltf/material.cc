#include "gltf/material.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "base/number_text.h"
#include "gltf/enterprise.h"
#include "material/models/models.h"
#include "material/parameters.h"
#include "math/round_to_float.h"

namespace facet::gltf {
namespace {

// The properties of each extension of materials.
const std::map<std::string_view, std::set<std::string_view>>& ExtensionProperties() {
  static const auto properties = [] {
    std::map<std::string_view, std::set<std::string_view>> all;
    for (const ModelInfo& model : kModels) {
      if (model.gltf_extension != nullptr) all[model.gltf_extension];
    }
    ForEachParameter([&](const auto& parameter) {
      const std::string_view group = parameter.gltf_group != nullptr ? parameter.gltf_group : "";
      if (!IsExtension(group)) return;
      const std::size_t dot = group.find('.');  // an object in the extension has it
      all[group.substr(0, dot)].insert(dot == group.npos ? parameter.gltf_name : group.substr(dot + 1));
    });
    all.merge(EnterpriseProperties());
    return all;
  }();
  return properties;
}

class MaterialReader {
 public:
  MaterialReader(const Document& document, const Json& object, const Place& place)
      : texture_count_(document.Count("textures")), object_(object), place_(place) {}

  Material Read() {
    Material out;
    out.name = NameOf(object_, place_);
    // The older model states its own base colour, and what stands in pbrMetallicRoughness is for other viewers.
    const bool is_older = ExtensionOf(object_, "KHR_materials_pbrSpecularGlossiness", place_) != nullptr &&
                          ExtensionOf(object_, "KHR_materials_unlit", place_) == nullptr;
    ForEachParameter([&](const auto& parameter) {
      auto& value = out.*parameter.member;
      const char* const name = parameter.gltf_group;
      if (name != nullptr && (is_older ? name == std::string_view("pbrMetallicRoughness") : parameter.alternative))
        return;
      if (name == nullptr) return ReadValue(object_, place_, parameter, value);
      if (const Json* group = Group(name)) ReadValue(*group, PlaceOf(name), parameter, value);
    });
    WarnOfUnknownProperties();
    if (IsEnterprise(object_, place_)) {
      const auto read_texture = [this](const Json& info, const Place& where) { return ReadRef(info, where); };
      ReadEnterprise(object_, place_, read_texture, out);
    }
    return out;
  }

 private:
  // An object in the material, one of its extensions, or an object in one of those ("GROUP.OBJECT"); null if there is
  // none. An error in it is reported once.
  const Json* Group(const std::string& name) {
    const auto [known, is_new] = groups_.try_emplace(name);
    if (!is_new) return known->second;
    if (const std::size_t dot = name.find('.'); dot != name.npos) {
      const std::string outer = name.substr(0, dot);
      const Json* const object = Group(outer);
      return known->second = object ? LenientObject(*object, name.c_str() + dot + 1, PlaceOf(outer)) : nullptr;
    }
    return known->second = (IsExtension(name) ? ExtensionOf : LenientObject)(object_, name.c_str(), place_);
  }
  // What an extension does not have is most likely misspelt.
  void WarnOfUnknownProperties() const {
    const Json* const extensions = Find(object_, "extensions");
    if (extensions == nullptr || !extensions->is_object()) return;
    for (const auto& [name, object] : extensions->items()) {
      const auto known = ExtensionProperties().find(name);
      if (known == ExtensionProperties().end() || !object.is_object()) continue;
      std::string list;
      for (const std::string_view property : known->second) list += (list.empty() ? "" : ", ") + std::string(property);
      const Place place = PlaceOf(name);
      for (const auto& item : object.items()) {
        if (item.key() == "extensions" || known->second.contains(item.key())) continue;
        Place(place, item.key())
            .Warn("ignored: " + name + " has no such property, " + (list.empty() ? "and no other" : "but " + list));
      }
    }
  }

  Place PlaceOf(std::string_view group) const { return {IsExtension(group) ? extensions_place_ : place_, group}; }

  // The nearest number of the range, with a warning if it is another one.
  static float WithinRange(double value, ParameterRange range, const char* name, const Place& where) {
    if (value == double{range.exception}) return static_cast<float>(value);
    const bool is_exception = range.zero_is_exception && value <= 0.0;
    const double within =
        is_exception ? double{range.exception} : std::min(std::max(value, double{range.low}), double{range.high});
    if (within != value) {
      const std::string used = ShortNumber(within), read = ShortNumber(value);
      const std::string exact = read == used ? ShortNumber(value, 17) : read;
      where.Warn(std::string(name) + " " + exact + " is out of range; " + used + " is used");
    }
    return is_exception ? range.exception : RoundToFiniteFloat(within);
  }

  void ReadValue(const Json& object, const Place& place, const Parameter<float>& parameter, float& out) const {
    const auto value = LenientNumber(object, parameter.gltf_name, place);
    if (value) out = WithinRange(*value, parameter.range, parameter.name, Place(place, parameter.gltf_name));
  }
  template <int kLength>
  void ReadValue(const Json& object, const Place& place, const Parameter<glm::vec<kLength, float>>& parameter,
                 glm::vec<kLength, float>& out) const {
    // Colours with alpha are often written without it.
    const auto values = LenientNumbers(object, parameter.gltf_name, kLength, place, kLength == 4 ? 3 : kLength);
    const Place array_place(place, parameter.gltf_name);
    for (std::size_t c = 0; c < values.size(); ++c) {
      out[static_cast<int>(c)] = WithinRange(values[c], parameter.range, parameter.name, Place(array_place, c));
    }
  }
  void ReadValue(const Json& object, const Place& place, const Parameter<bool>& parameter, bool& out) const {
    out = LenientBool(object, parameter.gltf_name, place).value_or(out);
  }
  void ReadValue(const Json& object, const Place& place, const Parameter<AlphaMode>& parameter, AlphaMode& out) const {
    const std::string mode = LenientString(object, parameter.gltf_name, place).value_or("OPAQUE");
    if (mode == "MASK") {
      out = AlphaMode::Mask;
    } else if (mode == "BLEND") {
      out = AlphaMode::Blend;
    } else if (mode != "OPAQUE") {
      Place(place, parameter.gltf_name).Warn("\"" + mode + "\" is unknown; OPAQUE is used");
    }
  }
  void ReadValue(const Json& object, const Place& place, const Parameter<ShadingModel>&, ShadingModel& out) const {
    for (const ModelInfo& model : kModels) {
      const char* const extension = model.gltf_extension;
      if (extension != nullptr && ExtensionOf(object, extension, place) != nullptr) out = model.model;
    }
  }
  void ReadValue(const Json&, const Place& place, const Parameter<TextureRef>& parameter, TextureRef& out) {
    const std::string outer = parameter.gltf_group ? std::string(parameter.gltf_group) + "." : "";
    if (const Json* info = Group(outer + parameter.gltf_name)) out = ReadRef(*info, Place(place, parameter.gltf_name));
  }

  static void SetTexCoord(const Json& object, const Place& place, TextureRef& ref) {
    constexpr std::size_t kMostSets = 0x10000;
    const int set = LenientIndex(object, "texCoord", kMostSets, "UV sets", place);
    if (set >= 0) ref.tex_coord = set;
  }

  TextureRef ReadRef(const Json& info, const Place& info_place) const {
    TextureRef ref;
    if (!Find(info, "index")) info_place.Warn("ignored: \"index\" is missing");
    ref.texture = LenientIndex(info, "index", texture_count_, "textures", info_place);
    SetTexCoord(info, info_place, ref);
    constexpr const char* kTransform = "KHR_texture_transform";
    const Json* transform = ExtensionOf(info, kTransform, info_place);
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
  const Place extensions_place_{place_, "extensions"};
  std::map<std::string, const Json*> groups_;  // that were asked for
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
