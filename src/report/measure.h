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

// The error of `film` against `reference`, both of one size, less FLIP.
FilmError ErrorOf(const Film& film, const ReferenceFilm& reference);

// The same against another film.
FilmError ErrorOf(const Film& film, const Film& reference);

// The film at 1 / n of its size, each pixel the mean of n x n, with the smallest n for which no side is longer than
// `longest` pixels; rows and columns that do not fill a pixel are left out.
Film Reduced(const Film& film, int longest);

// The same for a picture of type F32 with one channel.
Image Reduced(const Image& image, int longest);

}  // namespace facet
