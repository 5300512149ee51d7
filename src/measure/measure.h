// What a rendering takes, and how far it is from another: the measurements behind a report.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "facet/film.h"
#include "facet/image.h"
#include "facet/report.h"
#include "reference/reference.h"

namespace facet {

// The largest number of bytes by which the process grows while `body` runs, as the kernel counts resident memory; 0
// where it does not say.
std::size_t PeakBytes(const std::function<void()>& body);

// What one point's runs say.
struct PointTime {
  double median = 0.0, low = 0.0, high = 0.0;  // seconds; the fastest and the slowest run
};

// `rounds`: of each round the seconds of every point, one run each. A machine that is slow for a while is so in whole
// rounds, so the median is that of a point's shares of its rounds, times the median round: what slows some rounds slows
// all points alike, whichever of them it caught.
std::vector<PointTime> TimesOf(const std::vector<std::vector<double>>& rounds);

// The error of `film` against what `reference` knows of a picture of the same size, less FLIP.
FilmError ErrorOf(const Film& film, const ReferenceFilm& reference);

// The same against another film.
FilmError ErrorOf(const Film& film, const Film& reference);

// The film at 1 / n of its size, each pixel the mean of n x n, with the smallest n for which no side is longer than
// `longest` pixels; rows and columns that do not fill a pixel are left out.
Film Reduced(const Film& film, int longest);

// FLIP of developed pictures against a reference's. Where that knows blocks of the picture only, each is a picture by
// itself, whose borders FLIP continues outwards: that makes the mean about 3 % larger.
class FlipJudge {
 public:
  // `developed`: of the reference, integers.
  FlipJudge(const ReferenceFilm& reference, const Image& developed);

  struct Verdict {
    double mean = 0.0;
    std::vector<float> errors;  // of each pixel, 0 to 1; 0 where the reference is not known
  };
  Verdict Judge(const Image& developed) const;

  // The errors as HeatMap() shows them, reduced as a film is; transparent where nothing is known.
  Image Map(const Verdict& verdict, int longest) const;

 private:
  Image light_;
  std::vector<PixelBlock> parts_;
  std::size_t known_pixels_;
  bool whole_;
};

}  // namespace facet
