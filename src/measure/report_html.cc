// The report as a self-contained HTML page without network access and JavaScript. It is also well-formed XML.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "base/base64.h"
#include "base/markup.h"
#include "base/number_text.h"
#include "facet/report.h"
#include "measure/knobs.h"
#include "measure/report_svg.h"
#include "settings/render_request.h"

namespace facet {
namespace {

constexpr std::string_view kStyle = R"(
:root { color-scheme: light dark; --paper: #fff; --ink: #1b1f24; --soft: #59636e; --line: #c9ced6; --faint: #eceef1;
  --front: #0b5cad; --mark: #c2410c; --band: #f1e3c6; --bar: #d5e4f5; }
@media (prefers-color-scheme: dark) {
  :root { --paper: #14171b; --ink: #e3e7ec; --soft: #9aa4af; --line: #414851; --faint: #23282e;
    --front: #6cb1f5; --mark: #ff9a5c; --band: #3a3020; --bar: #1d3a5a; }
}
body { font: 15px/1.5 system-ui, sans-serif; margin: 2em auto; padding: 0 1.5em; max-width: 82em;
  background: var(--paper); color: var(--ink); }
h1 { font-size: 1.55em; line-height: 1.2; margin: 0 0 .3em; } h2 { font-size: 1.2em; margin: 2em 0 .5em; }
p { max-width: 54em; margin: .4em 0; } .soft, figcaption, th { color: var(--soft); }
code { font-size: .88em; overflow-wrap: anywhere; }
.diagrams { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(30em, 100%), 1fr)); gap: 1.5em;
  margin: 1.5em 0; }
figure { margin: 0; } figcaption { font-size: .88em; margin-top: .5em; } figcaption b { color: var(--ink); }
svg { display: block; width: 100%; height: auto; font: 12.5px system-ui, sans-serif; }
svg text { fill: var(--ink); } svg .title { font-size: 13.5px; }
svg .number, svg .label, svg text.level { paint-order: stroke; stroke: var(--paper); stroke-width: 3px;
  stroke-linejoin: round; }
svg .number { font-size: 11px; fill: var(--front); } svg .label { font-weight: 600; fill: var(--mark); }
svg text.level { font-size: 11.5px; fill: var(--soft); stroke: none; }
.frame { fill: none; stroke: var(--ink); } .minor { stroke: var(--faint); } .major { stroke: var(--line); }
.band { fill: var(--band); } line.level { stroke: var(--soft); stroke-dasharray: 5 3; }
.spread { fill: none; stroke: var(--soft); opacity: .7; }
polyline.front { fill: none; stroke: var(--front); stroke-width: 1.6; }
.dot { fill: var(--paper); stroke: var(--soft); stroke-width: 1.4; } .dot:hover { stroke-width: 4; }
.dot.front { fill: var(--front); stroke: var(--paper); stroke-width: 1; }
.dot.marked { stroke: var(--mark); stroke-width: 2.6; }
.dot.off { fill: var(--paper); stroke: var(--soft); stroke-dasharray: 2 2; }
.wide { overflow-x: auto; } table { border-collapse: collapse; margin: .8em 0; font-size: .93em; }
table { border-top: 1.5px solid var(--ink); border-bottom: 1.5px solid var(--ink); }
thead tr:last-child { border-bottom: 1px solid var(--ink); } th { font-weight: 500; }
th, td { text-align: left; padding: .22em .9em .22em 0; white-space: nowrap; } td.settings { white-space: normal; }
th.number, td.number { text-align: right; font-variant-numeric: tabular-nums; }
th.group { text-align: center; border-bottom: 1px solid var(--line); }
a { color: inherit; text-decoration-color: var(--line); text-underline-offset: .2em; }
tr.dominated td { color: var(--soft); } td.mark { color: var(--front); } tr.asked td.settings { color: var(--mark); }
td.bar { background: linear-gradient(to right, var(--bar) var(--share), transparent 0); padding-left: 6em;
  padding-right: .3em; }
tr:target, .card:target { outline: 2px solid var(--mark); }
.cards { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(22em, 100%), 1fr)); gap: 1.2em; }
.card div { display: flex; gap: .4em; } .card img { flex: 1 1 0; min-width: 0; }
img { image-rendering: pixelated; background: repeating-conic-gradient(#bbb 0 25%, #fff 0 50%) 0 0 / 16px 16px; }
)";

// A unit of an axis: the largest one in which the least value is at least 0.5.
struct Unit {
  double size;
  const char* name;
};
constexpr Unit kTimes[] = {{1.0, "s"}, {1e-3, "ms"}, {1e-6, "µs"}};
constexpr Unit kSizes[] = {{1073741824.0, "GiB"}, {1048576.0, "MiB"}, {1024.0, "KiB"}};

template <std::size_t N>
Unit UnitFor(const Unit (&units)[N], double least) {
  for (const Unit& unit : units) {
    if (least >= 0.5 * unit.size) return unit;
  }
  return units[N - 1];
}

// A point and its label in the page, which is its rank by error.
struct Ranked {
  const ReportPoint* point;
  std::string number;
  bool asked;  // whether it has the requested settings
};

double SortKey(double value) { return std::isnan(value) ? std::numeric_limits<double>::infinity() : value; }

std::vector<Ranked> RankedByError(const ErrorReport& report) {
  std::vector<Ranked> ranked;
  for (const ReportPoint& point : report.points) ranked.push_back({&point, {}, &point == report.points.data()});
  std::stable_sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) {
    return SortKey(a.point->error.relative_rmse) < SortKey(b.point->error.relative_rmse);
  });
  for (std::size_t i = 0; i < ranked.size(); ++i) ranked[i].number = std::to_string(i + 1);
  return ranked;
}

