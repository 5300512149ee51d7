// The measurements of a report: time, memory and error of a rendering.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "facet/film.h"
#include "facet/image.h"
#include "facet/report.h"
#include "reference/reference.h"

namespace facet {

// The peak growth of the process's resident memory while `body` runs, in bytes; 0 if the kernel does not report it.
std::size_t PeakBytes(const std::function<void()>& body);

// The times of one point's runs.
struct PointTime {
  double median = 0.0, low = 0.0, high = 0.0;  // seconds; the fastest and the slowest run
};

// `rounds`: for each round the seconds of all points, with one run each. If the machine becomes slow for a while, it
// affects whole rounds. The result is therefore the median of a point's share of each round, times the median round,
// which treats all points alike.
std::vector<PointTime> TimesOf(const std::vector<std::vector<double>>& rounds);

// The error of `film` against the known pixels of `reference`, which has the same size. Without FLIP.
FilmError ErrorOf(const Film& film, const ReferenceFilm& reference);

// The same against another film.
FilmError ErrorOf(const Film& film, const Film& reference);

// The film at 1 / n of its size, with pixels that are means of n x n pixels, for the smallest n for which no side is
// longer than `longest` pixels. Rows and columns that do not fill a pixel are dropped.
Film Reduced(const Film& film, int longest);

// FLIP of encoded images against a reference. If the reference has only some blocks of the image, each block is
// compared as an image of its own, whose borders FLIP extends outwards; this makes the mean about 3 % larger.
class FlipJudge {
 public:
  // `encoded`: the encoded reference, with integer components.
  FlipJudge(const ReferenceFilm& reference, const Image& encoded);

  struct Verdict {
    double mean = 0.0;
    std::vector<float> errors;  // of each pixel, 0 to 1; 0 where the reference is unknown
  };
  Verdict Judge(const Image& encoded) const;

  // The errors in the colours of HeatMap(), reduced like a film; transparent where the reference is unknown.
  Image Map(const Verdict& verdict, int longest) const;

 private:
  Image light_;
  std::vector<PixelBlock> parts_;
  std::size_t known_pixels_;
  bool whole_;
};

}  // namespace facet
