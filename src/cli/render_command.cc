#include "base/parallel.h"
#include "cli/render_command.h"

#include <chrono>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cli/console.h"
#include "cli/output_path.h"
#include "cli/parse.h"
#include "cli/progress.h"
#include "cli/stats_output.h"
#include "facet/error.h"
#include "facet/version.h"
#include "image/codec.h"

namespace facet::cli {
namespace {

class Stopwatch {
 public:
  // Seconds since the last call, or since construction.
  double Lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

template <class T>
std::vector<std::string> Names(const std::vector<T>& things) {
  std::vector<std::string> names;
  names.reserve(things.size());
  for (const T& thing : things) names.push_back(thing.name);
  return names;
}

// Settings that contradict the output's format or each other; everything that needs no file.
void Reconcile(RenderOptions& options) {
  const OutputFormat& format = FormatOf(options.output);
  CheckWritable(options.output);
  if (options.stats_json && *options.stats_json != "-") CheckWritable(*options.stats_json);
  const bool environment_shown = options.settings.background == Background::Environment;
  if (environment_shown && options.settings.environment.kind == EnvironmentSettings::Kind::None) {
    throw Error(ErrorCode::InvalidUsage, "there is no environment to show", "--background environment",
                "drop --environment none, or choose a colour");
  }
  const std::string kind(format.extension);
  if (options.type == ChannelType::U16 && !format.sixteen_bits) {
    throw Error(ErrorCode::InvalidUsage, kind + " files do not hold 16-bit integers", "--bits 16",
                "write .png or .tif, or .exr for linear light");
  }
  if (format.linear) {
    options.type = ChannelType::F32;
    if (options.tone_map_given && options.display.tone_map != ToneMap::None && !options.quiet) {
      PrintWarning("--tonemap: " + kind + " files hold linear light, which is not tone-mapped");
    }
  }
  if (!format.alpha && !environment_shown && !options.display.background_srgb) {
    if (options.background_given) {
      throw Error(ErrorCode::InvalidUsage, kind + " files have no transparency", "--background transparent",
                  "choose a colour, or write .png");
    }
    // Light adds to black, ink to white.
    options.display.background_srgb = glm::vec3(format.linear ? 0.0f : 1.0f);
  }
}

// Names into indices.
void Resolve(const RenderOptions& options, const Scene& scene, RenderSettings& settings) {
  if (options.scene) settings.scene = Choose("--scene", "scene", *options.scene, Names(scene.scenes));
  if (options.camera) {
    settings.camera = SceneCamera{Choose("--camera", "camera", *options.camera, Names(scene.cameras))};
  }
  if (options.animation || options.time_given) {
    settings.animation = Choose(options.animation ? "--animation" : "--time", "animation",
                                options.animation.value_or("0"), Names(scene.animations));
  }
  if (options.variant) settings.variant = Choose("--variant", "variant", *options.variant, scene.variants);
}

void PrintWarnings(const std::vector<std::string>& warnings, bool quiet) {
  if (quiet) return;
  for (const std::string& warning : warnings) PrintWarning(warning);
}

void PrintStats(const RenderOptions& options, const CommandStats& stats) {
  if (options.stats_table) {
    const std::string table = StatsTable(stats);
    std::fwrite(table.data(), 1, table.size(), stderr);
  }
  if (!options.stats_json) return;
  const std::string json = StatsJson(stats);
  if (*options.stats_json == "-") {
    PrintOutput(json);
  } else {
    WriteFileWhole(*options.stats_json, std::as_bytes(std::span(json)));
  }
}

Film RenderWithProgress(const Scene& scene, const RenderOptions& options, RenderSettings settings, RenderStats& stats) {
  const Progress::Style style = Progress::StyleFor(options.quiet, options.progress ? &*options.progress : nullptr);
  Progress progress(style);
  if (style != Progress::Style::None) {
    settings.progress = [&progress](double share) { progress.Update(share); };
  }
  return Render(scene, settings, &stats);
}

void RenderToFile(RenderOptions& options) {
  Stopwatch total, stage;
  Reconcile(options);
  RenderSettings& settings = options.settings;
  CommandStats stats;
  stats.input = options.input.string();
  stats.output = options.output.string();
  stats.width = settings.width;
  stats.height = settings.height;
  stats.samples = settings.samples;

  Film film;
  {  // the scene's memory is given back before the picture is encoded
    const LoadedScene loaded = LoadGltf(options.input, options.load);
    stats.load_seconds = stage.Lap();
    stats.input_bytes = loaded.report.file_bytes;
    PrintWarnings(loaded.report.warnings, options.quiet);
    Resolve(options, loaded.scene, settings);
    if (options.environment) {
      settings.environment.image = std::make_shared<const Image>(LoadImage(*options.environment));
    }
    stats.environment_seconds = stage.Lap();
    film = RenderWithProgress(loaded.scene, options, settings, stats.render);
  }
  stats.render_seconds = stage.Lap();
  PrintWarnings(stats.render.warnings, options.quiet);

  const Image image = Develop(film, options.display, options.type);
  film = {};
  stats.develop_seconds = stage.Lap();
  WriteImage(options.output, image, {{"Software", std::string("facet ") + Version()}});
  stats.write_seconds = stage.Lap();
  stats.total_seconds = total.Lap();
  PrintStats(options, stats);
}

}  // namespace

// --threads bounds loading, developing and writing too.
void RunRender(RenderOptions options) {
  RunWithThreads(options.settings.threads, [&] { RenderToFile(options); });
}

}  // namespace facet::cli
