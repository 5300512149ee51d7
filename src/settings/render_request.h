// What a picture is made with, in words: the options that decide over its bits. The command line, manifests and the
// text inside PNG files share them, so that each is written once and read by the same code.
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
  RenderSettings settings;  // less what LoadInputs() resolves with the files at hand
  DisplaySettings display;
  ChannelType type = ChannelType::U8;                            // of the developed picture
  std::optional<std::string> scene, camera, animation, variant;  // names or indices
  std::optional<Orbit> orbit;
  std::optional<glm::dvec3> target;
  std::optional<double> fov_degrees;
  std::optional<std::filesystem::path> environment;       // a picture; none: settings.environment.kind says which
  std::map<std::string, std::string, std::less<>> given;  // option name -> text, as given

  bool Given(std::string_view option) const { return given.find(option) != given.end(); }
};

struct RequestOption {
  std::string_view name;     // without dashes
  std::string_view group;    // of the help page
  std::string_view value;    // what stands for the value there
  std::string_view initial;  // the text that means the default; empty: the option's absence means something of its own
  std::string_view description;
  // `where`: what a message calls the option. Throws Error(InvalidUsage).
  void (*read)(RenderRequest& request, std::string_view where, std::string_view text);
  // An approximation's values that are worth trying, from cheap to exact, separated by spaces; empty: it is none.
  std::string_view sweep = {};
};

// What the option "without" calls a feature.
struct FeatureWord {
  Feature feature;
  std::string_view word;
};
std::span<const FeatureWord, kFeatureCount> FeatureWords();

// In the order of the help page.
std::span<const RequestOption> RequestOptions();

// Sets an option by its name. Throws Error(InvalidUsage): a bad value (`where` names it), or no such option.
void SetOption(RenderRequest& request, std::string_view name, std::string_view where, std::string_view text);

// Every option of a request, defaults spelled out: what makes the same picture with another version's defaults.
// Environment pictures are named without their folders.
std::map<std::string, std::string> SpelledOut(const RenderRequest& request);

// Throws Error(InvalidUsage) for options that contradict each other.
void RefuseContradictions(const RenderRequest& request);

// Where the name of the environment's image comes from. Empty: from a user. Else a file that names it, relative to its
// folder, and within that folder or `root` (see DataPath() of base/input_file.h).
struct NamedBy {
  std::filesystem::path file, root;
};

// The settings for a scene: names become indices, and the environment's image is loaded, or opened where there is a
// `cache` for what is prepared from it.
// Throws Error: InvalidUsage for names that the scene does not have; what LoadImage throws.
RenderSettings ResolveRequest(const RenderRequest& request, const Scene& scene, const NamedBy& named_by = {},
                              const std::filesystem::path& cache = {});

// A scene and its settings, ready for Render().
struct RenderInputs {
  LoadedScene loaded;
  RenderSettings settings;
};

// All of the above at once; options.memory_limit is the rendering's too. Throws what LoadGltf and they throw.
RenderInputs LoadInputs(const std::filesystem::path& scene, const RenderRequest& request,
                        const LoadOptions& options = {}, const NamedBy& named_by = {});

// The environment's picture as it is decoded, or drawn (the studio); none where there is no environment.
std::optional<Digest> HashEnvironment(const EnvironmentSettings& environment);

}  // namespace facet
