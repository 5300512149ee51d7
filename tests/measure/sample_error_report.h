// A report as MeasureErrors() gives it, with made-up numbers.
#pragma once

#include <string>

#include "facet/report.h"

namespace facet::test {

inline ReportPoint SamplePoint(SettingsText changed, double ms, double relative, std::size_t mib, bool pareto) {
  ReportPoint point;
  point.changed = std::move(changed);
  point.runs = 5;
  point.seconds = ms / 1e3;
  point.seconds_low = 0.93 * point.seconds;
  point.seconds_high = 1.17 * point.seconds;
  point.peak_bytes = mib * 1048576 + 4096;
  point.error = {0.25 * relative, relative, 32.0 * relative, 0.5 * relative, 0.0};
  point.pareto = pareto;
  return point;
}

inline ErrorReport SampleErrorReport() {
  ErrorReport report;
  report.version = "1.2.3";
  report.scene = "a<b>&\"c\".glb";
  report.target = "AVX2";
  report.threads = 2;
  report.width = 480;
  report.height = 320;
  report.settings = {
      {"samples", "4"}, {"max-anisotropy", "8"}, {"prefilter-size", "256"}, {"texels", "half"}, {"size", "480x320"}};
  report.reference = {256, 8, 480 * 320, 31.5, 0.00009, 0.0004, {"textures without mips", "2 texels < 0 were set to 0"},
                      {}};
  report.rounding = FilmError{1.1e-7, 4.2e-7, 3e-5, 1e-8, 0.0};
  report.points = {
      SamplePoint({}, 62, 0.0061, 88, true),
      SamplePoint({{"samples", "1"}}, 21, 0.041, 61, false),
      SamplePoint({{"samples", "2"}}, 36, 0.0152, 70, true),
      SamplePoint({{"samples", "8"}}, 115, 0.0031, 124, true),
      SamplePoint({{"samples", "16"}}, 228, 0.00192, 196, true),
      SamplePoint({{"samples", "32"}}, 470, 0.00145, 340, true),
      SamplePoint({{"max-anisotropy", "1"}}, 55, 0.0174, 88, false),
      SamplePoint({{"max-anisotropy", "16"}}, 71, 0.0060, 88, true),
      SamplePoint({{"prefilter-size", "64"}}, 61, 0.0132, 62, true),
      SamplePoint({{"texels", "float"}}, 68, 0.00608, 142, true),
      SamplePoint({{"max-anisotropy", "1"}, {"samples", "1"}}, 17.5, 0.058, 61, true),
      SamplePoint({{"prefilter-size", "64"}, {"samples", "1"}}, 20, 0.046, 44, true),
      SamplePoint({{"max-anisotropy", "16"}, {"prefilter-size", "512"}, {"samples", "64"}, {"texels", "float"}}, 1340,
                  0.00036, 910, true)};
  report.costs = {{"max-anisotropy", "8", "1", "16", 0.0061, 0.0174, 0.0060, 0.062, 0.055, 0.071, 0.0004},
                  {"samples", "4", "1", "64", 0.0061, 0.041, 0.0012, 0.062, 0.021, 0.93, 0.0057},
                  {"texels", "half", "half", "float", 0.0061, 0.0061, 0.00608, 0.062, 0.062, 0.068, 0.00003}};
  report.seconds = 58.2;
  report.planned_points = 20;
  return report;
}

}  // namespace facet::test
