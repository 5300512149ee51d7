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

// What a rendering may cost. What is not given is not bounded.
struct Bound {
  std::optional<double> max_relative_rmse;  // > 0
  std::optional<double> max_seconds;        // > 0
};

struct ReportSettings {
  // Wall clock, for loading, the reference and all points; 1 to 86400. The first few blocks of the reference and the
  // settings asked for are measured whatever it says, and what has been begun when it ends is finished: one rendering,
  // or one of all points where the machine became slower meanwhile.
  double budget_seconds = 60.0;
  int threads = 0;  // 0: one per core
  // Called now and then from the calling thread with the share of the budget that is used and what is being done. May
  // be empty.
  std::function<void(double, const std::string&)> progress;
  // What a point is wanted for. Where no settings come near it the report ends as soon as that is known.
  Bound bound;
};

// How far a picture is from the reference. Over all pixels that the reference has and R, G, B, in linear light that is
// premultiplied by alpha.
struct FilmError {
  double rmse = 0.0;            // root of the mean squared difference
  double relative_rmse = 0.0;   // that, divided by the root mean square of the reference
  double largest = 0.0;         // the largest difference of a number
  double flip = 0.0;            // mean FLIP of the developed pictures
  double standard_error = 0.0;  // of `relative_rmse`, where not all of the picture's pixels were compared
};

// One choice of settings, measured.
struct ReportPoint {
  SettingsText changed;  // what differs from the settings that were asked for; empty: those themselves
  int runs = 0;
  // Of Render(): the median of the runs, which go round all points in turn, less what slowed whole rounds.
  double seconds = 0.0;
  double seconds_low = 0.0;    // the fastest run
  double seconds_high = 0.0;   // the slowest
  std::size_t peak_bytes = 0;  // what the process grew by at most while rendering; 0 where it is not known
  FilmError error;
  bool pareto = false;                   // no other point has both less error (relative RMSE) and less time
  std::vector<std::byte> picture_png;    // the developed picture
  std::vector<std::byte> error_map_png;  // FLIP against the reference, as a heat map
};

// An approximation, by itself: from the settings asked for to its most exact value and to its cheapest.
struct ApproximationCost {
  std::string option;
  std::string used, cheapest, most_exact;  // values
  // Relative RMSE and seconds of those three points. `used` is the point of the settings asked for.
  double error_used = 0, error_cheapest = 0, error_most_exact = 0;
  double seconds_used = 0, seconds_cheapest = 0, seconds_most_exact = 0;
  // Relative RMSE between the pictures with the used value and with the most exact one, all else the same: what this
  // approximation alone changes.
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
    int samples = 0;  // a pixel and batch
    int batches = 0;
    // Pixels that it has of the picture, in blocks spread evenly over it: as many as there was time for. All errors are
    // over these.
    std::size_t pixels = 0;
    double seconds = 0.0;
    double rms_error = 0.0;  // what is left of its own error, as it estimates it
    double relative_error = 0.0;
    std::vector<std::string> notes;
  } reference;
  std::vector<std::string> warnings;         // of loading and rendering; not stored
  std::vector<std::filesystem::path> files;  // that the scene was read from; not stored
  // The same algorithm on lanes of floats and in double: the rounding error, apart from the approximations'.
  std::optional<FilmError> rounding;
  std::vector<ReportPoint> points;  // points[0] has the settings asked for
  std::vector<ApproximationCost> costs;
  double seconds = 0.0;
  bool complete = false;  // false: the budget ended before every point was measured
  std::size_t planned_points = 0;
  // Why no settings would keep ReportSettings::bound, one line; the report has then the points that are nearest to it,
  // as far as is known, and the settings asked for. Empty: some may. Not stored.
  std::string out_of_reach;
};

// Renders the reference of a scene, or as much of it as half of the budget is enough for, then the scene with every
// approximation's values, one at a time, and with combinations of them as long as the budget lasts. There is always a
// point.
// Throws Error: InvalidUsage for settings that do not exist or are out of range; what LoadGltf, LoadImage and Render
// throw.
ErrorReport MeasureErrors(const std::filesystem::path& scene, const SettingsText& settings,
                          const ReportSettings& report = {}, const LoadOptions& load = {});

// One page without scripts or files of others': diagrams in SVG, tables, pictures.
std::string ToHtml(const ErrorReport& report);
// An object with the array `points`; pictures are left out.
std::string ToJson(const ErrorReport& report);
// A line per point.
std::string ToCsv(const ErrorReport& report);

// What ToJson() gave. Throws Error(InvalidInput); `name` is what messages call it.
ErrorReport ReportFromJson(const std::string& json, const std::string& name);

// The point of a report that keeps the bound: the fastest one whose error is within, or the most exact one whose time
// is within, or, under both, the fastest. None does: the nearest, and `kept` is false.
struct Choice {
  std::size_t point = 0;  // index into ErrorReport::points
  bool kept = false;
  std::string why;  // one line, for people
};

// Throws Error(InvalidUsage) for a bound that is no positive number, or none at all; InvalidInput for a report without
// points.
Choice ChoosePoint(const ErrorReport& report, const Bound& bound);

}  // namespace facet
