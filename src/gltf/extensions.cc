#include "gltf/extensions.h"

#include <algorithm>
#include <map>
#include <string_view>

#include "gltf/enterprise.h"
#include "material/models/models.h"
#include "material/parameters.h"

namespace facet::gltf {
namespace {

// Where an extension is used: the first place, and how many more there are.
struct Uses {
  std::string place;
  std::size_t more = 0;
};

void CollectUnlisted(const Context& context, const Json& value, const Place& place, std::map<std::string, Uses>& out) {
  if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) CollectUnlisted(context, value[i], Place(place, i), out);
  }
  if (!value.is_object()) return;
  for (const auto& item : value.items()) {
    const Place item_place(place, item.key());
    CollectUnlisted(context, item.value(), item_place, out);
    if (item.key() != "extensions" || !item.value().is_object()) continue;
    for (const auto& extension : item.value().items()) {
      // A material's extras may have become these.
      if (context.IsUsed(extension.key()) || IsEnterpriseExtension(extension.key())) continue;
      const auto [uses, is_new] = out.try_emplace(extension.key());
      if (is_new) {
        uses->second.place = Place(item_place, extension.key()).Path();
      } else {
        ++uses->second.more;
      }
    }
  }
}

}  // namespace

void WarnOfUnlistedExtensions(Context& context) {
  std::map<std::string, Uses> unlisted;
  CollectUnlisted(context, context.document.root, context.place, unlisted);
  for (const auto& [name, uses] : unlisted) {
    std::string what = IsSupported(name) ? "is read, although extensionsUsed does not list it"
                                         : "ignored: is not supported, and extensionsUsed does not list it";
    if (uses.more > 0)
      what += " (and in " + std::to_string(uses.more) + (uses.more == 1 ? " more place)" : " more places)");
    context.warnings.Add(uses.place, Shortened(what, kMostOfMessage));
  }
}

bool IsSupported(const std::string& extension) {
  static const char* const kSupported[] = {
      "EXT_mesh_gpu_instancing", "EXT_meshopt_compression", "EXT_texture_webp", "KHR_draco_mesh_compression",
      "KHR_lights_punctual", "KHR_materials_variants", "KHR_mesh_quantization", "KHR_node_visibility",
      "KHR_texture_transform",
      // These only describe the data, so ignoring them is enough to support them.
      "FB_ngon_encoding", "KHR_xmp", "KHR_xmp_json_ld"};
  bool supported = std::find(std::begin(kSupported), std::end(kSupported), extension) != std::end(kSupported);
  const auto compare = [&](const char* group) {  // or an object in one
    const std::string_view name = group != nullptr ? group : "";
    supported = supported || (IsExtension(name) && extension == name.substr(0, name.find('.')));
  };
  for (const ModelInfo& model : kModels) compare(model.gltf_extension);
  ForEachParameter([&](const auto& parameter) { compare(parameter.gltf_group); });
  return supported || IsEnterpriseExtension(extension);
}

void ReadExtensions(Context& context) {
  constexpr std::size_t kMostNamed = 20;
  std::map<std::string, bool> required;
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
    const Json* names = LenientArray(context.document.root, list, context.place);
    const Place list_place(context.place, list);
    for (std::size_t i = 0; names && i < names->size(); ++i) {
      const Json& name = (*names)[i];
      if (name.is_string()) {
        required[name.get<std::string>()] |= std::string(list) == "extensionsRequired";
      } else {
        Place(list_place, i).Warn("ignored: is not a string");
      }
    }
  }
  std::string missing;
  std::size_t missing_count = 0;
  for (const auto& [name, is_required] : required) {
    const bool supported = IsSupported(name);
    context.report.extensions.push_back({name, is_required, supported});
    if (supported) continue;
    Place(context.place, is_required ? "extensionsRequired" : "extensionsUsed")
        .Warn("ignored: " + name + " is not supported");
    if (!is_required || ++missing_count > kMostNamed) continue;
    missing += (missing.empty() ? "" : ", ") + (name.empty() ? "\"\"" : name);
  }
  if (missing_count > kMostNamed) missing += " and " + std::to_string(missing_count - kMostNamed) + " more";
  if (missing_count > 0 && !context.options.ignore_required_extensions) {
    Fail(Place(context.place, "extensionsRequired"), "the file requires " + missing + ", which facet does not support",
         "export it without, or ignore required extensions", ErrorCode::Unsupported);
  }
}

}  // namespace facet::gltf
