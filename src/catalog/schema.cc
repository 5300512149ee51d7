// MaterialFileSchema() of facet/catalog.h.
#include <cmath>
#include <nlohmann/json.hpp>

#include "facet/catalog.h"
#include "facet/models.h"

namespace facet {
namespace {

using Json = nlohmann::ordered_json;

Json NumberIn(const ParameterDescription& parameter) {
  Json number = {{"type", "number"}};
  if (std::isfinite(parameter.low)) number["minimum"] = parameter.low;
  if (std::isfinite(parameter.high)) number["maximum"] = parameter.high;
  if (!parameter.other || !std::isfinite(*parameter.other)) return number;
  return {{"anyOf", {number, {{"const", *parameter.other}}}}};
}

Json SchemaOf(const ParameterDescription& parameter) {
  Json json = {{"description", parameter.meaning + (parameter.unit.empty() ? "" : ", in " + parameter.unit)}};
  const std::size_t size = parameter.initial.size();
  if (parameter.type == "choice") {
    json["enum"] = parameter.choices;
    json["default"] = parameter.choices.at(static_cast<std::size_t>(parameter.initial[0]));
  } else if (parameter.type == "true or false") {
    json["type"] = "boolean";
    json["default"] = parameter.initial[0] != 0.0f;
  } else if (size == 1) {
    json.update(NumberIn(parameter));
    if (std::isfinite(parameter.initial[0])) json["default"] = parameter.initial[0];
  } else {
    json["type"] = "array";
    json["items"] = NumberIn(parameter);
    json["minItems"] = size == 4 ? 3 : size;
    json["maxItems"] = size;
    json["default"] = parameter.initial;
  }
  return json;
}

Json ObjectOf(Json properties) {
  return {{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
}

enum class TextureOf { Color, Number, Direction };
constexpr const char* kTextureDefinitions[] = {"texture", "textureOfNumber", "textureOfDirection"};

Json TextureSchema(TextureOf of) {
  const Json pair = {{"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", 2}, {"maxItems", 2}};
  Json object = ObjectOf({{"image", {{"type", "string"}, {"description", "a picture, relative to the material file"}}},
                          {"texCoord", {{"type", "integer"}, {"minimum", 0}, {"maximum", 65535}, {"default", 0}}},
                          {"offset", pair},
                          {"scale", pair},
                          {"rotation", {{"type", "number"}, {"description", "radians"}}},
                          {"wrap", {{"enum", {"repeat", "mirror", "clamp"}}}},
                          {"filter", {{"enum", {"nearest", "linear"}}}}});
  if (of == TextureOf::Number) object["properties"]["channel"] = {{"enum", {"r", "g", "b", "a"}}, {"default", "r"}};
  if (of == TextureOf::Direction) {
    object["properties"]["strength"] = {{"type", "number"}, {"description", "multiplies x and y"}, {"default", 1}};
  }
  object["required"] = {"image"};
  return {{"oneOf", {{{"type", "string"}}, {{"type", "null"}}, object}}};
}

Json EntryOf(const ModelDescription& model) {
  Json parameters = Json::object(), textures = Json::object();
  for (const ParameterDescription& parameter : model.parameters) {
    parameters[parameter.name] = SchemaOf(parameter);
    if (!parameter.textured) continue;
    const TextureOf of = parameter.initial.size() == 1   ? TextureOf::Number
                         : parameter.type == "direction" ? TextureOf::Direction
                                                         : TextureOf::Color;
    textures[parameter.name] = {{"$ref", std::string("#/$defs/") + kTextureDefinitions[static_cast<int>(of)]}};
  }
  Json entry = ObjectOf(
      {{"match",
        {{"description", "a material's name, with * and ?, or a list of such"},
         {"oneOf", {{{"type", "string"}}, {{"type", "array"}, {"items", {{"type", "string"}}}, {"minItems", 1}}}}}},
       {"model", {{"const", model.name}}},
       {"inherit", {{"type", "boolean"}, {"default", false}}},
       {"parameters", ObjectOf(std::move(parameters))},
       {"textures", ObjectOf(std::move(textures))},
       {"alphaMode", {{"enum", {"OPAQUE", "MASK", "BLEND"}}}},
       {"alphaCutoff", {{"type", "number"}, {"minimum", 0}}},
       {"doubleSided", {{"type", "boolean"}}}});
  if (model.model == ShadingModel::Enterprise) entry["properties"]["preset"] = {{"enum", kEnterprisePresets}};
  entry["required"] = {"match", "model"};
  return entry;
}

}  // namespace

std::string MaterialFileSchema() {
  Json entries = Json::array();
  for (const ModelDescription& model : DescribeModels()) entries.push_back(EntryOf(model));
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "facet material file"}};
  schema.update(ObjectOf({{"$schema", {{"type", "string"}}},
                          {"materials", {{"type", "array"}, {"items", {{"oneOf", std::move(entries)}}}}}}));
  schema["required"] = {"materials"};
  for (const TextureOf of : {TextureOf::Color, TextureOf::Number, TextureOf::Direction}) {
    schema["$defs"][kTextureDefinitions[static_cast<int>(of)]] = TextureSchema(of);
  }
  return schema.dump(2) + "\n";
}

}  // namespace facet
