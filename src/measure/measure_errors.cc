// MeasureErrors() of facet/report.h: first the reference, then each point once, then rounds over all points to measure
// times.
#include "measure/measure_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/memory_budget.h"
#include "base/number_text.h"
#include "base/parallel.h"
#include "facet/compare.h"
#include "facet/error.h"
#include "facet/render.h"
#include "facet/version.h"
#include "image/codec.h"
#include "light/studio_table.h"
#include "measure/knobs.h"
#include "measure/measure.h"
#include "reference/reference.h"
#include "render/render_in_double.h"
#include "settings/render_request.h"

namespace facet {
namespace {

constexpr int kThumbnail = 256;                // pixels along the longer side
constexpr double kReferenceShare = 0.5;        // of the budget
constexpr double kFirstLookShare = 0.05;       // of the budget, for a reference that only tells whether a bound is far
constexpr double kMostBudget = 86400.0;        // seconds
constexpr int kFewestRuns = 3, kMostRuns = 7;  // of a point: about a second of them, if there is time
constexpr double kSparedRuns = 2.5;            // time reserved when points are added: for two runs, and for their
                                               // being slower than expected
// Rendering in double takes 1 to 4 times as long as on lanes (the bundled scenes and DamagedHelmet).
constexpr double kDoubleToLanes = 5.0;
// A bound is out of reach if both ends of all approximations together miss it by this factor. The most exact settings
// do not always have the least error (CesiumMan has two thirds of it without mip levels), and times vary.
constexpr double kFar = 1.6;

// Memory per pixel at most: three films, one encoded image and its linear light, the reference's light, FLIP's errors.
constexpr std::size_t kComparedBytes = 6 * sizeof(glm::vec4) + 2 * sizeof(float);

class Sweep {
 public:
  Sweep(const Clock& clock, double start, const LoadedScene& loaded, const RenderRequest& request,
        RenderSettings resolved, const ReportSettings& report)
      : scene_(loaded.scene),
        request_(request),
        resolved_(std::move(resolved)),
        report_(report),
        clock_(clock),
        start_(start),
        compared_(std::uint64_t(resolved_.width) * std::uint64_t(resolved_.height), kComparedBytes,
                  "films to compare") {
    if (resolved_.environment.kind == EnvironmentSettings::Kind::Studio) {
      studio_ = std::make_shared<const Image>(StudioImage(kStudioWidth, kStudioHeight));
      largest_environment_ = kStudioMaxSize;
      resolved_.environment_size = std::min(resolved_.environment_size, kStudioMaxSize);
    }
    out_.settings = SpelledOut(request);
    out_.width = resolved_.width;
    out_.height = resolved_.height;
    out_.version = Version();
  }

  ErrorReport Run() {
    BeginReference();
    Render(scene_, SettingsOf({}));  // fills caches that all points share
    std::vector<Drawn> ends;
    if (report_.bound.max_seconds || report_.bound.max_relative_rmse) ends = DrawEnds();
    if (out_.out_of_reach.empty()) ContinueReference(kReferenceShare);
    TakeReference();
    Say("the settings asked for");
    const Drawn used = Draw({});
    AddPoint(used);
    for (const Drawn& end : ends) AddPoint(end);
    ends.clear();
    if (out_.out_of_reach.empty()) {
      MeasureRounding(used);
      MeasureOneByOne(used);
      MeasureCombinations();
    }
    TimeInTurn();
    CompleteCosts();
    MarkParetoFront();
    out_.seconds = Elapsed();
    out_.planned_points = out_.points.size() + unmeasured_;
    out_.complete = unmeasured_ == 0;
    return std::move(out_);
  }

 private:
  // A rendering that is not a point of the report yet.
  struct Drawn {
    SettingsText changed;
    Film film;
    double seconds = 0.0;
    std::size_t peak_bytes = 0;
    double spent = 0.0;  // seconds, including the work around the rendering
  };

  double Elapsed() const { return clock_() - start_; }

  void Say(const std::string& what) const {
    if (report_.progress) report_.progress(std::min(Elapsed() / report_.budget_seconds, 1.0), what);
  }

  // Whether there is time for this many more points, and for timing all points afterwards.
  bool Affords(std::size_t more) {
    if (late_) return false;
    const double count = double(out_.points.size()), grown = (count + double(more)) / count;
    const double needed = double(more) * visits_seconds_ / count + kSparedRuns * round_seconds_ * grown;
    const bool fits = Elapsed() + needed <= report_.budget_seconds;
    late_ = !fits && more == 1;
    return fits;
  }

