// Work-precision diagrams as SVG.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace facet {

// An axis with a logarithmic scale. Numbers at or below 0 stand at its low end, infinite ones and NaN at its high end.
struct LogAxis {
  double low = 0.1, high = 1.0;  // values at the ends; 0 < low < high
  double from = 0.0, to = 1.0;   // where those stand in the image

  // from + (to - from) (log10 value - log10 low) / (log10 high - log10 low), held between the ends.
  double At(double value) const;
};

// The axis over all positive, finite numbers among `values` and a margin of 6 % at each end; at least a factor of 4.
LogAxis AxisOver(std::span<const double> values, double from, double to);

struct Tick {
  double value;
  bool labelled;
};

// Lines at 1, 2, ... 9 times every power of ten. Labels at 1, 2 and 5 where the axis is short, then at the powers of
// ten, then at some of them: never more than about ten.
std::vector<Tick> Ticks(const LogAxis& axis);

struct DiagramPoint {
  double x = 0.0, error = 0.0;          // x in the unit that x_title names
  std::optional<double> x_low, x_high;  // the spread
  std::string title;                    // shown on hover
  std::string number;                   // what the text calls it
  std::string link;                     // the place in the page that tells more; empty: none
  bool front = false;                   // on the Pareto front
  std::string label;                    // for the one that is marked; else empty
};

// A number of the error axis with its name: a line across the diagram.
struct ErrorLevel {
  double error = 0.0;
  std::string name;
  bool band = false;  // all below is shaded: it cannot be told apart
};

struct Diagram {
  std::string name;  // for readers who do not see
  std::string x_title, y_title;
  std::vector<DiagramPoint> points;
  std::vector<ErrorLevel> levels;
};

// An svg element without a style; classes: frame, minor, major, tick, title, band, level, spread, front, dot, marked,
// off, number, label. Levels more than two powers of ten below all points are named at the lower edge.
std::string ToSvg(const Diagram& diagram);

// Whether a point cannot stand at its place in a diagram with logarithmic axes.
bool OffLogAxes(const DiagramPoint& point);

}  // namespace facet
