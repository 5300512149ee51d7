#include "cli/render_command.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/memory_budget.h"
#include "base/output_file.h"
#include "base/parallel.h"
#include "cli/console.h"
#include "cli/progress.h"
#include "cli/report_command.h"
#include "cli/stats_output.h"
#include "facet/error.h"
#include "facet/version.h"
#include "film/hash_film.h"
#include "image/codec.h"
#include "image/formats.h"
#include "image/hash_image.h"
#include "settings/provenance.h"

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

// With --strict, warnings are errors and are printed even with --quiet.
void PrintWarnings(const std::vector<std::string>& warnings, const RenderOptions& options) {
  if (!options.quiet || options.strict) cli::PrintWarnings(warnings, options.strict, options.input.string());
}

// Resolves or refuses settings that do not fit the output's format. Does not read any file.
void Reconcile(RenderOptions& options) {
  RefuseContradictions(options.request);
  const ImageFormat& format = FormatToWrite(options.output);
  CheckWritable(options.output);
  if (options.stats_json && *options.stats_json != "-") CheckWritable(*options.stats_json);
  RenderRequest& request = options.request;
  const std::string kind = ExtensionOf(options.output);
  if (request.type == ChannelType::U16 && !format.Holds(ChannelType::U16)) {
    throw Error(ErrorCode::InvalidUsage, kind + " files do not hold 16-bit integers", "--bits 16",
                "write .png or .tif, or .exr for linear light");
  }
  if (format.IsLinear()) {
    request.type = ChannelType::F32;
    std::vector<std::string> warnings;
    if (request.Given("tonemap") && request.display.tone_map != ToneMap::None) {
      warnings.push_back("--tonemap: " + kind + " files hold linear light, which is not tone-mapped");
    }
    if (request.Given("bits")) warnings.push_back("--bits: " + kind + " files hold floats");
    PrintWarnings(warnings, options);
  }
  if (format.alpha == FileAlpha::None && request.settings.background != Background::Environment &&
      !request.display.background_srgb) {
    if (request.Given("background")) {
      throw Error(ErrorCode::InvalidUsage, kind + " files have no transparency", "--background transparent",
                  "choose a colour, or write .png");
    }
    // The backdrop is black for linear light and white, like paper, for display formats.
    request.display.background_srgb = glm::vec3(format.IsLinear() ? 0.0f : 1.0f);
  }
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
    WriteFile(*options.stats_json, json);
  }
}

// Calls draw(settings) with settings that report progress while it renders.
template <class Draw>
void DrawWithProgress(const RenderOptions& options, RenderSettings settings, const Draw& draw) {
  const Progress::Style style = Progress::StyleFor(options.quiet, options.progress ? &*options.progress : nullptr);
  Progress progress(style);
  if (style != Progress::Style::None) {
    settings.progress = [&progress](double share) { progress.Update(share); };
  }
  draw(settings);
}

// The number of rows in a band of the image, or 0 to render it as a whole. A PNG with a large film is rendered, encoded
// and written in bands, so that the memory needed does not grow with its height.
int BandRows(const RenderOptions& options) {
  constexpr std::uint64_t kLargestWhole = std::uint64_t{256} << 20, kBand = std::uint64_t{64} << 20;  // bytes of film
  const RenderSettings& settings = options.request.settings;
  const std::uint64_t limit = settings.memory_limit > 0 ? settings.memory_limit : DefaultMemoryLimit();
  const std::uint64_t row_bytes = std::uint64_t(settings.width) * sizeof(glm::vec4);
  const bool large = row_bytes * std::uint64_t(settings.height) > std::min(kLargestWhole, limit / 4);
  const bool streamed = ExtensionOf(options.output) == ".png" && IsPlainFile(options.output);
  return large && streamed ? static_cast<int>(std::max<std::uint64_t>(std::min(kBand, limit / 8) / row_bytes, 1)) : 0;
}

// Checks the memory for encoding an image that is rendered as a whole. RenderSettings::memory_limit covers rendering.
void CheckMemory(const RenderOptions& options) {
  const RenderRequest& request = options.request;
  const RenderSettings& settings = request.settings;
  const std::uint64_t pixels = std::uint64_t(settings.width) * std::uint64_t(settings.height);
  const std::string size = std::to_string(settings.width) + " x " + std::to_string(settings.height) + " pixels";
  const std::string remedy = ExtensionOf(options.output) == ".png"
                                 ? "make the picture smaller, or write it to a plain file, which is done piece by piece"
                                 : "make the picture smaller, or write it as .png, which is done piece by piece";
  MemoryBudget budget(settings.memory_limit);
  budget.Charge(pixels, sizeof(glm::vec4), "a film of " + size, {}, remedy);
  budget.Charge(2 * pixels, 4 * SizeOf(request.type), "its encoded pixels and the encoder's copy", {}, remedy);
}

// Loads the scene, renders it, and encodes and writes the image.
class Drawing {
 public:
  Drawing(const RenderOptions& options, CommandStats& stats)
      : options_(options), request_(options.request), stats_(stats) {}