// Whether all approximations have their default values in the requested settings. Points differ in no other options.
bool AskedForDefaults(const ErrorReport& report) {
  const std::span<const RequestOption> options = RequestOptions();
  return std::all_of(options.begin(), options.end(), [&](const RequestOption& option) {
    const auto asked = report.settings.find(std::string(option.name));
    return option.sweep.empty() || asked == report.settings.end() || asked->second == option.initial;
  });
}

std::string AskedName(const ErrorReport& report) { return AskedForDefaults(report) ? "default" : "asked for"; }

bool HasImages(const ReportPoint& point) { return !point.image_png.empty() || !point.error_map_png.empty(); }

std::string Cell(const std::string& text) { return "<td class=\"number\">" + Escaped(text) + "</td>"; }

std::string Count(std::size_t count, const char* one, const char* more) {
  return std::to_string(count) + " " + (count == 1 ? one : more);
}

std::string Heading(const ErrorReport& report) {
  std::string html = "<h1>Error against run time: " + Escaped(report.scene) + "</h1>\n<p>" +
                     std::to_string(report.width) + " × " + std::to_string(report.height) + " pixels, " +
                     Count(std::size_t(report.threads), "thread", "threads") +
                     ", instructions: " + Escaped(report.target) + ", facet " + Escaped(report.version) + ". " +
                     Count(report.points.size(), "point", "points") + " in " + TimeWords(report.seconds) + ".";
  if (!report.complete) {
    html += " <b>The budget ended before all of the " + std::to_string(report.planned_points) +
            " points that were planned.</b>";
  }
  return html + "</p>\n<p class=\"soft\">Settings: <code>" + Escaped(SettingsWords(report.settings)) + "</code></p>\n";
}

