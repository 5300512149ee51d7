#include "settings/render_request.h"

#include <algorithm>
#include <array>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "base/float_environment.h"
#include "base/input_file.h"
#include "base/memory_budget.h"
#include "base/printable.h"
#include "facet/error.h"
#include "facet/models.h"
#include "image/codec.h"
#include "light/environment_source.h"
#include "light/studio.h"
#include "material/model_parameters.h"
#include "material/models/models.h"

namespace facet {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;

constexpr std::string_view kOutput = "Output", kCamera = "Camera", kScene = "Scene", kLight = "Light",
                           kQuality = "Quality and speed";

using Text = std::string_view;

// Words separated by commas, or "none".
FeatureSet ParseFeatures(Text where, Text text) {
  std::vector<Text> words;
  for (const FeatureWord& known : kFeatureWords) words.push_back(known.word);
  FeatureSet features;
  for (const int i : ParseChoices(where, text, words)) features.Add(kFeatureWords[std::size_t(i)].feature);
  return features;
}

// A model that is not one of glTF's.
ShadingModel ParseOwnModel(Text where, Text text) {
  std::vector<Text> words;
  for (const ModelInfo& model : kModels) {
    if (HasParameters(model.model)) words.push_back(model.word);
  }
  const std::size_t first = kModels.size() - words.size();
  return kModels[first + std::size_t(ParseChoice(where, text, words))].model;
}

// The help of "without": the words in lines as wide as those of the other options.
struct FeatureHelp {
  std::array<char, 1024> text{};
  std::size_t size = 0;

  constexpr FeatureHelp() {
    constexpr std::size_t kLine = 50;
    Append("Features to disable, with commas between them:\n");
    std::size_t line = 0;
    for (const FeatureWord& known : kFeatureWords) {
      const bool is_last = known.feature == kFeatureWords.back().feature;
      const std::size_t with_comma = known.word.size() + (is_last ? 0 : 1);
      if (line > 0 && line + 1 + with_comma > kLine) Append("\n"), line = 0;
      if (line > 0) Append(" "), ++line;
      Append(known.word);
      if (!is_last) Append(",");
      line += with_comma;
    }
    Append(" [none]");
  }
  constexpr Text View() const { return {text.data(), size}; }