  void InBands(int rows) {
    Load();
    const int width = settings_.width, height = settings_.height;
    Provenance provenance = Origin();
    Sha256 film_hash = BeginFilmHash(width, height), pixel_hash;
    std::optional<PngStream> png;
    const auto add = [&](const Film& band, int first_row) {
      Stopwatch stage;
      const Image image = EncodeFilm(band, request_.display, request_.type);
      stats_.encode_seconds += stage.Lap();
      if (first_row == 0) {
        const Image form{width, height, image.channels, image.type, image.encoding, {}};
        png.emplace(options_.output, form, ToImageText(provenance));
        pixel_hash = BeginImageHash(form);
      }
      png->Add(image, [&] {
        film_hash.Add(std::as_bytes(std::span(band.pixels)));
        pixel_hash.Add(std::span(image.bytes));
      });
      stats_.write_seconds += stage.Lap();
    };
    DrawWithProgress(options_, settings_, [&](const RenderSettings& settings) {
      RenderBands(loaded_.scene, settings, rows, add, &stats_.render);
    });
    stats_.render_seconds = stage_.Lap() - stats_.encode_seconds - stats_.write_seconds;
    PrintWarnings(stats_.render.warnings, options_);
    provenance.film = film_hash.Finish();
    provenance.pixels = pixel_hash.Finish();
    png->Finish(ToImageText(provenance));
    stats_.write_seconds += stage_.Lap();
  }

  void Whole() {
    Load();
    Film film;
    DrawWithProgress(options_, settings_,
                     [&](const RenderSettings& settings) { film = Render(loaded_.scene, settings, &stats_.render); });
    settings_ = {}, loaded_ = {};  // frees the scene's memory before encoding
    stats_.render_seconds = stage_.Lap();
    PrintWarnings(stats_.render.warnings, options_);

    const Image image = EncodeFilm(film, request_.display, request_.type);
    stats_.encode_seconds = stage_.Lap();
    WriteImageWithText(options_.output, image, [&](const Image& stored) {
      Provenance provenance = Origin();
      provenance.film = HashFilm(film);
      provenance.pixels = HashImage(stored);
      return ToImageText(provenance);
    });
    stats_.write_seconds = stage_.Lap();
  }

 private:
  void Load() {
    loaded_ = LoadGltf(options_.input, options_.load);
    ApplyMaterials(request_, loaded_, options_.load);
    stats_.load_seconds = stage_.Lap();
    stats_.input_bytes = loaded_.report.file_bytes;
    PrintWarnings(loaded_.report.warnings, options_);
    RefuseOverwritingInputs();
    settings_ = ResolveRequest(request_, loaded_.scene, {}, options_.cache);
    stats_.environment_seconds = stage_.Lap();
  }

  void RefuseOverwritingInputs() const {
    std::vector<std::filesystem::path> outputs = {options_.output}, inputs = loaded_.report.files;
    if (options_.stats_json && *options_.stats_json != "-") outputs.emplace_back(*options_.stats_json);
    inputs.push_back(options_.input);
    if (request_.environment) inputs.push_back(*request_.environment);
    if (options_.report) inputs.push_back(*options_.report);
    RefuseOverwriting(outputs, inputs);
  }

  // The provenance to store in the file, without its digests.
  Provenance Origin() const {
    Provenance provenance;
    provenance.version = Version();
    provenance.scene = options_.input.filename().string();
    provenance.settings = SpelledOut(request_);
    return provenance;
  }

  const RenderOptions& options_;
  const RenderRequest& request_;
  CommandStats& stats_;
  Stopwatch stage_;
  LoadedScene loaded_;
  RenderSettings settings_;
};

void RenderToFile(RenderOptions& options) {
  MemoryBudget budget(options.load.memory_limit);
  const MemoryBudget::Scope scope(budget);
  options.request.settings.memory_limit = options.load.memory_limit;
  Reconcile(options);
  const int band_rows = BandRows(options);
  if (band_rows == 0) CheckMemory(options);
  if (options.bound.max_relative_rmse || options.bound.max_seconds) {
    const Choice choice = ChooseApproximations(options);
    if (!choice.kept) {
      cli::PrintWarnings({choice.why}, options.strict, options.input.string());
    } else if (!options.quiet) {
      PrintNote(choice.why);
    }
  } else if (options.report || options.budget_seconds) {
    throw Error(ErrorCode::InvalidUsage, "there is no bound to choose by", options.report ? "--report" : "--budget",
                "add --max-error or --max-time");
  }
  Stopwatch total;
  CommandStats stats;
  stats.input = options.input.string();
  stats.output = options.output.string();
  stats.width = options.request.settings.width;
  stats.height = options.request.settings.height;
  stats.samples = options.request.settings.samples;
  Drawing drawing(options, stats);
  band_rows > 0 ? drawing.InBands(band_rows) : drawing.Whole();
  stats.total_seconds = total.Lap();
  PrintStats(options, stats);
}

}  // namespace

// --threads also limits the threads for loading, encoding and writing.
void RunRender(RenderOptions options) {
  RunWithThreads(options.request.settings.threads, [&] { RenderToFile(options); });
}

}  // namespace facet::cli