  void BeginReference() {
    Say("reference");
    RenderSettings settings = resolved_;
    settings.progress = [this](double) { Say("reference"); };
    ReferenceSettings reference;
    reference.samples = out_.reference.samples = 16;
    reference.batches = 65536;
    reference.clock = clock_;
    reference_began_ = Elapsed();
    reference_ = std::make_unique<ReferenceRun>(scene_, settings, reference);
  }

  // Seconds until that share of the budget is used.
  void ContinueReference(double share) {
    reference_film_ = &reference_->Continue(share * report_.budget_seconds - reference_began_);
  }

  void TakeReference() {
    const ReferenceFilm& film = *reference_film_;
    const Film exact = ToFilm(film);
    flip_ = std::make_unique<FlipJudge>(film, EncodeFilm(exact, request_.display));
    ErrorReport::Reference& out = out_.reference;
    out = {out.samples,
           film.batches,
           film.known_pixels,
           film.seconds,
           film.rms_error,
           film.relative_error,
           film.notes,
           film.whole ? EncodePng(EncodeFilm(Reduced(exact, kThumbnail), request_.display)) : std::vector<std::byte>()};
  }

  // Renders with the cheapest and with the most exact values of all approximations, which are most likely to keep a
  // bound. Sets `out_of_reach` if even these are far from it.
  std::vector<Drawn> DrawEnds() {
    Say("whether the bound is in reach");
    ContinueReference(kFirstLookShare);
    const std::vector<Knob> knobs = AllKnobs(out_.settings, largest_environment_);
    std::vector<Drawn> ends;
    ends.push_back(Draw(Turned(knobs, [](const Knob&) { return std::size_t(0); })));
    ends.push_back(Draw(Turned(knobs, [](const Knob& knob) { return knob.Last(); })));
    const Bound& bound = report_.bound;
    if (bound.max_seconds && ends[0].seconds > kFar * *bound.max_seconds) {
      const RenderSettings settings = SettingsOf(ends[0].changed);
      const double again = SecondsOf([&] { Render(scene_, settings); });
      if (again > kFar * *bound.max_seconds) out_.out_of_reach = "not even the cheapest settings come near it";
    }
    if (bound.max_relative_rmse && out_.out_of_reach.empty()) LookAtError(ends[1].film, *bound.max_relative_rmse);
    std::erase_if(ends, [](const Drawn& end) { return end.changed.empty(); });
    return ends;
  }

