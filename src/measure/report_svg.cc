#include "measure/report_svg.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/markup.h"
#include "base/number_text.h"

namespace facet {
namespace {

constexpr double kWidth = 560.0, kHeight = 430.0;
constexpr double kLeft = 72.0, kRight = 546.0, kTop = 12.0, kBottom = 370.0;

bool OnLogAxis(double value) { return std::isfinite(value) && value > 0.0; }

// A position, rounded to an invisible hundredth of a pixel to keep the text short.
std::string Place(double at) { return ShortNumber(std::round(at * 100.0) / 100.0); }

std::string Attribute(const char* name, double at) { return std::string(" ") + name + "=\"" + Place(at) + "\""; }

std::string Line(const std::string& kind, double x1, double y1, double x2, double y2) {
  return "<line class=\"" + kind + "\"" + Attribute("x1", x1) + Attribute("y1", y1) + Attribute("x2", x2) +
         Attribute("y2", y2) + "/>\n";
}

std::string Text(const std::string& kind, double x, double y, const char* anchor, const std::string& text,
                 const std::string& more = {}) {
  return "<text class=\"" + kind + "\"" + Attribute("x", x) + Attribute("y", y) + " text-anchor=\"" + anchor + "\"" +
         more + ">" + Escaped(text) + "</text>\n";
}

// "0.02", or "2·10⁻⁵" on an axis whose plain numbers would be long.
std::string TickLabel(double value, bool powers) {
  if (!powers) return ShortNumber(value);
  const int exponent = int(std::floor(std::log10(value) + 1e-9));
  const std::string digit = ShortNumber(value / std::pow(10.0, exponent), 2), power = PowerOfTen(exponent);
  return digit == "1" ? power : digit + "·" + power;
}

bool NeedsPowers(const std::vector<Tick>& ticks) {
  return std::any_of(ticks.begin(), ticks.end(),
                     [](const Tick& tick) { return tick.labelled && (tick.value < 0.00099 || tick.value > 50001.0); });
}

std::string Grid(const LogAxis& x, const LogAxis& y) {
  std::string svg;
  const std::vector<Tick> across = Ticks(x), up = Ticks(y);
  for (const Tick& tick : across) {
    svg += Line(tick.labelled ? "major" : "minor", x.At(tick.value), kTop, x.At(tick.value), kBottom);
  }
  for (const Tick& tick : up) {
    svg += Line(tick.labelled ? "major" : "minor", kLeft, y.At(tick.value), kRight, y.At(tick.value));
  }
  for (const Tick& tick : across) {
    if (tick.labelled) {
      svg += Text("tick", x.At(tick.value), kBottom + 17.0, "middle", TickLabel(tick.value, NeedsPowers(across)));
    }
  }
  for (const Tick& tick : up) {
    if (tick.labelled)
      svg += Text("tick", kLeft - 7.0, y.At(tick.value) + 4.0, "end", TickLabel(tick.value, NeedsPowers(up)));
  }
  return svg;
}

// Names are at the left, where points lie above most levels, or further right if they would overlap another name.
std::string Levels(const std::vector<ErrorLevel>& levels, const LogAxis& y) {
  std::string svg;
  std::vector<double> lines;
  for (const ErrorLevel& level : levels) {
    const bool shown = level.error >= y.low;
    const double at = shown ? y.At(level.error) : kBottom;
    if (shown && level.band) {
      svg += std::string("<rect class=\"band\"") + Attribute("x", kLeft) + Attribute("y", at) +
             Attribute("width", kRight - kLeft) + Attribute("height", kBottom - at) + "/>\n";
    }
    if (shown) svg += Line("level", kLeft, at, kRight, at);
    const auto near =
        std::count_if(lines.begin(), lines.end(), [at](double line) { return std::abs(line - at) < 14.0; });
    lines.push_back(at);
    const double text = near > 0 && at + 16.0 < kBottom ? at + 13.0 : at - 5.0;
    svg += Text("level", kLeft + 6.0 + 210.0 * double(near), text, "start",
                (shown ? "" : "↓ ") + level.name + " " + ErrorWords(level.error));
  }
  return svg;
}

std::string Front(const std::vector<DiagramPoint>& points, const LogAxis& x, const LogAxis& y) {
  std::vector<const DiagramPoint*> front;
  for (const DiagramPoint& point : points) {
    if (point.front) front.push_back(&point);
  }
  std::stable_sort(front.begin(), front.end(), [](const DiagramPoint* a, const DiagramPoint* b) {
    return a->x != b->x ? a->x < b->x : a->error > b->error;
  });
  std::string places;
  for (const DiagramPoint* point : front) {
    if (!places.empty()) places += ' ';
    places += Place(x.At(point->x)) + "," + Place(y.At(point->error));
  }
  return places.empty() ? "" : "<polyline class=\"front\" points=\"" + places + "\"/>\n";
}

std::string Spread(const DiagramPoint& point, const LogAxis& x, const LogAxis& y) {
  if (!point.x_low || !point.x_high) return {};
  const std::string low = Place(x.At(*point.x_low)), high = Place(x.At(*point.x_high));
  const double at = y.At(point.error);
  const std::string cap = Place(at - 3.0) + "v6";
  return "<path class=\"spread\" d=\"M" + low + " " + Place(at) + "H" + high + "M" + low + " " + cap + "M" + high +
         " " + cap + "\"/>\n";
}

std::string Dot(const DiagramPoint& point, const LogAxis& x, const LogAxis& y) {
  const double at_x = x.At(point.x), at_y = y.At(point.error);
  const bool marked = !point.label.empty();
  const std::string kind = std::string("dot") + (point.front ? " front" : "") + (marked ? " marked" : "") +
                           (OffLogAxes(point) ? " off" : "");
  std::string svg = "<circle class=\"" + kind + "\"" + Attribute("cx", at_x) + Attribute("cy", at_y) +
                    Attribute("r", marked        ? 6.0
                                   : point.front ? 4.5
                                                 : 3.5) +
                    "><title>" + Escaped(point.title) + "</title></circle>\n";
  if (!point.link.empty()) svg = "<a href=\"" + Escaped(point.link) + "\">" + svg + "</a>\n";
  if (marked) {
    const bool right = at_x<kLeft + 0.75 * (kRight - kLeft), above = at_y> kTop + 24.0;
    svg += Text("label", right ? at_x + 8.0 : at_x - 8.0, above ? at_y - 9.0 : at_y + 18.0, right ? "start" : "end",
                point.label);
  }
  return svg;
}

// The labels of points on the front, in the order of `points`; those that would overlap an earlier one are omitted.
std::string Numbers(const std::vector<const DiagramPoint*>& points, const LogAxis& x, const LogAxis& y) {
  std::string svg;
  std::vector<const DiagramPoint*> written;
  for (const DiagramPoint* point : points) {
    const auto covers = [&](const DiagramPoint* other) {
      return std::abs(x.At(other->x) - x.At(point->x)) < 15.0 &&
             std::abs(y.At(other->error) - y.At(point->error)) < 10.0;
    };
    if (!point->front || std::any_of(written.begin(), written.end(), covers)) continue;
    written.push_back(point);
    svg += Text("number", x.At(point->x) - 6.0, y.At(point->error) + 14.0, "end", point->number);
  }
  return svg;
}

LogAxis ErrorAxis(const Diagram& diagram) {
  std::vector<double> errors;
  double least = std::numeric_limits<double>::infinity();
  for (const DiagramPoint& point : diagram.points) {
    errors.push_back(point.error);
    if (OnLogAxis(point.error)) least = std::min(least, point.error);
  }
  for (const ErrorLevel& level : diagram.levels) {
    if (!std::isfinite(least) || level.error >= least / 100.0) errors.push_back(level.error);
  }
  return AxisOver(errors, kBottom, kTop);
}

}  // namespace

double LogAxis::At(double value) const {
  if (!(value > low)) return std::isnan(value) ? to : from;
  if (value >= high) return to;
  return from + (to - from) * (std::log10(value) - std::log10(low)) / (std::log10(high) - std::log10(low));
}

LogAxis AxisOver(std::span<const double> values, double from, double to) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : values) {
    if (!OnLogAxis(value)) continue;
    low = std::min(low, std::log10(value));
    high = std::max(high, std::log10(value));
  }
  if (low > high) low = -1.0, high = 0.0;  // nothing to show: any axis will do
  const double margin = std::max(0.06 * (high - low), 0.5 * (std::log10(4.0) - (high - low)));
  // Within the range of normal doubles.
  return {std::pow(10.0, std::max(low - margin, -307.0)), std::pow(10.0, std::min(high + margin, 308.0)), from, to};
}

