// Error against run time: the work-precision diagram of a scene's settings.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "facet/load.h"

namespace facet {

// Options of `facet render`, name to value: {"size", "256x256"}.
using SettingsText = std::map<std::string, std::string>;

// Upper bounds on error and time. A bound that is not given does not apply.
struct Bound {
  std::optional<double> max_relative_rmse;  // > 0
  std::optional<double> max_seconds;        // > 0
};

struct ReportSettings {
  // Wall clock for loading, the reference and all points; 1 to 86400. The first few blocks of the reference and the
  // requested settings are measured in any case, and what has begun when the budget ends is finished: one rendering, or
  // one round over all points if the machine became slower meanwhile.
  double budget_seconds = 60.0;
  int threads = 0;  // 0: one per core
  // Called now and then on the calling thread with the share of the budget that is used and the current activity. May
  // be empty.
  std::function<void(double, const std::string&)> progress;
  // The bound that some point should keep. If no settings can come near it, the report ends as soon as that is known.
  Bound bound;
};

// The error of a film against the reference: over R, G and B of all pixels that the reference has, in linear light
// premultiplied by alpha.
struct FilmError {
  double rmse = 0.0;            // root of the mean squared difference
  double relative_rmse = 0.0;   // rmse divided by the root mean square of the reference
  double largest = 0.0;         // the largest difference of one component
  double flip = 0.0;            // mean FLIP of the tone-mapped and encoded images
  double standard_error = 0.0;  // of `relative_rmse`, if not all pixels of the image were compared
};

// A measurement of one choice of settings.
struct ReportPoint {
  SettingsText changed;  // what differs from the requested settings; empty: nothing
  int runs = 0;
  // Of Render(): the median over the runs. Runs are made in rounds over all points; what slowed a whole round is
  // subtracted.
  double seconds = 0.0;
  double seconds_low = 0.0;    // the fastest run
  double seconds_high = 0.0;   // the slowest
  std::size_t peak_bytes = 0;  // peak growth of the process while rendering; 0: not known
  FilmError error;
  bool pareto = false;                   // no other point has both less error (relative RMSE) and less time
  std::vector<std::byte> image_png;      // the encoded image
  std::vector<std::byte> error_map_png;  // FLIP against the reference, as a heat map
};

// The cost of one approximation: the requested settings against its most exact and its cheapest value.
struct ApproximationCost {
  std::string option;
  std::string used, cheapest, most_exact;  // values
  // Relative RMSE and seconds of these three points. `used`: the requested settings.
  double error_used = 0, error_cheapest = 0, error_most_exact = 0;
  double seconds_used = 0, seconds_cheapest = 0, seconds_most_exact = 0;
  // Relative RMSE between the image with the used value and the one with the most exact value, all else being equal:
  // the effect of this approximation alone.
  double change = 0;
};

struct ErrorReport {
  std::string version;  // of facet
  std::string scene;    // the file's name
  std::string target;   // instruction set
  int threads = 0;
  int width = 0, height = 0;
  SettingsText settings;  // every option, defaults spelled out
  struct Reference {
    int samples = 0;  // per pixel and batch
    int batches = 0;
    // The number of the image's pixels that were computed, as many as there was time for, in blocks spread evenly over
    // it. All errors are over these pixels.
    std::size_t pixels = 0;
    double seconds = 0.0;
    double rms_error = 0.0;  // the reference's estimate of its own remaining error
    double relative_error = 0.0;
    std::vector<std::string> notes;
    std::vector<std::byte> image_png;  // encoded as the points' images; empty if only parts of it were computed
  } reference;
  std::vector<std::string> warnings;         // of loading and rendering; not stored
  std::vector<std::filesystem::path> files;  // all files of the scene; not stored
  // The rounding error alone: the same algorithm in lanes of floats against double.
  std::optional<FilmError> rounding;
  std::vector<ReportPoint> points;  // points[0] has the requested settings
  std::vector<ApproximationCost> costs;
  double seconds = 0.0;
  bool complete = false;  // false: the budget ended before every point was measured
  std::size_t planned_points = 0;
  // One line that says why no settings can keep ReportSettings::bound; the report then has the requested settings and
  // the points nearest to the bound, as far as known. Empty: some settings may keep it. Not stored.
  std::string out_of_reach;
};

// Renders the reference of a scene, or as much of it as fits half of the budget; then the scene with each value of each
// approximation, one changed at a time, and with combinations of them for as long as the budget lasts. The report has
// at least one point. Throws Error: InvalidUsage for settings that do not exist or are out of range; what LoadGltf,
// LoadImage and Render throw.
ErrorReport MeasureErrors(const std::filesystem::path& scene, const SettingsText& settings,
                          const ReportSettings& report = {}, const LoadOptions& load = {});

// One self-contained page without scripts: diagrams in SVG, tables, images.
std::string ToHtml(const ErrorReport& report);
// An object with the array `points`, without the images.
std::string ToJson(const ErrorReport& report);
// One line per point.
std::string ToCsv(const ErrorReport& report);

// The inverse of ToJson(). Throws Error(InvalidInput), whose message calls the text `name`.
ErrorReport ReportFromJson(const std::string& json, const std::string& name);

// The best point of a report that keeps a bound: the fastest one, or, if only time is bounded, the most exact one. If
// none keeps the bound, the nearest one, and `kept` is false.
struct Choice {
  std::size_t point = 0;  // index into ErrorReport::points
  bool kept = false;
  std::string why;  // one line, for people
};

// Throws Error: InvalidUsage if the bound is empty or not positive, InvalidInput for a report without points.
Choice ChoosePoint(const ErrorReport& report, const Bound& bound);

}  // namespace facet
