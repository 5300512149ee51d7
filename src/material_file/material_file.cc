// ApplyMaterialFile() of facet/load.h: materials of a scene get other shading models (docs/material-files.md).
#include "material_file/material_file.h"

#include <fnmatch.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/input_file.h"
#include "base/json_bounds.h"
#include "base/memory_budget.h"
#include "base/number_text.h"
#include "base/printable.h"
#include "facet/load.h"
#include "facet/models.h"
#include "gltf/pictures.h"
#include "gltf/strict_json.h"
#include "gltf/warnings.h"
#include "material/from_gltf.h"
#include "material/model_parameters.h"
#include "material/models/models.h"
#include "math/round_to_float.h"
#include "scene/missing_sets.h"

namespace facet {
namespace {

// --- Values ---------------------------------------------------------------------------------------------------------

std::string InWords(ParameterRange range) {
  const std::string low = ShortNumber(double{range.low}), high = ShortNumber(double{range.high});
  std::string text =
      std::isinf(range.high) ? (std::isinf(range.low) ? "any number" : low + " or more") : low + " to " + high;
  if (!std::isnan(range.exception)) text += ", or " + ShortNumber(double{range.exception});
  return text;
}

void ReadValue(const JsonValue& value, const RowOptions& options, float& out) {
  const double number = value.Expect(value.json.is_number(), "number").json.get<double>();
  out = RoundToFiniteFloat(number);
  if (std::abs(number) > double{std::numeric_limits<float>::max()}) value.Fail("is too large for a number of 32 bits");
  const ParameterRange& range = options.range;
  if (out != range.exception && !(number >= double{range.low} && number <= double{range.high})) {
    value.Fail(ShortNumber(number) + " is out of range", InWords(range));
  }
}

template <int kLength>
void ReadValue(const JsonValue& value, const RowOptions& options, glm::vec<kLength, float>& out) {
  const std::size_t size = value.Expect(value.json.is_array(), "list of numbers").json.size();
  const std::size_t least = kLength == 4 ? 3 : std::size_t{kLength};
  if (size < least || size > std::size_t{kLength}) {
    value.Fail("has " + std::to_string(size) + " numbers", kLength == 4 ? "give 3 or 4" : "give 3");
  }
  int exceptions = 0;
  for (std::size_t c = 0; c < size; ++c) {
    float& number = out[static_cast<int>(c)];
    ReadValue({value.json[c], value.pointer / c, value.file}, options, number);
    exceptions += number == options.range.exception ? 1 : 0;
  }
  if (exceptions != 0 && exceptions != static_cast<int>(size)) {
    value.Fail("mixes " + ShortNumber(double{options.range.exception}) + " with other numbers",
               "give one or the other");
  }
}

void ReadValue(const JsonValue& value, const RowOptions&, bool& out) {
  out = value.Expect(value.json.is_boolean(), "true or false").json.get<bool>();
}

template <class Value>
requires std::is_enum_v<Value>
void ReadValue(const JsonValue& value, const RowOptions& options, Value& out) {
  const auto place = std::ranges::find(options.words, value.Text());
  if (place == options.words.end()) {
    value.Fail(Quoted(value.Text()) + " is unknown",
               "use one of " + Joined({options.words.begin(), options.words.end()}));
  }
  out = static_cast<Value>(place - options.words.begin());
}

template <class Value>
requires kHasTexture<Value>
void ReadValue(const JsonValue& value, const RowOptions& options, Value& out) { ReadValue(value, options, out.value); }

// What a parameter is where only its texture is given: nothing is taken away from it.
void MakeNeutral(float& value) { value = 1.0f; }
void MakeNeutral(glm::vec3& value) { value = glm::vec3(1.0f); }
void MakeNeutral(glm::vec4& value) { value = glm::vec4(1.0f); }

// Refuses names that are no parameters of the model. `textures`: may be null.
template <class Block>
void RefuseUnknown(const JsonValue& parameters, const JsonValue* textures) {
  std::vector<const char*> all, textured;
  ForEachRow(std::type_identity<Block>(), [&]<class Value>(const ModelParameter<Block, Value>& parameter) {
    all.push_back(parameter.name);
    if (kHasTexture<Value>) textured.push_back(parameter.name);
  });
  parameters.ExpectObject(all);
  if (textures != nullptr) textures->ExpectObject(textured);
}

// --- The file -------------------------------------------------------------------------------------------------------

class MaterialFile {
 public:
  MaterialFile(Scene& scene, const std::filesystem::path& path, const LoadOptions& options, LoadReport& report)
      : scene_(scene),
        path_(path),
        name_(Printable(path.string())),
        root_(options.root),
        report_(report),
        materials_(scene.materials),
        images_(scene.images),
        textures_(scene.textures) {}

