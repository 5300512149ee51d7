// `facet info --json`.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "cli/camera_text.h"
#include "cli/info_summary.h"
#include "material/model_parameters.h"
#include "material/models/models.h"
#include "material/parameters.h"

namespace facet::cli {
namespace {

using Json = nlohmann::ordered_json;

// JSON cannot represent infinite numbers; they become null.
Json Finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

template <class Vector>
Json Array(const Vector& vector) {
  Json array = Json::array();
  for (int i = 0; i < Vector::length(); ++i) array.push_back(Finite(static_cast<double>(vector[i])));
  return array;
}

Json Number(float value) { return value; }
template <glm::length_t kLength>
Json Number(const glm::vec<kLength, float>& color) {
  return Array(color);
}

// The name of the texture that a parameter belongs to, "normalTexture" or that in "EXTENSION.clearcoatNormalTexture";
// empty: none. `group`: as in Parameter.
constexpr std::string_view kTexture = "Texture";
std::string_view TextureOf(const char* group) {
  std::string_view name = group != nullptr ? group : "";
  name.remove_prefix(name.find('.') + 1);  // npos + 1 is 0
  return name.ends_with(kTexture) ? name : std::string_view();
}

Json ToJson(const Geometry& geometry) {
  return {{"primitives", geometry.primitives},
          {"vertices", geometry.vertices},
          {"triangles", geometry.triangles},
          {"lines", geometry.lines},
          {"points", geometry.points}};
}

Json ToJson(const SceneSummary& scene) {
  Json json = {{"name", scene.name}, {"nodes", scene.nodes}, {"drawn", ToJson(scene.drawn)}};
  json["bounds"] = nullptr;
  if (!scene.empty) json["bounds"] = {{"low", Array(scene.low)}, {"high", Array(scene.high)}};
  return json;
}

Json ToJson(const MeshSummary& mesh) {
  Json json = {{"name", mesh.name}};
  json.update(ToJson(mesh.geometry));
  json["normals"] = mesh.normals;
  json["tangents"] = mesh.tangents;
  json["tex_coord_sets"] = mesh.tex_coord_sets;
  json["colors"] = mesh.colors;
  json["morph_targets"] = mesh.morph_targets;
  json["influences"] = mesh.influences;
  return json;
}

// The key of a number or colour: its name in glTF, "metallicFactor", as "metallic_factor". What belongs to a texture
// has the texture's name before its own: "scale" of "clearcoatNormalTexture" is "clearcoat_normal_scale".
template <class Value>
std::string KeyOf(const Parameter<Value>& parameter) {
  if (parameter.key != nullptr) return parameter.key;
  std::string name = parameter.gltf_name;
  if (const std::string_view texture = TextureOf(parameter.gltf_group); !texture.empty()) {
    name = std::string(texture.substr(0, texture.size() - kTexture.size())) + "_" + name;
  }
  std::string key;
  for (const char c : name) {
    const bool is_capital = c >= 'A' && c <= 'Z';
    if (is_capital) key += '_';
    key += is_capital ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return key;
}

// Factors of core glTF and the emissive strength always, other numbers where they are not the defaults.
void AddNumbers(const Material& material, Json& json) {
  const Material plain;
  int row = 0;
  ForEachParameter([&]<class Value>(const Parameter<Value>& parameter) {
    const bool is_core = row++ < kCoreParameters;
    if constexpr (std::is_same_v<Value, float> || std::is_same_v<Value, glm::vec3> ||
                  std::is_same_v<Value, glm::vec4>) {
      if (parameter.alternative) return;
      const Value& value = material.*parameter.member;
      const bool is_always_there = is_core && TextureOf(parameter.gltf_group).empty();
      if (is_always_there || value != plain.*parameter.member) json[KeyOf(parameter)] = Number(value);
    }
  });
}

template <class Value>
Json JsonOf(const Value& value, const RowOptions& options) {
  if constexpr (requires { value.value; }) {
    return Number(value.value);
  } else if constexpr (std::is_same_v<Value, bool>) {
    return value;
  } else if constexpr (std::is_enum_v<Value>) {
    return options.words[std::size_t(value)];
  } else {
    return Number(value);
  }
}

Json ToJson(const MaterialSummary& summary) {
  const Material& material = *summary.material;
  Json textures = Json::object();
  for (const TextureUse& use : summary.textures) {
    textures[use.slot] = {
        {"texture", use.ref.texture}, {"tex_coord", use.ref.tex_coord}, {"transformed", use.transformed}};
  }
  Json json = {{"name", material.name},
               {"alpha_mode", NameOf(material.alpha_mode)},
               {"alpha_cutoff", material.alpha_cutoff},
               {"double_sided", material.double_sided},
               {"model", InfoOf(material.model).word},
               {"unlit", material.model == ShadingModel::Unlit}};
  if (material.parameters == nullptr) {
    AddNumbers(material, json);
  } else {
    ForEachStatedParameter(*material.parameters, [&](const auto& parameter, const auto& value) {
      json["parameters"][parameter.name] = JsonOf(value, parameter);
    });
  }
  json["textures"] = std::move(textures);
  if (!summary.ignored.empty()) json["ignored"] = summary.ignored;
  json["primitives"] = summary.primitives;
  return json;
}

Json ToJson(const ImageSummary& image) {
  const ImageHeader header = image.header.value_or(ImageHeader());
  const auto known = [](auto value) { return value > 0 ? Json(value) : Json(nullptr); };
  return {{"name", image.name},
          {"source", image.source},
          {"format", header.format.empty() ? Json(nullptr) : Json(header.format)},
          {"width", known(header.width)},
          {"height", known(header.height)},
          {"channels", known(header.channels)},
          {"bits", known(header.bits)},
          {"bytes", known(header.bytes)},
          {"textures", image.textures}};
}

Json ToJson(const Texture& texture) {
  Json json = {{"name", texture.name}};
  json["image"] = texture.image < 0 ? Json(nullptr) : Json(texture.image);
  return json;
}

Json ToJson(const Camera& camera) {
  Json json = {{"name", camera.name}, {"type", camera.orthographic ? "orthographic" : "perspective"}};
  if (camera.orthographic) {
    json["xmag"] = camera.xmag;
    json["ymag"] = camera.ymag;
  } else {
    json["yfov"] = camera.yfov;
    json["aspect"] = camera.aspect ? Json(*camera.aspect) : Json(nullptr);
  }
  json["znear"] = camera.znear;
  json["zfar"] = Finite(camera.zfar);
  return json;
}

Json ToJson(const Light& light) {
  Json json = {{"name", light.name},
               {"type", NameOf(light.type)},
               {"color", Array(light.color)},
               {"intensity", light.intensity}};
  json["range"] = Finite(static_cast<double>(light.range));
  if (light.type == LightType::Spot) {
    json["inner_cone_angle"] = light.inner_cone_angle;
    json["outer_cone_angle"] = light.outer_cone_angle;
  }
  return json;
}

Json ToJson(const AnimationSummary& animation) {
  return {{"name", animation.name},           {"duration", animation.duration_seconds},
          {"channels", animation.channels},   {"translations", animation.translations},
          {"rotations", animation.rotations}, {"scales", animation.scales},
          {"weights", animation.weights}};
}

Json ToJson(const Skin& skin) { return {{"name", skin.name}, {"joints", skin.joints.size()}}; }

Json ToJson(const ExtensionUse& extension) {
  return {{"name", extension.name}, {"required", extension.required}, {"supported", extension.supported}};
}

template <class Things>
Json List(const Things& things) {
  Json array = Json::array();
  for (const auto& thing : things) array.push_back(ToJson(thing));
  return array;
}

}  // namespace

std::string InfoJson(const FileSummary& summary) {
  const Scene& scene = summary.file->scene;
  const LoadReport& report = summary.file->report;
  Json json;
  json["input"] = summary.input;
  json["asset"] = {{"version", report.version}, {"generator", report.generator}, {"copyright", report.copyright}};
  json["file_bytes"] = report.file_bytes;
  json["nodes"] = scene.nodes.size();
  json["geometry"] = ToJson(summary.geometry);
  json["default_scene"] = scene.scenes.empty() ? Json(nullptr) : Json(std::max(scene.default_scene, 0));
  json["default_camera"] = CameraJson(summary.camera, summary.camera_target_distance);
  json["scenes"] = List(summary.scenes);
  json["meshes"] = List(summary.meshes);
  json["materials"] = List(summary.materials);
  json["textures"] = List(scene.textures);
  json["images"] = List(summary.images);
  json["cameras"] = List(scene.cameras);
  json["lights"] = List(scene.lights);
  json["animations"] = List(summary.animations);
  json["skins"] = List(scene.skins);
  json["variants"] = scene.variants;
  json["extensions"] = List(report.extensions);
  json["warnings"] = report.warnings;
  // Names need not be UTF-8; JSON must be.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace facet::cli
