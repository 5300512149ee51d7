// The command line as values.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>

#include "facet/film.h"
#include "facet/load.h"
#include "facet/render.h"

namespace facet::cli {

// `facet render`. What can only be resolved with the file at hand (names of cameras and the like) stays text.
struct RenderOptions {
  std::filesystem::path input, output;
  RenderSettings settings;
  DisplaySettings display;
  LoadOptions load;
  ChannelType type = ChannelType::U8;  // the file's; F32 follows from the output's extension
  std::optional<std::string> scene, camera, animation, variant;
  bool time_given = false;
  bool background_given = false;
  bool tone_map_given = false;
  std::optional<std::filesystem::path> environment;  // a picture; else settings.environment.kind says which
  bool quiet = false;
  std::optional<bool> progress;  // none: when standard error is a terminal
  bool stats_table = false;
  std::optional<std::string> stats_json;  // a path, or "-" for standard output
};

// `facet info`.
struct InfoOptions {
  std::filesystem::path input;
  bool json = false;
};

// --help and --version: a text for standard output.
struct TextRequest {
  std::string text;
};

using Command = std::variant<TextRequest, RenderOptions, InfoOptions>;

// Throws Error(InvalidUsage).
Command ParseCommandLine(int argc, const char* const* argv);

}  // namespace facet::cli
