#include "cli/options.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <filesystem>
#include <memory>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/printable.h"
#include "cli/usage.h"
#include "facet/error.h"
#include "facet/version.h"

namespace facet::cli {
namespace {

constexpr const char* kExitCodes =
    "Exit codes:\n"
    "  0  success                       5  something required is not supported\n"
    "  1  a defect of facet             6  the output could not be written\n"
    "  2  wrong usage                   7  out of memory\n"
    "  3  the input cannot be read      8  OpenImageIO is needed and not installed\n"
    "  4  the input is not valid";

constexpr const char* kComparisonExitCodes =
    "Exit codes:\n"
    "  0  equal, or within the thresholds\n"
    "  1  different\n"
    "  2  an error: nothing was compared";

constexpr const char* kRenderExamples =
    "Examples:\n"
    "  facet render helmet.glb -o helmet.png\n"
    "  facet render car.gltf -o car.png --size 1920x1080 --orbit 35,80 --background white\n"
    "  facet render room.glb -o room.exr --camera Kitchen --environment sky.hdr\n"
    "  facet render fox.glb -o run.png --animation Run --time 0.4 --stats=json > run.json\n";

using std::filesystem::path;

// Adds an option with one value, whose text is passed to `use`.
template <class Use>
CLI::Option* Add(CLI::App& app, std::string_view group, const std::string& name, std::string_view value,
                 std::string_view description, Use use) {
  return app.add_option_function<std::string>(name, use, std::string(description))
      ->group(std::string(group))
      ->option_text(std::string(value))
      ->multi_option_policy(CLI::MultiOptionPolicy::Throw);
}

void AddFlag(CLI::App& app, const std::string& group, const std::string& name, const std::string& description,
             bool& flag) {
  app.add_flag(name, flag, description)->group(group)->disable_flag_override();
}

void AddPath(CLI::App& app, const std::string& name, const std::string& description, path& where) {
  app.add_option_function<std::string>(
         name, [&where](const std::string& text) { where = text; }, description)
      ->required()
      ->option_text(" ");
}

void AddScene(CLI::App& app, path& input) { AddPath(app, "IN", "The scene: a .gltf or .glb file", input); }

void AddThreads(CLI::App& app, const std::string& group, int& threads) {
  Add(app, group, "--threads", "N", "0 to 1024; 0 is one a core; never changes the\npicture [0]",
      [&](const std::string& text) { threads = ParseInteger("--threads", text, 0, 1024); });
}

// Options for loading the scene file.
void AddLoading(CLI::App& app, const std::string& group, LoadOptions& load, bool& strict) {
  AddFlag(app, group, "--strict", "Warnings are failures", strict);
  AddFlag(app, group, "--ignore-required-extensions",
          "Go on in spite of extensions that the file\nrequires and facet does not have",
          load.ignore_required_extensions);
  Add(app, group, "--root", "DIR",
      "Where files that the input names must lie; / for\nanywhere [the folder of the file that names them]",
      [&](const std::string& text) {
        std::error_code ignored;
        if (!std::filesystem::is_directory(text, ignored)) {
          throw Error(ErrorCode::InvalidUsage, "there is no folder " + Quoted(text), "--root",
                      "give one that is there");
        }
        load.root = text;
      });
  app.add_flag_callback(
         "--no-mmap", [&] { load.map_files = false; }, "Read large files whole: they may change while\nthey are in use")
      ->group(group)
      ->disable_flag_override();
}

void AddMemoryLimit(CLI::App& app, const std::string& group, std::uint64_t& limit) {
  Add(app, group, "--memory-limit", "SIZE",
      "Refuse what needs more, such as 512MiB or 2GiB;\nnever changes the picture [3/4 of the machine's]",
      [&](const std::string& text) { limit = ParseBytes("--memory-limit", text); });
}

// The options that determine the image, and those that only affect how it is rendered, such as threads and memory.
void AddRequest(CLI::App& app, RenderRequest& request, LoadOptions& load, bool& strict) {
  for (const RequestOption& option : RequestOptions()) {
    Add(app, option.group, "--" + std::string(option.name), option.value, option.description,
        [&request, name = option.name](const std::string& text) {
          SetOption(request, name, "--" + std::string(name), text);
        });
  }
  AddLoading(app, "Scene", load, strict);
  AddThreads(app, "Quality and speed", request.settings.threads);
  Add(app, "Quality and speed", "--tile-size", "8|16|32|64",
      "Pixels a side of the pieces that threads work on;\nnever changes the picture [32]",
      [&](const std::string& text) {
        request.settings.tile_size = 8 << ParseChoice("--tile-size", text, {"8", "16", "32", "64"});
      });
  AddMemoryLimit(app, "Quality and speed", load.memory_limit);
}

// --planes, for commands that print information about the planes of the film.
void AddPlanes(CLI::App& app, RenderRequest& request) {
  std::string names;
  for (const PlaneInfo& info : kPlanes) names += (names.empty() ? "" : ", ") + std::string(info.name);
  Add(app, "Output", "--planes", "LIST",
      "Planes of the film besides colour, with commas\nbetween them: " + names + " [none]",
      [&](const std::string& text) { request.settings.planes = ParsePlanes("--planes", text); });
}

void AddBound(CLI::App& app, RenderOptions& options) {
  const std::string group = "Chosen by error or time";
  Add(app, group, "--max-error", "X", "Take the fastest approximations whose relative\nerror is at most X, 1e-6 to 10",
      [&](const std::string& text) {
        options.bound.max_relative_rmse = ParseNumber("--max-error", text, {1e-6, 10.0});
      });
  Add(app, group, "--max-time", "TIME", "Take the most exact ones that render within TIME,\nsuch as 200ms",
      [&](const std::string& text) {
        options.bound.max_seconds = ParseDuration("--max-time", text, {1e-4, 3600.0});
      });
  Add(app, group, "--report", "FILE", "Choose from what facet report wrote as .json\n[measured first]",
      [&](const std::string& text) { options.report = text; });
  Add(app, group, "--budget", "TIME", "For measuring, 1s to 24h [30s]", [&](const std::string& text) {
    options.budget_seconds = ParseDuration("--budget", text, {1.0, 86400.0});
  });
}

void AddMessages(CLI::App& app, RenderOptions& options) {
  const std::string group = "Messages";
  const std::string stats_description =
      "Times and counts of each stage on standard error;\n--stats=json: as JSON on standard output";
  CLI::Option* stats = app.add_flag<const std::string>("--stats{table}", stats_description);
  stats->group(group)->each([&](const std::string& text) {
    if (ParseChoice("--stats", text, {"table", "json"}) == 0) {
      options.stats_table = true;
    } else {
      options.stats_json = "-";
    }
  });
  Add(app, group, "--stats-json", "FILE|-", "The same as JSON into a file",
      [&](const std::string& text) { options.stats_json = text; });
  app.add_flag_callback(
         "--progress", [&] { options.progress = true; }, "Report progress even when standard error is\nno terminal")
      ->group(group)
      ->disable_flag_override();
  app.add_flag_callback(
         "--no-progress", [&] { options.progress = false; }, "Never report progress")
      ->group(group)
      ->disable_flag_override();
  AddFlag(app, group, "-q,--quiet", "No warnings and no progress; errors only", options.quiet);
}

// A command of the program. Its --help option is listed last on its help page.
class CommandPage {
 public:
  CommandPage(CLI::App& program, const std::string& name, const std::string& description, const std::string& usage,
              const std::string& footer)
      : app_(*program.add_subcommand(name, description)->group("Commands")) {
    SetPage(app_, "facet " + name + " " + usage);
    app_.set_help_flag("");
    app_.footer(footer);
  }
  void End(const std::string& group) { app_.set_help_flag("-h,--help", "This page")->group(group); }
  CLI::App& app() { return app_; }

