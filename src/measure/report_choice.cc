// Chooses the cheapest point of a report that keeps a bound.
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "base/number_text.h"
#include "base/printable.h"
#include "facet/error.h"
#include "facet/report.h"
#include "measure/knobs.h"
#include "measure/measure_errors.h"

namespace facet {
namespace {

void RefuseUnlessPositive(const std::optional<double>& bound, const char* what) {
  if (!bound || (std::isfinite(*bound) && *bound > 0.0)) return;
  throw Error(ErrorCode::InvalidUsage, std::string(what) + " " + ShortNumber(*bound) + " cannot be kept", {},
              "give a finite number above 0");
}

// An unknown value (NaN) keeps no bound and counts as the farthest from it.
double KnownOrInfinite(double value) { return std::isnan(value) ? std::numeric_limits<double>::infinity() : value; }

std::string Error4(double error) { return std::isnan(error) ? ErrorWords(error) : ShortNumber(error, 4); }

}  // namespace

void RefuseUnlessPositive(const Bound& bound) {
  RefuseUnlessPositive(bound.max_relative_rmse, "the largest relative error");
  RefuseUnlessPositive(bound.max_seconds, "the longest time, in seconds,");
}

Choice ChoosePoint(const ErrorReport& report, const Bound& bound) {
  if (!bound.max_relative_rmse && !bound.max_seconds) {
    throw Error(ErrorCode::InvalidUsage, "there is nothing to choose by", {},
                "give a largest error, a longest time or both");
  }
  RefuseUnlessPositive(bound);
  if (report.points.empty()) {
    throw Error(ErrorCode::InvalidInput, "the report has no points", Printable(report.scene),
                "measure with a larger budget");
  }

  constexpr double kNone = std::numeric_limits<double>::infinity();
  const double max_error = bound.max_relative_rmse.value_or(kNone), max_seconds = bound.max_seconds.value_or(kNone);
  // Points that keep the bound come before those that do not. Among the former the time decides, or the error where
  // only the time is bounded; among the latter, by what factor the worse of the bounds is missed. Smaller is better.
  using Rank = std::tuple<bool, double>;
  const auto rank = [&](const ReportPoint& point) -> Rank {
    const double error = KnownOrInfinite(point.error.relative_rmse), seconds = KnownOrInfinite(point.seconds);
    const bool kept =
        (!bound.max_relative_rmse || error <= max_error) && (!bound.max_seconds || seconds <= max_seconds);
    if (kept) return {false, bound.max_relative_rmse ? seconds : error};
    if (!bound.max_seconds) return {true, error};
    if (!bound.max_relative_rmse) return {true, seconds};
    return {true, std::max(error / max_error, seconds / max_seconds)};
  };
  const auto best = std::min_element(report.points.begin(), report.points.end(),
                                     [&](const ReportPoint& a, const ReportPoint& b) { return rank(a) < rank(b); });
  const auto kept_count = std::count_if(report.points.begin(), report.points.end(),
                                        [&](const ReportPoint& point) { return !std::get<0>(rank(point)); });

  Choice choice;
  choice.point = std::size_t(best - report.points.begin());
  choice.kept = kept_count > 0;
  const std::string error = Error4(best->error.relative_rmse), seconds = TimeWords(best->seconds);
  std::string bounds, values;
  if (bound.max_relative_rmse) {
    bounds = "relative RMSE " + Error4(max_error);
    values = "relative RMSE " + error;
  }
  if (bound.max_seconds) {
    bounds += (bounds.empty() ? "" : " and ") + TimeWords(max_seconds);
    values += (values.empty() ? "" : " and ") + seconds;
  }
  std::string& why = choice.why;
  if (!choice.kept) {
    const std::string count = std::to_string(report.points.size());
    why = (count == "1" ? "the only point does not keep " : "none of " + count + " points keeps ") + bounds +
          "; takes the nearest, " + SettingsWords(best->changed) + ": " + values;
    const double noise = report.reference.relative_error;
    if (report.out_of_reach.empty() && max_error <= noise && best->error.relative_rmse < 2.0 * noise) {
      why += "; the reference itself is off by " + Error4(noise) + ", by less in a larger budget";
    }
  } else {
    why = "takes " + SettingsWords(best->changed) + ": ";
    if (bound.max_relative_rmse) why += "relative RMSE " + error + " is within " + Error4(max_error);
    if (bound.max_relative_rmse && bound.max_seconds) why += ", and ";
    if (bound.max_seconds) why += "its " + seconds + " are within " + TimeWords(max_seconds);
    const std::string of_those = " the least of " + std::to_string(kept_count) + " such points";
    if (kept_count == 1) {
      why += "; it is the only such point";
    } else if (bound.max_relative_rmse && bound.max_seconds) {
      why += " and" + of_those;
    } else if (bound.max_seconds) {
      why += ", and its relative RMSE " + error + " is" + of_those;
    } else {
      why += ", and its " + seconds + " are" + of_those;
    }
  }
  why = Printable(why);
  return choice;
}

}  // namespace facet