std::string ReferenceText(const ErrorReport& report) {
  const ErrorReport::Reference& r = report.reference;
  const auto below = std::count_if(report.points.begin(), report.points.end(), [&](const ReportPoint& point) {
    return point.error.relative_rmse <= r.relative_error;
  });
  const std::size_t all = std::size_t(report.width) * std::size_t(report.height);
  std::string html = "<p>The reference is computed in double with " + std::to_string(r.samples) +
                     " samples a pixel in each of " + Count(std::size_t(r.batches), "batch", "batches") + ", in " +
                     TimeWords(r.seconds) + ". It estimates its own remaining error as " +
                     ErrorWords(r.relative_error) + " (relative RMSE; RMSE " + ErrorWords(r.rms_error) +
                     "): points in the shaded band cannot be told apart. " +
                     (below == 0 ? "None is" : Count(std::size_t(below), "point is", "points are")) + " there.</p>\n";
  if (r.pixels < all) {
    html += "<p>There was time for " + Grouped(r.pixels) + " of the picture's " + Grouped(all) +
            " pixels, in blocks spread evenly over it: all errors are over these, and the relative RMSE of the whole "
            "picture is within about the ± given. A larger budget gives more of them.</p>\n";
  }
  if (r.notes.empty()) return html;
  html += "<ul>\n";
  for (const std::string& note : r.notes) html += "<li>" + Escaped(note) + "</li>\n";
  return html + "</ul>\n";
}

// The measure on a diagram's error axis.
struct Measure {
  const char* name;
  const char* y_title;
  double FilmError::*error;
};
constexpr Measure kRelative = {"Error", "error: relative RMSE, linear light", &FilmError::relative_rmse};
constexpr Measure kFlip = {"FLIP", "mean FLIP of the encoded images", &FilmError::flip};
constexpr Measure kLargest = {"Largest difference", "largest difference, linear light", &FilmError::largest};

// The parts that all diagrams of a measure share. The caller sets x.
Diagram DiagramOf(const ErrorReport& report, const std::vector<Ranked>& ranked, const Measure& measure) {
  Diagram diagram;
  diagram.y_title = measure.y_title;
  if (measure.error == kRelative.error) {
    diagram.levels.push_back({report.reference.relative_error, "reference's own error", true});
  }
  if (report.rounding) diagram.levels.push_back({(*report.rounding).*measure.error, "rounding error", false});
  for (const Ranked& r : ranked) {
    DiagramPoint& point = diagram.points.emplace_back();
    point.error = r.point->error.*measure.error;
    point.number = r.number;
    point.title = r.number + ": " + SettingsWords(r.point->changed) + ", relative RMSE " +
                  ErrorWords(r.point->error.relative_rmse) + ", " + TimeWords(r.point->seconds);
    if (r.point->peak_bytes > 0) point.title += ", " + BytesWords(double(r.point->peak_bytes));
    point.link = (HasImages(*r.point) ? "#picture-" : "#point-") + r.number;
    if (r.asked) point.label = AskedName(report);
  }
  return diagram;
}

std::string Captioned(const Diagram& diagram, const std::string& caption) {
  const auto off = std::size_t(std::count_if(diagram.points.begin(), diagram.points.end(), OffLogAxes));
  std::string html = "<figure>\n" + ToSvg(diagram) + "<figcaption><b>" + diagram.name + ".</b> " + caption;
  if (off > 0) {
    html += " " + Count(off, "point has", "points have") +
            " a zero or no finite number, which logarithmic axes cannot show: dashed, at the edge.";
  }
  return html + "</figcaption>\n</figure>\n";
}

// Marks the Pareto front: the points that no other point dominates in x and error.
void MarkFront(std::vector<DiagramPoint>& points) {
  for (DiagramPoint& point : points) {
    point.front = std::none_of(points.begin(), points.end(), [&](const DiagramPoint& other) {
      return other.x <= point.x && other.error <= point.error && (other.x < point.x || other.error < point.error);
    });
  }
}