 private:
  constexpr void Append(Text words) {
    for (const char c : words) text.at(size++) = c;
  }
};
constexpr FeatureHelp kFeatureHelp;

constexpr std::array kOptions = {
    RequestOption{"size", kOutput, "WxH|N", "1024x1024", "Pixels, each side 1 to 16384; N is NxN [1024x1024]",
                  [](RenderRequest& r, Text where, Text text) {
                    const Size size = ParseSize(where, text);
                    r.settings.width = size.width;
                    r.settings.height = size.height;
                  }},
    RequestOption{"bits", kOutput, "8|16", "8", "Bits a channel of PNG and TIFF [8]",
                  [](RenderRequest& r, Text where, Text text) {
                    r.type = ParseChoice(where, text, {"8", "16"}) == 0 ? ChannelType::U8 : ChannelType::U16;
                  }},
    RequestOption{"exposure", kOutput, "EV", "0", "Multiply light by 2^EV, -64 to 64 [0]",
                  [](RenderRequest& r, Text where, Text text) {
                    r.display.exposure_ev = ParseNumber(where, text, {-64.0, 64.0});
                  }},
    RequestOption{"camera-exposure", kOutput, "N,SECONDS,ISO", "",
                  "Of a camera's f-number, shutter and sensitivity,\nsuch as 16,1/125,100 [none]",
                  [](RenderRequest& r, Text where, Text text) {
                    const auto [aperture, seconds, iso] = ParseCameraExposure(where, text);
                    r.display.camera = CameraExposure{aperture, seconds, iso};
                  }},
    RequestOption{"tonemap", kOutput, "CURVE", "neutral",
                  "none, reinhard, aces, agx, neutral, filmic,\ngeneric, gt7, agx-golden or agx-punchy [neutral]",
                  [](RenderRequest& r, Text where, Text text) {
                    r.display.tone_map =
                        static_cast<ToneMap>(ParseChoice(where, text, {kToneMapWords.begin(), kToneMapWords.end()}));
                  }},
    RequestOption{"transfer", kOutput, "CURVE", "srgb", "srgb, or gamma: a power of 1 / 2.2 [srgb]",
                  [](RenderRequest& r, Text where, Text text) {
                    r.display.transfer = static_cast<Transfer>(ParseChoice(where, text, {"srgb", "gamma"}));
                  }},
    RequestOption{"white-balance", kOutput, "TEMPERATURE,TINT", "",
                  "Turns the picture from blue to yellow, and from\ngreen to magenta, -1 to 1 each [0,0]",
                  [](RenderRequest& r, Text where, Text text) {
                    const std::vector<double> numbers = ParseNumbers(where, text, 2, {-1.0, 1.0});
                    r.display.grading.temperature = numbers[0], r.display.grading.tint = numbers[1];
                  }},
    RequestOption{"contrast", kOutput, "F", "1", "Around middle grey, 0 to 2 [1]",
                  [](RenderRequest& r, Text where, Text text) {
                    r.display.grading.contrast = ParseNumber(where, text, {0.0, 2.0});
                  }},
    RequestOption{"saturation", kOutput, "F", "1", "0 (grey) to 2 [1]",
                  [](RenderRequest& r, Text where, Text text) {
                    r.display.grading.saturation = ParseNumber(where, text, {0.0, 2.0});
                  }},
    RequestOption{"curves", kOutput, "GAMMA,MIDDLE,SCALE", "",
                  "A power below a middle, a slope above it, 0.01 to\n100 each [1,1,1]",
                  [](RenderRequest& r, Text where, Text text) {
                    const std::vector<double> numbers = ParseNumbers(where, text, 3, {0.01, 100.0});
                    r.display.grading.gamma = glm::dvec3(numbers[0]);
                    r.display.grading.middle = glm::dvec3(numbers[1]);
                    r.display.grading.scale = glm::dvec3(numbers[2]);
                  }},
    RequestOption{"background", kOutput, "WHAT", "transparent",
                  "#rgb, #rrggbb, a colour's name, transparent,\nor environment [transparent]",
                  [](RenderRequest& r, Text where, Text text) {
                    const std::string word = LowerCase(text);
                    r.settings.background = word == "environment" ? Background::Environment : Background::Transparent;
                    r.display.background_srgb.reset();
                    if (word != "environment" && word != "transparent") {
                      r.display.background_srgb = ParseColor(where, text);
                    }
                  }},

    RequestOption{"camera", kCamera, "NAME|INDEX", "", "A camera of the file [framed from the bounds]",
                  [](RenderRequest& r, Text, Text text) { r.camera = text; }},
    RequestOption{"orbit", kCamera, "THETA,PHI[,RADIUS]", "",
                  "Degrees about +Y, degrees from +Y, and distance\n[the distance that shows all from every side]",
                  [](RenderRequest& r, Text where, Text text) { r.orbit = ParseOrbit(where, text); }},
    RequestOption{"target", kCamera, "X,Y,Z", "", "What the orbit turns about [centre of the bounds]",
                  [](RenderRequest& r, Text where, Text text) { r.target = ParseVec3(where, text); }},
    RequestOption{"fov", kCamera, "DEG", "", "Vertical field of view, 1 to 179 [45]",
                  [](RenderRequest& r, Text where, Text text) {
                    r.fov_degrees = ParseNumber(where, text, {1.0, 179.0});
                  }},

    RequestOption{"scene", kScene, "NAME|INDEX", "", "A scene of the file [its default one]",
                  [](RenderRequest& r, Text, Text text) { r.scene = text; }},
    RequestOption{"animation", kScene, "NAME|INDEX", "",
                  "Pose by an animation [rest pose; the first one\nif --time is given]",
                  [](RenderRequest& r, Text, Text text) { r.animation = text; }},
    RequestOption{"time", kScene, "SECONDS", "", "Moment of the animation [0]",
                  [](RenderRequest& r, Text where, Text text) {
                    r.settings.time = ParseNumber(where, text, {0.0, 1e9});
                  }},
    RequestOption{"variant", kScene, "NAME|INDEX", "", "A material variant of the file [none]",
                  [](RenderRequest& r, Text, Text text) { r.variant = text; }},
    RequestOption{
        "model", kScene, "NAME", "",
        "Another shading model for its materials, with what\nthey state: lecture, filament or enterprise [their own]",
        [](RenderRequest& r, Text where, Text text) { r.model = ParseOwnModel(where, text); }},
    RequestOption{"materials", kScene, "FILE", "",
                  "Other shading models for its materials, as a JSON\nfile says (docs/material-files.md) [its own]",
                  [](RenderRequest& r, Text, Text text) { r.materials = text; }},
    RequestOption{"without", kScene, "LIST", "none", kFeatureHelp.View(),
                  [](RenderRequest& r, Text where, Text text) { r.settings.without = ParseFeatures(where, text); }},

    RequestOption{"environment", kLight, "FILE|none", "studio",
                  "Equirectangular picture that lights the scene\n[a built-in studio]",
                  [](RenderRequest& r, Text, Text text) {
                    using Kind = EnvironmentSettings::Kind;
                    r.environment.reset();
                    r.settings.environment.kind = text == "studio" ? Kind::Studio
                                                  : text == "none" ? Kind::None
                                                                   : Kind::Image;
                    if (r.settings.environment.kind == Kind::Image) r.environment = text;
                  }},
    RequestOption{"environment-rotation", kLight, "DEG", "0", "Counter-clockwise seen from above [0]",
                  [](RenderRequest& r, Text where, Text text) {
                    r.settings.environment.rotation = ParseNumber(where, text, {-36000.0, 36000.0}) * kRadiansPerDegree;
                  }},
    RequestOption{"environment-intensity", kLight, "F", "1", "Factor of its light, 0 to 1e6 [1]",
                  [](RenderRequest& r, Text where, Text text) {
                    r.settings.environment.intensity = ParseNumber(where, text, {0.0, 1e6});
                  }},

    RequestOption{"samples", kQuality, "1|2|4|8", "4", "Coverage samples a pixel [4]",
                  [](RenderRequest& r, Text where, Text text) {
                    r.settings.samples = 1 << ParseChoice(where, text, {"1", "2", "4", "8"});
                  },
                  "1 2 4 8"},
    RequestOption{
        "max-anisotropy", kQuality, "N", "8", "Texture samples along a stretched footprint,\n1 to 16 [8]",
        [](RenderRequest& r, Text where, Text text) { r.settings.max_anisotropy = ParseInteger(where, text, 1, 16); },
        "1 2 4 8 16"},
    RequestOption{
        "mip-filter", kQuality, "WHICH", "linear", "The most between mip levels: none, nearest or\nlinear [linear]",
        [](RenderRequest& r, Text where, Text text) {
          r.settings.mip_filter = static_cast<MipFilter>(ParseChoice(where, text, {"none", "nearest", "linear"}));
        },
        "none nearest linear"},
    RequestOption{"texels", kQuality, "BITS", "mixed",
                  "Bits a channel that textures are kept with: 8, 16\nor mixed, 16 for colours [mixed]",
                  [](RenderRequest& r, Text where, Text text) {
                    r.settings.texels = static_cast<TexelBits>(ParseChoice(where, text, {"mixed", "8", "16"}));
                  },
                  "8 mixed 16"},
    RequestOption{"tangents", kQuality, "WHOSE", "file", "file, or generated also where it has some [file]",
                  [](RenderRequest& r, Text where, Text text) {
                    r.settings.tangents = static_cast<TangentSource>(ParseChoice(where, text, {"file", "generated"}));
                  },
                  "file generated"},
    RequestOption{"environment-size", kQuality, "N", "1024",
                  "Most texels along the environment's sharpest map,\n64, 128, 256, 512 or 1024 [1024]",
                  [](RenderRequest& r, Text where, Text text) {
                    r.settings.environment_size = 64 << ParseChoice(where, text, {"64", "128", "256", "512", "1024"});
                  },
                  "64 128 256 512 1024"},
    RequestOption{"environment-samples", kQuality, "N", "24", "Of its narrowest lobe, 6 to 768 [24]",
                  [](RenderRequest& r, Text where, Text text) {
                    r.settings.environment_samples = ParseInteger(where, text, 6, 768);
                  },
                  "6 12 24 48 96 192"},
    RequestOption{
        "irradiance", kQuality, "METHOD", "convolution", "convolution, or harmonics of degree 2 [convolution]",
        [](RenderRequest& r, Text where, Text text) {
          r.settings.irradiance = static_cast<IrradianceMethod>(ParseChoice(where, text, {"convolution", "harmonics"}));
        },
        "harmonics convolution"},
    RequestOption{"specular-antialiasing", kQuality, "on|off", "on",
                  "Widens reflections where the normal turns within\na pixel [on]",
                  [](RenderRequest& r, Text where, Text text) {
                    r.settings.specular_antialiasing = ParseChoice(where, text, {"off", "on"}) == 1;
                  },
                  "off on"},
};

template <class T>
std::vector<std::string> Names(const std::vector<T>& things) {
  std::vector<std::string> names;
  names.reserve(things.size());
  for (const T& thing : things) names.push_back(thing.name);
  return names;
}

CameraChoice PlacedCamera(const RenderRequest& request, const Scene& scene) {
  if (request.camera) {
    return SceneCamera{Choose("--camera", "camera", *request.camera, Names(scene.cameras))};
  }
  std::optional<double> yfov;
  if (request.fov_degrees) yfov = *request.fov_degrees * kRadiansPerDegree;
  if (!request.orbit && !request.target) return AutoCamera{yfov};
  OrbitCamera orbit;
  if (request.orbit) {
    orbit.theta = request.orbit->theta_degrees * kRadiansPerDegree;
    orbit.phi = request.orbit->phi_degrees * kRadiansPerDegree;
    orbit.radius = request.orbit->radius;
  }
  orbit.target = request.target;
  orbit.yfov = yfov;
  return orbit;
}

}  // namespace