  void Apply() {
    const Bytes bytes = ReadFile(path_, {.regular_only = true});  // a name may come from data
    const std::string text(bytes.Text());
    const MemoryLease lease(JsonMemory(text), 2, "JSON", name_);
    const StrictJson json = ParseStrictJson(text, name_);
    report_.file_bytes = bytes.size;
    report_.files.push_back(path_);

    const JsonValue root{json, StrictJson::json_pointer(), name_};
    root.ExpectObject(std::array{"$schema", "materials"});
    if (root.Has("$schema")) root["$schema"].Expect(root["$schema"].json.is_string(), "string");
    if (!root.Has("materials")) root.Fail("has no list \"materials\"");
    const JsonValue entries = root["materials"];
    entries.Expect(entries.json.is_array(), "list");
    for (std::size_t i = 0; i < entries.json.size(); ++i) {
      ReadEntry({entries.json[i], entries.pointer / i, name_});
    }
    Commit();
  }

 private:
  struct Change {
    std::string place;  // of the entry: its JSON pointer
    std::string loss;
  };

  // Nothing in the scene changes before all of the file has been read.
  void Commit() {
    UseDefaultMaterial(scene_, default_material_);
    scene_.materials = std::move(materials_);
    scene_.images = std::move(images_);
    scene_.textures = std::move(textures_);
    for (const auto& [index, change] : changes_) {
      if (!change.loss.empty()) warnings_.Add(change.place, change.loss);
    }
    for (const Mesh& mesh : scene_.meshes) {
      for (const Primitive& primitive : mesh.primitives) {
        const auto change = changes_.find(std::size_t(primitive.material));
        if (change != changes_.end()) WarnOfMissingSets(mesh, primitive, change->second.place);
      }
    }
    for (const std::string& line : warnings_.Lines()) report_.warnings.push_back(name_ + ": " + line);
  }

  // `place`: of the entry that changed the primitive's material.
  void WarnOfMissingSets(const Mesh& mesh, const Primitive& primitive, const std::string& place) {
    const Material& material = scene_.materials[std::size_t(primitive.material)];
    ForEachMissingSet(primitive, material, [&](const SlotInfo& slot, std::size_t set) {
      warnings_.Add(place, "mesh " + Quoted(mesh.name) + " has no TEXCOORD_" + std::to_string(set) + ", by which " +
                               slot.name + " is read; its texel at 0, 0 is used everywhere");
    });
  }

  void ReadEntry(const JsonValue& entry) {
    entry.ExpectObject(std::array{"match", "model", "preset", "inherit", "parameters", "textures", "alphaMode",
                                  "alphaCutoff", "doubleSided"});
    for (const char* key : {"match", "model"}) {
      if (!entry.Has(key)) entry.Fail(std::string("has no \"") + key + "\"");
    }
    const ShadingModel model = ReadModel(entry["model"]);
    bool inherits = false;
    if (entry.Has("inherit")) ReadValue(entry["inherit"], {}, inherits);
    if (inherits && entry.Has("preset")) entry["preset"].Fail("cannot go together with \"inherit\"");
    Material changes =
        ReadChanges(entry, model, entry.Has("preset") ? ReadPreset(entry["preset"], model) : DefaultsOf(model));
    WarnOfIgnored(*changes.parameters, entry);
    for (const std::size_t index : Matching(entry["match"])) {
      static const Material plain;
      const Material& of_scene = index < scene_.materials.size() ? scene_.materials[index] : plain;
      Change& change =
          changes_[index] = {Printable(entry.pointer.to_string()), {}};  // of several entries the last counts
      if (inherits) changes = ReadChanges(entry, model, Inherited(of_scene, model, change.loss));
      Material& material = materials_[index] = changes;
      material.name = of_scene.name;
      if (!states_alpha_mode_) material.alpha_mode = of_scene.alpha_mode;
      if (!entry.Has("alphaCutoff")) material.alpha_cutoff = of_scene.alpha_cutoff;
      if (!entry.Has("doubleSided")) material.double_sided = of_scene.double_sided;
    }
  }