  void LookAtError(const Film& most_exact, double bound) {
    const FilmError error = ErrorOf(most_exact, *reference_film_);
    const double least = std::max(error.relative_rmse - 2.0 * error.standard_error, 0.0);
    const double noise = reference_film_->relative_error, far = kFar * bound;
    // Most of the error must come from the settings, since the contribution of the reference's noise is not well known.
    if (least * least - 2.0 * noise * noise > far * far) {
      out_.out_of_reach = "not even the most exact settings come near it";
    } else if (reference_began_ + reference_->SecondsFor(far) > kReferenceShare * report_.budget_seconds) {
      const double budget = (reference_began_ + reference_->SecondsFor(0.5 * bound)) / kReferenceShare;
      out_.out_of_reach = "in this budget the reference would be less exact than that; " +
                          (budget > kMostBudget ? "no budget is large enough"
                                                : "one of about " + TimeWords(budget) + " is large enough");
    }
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

  // The studio is prefiltered once per process, or by the build; a report must include that cost where there is one.
  void PrepareStudioAnew(RenderSettings& settings) const {
    const EnvironmentOptions options{settings.background == Background::Environment, settings.environment_size,
                                     settings.environment_samples, settings.irradiance};
    if (options == kStudioOptions) return;
    settings.environment.kind = EnvironmentSettings::Kind::Image;
    settings.environment.image = studio_;
  }

  template <class Body>
  double SecondsOf(const Body& body) const {
    const double before = clock_();
    body();
    return clock_() - before;
  }

  Drawn Draw(const SettingsText& changed) {
    const RenderSettings settings = SettingsOf(changed);
    Drawn drawn;
    drawn.changed = changed;
    RenderStats stats;
    drawn.spent = SecondsOf([&] {
      drawn.peak_bytes =
          PeakBytes([&] { drawn.seconds = SecondsOf([&] { drawn.film = Render(scene_, settings, &stats); }); });
    });
    out_.target = stats.target;
    out_.threads = stats.threads;
    if (changed.empty()) out_.warnings = stats.warnings;
    return drawn;
  }

  // Its time is preliminary: that of one run.
  void AddPoint(const Drawn& drawn) {
    const double before = Elapsed();
    ReportPoint point;
    point.changed = drawn.changed;
    point.seconds = drawn.seconds;
    point.peak_bytes = drawn.peak_bytes;
    point.error = ErrorOf(drawn.film, *reference_film_);
    const FlipJudge::Verdict flip = flip_->Judge(EncodeFilm(drawn.film, request_.display));
    point.error.flip = flip.mean;
    point.image_png = EncodePng(EncodeFilm(Reduced(drawn.film, kThumbnail), request_.display));
    point.error_map_png = EncodePng(flip_->Map(flip, kThumbnail));
    out_.points.push_back(std::move(point));
    measured_.insert(drawn.changed);
    round_seconds_ += drawn.seconds;
    visits_seconds_ += drawn.spent + (Elapsed() - before);
  }

  void MeasureRounding(const Drawn& used) {
    if (Elapsed() + kDoubleToLanes * used.seconds + kSparedRuns * round_seconds_ > report_.budget_seconds) return;
    Say("rounding");
    const Film exact = RenderInDouble(scene_, resolved_);
    FilmError error = ErrorOf(used.film, exact);
    error.flip = CompareImages(EncodeFilm(exact, request_.display), EncodeFilm(used.film, request_.display)).flip_mean;
    out_.rounding = error;
  }

  // Varies each approximation by itself. One whose cheapest and most exact values make no difference does not apply to
  // this scene.
  void MeasureOneByOne(const Drawn& used) {
    for (Knob& knob : AllKnobs(out_.settings, largest_environment_)) {
      std::vector<std::size_t> ends;
      for (const std::size_t end : {std::size_t(0), knob.Last()}) {
        if (end != knob.used) ends.push_back(end);
      }
      if (!Affords(ends.size())) {
        unmeasured_ += ends.size();
        continue;
      }
      Say(knob.option);
      std::vector<Drawn> drawn;
      for (const std::size_t end : ends) drawn.push_back(Draw({{knob.option, knob.values[end]}}));
      if (std::all_of(drawn.begin(), drawn.end(), [&](const Drawn& d) { return SameBits(d.film, used.film); }))
        continue;
      for (const Drawn& d : drawn) AddPoint(d);
      ApproximationCost cost;
      cost.option = knob.option;
      cost.used = knob.values[knob.used];
      cost.cheapest = knob.values.front();
      cost.most_exact = knob.values.back();
      if (knob.used != knob.Last()) cost.change = ErrorOf(used.film, drawn.back().film).relative_rmse;
      out_.costs.push_back(std::move(cost));
      knobs_.push_back(std::move(knob));
    }
    for (const Knob& knob : knobs_) {
      for (std::size_t i = 1; i < knob.Last(); ++i) {
        if (i != knob.used) MeasurePoint({{knob.option, knob.values[i]}});
      }
    }
  }

  // False: time was up.
  bool MeasurePoint(const SettingsText& changed) {
    if (!Affords(1)) {
      ++unmeasured_;
      return false;
    }
    Say(SettingsWords(changed));
    AddPoint(Draw(changed));
    return true;
  }

  // Extends the Pareto front: from its points one step in every approximation and direction, until there is no new
  // point.
  void MeasureCombinations() {
    for (bool grew = true; grew;) {
      grew = false;
      MarkParetoFront();
      std::vector<SettingsText> next;
      for (const ReportPoint& point : out_.points) {
        if (!point.pareto) continue;
        for (SettingsText& neighbour : NeighboursOf(point.changed, knobs_)) {
          if (measured_.count(neighbour) > 0) continue;
          if (std::find(next.begin(), next.end(), neighbour) == next.end()) next.push_back(std::move(neighbour));
        }
      }
      for (const SettingsText& changed : next) grew = MeasurePoint(changed) || grew;
    }
  }

  // Rounds over all points, forwards and backwards in turn.
  void TimeInTurn() {
    const std::size_t count = out_.points.size();
    std::vector<RenderSettings> settings;
    for (const ReportPoint& point : out_.points) settings.push_back(SettingsOf(point.changed));
    const double in_a_second = double(count) / std::max(round_seconds_, 1e-9);
    const int wanted = out_.out_of_reach.empty()
                           ? static_cast<int>(std::clamp(in_a_second, double(kFewestRuns), double(kMostRuns)))
                           : 1;
    std::vector<std::vector<double>> rounds;
    while (int(rounds.size()) < wanted) {
      if (!rounds.empty() && Elapsed() + round_seconds_ > report_.budget_seconds) break;
      Say("times, round " + std::to_string(rounds.size() + 1) + " of " + std::to_string(wanted));
      std::vector<double>& round = rounds.emplace_back(count);
      const double begun = clock_();
      double last = begun;
      for (std::size_t i = 0; i < count; ++i) {
        const std::size_t point = rounds.size() % 2 == 1 ? i : count - 1 - i;
        Render(scene_, settings[point]);
        const double now = clock_();
        round[point] = now - std::exchange(last, now);
      }
      round_seconds_ = last - begun;
    }
    const std::vector<PointTime> times = TimesOf(rounds);
    for (std::size_t i = 0; i < count; ++i) {
      ReportPoint& point = out_.points[i];
      point.runs = int(rounds.size());
      point.seconds = times[i].median;
      point.seconds_low = times[i].low;
      point.seconds_high = times[i].high;
    }
  }

  // Computes from the points the costs of each approximation's three values.
  void CompleteCosts() {
    for (ApproximationCost& cost : out_.costs) {
      const auto read = [&](const std::string& value, double& error, double& seconds) {
        const SettingsText changed = value == cost.used ? SettingsText{} : SettingsText{{cost.option, value}};
        for (const ReportPoint& point : out_.points) {
          if (point.changed != changed) continue;
          error = point.error.relative_rmse;
          seconds = point.seconds;
        }
      };
      read(cost.used, cost.error_used, cost.seconds_used);
      read(cost.cheapest, cost.error_cheapest, cost.seconds_cheapest);
      read(cost.most_exact, cost.error_most_exact, cost.seconds_most_exact);
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
  std::shared_ptr<const Image> studio_;                        // where it is the light
  int largest_environment_ = std::numeric_limits<int>::max();  // texels that it is prepared with at most
  const ReportSettings& report_;
  const Clock& clock_;
  const double start_;
  const MemoryLease compared_;
  std::unique_ptr<ReferenceRun> reference_;
  double reference_began_ = 0.0;
  const ReferenceFilm* reference_film_ = nullptr;
  std::unique_ptr<FlipJudge> flip_;
  std::vector<Knob> knobs_;  // that make a difference
  std::set<SettingsText> measured_;
  double visits_seconds_ = 0.0;  // of all points so far, including their images
  double round_seconds_ = 0.0;   // of one run of every point
  bool late_ = false;            // there is no time for another point
  std::size_t unmeasured_ = 0;   // points that were planned when the budget ended
  ErrorReport out_;
};

}  // namespace

ErrorReport MeasureErrorsBy(const Clock& clock, const std::filesystem::path& scene, const SettingsText& settings,
                            const ReportSettings& report, const LoadOptions& load) {
  const double start = clock();
  if (!(report.budget_seconds >= 1.0 && report.budget_seconds <= kMostBudget)) {
    throw Error(ErrorCode::InvalidUsage, "a budget of " + std::to_string(report.budget_seconds) + " s",
                "report settings", "1 to 86400 are accepted");
  }
  RefuseUnlessPositive(report.bound);
  RenderRequest request;
  for (const auto& [option, value] : settings) SetOption(request, option, option, value);
  request.settings.threads = report.threads;
  ErrorReport out;
  MemoryBudget budget(load.memory_limit);  // of what is neither loading nor rendering
  const MemoryBudget::Scope scope(budget);
  RunWithThreads(report.threads, [&] {
    const RenderInputs inputs = LoadInputs(scene, request, load);
    out = Sweep(clock, start, inputs.loaded, request, inputs.settings, report).Run();
    const std::vector<std::string>& of_loading = inputs.loaded.report.warnings;
    out.warnings.insert(out.warnings.begin(), of_loading.begin(), of_loading.end());
    out.files = inputs.loaded.report.files;
  });
  out.scene = scene.filename().string();
  return out;
}

ErrorReport MeasureErrors(const std::filesystem::path& scene, const SettingsText& settings,
                          const ReportSettings& report, const LoadOptions& load) {
  return MeasureErrorsBy(SteadySeconds, scene, settings, report, load);
}

}  // namespace facet