std::span<const RequestOption> RequestOptions() { return kOptions; }

void SetOption(RenderRequest& request, std::string_view name, std::string_view where, std::string_view text) {
  for (const RequestOption& option : kOptions) {
    if (option.name != name) continue;
    option.read(request, where, text);
    request.given[std::string(name)] = text;
    return;
  }
  std::string list;
  for (const RequestOption& option : kOptions) list += (list.empty() ? "" : ", ") + std::string(option.name);
  throw Error(ErrorCode::InvalidUsage, "there is no setting " + Quoted(name), std::string(where), "use one of " + list);
}

std::map<std::string, std::string> SpelledOut(const RenderRequest& request) {
  std::map<std::string, std::string> all;
  for (const RequestOption& option : kOptions) {
    if (!option.initial.empty()) all[std::string(option.name)] = option.initial;
  }
  for (const auto& [name, text] : request.given) all[name] = text;
  if (request.environment) all["environment"] = request.environment->filename().string();
  if (request.materials) all["materials"] = request.materials->filename().string();
  return all;
}

void RefuseContradictions(const RenderRequest& request) {
  for (const char* other : {"orbit", "target", "fov"}) {
    if (!request.camera || !request.Given(other)) continue;
    throw Error(ErrorCode::InvalidUsage, std::string("--camera cannot go together with --") + other, {},
                "leave one of them out");
  }
  if (request.settings.background == Background::Environment &&
      request.settings.environment.kind == EnvironmentSettings::Kind::None) {
    throw Error(ErrorCode::InvalidUsage, "there is no environment to show", "--background environment",
                "drop --environment none, or choose a colour");
  }
}