 private:
  CLI::App& app_;
};

CLI::App& AddRender(CLI::App& program, RenderOptions& options) {
  CommandPage page(program, "render", "Draw a scene into a picture", "IN -o OUT [OPTIONS]",
                   std::string("A value in brackets is the default.\n\n") + kRenderExamples + "\n" + kExitCodes);
  CLI::App& app = page.app();
  AddScene(app, options.input);
  Add(app, "Output", "-o,--output", "FILE", "Picture: .png, .exr, .hdr, .tif, .jpg, .webp ...",
      [&](const std::string& text) { options.output = text; })
      ->required();
  AddRequest(app, options.request, options.load, options.strict);
  Add(app, "Quality and speed", "--cache", "DIR|none",
      "Keep prepared environments in DIR, and take them\nfrom there; never changes the picture\n"
      "[$FACET_CACHE, or none]",
      [&](const std::string& text) { options.cache = text == "none" ? path() : path(text); })
      ->envname("FACET_CACHE");
  AddBound(app, options);
  AddMessages(app, options);
  page.End("Messages");
  return app;
}

CLI::App& AddInfo(CLI::App& program, InfoOptions& options) {
  CommandPage page(program, "info", "Say what is in a file and what facet makes of it", "IN [OPTIONS]", kExitCodes);
  AddScene(page.app(), options.input);
  options.load.ignore_required_extensions = true;  // such files can still be described
  AddLoading(page.app(), "Options", options.load, options.strict);
  AddMemoryLimit(page.app(), "Options", options.load.memory_limit);
  AddFlag(page.app(), "Options", "--json", "As JSON with stable keys", options.json);
  page.End("Options");
  return page.app();
}

CLI::App& AddExplain(CLI::App& program, ExplainOptions& options) {
  CommandPage page(program, "explain", "Say what a frame uses, what is disabled, and what each feature costs",
                   "IN [OPTIONS]",
                   std::string("Takes the options of render that determine the image.\n\n") + kExitCodes);
  CLI::App& app = page.app();
  AddScene(app, options.input);
  AddRequest(app, options.request, options.load, options.strict);
  AddPlanes(app, options.request);
  AddFlag(app, "Messages", "--json", "As JSON with stable keys", options.json);
  page.End("Messages");
  return app;
}

CLI::App& AddHash(CLI::App& program, HashOptions& options) {
  CommandPage page(program, "hash", "Print the SHA-256 of a scene's picture and of what it is made from",
                   "IN [OPTIONS]",
                   std::string("Takes the options of render that determine the image.\n\n") + kExitCodes);
  CLI::App& app = page.app();
  AddScene(app, options.input);
  AddRequest(app, options.request, options.load, options.strict);
  AddPlanes(app, options.request);
  AddFlag(app, "Messages", "--json", "As JSON with stable keys", options.json);
  page.End("Messages");
  return app;
}

CLI::App& AddVerify(CLI::App& program, VerifyOptions& options) {
  CommandPage page(program, "verify", "Render a picture's scene again and say whether it is equal",
                   "PICTURE IN [OPTIONS]", kComparisonExitCodes);
  CLI::App& app = page.app();
  AddPath(app, "PICTURE", "A PNG or EXR that facet wrote: its settings stand in\nit", options.picture);
  AddScene(app, options.input);
  Add(app, "Options", "--environment", "FILE",
      "The picture that lit the scene\n[the file of that name in the scene's folder]",
      [&](const std::string& text) { options.environment = text; });
  Add(app, "Options", "--materials", "FILE", "Its material file\n[the file of that name in the scene's folder]",
      [&](const std::string& text) { options.materials = text; });
  AddLoading(app, "Options", options.load, options.strict);
  AddMemoryLimit(app, "Options", options.load.memory_limit);
  AddThreads(app, "Options", options.threads);
  AddFlag(app, "Options", "--json", "As JSON with stable keys", options.json);
  page.End("Options");
  return app;
}

// Adds an option for a threshold; `use` is called with a number in `range`.
template <class Use>
void AddThreshold(CLI::App& app, const std::string& name, const std::string& value, const std::string& description,
                  Range range, Use use) {
  Add(app, "Thresholds", name, value, description,
      [name, range, use](const std::string& text) { use(ParseNumber(name, text, range)); });
}

void AddThresholds(CLI::App& app, CompareThresholds& t) {
  AddThreshold(app, "--max-difference", "X", "Of any channel, 0 to 1e6", {0.0, 1e6},
               [&t](double x) { t.max_difference = x; });
  Add(app, "Thresholds", "--max-pixels", "N", "Pixels that differ at all", [&t](const std::string& text) {
    t.max_pixels = static_cast<std::size_t>(ParseInteger("--max-pixels", text, 0, 1 << 28));
  });
  AddThreshold(app, "--max-rmse", "X", "Root mean square difference, 0 to 1e6", {0.0, 1e6},
               [&t](double x) { t.max_rmse = x; });
  AddThreshold(app, "--min-psnr", "DB", "Peak signal-to-noise ratio, -200 to 200", {-200.0, 200.0},
               [&t](double x) { t.min_psnr_db = x; });
  AddThreshold(app, "--min-ssim", "X", "Structural similarity, -1 to 1", {-1.0, 1.0},
               [&t](double x) { t.min_ssim = x; });
  AddThreshold(app, "--max-flip", "X", "Mean FLIP, 0 to 1", {0.0, 1.0}, [&t](double x) { t.max_flip = x; });
}

CLI::App& AddDiff(CLI::App& program, DiffOptions& options) {
  CommandPage page(program, "diff", "Say how far two pictures are apart", "A B [OPTIONS]",
                   std::string("With thresholds, exit code 0 means that all are kept.\n\n") + kComparisonExitCodes);
  CLI::App& app = page.app();
  AddPath(app, "A", "The reference: a picture of any format", options.a);
  AddPath(app, "B", "The picture to judge", options.b);
  AddThresholds(app, options.thresholds);
  Add(app, "Options", "-o,--output", "FILE", "Where they differ, as a heat map of FLIP",
      [&](const std::string& text) { options.output = text; });
  Add(app, "Options", "--pixels-per-degree", "X", "Of the eye that FLIP models, 1 to 1000 [67.02]",
      [&](const std::string& text) {
        options.compare.pixels_per_degree = ParseNumber("--pixels-per-degree", text, {1.0, 1000.0});
      });
  AddMemoryLimit(app, "Options", options.compare.memory_limit);
  AddFlag(app, "Options", "--json", "As JSON with stable keys", options.json);
  page.End("Options");
  return app;
}

CLI::App& AddCheck(CLI::App& program, CheckCommandOptions& options) {
  CommandPage page(program, "check", "Golden tests: render what a manifest lists and compare", "MANIFEST [OPTIONS]",
                   std::string("docs/golden-tests.md describes manifests.\n\n") + kComparisonExitCodes);
  CLI::App& app = page.app();
  AddPath(app, "MANIFEST", "A JSON file: scenes, their settings and what is expected", options.manifest);
  const std::string group = "Options";
  AddFlag(app, group, "--update", "Rewrite the expectations that do not hold, and say\nwhich", options.check.update);
  Add(app, group, "--only", "REGEX", "Entries whose name contains a match [all]",
      [&](const std::string& text) { options.check.only = text; });
  Add(app, group, "--html", "FILE", "A report for people: one page with the pictures",
      [&](const std::string& text) { options.html = text; });
  Add(app, group, "--junit", "FILE", "A report for continuous integration, as JUnit XML",
      [&](const std::string& text) { options.junit = text; });
  Add(app, group, "--output", "FOLDER", "Where pictures of failed entries are written [nowhere]",
      [&](const std::string& text) { options.output = text; });
  AddLoading(app, group, options.check.load, options.check.strict);
  AddMemoryLimit(app, group, options.check.load.memory_limit);
  AddThreads(app, group, options.check.threads);
  AddFlag(app, group, "--json", "As JSON instead of a table", options.json);
  page.End(group);
  return app;
}

CLI::App& AddReport(CLI::App& program, ReportOptions& options) {
  CommandPage page(program, "report", "Measure what each approximation costs in error and time", "IN -o FILE [OPTIONS]",
                   std::string("The other options are those of render that determine the image.\n\n") + kExitCodes);
  CLI::App& app = page.app();
  AddScene(app, options.input);
  app.add_option_function<std::vector<std::string>>(
         "-o,--output",
         [&](const std::vector<std::string>& texts) { options.outputs.assign(texts.begin(), texts.end()); },
         "Diagrams and pictures as .html; numbers as .json\nor .csv. May be given several times")
      ->group("Output")
      ->option_text("FILE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->required();
  Add(app, "Output", "--budget", "TIME", "For the reference and all points, 1s to 24h [60s]",
      [&](const std::string& text) {
        options.budget_seconds = ParseDuration("--budget", text, {1.0, 86400.0});
      });
  AddRequest(app, options.request, options.load, options.strict);
  AddFlag(app, "Messages", "-q,--quiet", "No progress; errors only", options.quiet);
  page.End("Messages");
  return app;
}

CLI::App& AddModels(CLI::App& program, ModelsOptions& options) {
  CommandPage page(program, "models", "Shading models beside glTF's, and their parameters", "[NAME] [OPTIONS]",
                   std::string("facet render IN -o OUT --materials FILE gives them to a scene\n"
                               "(docs/material-files.md).\n\n") +
                       kExitCodes);
  CLI::App& app = page.app();
  app.add_option("NAME", options.name, "One of the models [all]")->option_text(" ");
  const std::string group = "Options";
  Add(app, group, "--chart", "FILE",
      "A picture of each parameter of the model NAME from\none end of its range to the other",
      [&](const std::string& text) { options.chart = text; });
  Add(app, group, "--compare", "FILE",
      "A picture of the same base colours, metalnesses\nand roughnesses by all models; prints how far each\nis from "
      "glTF's",
      [&](const std::string& text) { options.compare = text; });
  AddFlag(app, group, "--schema", "Print the JSON schema of material files", options.schema);
  AddFlag(app, group, "--json", "As JSON with stable keys", options.json);
  page.End(group);
  return app;
}

struct Limit {
  std::uint64_t operator()(const TextRequest&) const { return 0; }
  std::uint64_t operator()(const ModelsOptions&) const { return 0; }
  std::uint64_t operator()(const DiffOptions& options) const { return options.compare.memory_limit; }
  std::uint64_t operator()(const CheckCommandOptions& options) const { return options.check.load.memory_limit; }
  template <class Options>
  std::uint64_t operator()(const Options& options) const {
    return options.load.memory_limit;
  }
};

struct Threads {
  int operator()(const TextRequest&) const { return 0; }
  int operator()(const ModelsOptions&) const { return 0; }
  int operator()(const InfoOptions&) const { return 0; }
  int operator()(const DiffOptions&) const { return 0; }
  int operator()(const VerifyOptions& options) const { return options.threads; }
  int operator()(const CheckCommandOptions& options) const { return options.check.threads; }
  template <class Options>
  int operator()(const Options& options) const {
    return options.request.settings.threads;
  }
};

}  // namespace

std::uint64_t MemoryLimitOf(const Command& command) { return std::visit(Limit(), command); }

int ThreadsOf(const Command& command) { return std::visit(Threads(), command); }

Command ParseCommandLine(int argc, const char* const* argv) {
  // Accepts "facet help" and "facet help render" as well.
  std::vector<const char*> arguments(argv, argv + argc);
  if (argc > 1 && std::string_view(argv[1]) == "help") {
    arguments.erase(arguments.begin() + 1);
    arguments.push_back("--help");
  }
  CLI::App program("facet renders glTF 2.0 scenes on the CPU: the same picture, to the last bit, on every machine.",
                   "facet");
  SetPage(program, "facet COMMAND [OPTIONS]");
  program.set_help_flag("-h,--help", "This page, or a command's: facet render --help");
  program.set_version_flag("-v,--version", std::string("facet ") + Version(), "The version of facet");
  program.footer(std::string(kRenderExamples) + "  facet info helmet.glb\n\n" + kExitCodes);
  program.require_subcommand(1);

  RenderOptions render;
  InfoOptions info;
  ExplainOptions explain;
  HashOptions hash;
  VerifyOptions verify;
  DiffOptions diff;
  CheckCommandOptions check;
  ReportOptions report;
  ModelsOptions models;
  AddRender(program, render);
  const CLI::App& info_app = AddInfo(program, info);
  const CLI::App& explain_app = AddExplain(program, explain);
  const CLI::App& hash_app = AddHash(program, hash);
  const CLI::App& verify_app = AddVerify(program, verify);
  const CLI::App& diff_app = AddDiff(program, diff);
  const CLI::App& check_app = AddCheck(program, check);
  const CLI::App& report_app = AddReport(program, report);
  const CLI::App& models_app = AddModels(program, models);

  try {
    program.parse(static_cast<int>(arguments.size()), arguments.data());
  } catch (const CLI::CallForHelp&) {
    const std::vector<CLI::App*> chosen = program.get_subcommands();
    return TextRequest{(chosen.empty() ? program : *chosen.front()).help()};
  } catch (const CLI::CallForVersion& version) {
    return TextRequest{std::string(version.what()) + "\n"};
  } catch (const CLI::ParseError& complaint) {
    throw UsageError(program, complaint);
  }
  if (info_app.parsed()) return info;
  if (explain_app.parsed()) return explain;
  if (hash_app.parsed()) return hash;
  if (verify_app.parsed()) return verify;
  if (diff_app.parsed()) return diff;
  if (check_app.parsed()) return check;
  if (report_app.parsed()) return report;
  if (models_app.parsed()) return models;
  return render;
}

}  // namespace facet::cli