std::string TimeDiagram(const ErrorReport& report, const std::vector<Ranked>& ranked, const Measure& measure,
                        const std::string& caption) {
  Diagram diagram = DiagramOf(report, ranked, measure);
  double least = std::numeric_limits<double>::infinity();
  for (const ReportPoint& point : report.points) {
    if (point.seconds > 0.0) least = std::min(least, point.seconds);
  }
  const Unit unit = UnitFor(kTimes, least);
  diagram.name = std::string(measure.name) + " against run time";
  diagram.x_title = std::string("run time (") + unit.name + ")";
  for (std::size_t i = 0; i < ranked.size(); ++i) {
    const ReportPoint& from = *ranked[i].point;
    DiagramPoint& point = diagram.points[i];
    point.x = from.seconds / unit.size;
    if (from.runs > 1) {
      point.x_low = from.seconds_low / unit.size;
      point.x_high = from.seconds_high / unit.size;
    }
  }
  MarkFront(diagram.points);
  return Captioned(diagram, caption);
}

std::string MemoryDiagram(const ErrorReport& report, const std::vector<Ranked>& ranked) {
  const Diagram all = DiagramOf(report, ranked, kRelative);
  Diagram diagram = all;
  diagram.points.clear();
  std::size_t least = 0;
  for (const ReportPoint& point : report.points) {
    if (point.peak_bytes > 0 && (least == 0 || point.peak_bytes < least)) least = point.peak_bytes;
  }
  if (least == 0) return "<p>How much memory the points need is not known.</p>\n";
  const Unit unit = UnitFor(kSizes, double(least));
  for (std::size_t i = 0; i < ranked.size(); ++i) {
    if (ranked[i].point->peak_bytes == 0) continue;
    diagram.points.push_back(all.points[i]);
    diagram.points.back().x = double(ranked[i].point->peak_bytes) / unit.size;
  }
  MarkFront(diagram.points);
  diagram.name = "Error against memory";
  diagram.x_title = std::string("most memory while rendering (") + unit.name + ")";
  std::string caption = "The same points. Filled and joined: no other point has less error without more memory.";
  const std::size_t omitted = ranked.size() - diagram.points.size();
  if (omitted > 0) caption += " " + Count(omitted, "point is", "points are") + " left out, for want of a known memory.";
  return Captioned(diagram, caption);
}

std::string CostsTable(const ErrorReport& report) {
  if (report.costs.empty()) return {};
  const auto size_of = [](double change) { return std::isfinite(change) ? change : 0.0; };
  std::vector<const ApproximationCost*> costs;
  for (const ApproximationCost& cost : report.costs) costs.push_back(&cost);
  std::stable_sort(costs.begin(), costs.end(), [&](const ApproximationCost* a, const ApproximationCost* b) {
    return size_of(a->change) > size_of(b->change);
  });
  const double largest = size_of(costs.front()->change);
  std::string html =
      "<h2>What each approximation costs</h2>\n<p>One at a time, all else as asked for. <i>Alone</i>: the relative "
      "RMSE "
      "between the pictures with the value used and with the most exact one, which is what this approximation changes; "
      "the errors before it are all approximations' together, against the reference.</p>\n"
      "<div class=\"wide\"><table>\n<thead><tr><th></th><th class=\"group\" colspan=\"3\">value</th>"
      "<th class=\"group\" colspan=\"3\">relative RMSE</th><th class=\"group\" colspan=\"3\">time</th><th></th></tr>\n"
      "<tr><th>option</th><th>cheapest</th><th>used</th><th>most exact</th><th class=\"number\">cheapest</th>"
      "<th class=\"number\">used</th><th class=\"number\">most exact</th><th class=\"number\">cheapest</th>"
      "<th class=\"number\">used</th><th class=\"number\">most exact</th><th class=\"number\">alone</th></tr></thead>\n"
      "<tbody>\n";
  for (const ApproximationCost* c : costs) {
    const double share = largest > 0.0 ? 100.0 * size_of(c->change) / largest : 0.0;
    html += "<tr><td><code>" + Escaped(c->option) + "</code></td><td>" + Escaped(c->cheapest) + "</td><td>" +
            Escaped(c->used) + "</td><td>" + Escaped(c->most_exact) + "</td>" + Cell(ErrorWords(c->error_cheapest)) +
            Cell(ErrorWords(c->error_used)) + Cell(ErrorWords(c->error_most_exact)) +
            Cell(TimeWords(c->seconds_cheapest)) + Cell(TimeWords(c->seconds_used)) +
            Cell(TimeWords(c->seconds_most_exact)) +
            "<td class=\"number bar\" style=\"--share: " + std::to_string(int(std::lround(share))) + "%\">" +
            ErrorWords(c->change) + "</td></tr>\n";
  }
  return html + "</tbody>\n</table></div>\n";
}

