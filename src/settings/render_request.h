// The options that determine the bits of an image, as text. The command line, manifests and the text in PNG files share
// them, so that each option is defined once and parsed by the same code.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "facet/digest.h"
#include "facet/film.h"
#include "facet/load.h"
#include "facet/settings.h"
#include "settings/parse.h"

namespace facet {

struct RenderRequest {
  RenderSettings settings;  // without what LoadInputs() resolves from files
  DisplaySettings display;
  ChannelType type = ChannelType::U8;                            // of the encoded image
  std::optional<std::string> scene, camera, animation, variant;  // names or indices
  std::optional<Orbit> orbit;
  std::optional<glm::dvec3> target;
  std::optional<double> fov_degrees;
  std::optional<ShadingModel> model;                      // of all materials; not one of glTF's
  std::optional<std::filesystem::path> materials;         // a material file
  std::optional<std::filesystem::path> environment;       // an image file; none: see settings.environment.kind
  std::map<std::string, std::string, std::less<>> given;  // option name -> text, as given

  bool Given(std::string_view option) const { return given.find(option) != given.end(); }
};

struct RequestOption {
  std::string_view name;     // without dashes
  std::string_view group;    // of the help page
  std::string_view value;    // placeholder of the value there
  std::string_view initial;  // the text of the default; empty: it has no text
  std::string_view description;
  // `where`: the option's name in messages. Throws Error(InvalidUsage).
  void (*read)(RenderRequest& request, std::string_view where, std::string_view text);
  // For approximations the values worth trying, from cheap to exact, separated by spaces; empty for other options.
  std::string_view sweep = {};
};

// In the order of the help page.
std::span<const RequestOption> RequestOptions();

// Sets an option by its name. Throws Error(InvalidUsage): a bad value (`where` names it), or no such option.
void SetOption(RenderRequest& request, std::string_view name, std::string_view where, std::string_view text);

// All options of a request with defaults spelled out, which give the same image if another version has other defaults.
// Environment images are named without their folders.
std::map<std::string, std::string> SpelledOut(const RenderRequest& request);

// Throws Error(InvalidUsage) for options that contradict each other.
void RefuseContradictions(const RenderRequest& request);

// The origin of the names of the environment's image and of the material file. Empty: a user. Otherwise a file that
// names it, relative to the file's folder and within that folder or `root` (see DataPath() of base/input_file.h).
struct NamedBy {
  std::filesystem::path file, root;
};

// Gives the scene's materials the request's model and those of its material file, as far as it has these, and adds to
// the report what was read and what was lost. Throws what ApplyMaterialFile() throws.
void ApplyMaterials(const RenderRequest& request, LoadedScene& loaded, const LoadOptions& options = {},
                    const NamedBy& named_by = {});

// Resolves the settings for a scene: names become indices, and the environment's image is loaded, or, if there is a
// `cache` of prefiltered environments, only opened. Throws Error: InvalidUsage for names that the scene does not have;
// what LoadImage throws.
RenderSettings ResolveRequest(const RenderRequest& request, const Scene& scene, const NamedBy& named_by = {},
                              const std::filesystem::path& cache = {});

// A scene and its settings, ready for Render().
struct RenderInputs {
  LoadedScene loaded;
  RenderSettings settings;
};

// Loads the scene and resolves its settings. options.memory_limit also applies to rendering. Throws what LoadGltf() and
// the functions above throw.
RenderInputs LoadInputs(const std::filesystem::path& scene, const RenderRequest& request,
                        const LoadOptions& options = {}, const NamedBy& named_by = {});

// The digest of the environment's image, decoded or computed (the studio); none if there is no environment.
std::optional<Digest> HashEnvironment(const EnvironmentSettings& environment);

}  // namespace facet