  // A material of these parameters, with what the entry says.
  Material ReadChanges(const JsonValue& entry, ShadingModel model, ModelParameters parameters) {
    Material changes;
    changes.model = model;
    std::visit([&](auto& block) { ReadBlock(entry, block, changes); }, parameters);
    changes.parameters = std::make_shared<const ModelParameters>(std::move(parameters));
    ReadCommon(entry, changes);
    return changes;
  }

  // What a material of the scene states, in the model's parameters. `loss`: a sentence about what is not inherited.
  static ModelParameters Inherited(const Material& of_scene, ShadingModel model, std::string& loss) {
    if (of_scene.model == model && of_scene.parameters != nullptr) return *of_scene.parameters;
    const std::string where = "material " + Quoted(of_scene.name);
    if (of_scene.parameters != nullptr) {
      loss = where + " is of another model, so nothing is inherited";
      return DefaultsOf(model);
    }
    FromGltf converted = ConvertFromGltf(of_scene, model);
    if (!converted.lost.empty()) loss = where + ": " + SentenceOf(converted.lost, model);
    return std::move(converted.parameters);
  }

  static ShadingModel ReadModel(const JsonValue& value) {
    std::vector<std::string> words;
    for (const ModelInfo& model : kModels) {
      if (!HasParameters(model.model)) continue;
      if (value.Text() == model.word) return model.model;
      words.emplace_back(model.word);
    }
    value.Fail("there is no model " + Quoted(value.Text()), "use one of " + Joined(words));
  }

  static ModelParameters ReadPreset(const JsonValue& value, ShadingModel model) {
    std::vector<std::string> words;
    if (model != ShadingModel::Enterprise) value.Fail("the model has no presets");
    for (const std::string_view preset : kEnterprisePresets) {
      if (value.Text() == preset) return EnterprisePreset(preset);
      words.emplace_back(preset);
    }
    value.Fail("there is no preset " + Quoted(value.Text()), "use one of " + Joined(words));
  }

  // The materials of the scene that the pattern stands for, or each of a list of patterns.
  std::vector<std::size_t> Matching(const JsonValue& match) {
    std::vector<std::size_t> found;
    if (!match.json.is_array()) {
      AddMatching(match, found);
    } else {
      if (match.json.empty()) match.Fail("is empty", "give a name or a pattern");
      for (std::size_t i = 0; i < match.json.size(); ++i) {
        AddMatching({match.json[i], match.pointer / i, name_}, found);
      }
    }
    return found;
  }

  void AddMatching(const JsonValue& pattern, std::vector<std::size_t>& found) {
    const std::string& text = pattern.Text();
    const auto matches = [&](const std::string& name) { return fnmatch(text.c_str(), name.c_str(), 0) == 0; };
    if (matches("")) AddDefaultMaterial(scene_, materials_, default_material_);
    const std::size_t before = found.size();
    for (std::size_t i = 0; i < materials_.size(); ++i) {
      if (matches(materials_[i].name)) found.push_back(i);
    }
    if (found.size() != before) return;
    constexpr std::size_t kMostNamed = 12;
    constexpr std::size_t kLongest = 60;
    std::vector<std::string> names;
    for (const Material& material : materials_) {
      if (names.size() == kMostNamed) break;
      const std::string& name = material.name;
      names.push_back(Quoted(name.size() <= kLongest ? name : name.substr(0, kLongest) + "..."));
    }
    if (names.size() < materials_.size()) names.emplace_back("...");
    pattern.Fail("no material's name matches " + Quoted(text),
                 names.empty() ? "the scene has no materials" : "the scene has " + Joined(names));
  }