std::string RoundingWords(double rounding, double approximation) {
  const std::string are = "The same algorithm in double differs by a relative RMSE of " + ErrorWords(rounding) +
                          ": the rounding error of floats. Against the reference the settings asked for differ by " +
                          ErrorWords(approximation);
  if (!(rounding >= 0.0 && approximation > 0.0) || std::isinf(rounding)) return are + ".";
  if (rounding == 0.0) return are + ": all of it is approximation.";
  const double ratio = approximation / rounding;
  if (ratio >= 10.0) return are + ", " + ErrorWords(ratio) + " times as much: the error is that of approximations.";
  if (ratio >= 1.0) return are + ", only " + ErrorWords(ratio) + " times as much: rounding is part of the error.";
  return are + ", which is less: rounding hides what the approximations change.";
}

std::string Rounding(const ErrorReport& report) {
  std::string html = "<h2>Rounding against approximation</h2>\n";
  if (!report.rounding) return html + "<p>The rounding error was not measured.</p>\n";
  const auto row = [](const char* what, const FilmError& e) {
    return std::string("<tr><td>") + what + "</td>" + Cell(ErrorWords(e.rmse)) + Cell(ErrorWords(e.relative_rmse)) +
           Cell(ErrorWords(e.largest)) + Cell(ErrorWords(e.flip)) + "</tr>\n";
  };
  if (!report.points.empty()) {
    html += "<p>" + RoundingWords(report.rounding->relative_rmse, report.points[0].error.relative_rmse) + "</p>\n";
  }
  html +=
      "<div class=\"wide\"><table>\n<thead><tr><th></th><th class=\"number\">RMSE</th><th class=\"number\">relative "
      "RMSE</th>"
      "<th class=\"number\">largest</th><th class=\"number\">FLIP</th></tr></thead>\n<tbody>\n" +
      row("rounding: floats against double, same algorithm", *report.rounding);
  if (!report.points.empty()) html += row("approximation and rounding: against the reference", report.points[0].error);
  return html + "<tr><td>the reference's own error</td>" + Cell(ErrorWords(report.reference.rms_error)) +
         Cell(ErrorWords(report.reference.relative_error)) + Cell("") + Cell("") + "</tr>\n</tbody>\n</table></div>\n";
}

// The standard error of the relative RMSE, if it is above 0.
std::string Uncertainty(const FilmError& error) {
  return error.standard_error > 0.0 ? " ± " + ErrorWords(error.standard_error) : std::string();
}

