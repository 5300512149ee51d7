// Work-precision diagrams as SVG.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace facet {

// An axis with a logarithmic scale. Values at or below 0 are at its low end, infinity and NaN at its high end.
struct LogAxis {
  double low = 0.1, high = 1.0;  // values at the ends; 0 < low < high
  double from = 0.0, to = 1.0;   // positions of the ends in the image

  // from + (to - from) (log10 value - log10 low) / (log10 high - log10 low), clamped to the ends.
  double At(double value) const;
};

// An axis over all positive, finite `values` with a margin of 6 % at each end. It spans at least a factor of 4.
LogAxis AxisOver(std::span<const double> values, double from, double to);

struct Tick {
  double value;
  bool labelled;
};

// Lines at 1, 2, ... 9 times every power of ten. Labels are at 1, 2 and 5 on short axes, at powers of ten on longer
// ones, and at some of these on the longest: never more than about ten.
std::vector<Tick> Ticks(const LogAxis& axis);

struct DiagramPoint {
  double x = 0.0, error = 0.0;          // x in the unit that x_title names
  std::optional<double> x_low, x_high;  // the spread
  std::string title;                    // shown on hover
  std::string number;                   // its label in the text
  std::string link;                     // link to its details in the page; empty: none
  bool front = false;                   // on the Pareto front
  std::string label;                    // for the marked point; empty for others
};

// A named value on the error axis, drawn as a line across the diagram.
struct ErrorLevel {
  double error = 0.0;
  std::string name;
  bool band = false;  // shades the area below, where errors are indistinguishable
};

struct Diagram {
  std::string name;  // for screen readers
  std::string x_title, y_title;
  std::vector<DiagramPoint> points;
  std::vector<ErrorLevel> levels;
};

// An svg element without a style; classes: frame, minor, major, tick, title, band, level, spread, front, dot, marked,
// off, number, label. Levels more than two powers of ten below all points are named at the lower edge.
std::string ToSvg(const Diagram& diagram);

// Whether a point has values that logarithmic axes cannot show.
bool OffLogAxes(const DiagramPoint& point);

}  // namespace facet
