// MeasureErrors of facet/report.h: the reference, then one point after the other.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <utility>

#include "base/parallel.h"
#include "facet/compare.h"
#include "facet/error.h"
#include "facet/report.h"
#include "facet/version.h"
#include "image/codec.h"
#include "light/studio_table.h"
#include "reference/reference.h"
#include "render/render_in_double.h"
#include "report/measure.h"
#include "report/render_request.h"

namespace facet {
namespace {

constexpr int kThumbnail = 256;                // pixels along the longer side
constexpr double kReferenceShare = 0.5;        // of the budget
constexpr double kShortestWait = 20.0;         // seconds for the least reference there is, whatever the budget
constexpr int kFewestRuns = 3, kMostRuns = 7;  // of a point: about a second of them

class Clock {
 public:
  double Seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// An approximation that this scene's picture depends on.
struct Knob {
  std::string option;
  std::vector<std::string> values;  // from cheap to exact
  std::size_t used = 0;             // index of the value that was asked for
};

std::vector<std::string> Words(std::string_view text) {
  std::istringstream stream{std::string(text)};
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

// Every approximation, with the value in use put among those that are tried.
std::vector<Knob> AllKnobs(const SettingsText& settings) {
  std::vector<Knob> knobs;
  for (const RequestOption& option : RequestOptions()) {
    if (option.sweep.empty()) continue;
    Knob knob{std::string(option.name), Words(option.sweep), 0};
    const std::string& used = settings.at(knob.option);
    auto place = std::find(knob.values.begin(), knob.values.end(), used);
    if (place == knob.values.end()) {  // only numbers have values between those that are tried
      place = std::find_if(knob.values.begin(), knob.values.end(),
                           [&](const std::string& value) { return std::stoi(value) > std::stoi(used); });
      place = knob.values.insert(place, used);
    }
    knob.used = std::size_t(place - knob.values.begin());
    knobs.push_back(std::move(knob));
  }
  return knobs;
}

class Sweep {
 public:
  Sweep(const LoadedScene& loaded, const RenderRequest& request, RenderSettings resolved, const ReportSettings& report)
      : scene_(loaded.scene), request_(request), resolved_(std::move(resolved)), report_(report) {
    if (resolved_.environment.kind == EnvironmentSettings::Kind::Studio) {
      studio_ = std::make_shared<const Image>(StudioPicture(kStudioWidth, kStudioHeight));
      largest_environment_ = kStudioMaxSize;
      resolved_.environment_size = std::min(resolved_.environment_size, kStudioMaxSize);
    }
    out_.settings = SpelledOut(request);
    out_.width = resolved_.width;
    out_.height = resolved_.height;
    out_.version = Version();
  }

  ErrorReport Run() {
    MeasureReference();
    Film used;
    Measure({}, &used);
    MeasureRounding(used);
    MeasureOneByOne(used);
    MeasureCombinations();
    MarkParetoFront();
    out_.seconds = clock_.Seconds();
    out_.planned_points = out_.points.size() + unmeasured_;
    out_.complete = unmeasured_ == 0;
    return std::move(out_);
  }

 private:
  bool OutOfTime() const { return clock_.Seconds() >= report_.budget_seconds; }

  void Say(const std::string& what) const {
    if (report_.progress) report_.progress(std::min(clock_.Seconds() / report_.budget_seconds, 1.0), what);
  }

  void MeasureReference() {
    Say("reference");
    ReferenceSettings settings;
    settings.samples = 16;
    settings.batches = 65536;
    settings.time_budget = kReferenceShare * report_.budget_seconds;
    settings.give_up_after = std::max(2.0 * report_.budget_seconds, kShortestWait);
    reference_ = RenderReference(scene_, resolved_, settings);
    developed_reference_ = Develop(ToFilm(reference_), request_.display);
    out_.reference = {settings.samples,     reference_.batches,        reference_.seconds,
                      reference_.rms_error, reference_.relative_error, reference_.notes};
  }

  RenderSettings SettingsOf(const SettingsText& changed) const {
    RenderRequest request;
    request.settings = resolved_;
    for (const auto& [option, value] : changed) SetOption(request, option, option, value);
    int& size = request.settings.environment_size;
    size = std::min(size, largest_environment_);
    if (studio_ != nullptr) PrepareStudioAnew(request.settings);
    return request.settings;
  }

  // The studio is prepared once a process, or already by the build; a report wants to see what it costs, where it does.
  void PrepareStudioAnew(RenderSettings& settings) const {
    const EnvironmentOptions options{settings.background == Background::Environment, settings.environment_size,
                                     settings.environment_samples, settings.irradiance};
    if (options == kStudioOptions) return;
    settings.environment.kind = EnvironmentSettings::Kind::Image;
    settings.environment.image = studio_;
  }

  // Every approximation; of the environment's sizes those that make a difference.
  std::vector<Knob> Knobs() const {
    SettingsText settings = out_.settings;
    std::string& size = settings.at("environment-size");
    size = std::to_string(std::min(std::stoi(size), largest_environment_));
    std::vector<Knob> knobs = AllKnobs(settings);
    for (Knob& knob : knobs) {
      if (knob.option != "environment-size") continue;
      std::erase_if(knob.values, [&](const std::string& value) { return std::stoi(value) > largest_environment_; });
    }
    return knobs;
  }

  // Adds a point; `kept` gets its film.
  void Measure(const SettingsText& changed, Film* kept = nullptr) {
    const RenderSettings settings = SettingsOf(changed);
    ReportPoint point;
    point.changed = changed;
    Film film;
    RenderStats stats;
    std::vector<double> seconds;
    const auto run = [&] {
      const Clock clock;
      film = Render(scene_, settings, &stats);
      seconds.push_back(clock.Seconds());
    };
    // The first run is for memory; it also warms caches that all points share, so its time does not count.
    point.peak_bytes = PeakBytes(run);
    const int wanted = std::clamp(static_cast<int>(1.0 / seconds[0]), kFewestRuns, kMostRuns);
    seconds.clear();
    do run();
    while (int(seconds.size()) < wanted && !OutOfTime());
    std::sort(seconds.begin(), seconds.end());
    point.runs = int(seconds.size());
    point.seconds = seconds[seconds.size() / 2];
    point.seconds_low = seconds.front();
    point.seconds_high = seconds.back();

    point.error = ErrorOf(film, reference_);
    ImageDifference difference = CompareImages(developed_reference_, Develop(film, request_.display));
    point.error.flip = difference.flip_mean;
    point.picture_png = EncodePng(Develop(Reduced(film, kThumbnail), request_.display));
    difference.flip_map = Reduced(difference.flip_map, kThumbnail);
    difference.width = difference.flip_map.width;
    difference.height = difference.flip_map.height;
    point.error_map_png = EncodePng(HeatMap(difference));
    out_.target = stats.target;
    out_.threads = stats.threads;
    if (changed.empty()) out_.warnings = stats.warnings;
    out_.points.push_back(std::move(point));
    measured_.insert(changed);
    if (kept != nullptr) *kept = std::move(film);
  }

  void MeasureRounding(const Film& used) {
    if (OutOfTime()) return;
    Say("rounding");
    const Film exact = RenderInDouble(scene_, resolved_);
    FilmError error = ErrorOf(used, exact);
    error.flip = CompareImages(Develop(exact, request_.display), Develop(used, request_.display)).flip_mean;
    out_.rounding = error;
  }

  // Each approximation by itself. One whose cheapest and most exact values change nothing is not for this scene.
  void MeasureOneByOne(const Film& used) {
    for (Knob& knob : Knobs()) {
      if (OutOfTime()) {
        ++unmeasured_;
        continue;
      }
      const std::size_t last = knob.values.size() - 1;
      const Film cheapest = Render(scene_, SettingsOf({{knob.option, knob.values.front()}}));
      const Film exact = Render(scene_, SettingsOf({{knob.option, knob.values[last]}}));
      if (SameBits(cheapest, used) && SameBits(exact, used)) continue;
      ApproximationCost cost;
      cost.option = knob.option;
      cost.used = knob.values[knob.used];
      cost.cheapest = knob.values.front();
      cost.most_exact = knob.values[last];
      cost.change = ErrorOf(used, exact).relative_rmse;
      const bool measured = MeasureValue(knob, 0) && MeasureValue(knob, last);
      knobs_.push_back(std::move(knob));
      if (!measured) continue;
      Read(cost.used, cost, cost.error_used, cost.seconds_used);
      Read(cost.cheapest, cost, cost.error_cheapest, cost.seconds_cheapest);
      Read(cost.most_exact, cost, cost.error_most_exact, cost.seconds_most_exact);
      out_.costs.push_back(cost);
    }
    for (const Knob& knob : knobs_) {
      for (std::size_t i = 1; i + 1 < knob.values.size(); ++i) MeasureValue(knob, i);
    }
  }

  // False: there was no time left.
  bool MeasureValue(const Knob& knob, std::size_t value) {
    if (value == knob.used) return true;
    if (OutOfTime()) {
      ++unmeasured_;
      return false;
    }
    Say(knob.option + " " + knob.values[value]);
    Measure({{knob.option, knob.values[value]}});
    return true;
  }

  // The point with one value of an approximation, all else as asked for.
  void Read(const std::string& value, const ApproximationCost& cost, double& error, double& seconds) const {
    const SettingsText changed = value == cost.used ? SettingsText{} : SettingsText{{cost.option, value}};
    for (const ReportPoint& point : out_.points) {
      if (point.changed != changed) continue;
      error = point.error.relative_rmse;
      seconds = point.seconds;
    }
  }

  // From the points on the front one step further, in every approximation and direction, until there is no new point.
  void MeasureCombinations() {
    for (bool grew = true; grew;) {
      grew = false;
      MarkParetoFront();
      std::vector<SettingsText> next;
      for (const ReportPoint& point : out_.points) {
        if (point.pareto) AddNeighbours(point.changed, next);
      }
      for (std::size_t i = 0; i < next.size(); ++i) {
        if (OutOfTime()) {
          unmeasured_ += next.size() - i;
          return;
        }
        Say("combination " + std::to_string(out_.points.size()));
        Measure(next[i]);
        grew = true;
      }
    }
  }

  void AddNeighbours(const SettingsText& from, std::vector<SettingsText>& next) {
    for (const Knob& knob : knobs_) {
      const auto changed = from.find(knob.option);
      const std::string& value = changed != from.end() ? changed->second : knob.values[knob.used];
      const auto place = std::size_t(std::find(knob.values.begin(), knob.values.end(), value) - knob.values.begin());
      for (const std::size_t step : {place - 1, place + 1}) {
        if (step >= knob.values.size()) continue;  // also one below the first
        SettingsText neighbour = from;
        if (step == knob.used) {
          neighbour.erase(knob.option);
        } else {
          neighbour[knob.option] = knob.values[step];
        }
        if (measured_.count(neighbour) > 0) continue;
        if (std::find(next.begin(), next.end(), neighbour) == next.end()) next.push_back(std::move(neighbour));
      }
    }
  }

  void MarkParetoFront() {
    for (ReportPoint& point : out_.points) {
      point.pareto = std::none_of(out_.points.begin(), out_.points.end(), [&](const ReportPoint& other) {
        return other.error.relative_rmse <= point.error.relative_rmse && other.seconds <= point.seconds &&
               (other.error.relative_rmse < point.error.relative_rmse || other.seconds < point.seconds);
      });
    }
  }

  static bool SameBits(const Film& a, const Film& b) { return HashFilm(a) == HashFilm(b); }

  const Scene& scene_;
  const RenderRequest& request_;
  RenderSettings resolved_;
  std::shared_ptr<const Image> studio_;  // where it is the light
  int largest_environment_ = std::numeric_limits<int>::max();  // texels that it is prepared with at most
  const ReportSettings& report_;
  const Clock clock_;
  ReferenceFilm reference_;
  Image developed_reference_;
  std::vector<Knob> knobs_;
  std::set<SettingsText> measured_;
  std::size_t unmeasured_ = 0;  // points that were planned when the budget ended
  ErrorReport out_;
};

}  // namespace

ErrorReport MeasureErrors(const std::filesystem::path& scene, const SettingsText& settings,
                          const ReportSettings& report, const LoadOptions& load) {
  if (!(report.budget_seconds >= 1.0 && report.budget_seconds <= 86400.0)) {
    throw Error(ErrorCode::InvalidUsage, "a budget of " + std::to_string(report.budget_seconds) + " s",
                "report settings", "1 to 86400 are accepted");
  }
  RenderRequest request;
  for (const auto& [option, value] : settings) SetOption(request, option, option, value);
  request.settings.threads = report.threads;
  ErrorReport out;
  RunWithThreads(report.threads, [&] {
    const RenderInputs inputs = LoadInputs(scene, request, load);
    out = Sweep(inputs.loaded, request, inputs.settings, report).Run();
    const std::vector<std::string>& of_loading = inputs.loaded.report.warnings;
    out.warnings.insert(out.warnings.begin(), of_loading.begin(), of_loading.end());
  });
  out.scene = scene.filename().string();
  return out;
}

}  // namespace facet