std::string PointsTable(const ErrorReport& report, const std::vector<Ranked>& ranked) {
  std::string html =
      "<h2>All points</h2>\n<p>By error; ● marks the Pareto front of error and time. Errors are over all "
      "pixels and colours in linear light, but for FLIP, which is the mean over the encoded images.</p>\n"
      "<div class=\"wide\"><table>\n<thead><tr><th class=\"number\">no.</th><th></th><th>settings</th>"
      "<th class=\"number\">time, median</th><th class=\"number\">fastest</th><th class=\"number\">slowest</th>"
      "<th class=\"number\">runs</th><th class=\"number\">memory</th><th class=\"number\">relative RMSE</th>"
      "<th class=\"number\">RMSE</th><th class=\"number\">largest</th><th "
      "class=\"number\">FLIP</th></tr></thead>\n<tbody>\n";
  for (const Ranked& r : ranked) {
    const ReportPoint& p = *r.point;
    std::string kind = p.pareto ? "front" : "dominated";
    if (r.asked) kind += " asked";
    std::string settings = Escaped(SettingsWords(p.changed));
    if (HasImages(p)) settings = "<a href=\"#picture-" + r.number + "\">" + settings + "</a>";
    if (r.asked && AskedForDefaults(report)) settings += " (default)";
    html += "<tr id=\"point-" + r.number + "\" class=\"" + kind + "\">" + Cell(r.number) + "<td class=\"mark\">" +
            (p.pareto ? "●" : "") + "</td><td class=\"settings\">" + settings + "</td>" + Cell(TimeWords(p.seconds)) +
            Cell(TimeWords(p.seconds_low)) + Cell(TimeWords(p.seconds_high)) + Cell(std::to_string(p.runs)) +
            Cell(p.peak_bytes == 0 ? "not known" : BytesWords(double(p.peak_bytes))) +
            Cell(ErrorWords(p.error.relative_rmse) + Uncertainty(p.error)) + Cell(ErrorWords(p.error.rmse)) +
            Cell(ErrorWords(p.error.largest)) + Cell(ErrorWords(p.error.flip)) + "</tr>\n";
  }
  return html + "</tbody>\n</table></div>\n";
}

std::string ImageTag(const std::string& alt, const std::vector<std::byte>& png) {
  if (png.empty()) return {};
  return "<img alt=\"" + Escaped(alt) + "\" src=\"data:image/png;base64," + Base64(png) + "\"/>";
}

std::string Gallery(const ErrorReport& report, const std::vector<Ranked>& ranked) {
  std::string cards;
  for (const Ranked& r : ranked) {
    if (!HasImages(*r.point)) continue;
    const std::string words = SettingsWords(r.point->changed);
    cards += "<figure class=\"card\" id=\"picture-" + r.number + "\"><div>" +
             ImageTag("picture with " + words, r.point->image_png) +
             ImageTag("error map of " + words, r.point->error_map_png) + "</div><figcaption><b>" + r.number + "</b> " +
             Escaped(words) + "<br/>relative RMSE " + ErrorWords(r.point->error.relative_rmse) + ", FLIP " +
             ErrorWords(r.point->error.flip) + ", " + TimeWords(r.point->seconds) + "</figcaption></figure>\n";
  }
  if (cards.empty()) return {};
  if (!report.reference.image_png.empty()) {
    cards = "<figure class=\"card\"><div>" + ImageTag("picture by the reference", report.reference.image_png) +
            "</div><figcaption>the reference</figcaption></figure>\n" + cards;
  }
  return "<h2>Pictures</h2>\n<p>Each with its error map, FLIP against the reference: the brighter, the more people see "
         "it."
         "</p>\n<div class=\"cards\">\n" +
         cards + "</div>\n";
}

}  // namespace

std::string ToHtml(const ErrorReport& report) {
  const std::vector<Ranked> ranked = RankedByError(report);
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
         "<meta name=\"viewport\" content=\"width=device-width\"/>\n<title>Error against run time: " +
         Escaped(report.scene) + "</title>\n<style>" + std::string(kStyle) + "</style>\n</head>\n<body>\n" +
         Heading(report) + ReferenceText(report) + "<div class=\"diagrams\">\n" +
         TimeDiagram(report, ranked, kRelative,
                     "A dot is a choice of settings, at the median of its runs; the bar spans them from the fastest to "
                     "the slowest. Filled and joined: the Pareto front, where no other point has both less error and "
                     "less time. Numbers are those of the table.") +
         MemoryDiagram(report, ranked) +
         TimeDiagram(report, ranked, kFlip, "What people see of the error, with a front of its own.") +
         TimeDiagram(report, ranked, kLargest, "The worst pixel: often one glint.") + "</div>\n" + CostsTable(report) +
         Rounding(report) + PointsTable(report, ranked) + Gallery(report, ranked) + "</body>\n</html>\n";
}

}  // namespace facet