  template <class Block>
  void ReadBlock(const JsonValue& entry, Block& block, Material& changes) {
    const StrictJson none = StrictJson::object();
    const auto member = [&](const char* key) {
      return entry.Has(key) ? entry[key] : JsonValue{none, entry.pointer / key, name_};
    };
    const JsonValue parameters = member("parameters"), textures = member("textures");
    RefuseUnknown<Block>(parameters, &textures);
    states_alpha_mode_ = states_blending_ = false;
    ForEachParameterOf(block, [&]<class Value>(const auto& parameter, Value& value) {
      const bool has_value = parameters.Has(parameter.name);
      if (has_value) ReadValue(parameters[parameter.name], parameter, value);
      bool has_texture = false;
      if constexpr (kHasTexture<Value>) {
        has_texture = textures.Has(parameter.name) && !textures[parameter.name].json.is_null();
        if (textures.Has(parameter.name) && !has_texture) value.texture = {};
        if (has_texture) {
          ReadTexture(textures[parameter.name], value);
          if constexpr (!std::is_same_v<Value, TangentSpaceNormal>) {
            if (!has_value) MakeNeutral(value.value);
          }
        }
      }
      if (parameter.is_coverage && (has_value || has_texture)) {
        changes.alpha_mode = AlphaMode::Blend;
        states_alpha_mode_ = true;
      }
    });
    if (const std::optional<AlphaMode> mode = AlphaModeOf(block)) {
      changes.alpha_mode = *mode;
      states_alpha_mode_ = states_blending_ = true;
    }
  }

  void WarnOfIgnored(const ModelParameters& parameters, const JsonValue& entry) {
    const auto* const enterprise = std::get_if<EnterpriseParameters>(&parameters);
    if (enterprise == nullptr || enterprise->displacement == glm::vec3(0.0f)) return;
    warnings_.Add(Printable(entry.pointer.to_string()), "displacement is not drawn");
  }

  void ReadCommon(const JsonValue& entry, Material& changes) {
    if (entry.Has("alphaMode")) {
      if (states_blending_) entry["alphaMode"].Fail("cannot go together with the parameter \"blending\"");
      static constexpr std::array kWords = {"OPAQUE", "MASK", "BLEND"};
      ReadValue(entry["alphaMode"], {.words = kWords}, changes.alpha_mode);
      states_alpha_mode_ = true;
    }
    if (entry.Has("alphaCutoff")) ReadValue(entry["alphaCutoff"], {.range = kNotNegative}, changes.alpha_cutoff);
    if (entry.Has("doubleSided")) ReadValue(entry["doubleSided"], {}, changes.double_sided);
  }

  // --- Textures -----------------------------------------------------------------------------------------------------

  template <class Value>
  void ReadTexture(const JsonValue& texture, Value& value) {
    value.texture = {};  // nothing of an inherited one stays
    if constexpr (requires { value.scale; }) value.scale = 1.0f;
    if constexpr (requires { value.channel; }) value.channel = 0;
    if (texture.json.is_string()) {
      value.texture.texture = TextureFor(texture, {});
      return;
    }
    std::vector<const char*> keys = {"image", "texCoord", "offset", "scale", "rotation", "wrap", "filter"};
    constexpr bool kIsNumber = std::is_same_v<Value, Textured<float>>;
    constexpr bool kIsNormal = std::is_same_v<Value, TangentSpaceNormal>;
    if (kIsNumber) keys.push_back("channel");
    if (kIsNormal) keys.push_back("strength");
    texture.ExpectObject(keys);
    if (!texture.Has("image")) texture.Fail("has no \"image\"");
    TextureRef& ref = value.texture;
    ref.texture = TextureFor(texture["image"], ReadSampler(texture));
    if (texture.Has("texCoord")) {
      float set = 0.0f;
      ReadValue(texture["texCoord"], {.range = {0.0f, 65535.0f}}, set);
      if (set != std::floor(set)) texture["texCoord"].Fail("is no UV set", "0 or more");
      ref.tex_coord = static_cast<int>(set);
    }
    if (texture.Has("offset")) ReadPair(texture["offset"], ref.offset);
    if (texture.Has("scale")) ReadPair(texture["scale"], ref.scale);
    if (texture.Has("rotation")) ReadValue(texture["rotation"], {.range = kAnyNumber}, ref.rotation);
    if constexpr (kIsNumber) {
      static constexpr std::array kWords = {"r", "g", "b", "a"};
      enum class Channel : std::int8_t { R, G, B, A } channel{};
      if (texture.Has("channel")) ReadValue(texture["channel"], {.words = kWords}, channel);
      value.channel = static_cast<std::int8_t>(channel);
    }
    if constexpr (kIsNormal) {
      if (texture.Has("strength")) ReadValue(texture["strength"], {.range = kAnyNumber}, value.scale);
    }
  }