namespace {

// The path of an option's file, which a user or a file names.
std::filesystem::path PathOf(const std::filesystem::path& name, const NamedBy& named_by, const char* option) {
  try {
    return named_by.file.empty() ? name : DataPath(named_by.file, name, named_by.root);
  } catch (const Error& error) {
    throw Error(error.code(), error.message(), option, error.hint());
  }
}

}  // namespace

void ApplyMaterials(const RenderRequest& request, LoadedScene& loaded, const LoadOptions& options,
                    const NamedBy& named_by) {
  if (request.materials) {
    const LoadReport read =
        ApplyMaterialFile(loaded.scene, PathOf(*request.materials, named_by, "--materials"), options);
    loaded.report.file_bytes += read.file_bytes;
    loaded.report.warnings.insert(loaded.report.warnings.end(), read.warnings.begin(), read.warnings.end());
    loaded.report.files.insert(loaded.report.files.end(), read.files.begin(), read.files.end());
  }
  // What the file says of a material counts, and inherits from the scene.
  if (!request.model) return;
  for (const std::string& sentence : ConvertMaterials(loaded.scene, *request.model)) {
    loaded.report.warnings.push_back("--model: " + sentence);
  }
}

RenderSettings ResolveRequest(const RenderRequest& request, const Scene& scene, const NamedBy& named_by,
                              const std::filesystem::path& cache) {
  RenderSettings settings = request.settings;
  if (request.scene) settings.scene = Choose("--scene", "scene", *request.scene, Names(scene.scenes));
  settings.camera = PlacedCamera(request, scene);
  if (request.animation || request.Given("time")) {
    settings.animation = Choose(request.animation ? "--animation" : "--time", "animation",
                                request.animation.value_or("0"), Names(scene.animations));
  }
  if (request.variant) settings.variant = Choose("--variant", "variant", *request.variant, scene.variants);
  if (request.environment) {
    const bool by_user = named_by.file.empty();
    const std::filesystem::path path = PathOf(*request.environment, named_by, "--environment");
    if (!cache.empty()) {
      settings.environment.source = OpenEnvironment(path, cache);
    } else {
      MemoryBudget budget(settings.memory_limit);
      const MemoryBudget::Scope scope(budget);
      const FloatEnvironment pinned;
      const Bytes file = ReadFile(path, {.regular_only = !by_user});
      settings.environment.image = std::make_shared<const Image>(DecodeImage(file.Span(), path.string()));
    }
  }
  return settings;
}

RenderInputs LoadInputs(const std::filesystem::path& scene, const RenderRequest& request, const LoadOptions& options,
                        const NamedBy& named_by) {
  RefuseContradictions(request);
  RenderInputs inputs{LoadGltf(scene, options), {}};
  ApplyMaterials(request, inputs.loaded, options, named_by);
  RenderRequest limited = request;
  limited.settings.memory_limit = options.memory_limit;
  inputs.settings = ResolveRequest(limited, inputs.loaded.scene, named_by);
  return inputs;
}

std::optional<Digest> HashEnvironment(const EnvironmentSettings& environment) {
  switch (environment.kind) {
    case EnvironmentSettings::Kind::None: return std::nullopt;
    case EnvironmentSettings::Kind::Studio: return HashImage(StudioImage(kStudioWidth, kStudioHeight));
    case EnvironmentSettings::Kind::Image: break;
  }
  return HashImage(*ImageOf(environment));
}

}  // namespace facet
