#include "cli/render_command.h"

#include <chrono>
#include <cstdio>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "cli/console.h"
#include "cli/output_path.h"
#include "cli/progress.h"
#include "cli/report_command.h"
#include "cli/stats_output.h"
#include "facet/error.h"
#include "facet/version.h"
#include "image/codec.h"
#include "report/provenance.h"

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

// Settings that contradict the output's format; everything that needs no file.
void Reconcile(RenderOptions& options) {
  RefuseContradictions(options.request);
  const OutputFormat& format = FormatOf(options.output);
  CheckWritable(options.output);
  if (options.stats_json && *options.stats_json != "-") CheckWritable(*options.stats_json);
  RenderRequest& request = options.request;
  const std::string kind(format.extension);
  if (request.type == ChannelType::U16 && !format.sixteen_bits) {
    throw Error(ErrorCode::InvalidUsage, kind + " files do not hold 16-bit integers", "--bits 16",
                "write .png or .tif, or .exr for linear light");
  }
  if (format.linear) {
    request.type = ChannelType::F32;
    if (request.Given("tonemap") && request.display.tone_map != ToneMap::None && !options.quiet) {
      PrintWarning("--tonemap: " + kind + " files hold linear light, which is not tone-mapped");
    }
  }
  if (!format.alpha && request.settings.background != Background::Environment && !request.display.background_srgb) {
    if (request.Given("background")) {
      throw Error(ErrorCode::InvalidUsage, kind + " files have no transparency", "--background transparent",
                  "choose a colour, or write .png");
    }
    // Light adds to black, ink to white.
    request.display.background_srgb = glm::vec3(format.linear ? 0.0f : 1.0f);
  }
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
  Reconcile(options);
  if (options.bound.max_relative_rmse || options.bound.max_seconds) {
    const Choice choice = ChooseApproximations(options);
    if (!choice.kept) {
      PrintWarning(choice.why);
    } else if (!options.quiet) {
      PrintNote(choice.why);
    }
  } else if (options.report || options.budget_seconds) {
    throw Error(ErrorCode::InvalidUsage, "there is no bound to choose by", options.report ? "--report" : "--budget",
                "add --max-error or --max-time");
  }
  Stopwatch total, stage;
  const RenderRequest& request = options.request;
  CommandStats stats;
  stats.input = options.input.string();
  stats.output = options.output.string();
  stats.width = request.settings.width;
  stats.height = request.settings.height;
  stats.samples = request.settings.samples;

  Film film;
  {  // the scene's memory is given back before the picture is encoded
    const LoadedScene loaded = LoadGltf(options.input, options.load);
    stats.load_seconds = stage.Lap();
    stats.input_bytes = loaded.report.file_bytes;
    PrintWarnings(loaded.report.warnings, options.quiet);
    const RenderSettings settings = ResolveRequest(request, loaded.scene);
    stats.environment_seconds = stage.Lap();
    film = RenderWithProgress(loaded.scene, options, settings, stats.render);
  }
  stats.render_seconds = stage.Lap();
  PrintWarnings(stats.render.warnings, options.quiet);

  const Image image = Develop(film, request.display, request.type);
  stats.develop_seconds = stage.Lap();
  WriteImageWithText(options.output, image, [&] {
    Provenance provenance;
    provenance.version = Version();
    provenance.scene = options.input.filename().string();
    provenance.settings = SpelledOut(request);
    provenance.film = HashFilm(film);
    provenance.pixels = HashImage(image);
    return ToPngText(provenance);
  });
  stats.write_seconds = stage.Lap();
  stats.total_seconds = total.Lap();
  PrintStats(options, stats);
}

}  // namespace

// --threads bounds loading, developing and writing too.
void RunRender(RenderOptions options) {
  RunWithThreads(options.request.settings.threads, [&] { RenderToFile(options); });
}

}  // namespace facet::cli