std::vector<Tick> Ticks(const LogAxis& axis) {
  const double low = std::log10(axis.low), high = std::log10(axis.high), decades = high - low;
  const int first = int(std::floor(low)), last = int(std::floor(high));
  const int step = 1 + int(decades / 10.0);
  std::vector<Tick> ticks;
  for (int exponent = first; exponent <= last; ++exponent) {
    for (int digit = 1; digit <= (decades <= 5.0 ? 9 : 1); ++digit) {
      const double value = double(digit) * std::pow(10.0, exponent);
      if (value < axis.low || value > axis.high) continue;
      const bool labelled = decades < 2.7 ? digit == 1 || digit == 2 || digit == 5 : digit == 1 && exponent % step == 0;
      ticks.push_back({value, labelled});
    }
  }
  return ticks;
}

bool OffLogAxes(const DiagramPoint& point) { return !OnLogAxis(point.x) || !OnLogAxis(point.error); }

std::string ToSvg(const Diagram& diagram) {
  std::vector<double> xs;
  for (const DiagramPoint& point : diagram.points) {
    xs.push_back(point.x);
    xs.push_back(point.x_low.value_or(point.x));
    xs.push_back(point.x_high.value_or(point.x));
  }
  const LogAxis x = AxisOver(xs, kLeft, kRight), y = ErrorAxis(diagram);
  const double middle_x = 0.5 * (kLeft + kRight), middle_y = 0.5 * (kTop + kBottom);
  std::string svg = "<svg viewBox=\"0 0 " + Place(kWidth) + " " + Place(kHeight) + "\" role=\"img\" aria-label=\"" +
                    Escaped(diagram.name) + "\">\n" + Grid(x, y) + Levels(diagram.levels, y) + "<rect class=\"frame\"" +
                    Attribute("x", kLeft) + Attribute("y", kTop) + Attribute("width", kRight - kLeft) +
                    Attribute("height", kBottom - kTop) + "/>\n";
  for (const DiagramPoint& point : diagram.points) svg += Spread(point, x, y);
  svg += Front(diagram.points, x, y);
  // Points on the front over the others, the marked one over all.
  std::vector<const DiagramPoint*> order;
  for (const DiagramPoint& point : diagram.points) order.push_back(&point);
  std::stable_sort(order.begin(), order.end(), [](const DiagramPoint* a, const DiagramPoint* b) {
    return 2 * !a->label.empty() + a->front < 2 * !b->label.empty() + b->front;
  });
  for (const DiagramPoint* point : order) svg += Dot(*point, x, y);
  std::reverse(order.begin(), order.end());
  svg += Numbers(order, x, y);
  svg += Text("title", middle_x, kHeight - 14.0, "middle", diagram.x_title);
  svg += Text("title", 0.0, 0.0, "middle", diagram.y_title,
              " transform=\"translate(16 " + Place(middle_y) + ") rotate(-90)\"");
  return svg + "</svg>\n";
}

}  // namespace facet