  static void ReadPair(const JsonValue& value, glm::vec2& out) {
    if (!value.json.is_array() || value.json.size() != 2) value.Fail("is no pair of numbers");
    for (int c = 0; c < 2; ++c) {
      ReadValue({value.json[std::size_t(c)], value.pointer / std::size_t(c), value.file}, {.range = kAnyNumber},
                out[c]);
    }
  }

  static Sampler ReadSampler(const JsonValue& texture) {
    Sampler sampler;
    if (texture.Has("wrap")) {
      static constexpr std::array kWords = {"repeat", "mirror", "clamp"};
      ReadValue(texture["wrap"], {.words = kWords}, sampler.wrap_u);
      sampler.wrap_v = sampler.wrap_u;
    }
    if (texture.Has("filter")) {
      static constexpr std::array kWords = {"nearest", "linear"};
      ReadValue(texture["filter"], {.words = kWords}, sampler.magnification);
      sampler.minification = sampler.magnification;
    }
    return sampler;
  }

  int TextureFor(const JsonValue& picture, const Sampler& sampler) {
    const std::string place = picture.pointer.to_string();
    if (const auto read = texture_of_place_.find(place); read != texture_of_place_.end()) return read->second;
    std::filesystem::path path;
    try {
      path = DataPath(path_, picture.Text(), root_);
    } catch (const Error& error) {
      picture.Fail(error.message(), error.hint());
    }
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) picture.Fail("there is no file " + Quoted(path.string()));
    const auto [known, is_new] = image_of_path_.try_emplace(path.string(), static_cast<int>(images_.size()));
    if (is_new) {
      images_.push_back({path.filename().string(), gltf::OpenPicture(path)});
      report_.files.push_back(path);
    }
    textures_.push_back({path.filename().string(), known->second, sampler});
    return texture_of_place_[place] = static_cast<int>(textures_.size()) - 1;
  }

  Scene& scene_;
  const std::filesystem::path& path_;
  const std::string name_;
  const std::filesystem::path root_;
  LoadReport& report_;
  gltf::Warnings warnings_;
  std::vector<Material> materials_;
  std::vector<SceneImage> images_;
  std::vector<Texture> textures_;
  std::map<std::string, int> image_of_path_, texture_of_place_;
  std::map<std::size_t, Change> changes_;  // by material
  int default_material_ = -1;       // of primitives without one; -1: they are left without
  bool states_alpha_mode_ = false, states_blending_ = false;  // of the entry that is being read
};

}  // namespace

void StateParameters(const std::string& json, const std::string& name, ModelParameters& parameters) {
  const StrictJson parsed = ParseStrictJson(json, name);
  const JsonValue values{parsed, StrictJson::json_pointer(), name};
  std::visit(
      [&]<class Block>(Block& block) {
        RefuseUnknown<Block>(values, nullptr);
        ForEachParameterOf(block, [&](const auto& parameter, auto& value) {
          if (values.Has(parameter.name)) ReadValue(values[parameter.name], parameter, value);
        });
      },
      parameters);
}

LoadReport ApplyMaterialFile(Scene& scene, const std::filesystem::path& file, const LoadOptions& options) {
  MemoryBudget budget(options.memory_limit);
  const MemoryBudget::Scope scope(budget);
  LoadReport report;
  MaterialFile(scene, file, options, report).Apply();
  return report;
}

}  // namespace facet
