#include "cli/report_command.h"

#include <unistd.h>

#include <cstdio>
#include <string>

#include "base/input_file.h"
#include "base/number_text.h"
#include "base/output_file.h"
#include "base/printable.h"
#include "cli/console.h"
#include "facet/error.h"
#include "facet/report.h"

namespace facet::cli {
namespace {

using Writer = std::string (*)(const ErrorReport&);

Writer WriterFor(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (extension == ".html") return ToHtml;
  if (extension == ".json") return ToJson;
  if (extension == ".csv") return ToCsv;
  throw Error(ErrorCode::InvalidUsage, "a report is not written as " + Quoted(extension), Printable(path.string()),
              "use .html, .json or .csv");
}

// Overwrites one line on the terminal.
void ShowProgress(double share, const std::string& what) {
  std::fprintf(stderr, "\r\033[Kmeasuring: %3d %% %s", static_cast<int>(100.0 * share), what.c_str());
}

ErrorReport Measure(const std::filesystem::path& scene, const RenderRequest& request, const LoadOptions& load,
                    double budget_seconds, const Bound& bound, bool quiet) {
  ReportSettings settings;
  settings.budget_seconds = budget_seconds;
  settings.bound = bound;
  settings.threads = request.settings.threads;
  const bool shown = !quiet && isatty(STDERR_FILENO) == 1;
  if (shown) settings.progress = ShowProgress;
  ErrorReport report = MeasureErrors(scene, {request.given.begin(), request.given.end()}, settings, load);
  if (shown) std::fputs("\r\033[K", stderr);
  return report;
}

bool IsApproximation(const std::string& name) {
  for (const RequestOption& option : RequestOptions()) {
    if (option.name == name) return !option.sweep.empty();
  }
  return false;
}

// A stored report is valid only for its scene and for the settings that it was made with.
void RefuseOtherSettings(const ErrorReport& report, const RenderOptions& options) {
  const std::string name = Printable(options.report->string());
  if (report.scene != options.input.filename().string()) {
    throw Error(ErrorCode::InvalidUsage, "is about the scene " + Quoted(report.scene), name, "make one for this scene");
  }
  const SettingsText wanted = SpelledOut(options.request);
  const auto value = [](const SettingsText& settings, const std::string& option) {
    const auto found = settings.find(option);
    return found == settings.end() ? std::string("not set") : Quoted(found->second);
  };
  for (const RequestOption& known : RequestOptions()) {
    const std::string option(known.name);
    // Approximations are chosen from the report, but those given explicitly must equal the ones it was made with.
    if (!known.sweep.empty() && !options.request.Given(option)) continue;
    if (value(report.settings, option) == value(wanted, option)) continue;
    throw Error(ErrorCode::InvalidUsage,
                "is about another picture: its " + option + " is " + value(report.settings, option) + ", not " +
                    value(wanted, option),
                name, "give the options that it was made with, or make another");
  }
}

}  // namespace

void RunReport(const ReportOptions& options) {
  for (const std::filesystem::path& output : options.outputs) {
    WriterFor(output);
    CheckWritable(output);
  }
  RefuseOverwriting(options.outputs, {options.input});
  const ErrorReport report =
      Measure(options.input, options.request, options.load, options.budget_seconds, {}, options.quiet);
  if (!options.quiet || options.strict) PrintWarnings(report.warnings, options.strict, options.input.string());
  RefuseOverwriting(options.outputs, report.files);
  for (const std::filesystem::path& output : options.outputs) {
    const std::string text = WriterFor(output)(report);
    WriteFile(output, text);
  }
  const std::size_t pixels = std::size_t(report.width) * std::size_t(report.height);
  if (report.reference.pixels < pixels && !options.quiet) {
    PrintNote("errors are over " + ShortNumber(100.0 * double(report.reference.pixels) / double(pixels), 2) +
              " % of the picture's pixels, in blocks spread over it, for which there was time");
  }
  if (!report.complete && !options.quiet) {
    PrintWarning("the budget ended after " + std::to_string(report.points.size()) + " of at least " +
                 std::to_string(report.planned_points) + " points; --budget gives more");
  }
}

Choice ChooseApproximations(RenderOptions& options) {
  ErrorReport report;
  if (options.report) {
    report = ReportFromJson(std::string(ReadFile(*options.report).Text()), Printable(options.report->string()));
    RefuseOtherSettings(report, options);
  } else {
    report = Measure(options.input, options.request, options.load, options.budget_seconds.value_or(30.0), options.bound,
                     options.quiet);
  }
  Choice choice = ChoosePoint(report, options.bound);
  if (!choice.kept && !report.out_of_reach.empty()) choice.why += "; " + report.out_of_reach;
  if (!report.complete) {
    choice.why += "; the budget ended after " + std::to_string(report.points.size()) + " of at least " +
                  std::to_string(report.planned_points) + " points";
  }
  for (const auto& [option, value] : report.settings) {
    if (IsApproximation(option)) SetOption(options.request, option, "--report", value);
  }
  for (const auto& [option, value] : report.points[choice.point].changed) {
    if (!IsApproximation(option)) {
      throw Error(ErrorCode::InvalidInput, Quoted(option) + " is no approximation", "--report", "make the report anew");
    }
    SetOption(options.request, option, "--report", value);
  }
  return choice;
}

}  // namespace facet::cli
